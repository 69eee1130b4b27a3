#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace depthmocap {

// The bytes of a C3D file as the processor that wrote them ordered them. Every access is checked: Error where the file
// is shorter.
class C3dBytes {
 public:
  enum class Processor { Intel = 84, Dec = 85, Mips = 86 };  // as files number them

  // Error if the file cannot be read or is larger than kMaxBytes.
  explicit C3dBytes(const std::filesystem::path& path);

  Processor processor = Processor::Intel;

  static constexpr std::uintmax_t kMaxBytes = std::uintmax_t{2} << 30U;

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::uint8_t byte(std::size_t at) const;
  [[nodiscard]] std::uint16_t word(std::size_t at) const;
  [[nodiscard]] std::int16_t signedWord(std::size_t at) const { return static_cast<std::int16_t>(word(at)); }
  [[nodiscard]] double number(std::size_t at) const;                         // 32-bit floating point
  [[nodiscard]] std::string text(std::size_t at, std::size_t length) const;  // without blanks at its end
  [[noreturn]] void fail(const std::string& what) const;

 private:
  void require(std::size_t at, std::size_t size) const;

  std::string bytes_;
  std::string where_;
};

}  // namespace depthmocap
