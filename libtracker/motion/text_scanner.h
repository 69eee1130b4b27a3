#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/core/read_file.h"

namespace depthmocap {

// A motion file as words with line numbers. Lines end as on Unix, Windows or the old Macintosh; a UTF-8 byte order mark
// is passed over, UTF-16 an Error. Blanks and tabs separate words, and so do the extra separators; from the comment
// sign (0: none) to the end of the line is nothing. Every failure is an Error that names file:line. The views stay
// valid as long as the scanner lives.
class TextScanner {
 public:
  // Reads the whole file; Error where that fails or the file is larger than kMaxBytes.
  TextScanner(const std::filesystem::path& path, std::string_view extra_separators, char comment);

  // Makes commas decimal points where the numbers at the end of the file are written so: each word there has at most
  // one comma, between digits, and none has a point. Before the first word is taken.
  void mendDecimalCommas();

  static constexpr std::size_t kMaxBytes = mebibytes(256);  // an hour of a BVH with 30 joints at 60 fps

  [[nodiscard]] bool atEnd();
  // The next word, without taking it; empty at the end of the file.
  std::string_view peek();
  // Takes the next word; Error at the end of the file, saying what was expected.
  std::string_view take(std::string_view expected);
  // Takes the next word as a number: finite and at most kMaxMagnitude in size.
  double takeNumber(std::string_view expected);
  // Takes the words from here to the end of the line that the next word stands on.
  void takeLine(std::vector<std::string_view>& words);
  // Takes the words that still stand on the line of the last word taken.
  void takeRestOfLine(std::vector<std::string_view>& words);

  // A word already taken as a number, with the same rules.
  [[nodiscard]] double number(std::string_view word, std::string_view expected) const;
  // Fails where so many joints times frames are far more than a file of this size can spell, so that a short file does
  // not take much memory: few joints of a motion stand still.
  void checkJointFrames(std::size_t count) const;
  // Throws the Error for the line of the last word taken.
  [[noreturn]] void fail(const std::string& what, const std::string& advice = {}) const;
  // Line of the last word taken, from 1.
  [[nodiscard]] int line() const { return line_; }

  static constexpr double kMaxMagnitude = 1e7;

 private:
  [[nodiscard]] bool isSeparator(char c) const;
  void findNext();

  std::string path_;
  std::string text_;
  std::string separators_;
  char comment_;
  std::size_t position_ = 0;
  int position_line_ = 1;
  int line_ = 1;
  bool has_next_ = false;
  std::string_view next_;
  int next_line_ = 1;
};

// The word in lower case (ASCII).
std::string lowerCase(std::string_view word);

}  // namespace depthmocap
