#include "libtracker/core/csv.h"

#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/core/printable.h"

namespace depthmocap {

namespace {

constexpr std::size_t kLongestLine = std::size_t{64} << 10U;
constexpr std::size_t kShownCharacters = 40;

// A piece of a damaged file, for a message.
std::string shown(std::string_view text) {
  return fmt::format("'{}'", printable(text, kShownCharacters));
}

void split(std::string_view line, char separator, std::vector<std::string_view>& fields) {
  fields.clear();
  const std::string_view ends = separator == CsvReader::kBlanks ? " \t" : std::string_view(&separator, 1);
  while (true) {
    const std::size_t end = line.find_first_of(ends);
    fields.push_back(trimmed(line.substr(0, end)));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
    if (separator == CsvReader::kBlanks) line = trimmed(line);
  }
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& path, char separator)
    : path_(path), stream_(path, std::ios::binary), separator_(separator), buffer_(kLongestLine) {
  if (std::filesystem::is_directory(path)) throw Error("is a folder, not a file", path.string());
  if (!stream_) throw Error(std::string("cannot be read: ") + std::strerror(errno), path.string());
}

void CsvReader::readHeader(const std::vector<std::string>& columns) {
  if (!next()) throw Error("is empty: the header row is missing", path_.string());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i >= fields_.size()) fail("column " + std::to_string(i + 1) + " '" + columns[i] + "' is missing in the header");
    if (fields_[i] != columns[i]) {
      fail("column " + std::to_string(i + 1) + " must be '" + columns[i] + "', not " + shown(fields_[i]));
    }
  }
  columns_ = columns;
}

bool CsvReader::next() {
  while (readLine()) {
    const std::string_view text = trimmed(line_);
    if (text.empty() || text.front() == '#') continue;
    split(text, separator_, fields_);
    if (fields_.size() < columns_.size()) {
      fail("has " + std::to_string(fields_.size()) + " fields, but " + std::to_string(columns_.size()) + " are needed");
    }
    return true;
  }
  if (stream_.bad()) throw Error("cannot be read to its end", path_.string());
  return false;
}

bool CsvReader::readLine() {
  stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  const auto taken = static_cast<std::size_t>(stream_.gcount());
  ++line_number_;
  if (stream_.fail() && !stream_.eof() && taken > 0) fail("is too long");
  if (stream_.fail()) return false;
  line_ = {buffer_.data(), taken - (stream_.eof() ? 0 : 1)};  // gcount() counts the line's end, if there was one
  if (line_number_ == 1) line_ = withoutByteOrderMark(line_);
  return true;
}

double CsvReader::number(std::size_t i) const {
  const auto value = parseDouble(fields_[i]);
  if (!value) fail(columnName(i) + " must be a number, not " + shown(fields_[i]));
  return *value;
}

std::int64_t CsvReader::integer(std::size_t i) const {
  const auto value = parseInteger(fields_[i]);
  if (!value) fail(columnName(i) + " must be a whole number, not " + shown(fields_[i]));
  return *value;
}

std::string CsvReader::columnName(std::size_t i) const {
  return i < columns_.size() ? columns_[i] : "field " + std::to_string(i + 1);
}

void CsvReader::fail(const std::string& what) const {
  throw Error("line " + std::to_string(line_number_) + ": " + what, path_.string());
}

}  // namespace depthmocap
