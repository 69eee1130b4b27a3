#include "libtracker/marker_files/c3d_parameters.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace depthmocap {
namespace {

constexpr std::size_t kBlock = 512;        // [bytes]
constexpr std::size_t kMaxDimensions = 7;  // of a value, by the format
constexpr int kMaxRecords = 10000;         // groups and values; laboratories write some hundred

std::string capitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

// A byte that holds a number from -128 to 127.
int asSigned(int byte) {
  return byte < 128 ? byte : byte - 256;
}

}  // namespace

C3dParameters::C3dParameters(C3dBytes& bytes) : bytes_(bytes) {
  const std::size_t first_block = bytes.byte(0);
  if (bytes.byte(1) != 0x50 || first_block == 0) bytes.fail("is no C3D file");
  const std::size_t section = (first_block - 1) * kBlock;
  const int processor = bytes.byte(section + 3);
  if (processor < 84 || processor > 86) bytes.fail("was written by a processor of unknown kind");
  bytes.processor = static_cast<C3dBytes::Processor>(processor);
  std::size_t at = section + 4;
  for (int i = 0; i < kMaxRecords; ++i) {
    const int name_length = std::abs(asSigned(bytes.byte(at)));
    const int group = asSigned(bytes.byte(at + 1));
    if (name_length == 0 || group == 0) break;
    const std::string name = capitals(bytes.text(at + 2, static_cast<std::size_t>(name_length)));
    const std::size_t next_at = at + 2 + static_cast<std::size_t>(name_length);
    const std::size_t offset = bytes.word(next_at);
    if (group < 0) {
      groups_[-group] = name;
    } else {
      add(next_at + 2, group, name);
    }
    if (offset < 2) break;  // 0 ends the section
    at = next_at + offset;
  }
  for (const auto& [key, value] : found_) {
    if (groups_.contains(key.first)) values_[groups_[key.first] + ":" + key.second] = value;
  }
}

std::size_t C3dParameters::add(std::size_t at, int group, const std::string& name) {
  Value value;
  value.type = asSigned(bytes_.byte(at));
  const std::size_t dimensions = bytes_.byte(at + 1);
  if (dimensions > kMaxDimensions) bytes_.fail("has a value of more dimensions than the format allows");
  for (std::size_t i = 0; i < dimensions; ++i) {
    value.dimensions.push_back(bytes_.byte(at + 2 + i));
    value.count *= value.dimensions.back();
    if (value.count > bytes_.size()) bytes_.fail("has a value larger than the file");
  }
  value.at = at + 2 + dimensions;
  found_.push_back({{group, name}, value});
  return value.at;
}

std::optional<double> C3dParameters::number(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.count == 0) return std::nullopt;
  const Value& value = found->second;
  if (value.type == 4) return bytes_.number(value.at);
  if (value.type == 2) return bytes_.signedWord(value.at);
  if (value.type == 1) return bytes_.byte(value.at);
  return std::nullopt;
}

std::vector<std::uint16_t> C3dParameters::words(const std::string& name) const {
  std::vector<std::uint16_t> result;
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.type != 2) return result;
  for (std::size_t i = 0; i < found->second.count; ++i) result.push_back(bytes_.word(found->second.at + 2 * i));
  return result;
}

std::vector<std::string> C3dParameters::texts(const std::string& name) const {
  std::vector<std::string> result;
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.type != -1 || found->second.dimensions.empty()) return result;
  const std::size_t length = found->second.dimensions.front();
  if (length == 0) return result;
  for (std::size_t i = 0; i < found->second.count / length; ++i) {
    result.push_back(bytes_.text(found->second.at + i * length, length));
  }
  return result;
}

}  // namespace depthmocap
