#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace depthmocap {

// Takes the bytes of a binary file of ours from the front. All throw Error where the file does not hold what is taken.
class ByteReader {
 public:
  // `what` names the kind of file in errors: "the pose mixture". Error if the file cannot be opened.
  ByteReader(const std::filesystem::path& path, std::string what);

  void raw(void* to, std::size_t size);
  // A 32-bit number of things, at most `most`.
  std::uint32_t count(std::uint32_t most);
  // Whether at least so many bytes are left.
  void require(std::size_t size) const;
  // What a whole file fulfils; else it is damaged.
  void check(bool condition) const;
  // Nothing is left.
  void end() const { check(at_ == bytes_.size()); }

 private:
  std::string bytes_;
  std::string what_;
  std::string where_;
  std::size_t at_ = 0;
};

}  // namespace depthmocap
