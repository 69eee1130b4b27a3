#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace depthmocap {

// Reads a comma-separated file line by line: blank lines and lines that start with '#' are skipped, fields are trimmed,
// there is no quoting. A byte order mark at the start is passed over. Memory is bounded by the longest line allowed
// (64 KiB). Every complaint is an Error that names file and line.
class CsvReader {
 public:
  // A separator: any number of blanks and tabs.
  static constexpr char kBlanks = ' ';

  explicit CsvReader(const std::filesystem::path& path, char separator = ',');

  // Takes the next line as the header. Its first columns must be these; more may follow.
  void readHeader(const std::vector<std::string>& columns);
  // Moves to the next row; false at the end of the file. A row with fewer fields than the header asked for is an Error.
  bool next();

  [[nodiscard]] std::size_t fieldCount() const { return fields_.size(); }
  // Field i in [0, fieldCount()) of the current row; valid until next().
  [[nodiscard]] std::string_view field(std::size_t i) const { return fields_[i]; }
  [[nodiscard]] double number(std::size_t i) const;  // finite
  [[nodiscard]] std::int64_t integer(std::size_t i) const;
  // Throws Error(what) located at the current line.
  [[noreturn]] void fail(const std::string& what) const;

 private:
  bool readLine();
  [[nodiscard]] std::string columnName(std::size_t i) const;

  std::filesystem::path path_;
  std::ifstream stream_;
  char separator_;
  std::size_t line_number_ = 0;
  std::vector<char> buffer_;  // holds the current line
  std::string_view line_;
  std::vector<std::string_view> fields_;
  std::vector<std::string> columns_;
};

}  // namespace depthmocap
