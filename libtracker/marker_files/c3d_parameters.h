#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libtracker/marker_files/c3d_bytes.h"

namespace depthmocap {

// The parameter section of a C3D file: values by "GROUP:NAME" in capitals.
class C3dParameters {
 public:
  // Finds out the processor, too. Error where the section is damaged.
  explicit C3dParameters(C3dBytes& bytes);

  // The first value of a number; nothing where the file does not have it.
  [[nodiscard]] std::optional<double> number(const std::string& name) const;
  // All 16-bit words of a value, without sign.
  [[nodiscard]] std::vector<std::uint16_t> words(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> texts(const std::string& name) const;

 private:
  struct Value {
    int type = 0;  // -1 characters, 1 bytes, 2 integers, 4 numbers
    std::vector<std::size_t> dimensions;
    std::size_t at = 0;     // of the data
    std::size_t count = 1;  // product of the dimensions
  };
  std::size_t add(std::size_t at, int group, const std::string& name);

  const C3dBytes& bytes_;
  std::map<int, std::string> groups_;
  std::vector<std::pair<std::pair<int, std::string>, Value>> found_;
  std::map<std::string, Value> values_;
};

}  // namespace depthmocap
