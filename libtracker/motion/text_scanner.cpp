#include "libtracker/motion/text_scanner.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/core/printable.h"

namespace depthmocap {

namespace {
constexpr std::size_t kShownBytes = 40;  // of a damaged word, in a message
}  // namespace

TextScanner::TextScanner(const std::filesystem::path& path, std::string_view extra_separators, char comment)
    : path_(path.string()),
      text_(readFile(path, "the motion file", kMaxBytes)),
      separators_(extra_separators),
      comment_(comment) {
  position_ = text_.size() - withoutByteOrderMark(text_).size();
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
    throw Error("the file is UTF-16 text", path_, "save it as plain text (UTF-8)");
  }
}

void TextScanner::mendDecimalCommas() {
  constexpr std::size_t kTail = 4096;  // [bytes] enough for some numbers of the last rows
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  bool commas = false;
  int in_word = 0;
  for (std::size_t i = text_.size() > kTail ? text_.size() - kTail : 1; i + 1 < text_.size(); ++i) {
    const char c = text_[i];
    if (isSeparator(c) && c != ',') in_word = 0;
    if (c == '.') return;
    if (c != ',') continue;
    if (++in_word > 1 || !isDigit(text_[i - 1]) || !isDigit(text_[i + 1])) return;
    commas = true;
  }
  if (commas) std::replace(text_.begin(), text_.end(), ',', '.');
}

bool TextScanner::isSeparator(char c) const {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\0' || separators_.find(c) != std::string::npos;
}

void TextScanner::findNext() {
  if (has_next_) return;
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '\n' || (c == '\r' && (position_ + 1 == text_.size() || text_[position_ + 1] != '\n'))) {
      ++position_line_;
      ++position_;
    } else if (comment_ != 0 && c == comment_) {
      position_ = std::min(text_.find_first_of("\r\n", position_), text_.size());
    } else if (isSeparator(c)) {
      ++position_;
    } else {
      break;
    }
  }
  const std::size_t begin = position_;
  while (position_ < text_.size() && !isSeparator(text_[position_]) &&
         (comment_ == 0 || text_[position_] != comment_)) {
    ++position_;
  }
  next_ = std::string_view(text_).substr(begin, position_ - begin);
  next_line_ = position_line_;
  has_next_ = true;
}

bool TextScanner::atEnd() {
  return peek().empty();
}

std::string_view TextScanner::peek() {
  findNext();
  return next_;
}

std::string_view TextScanner::take(std::string_view expected) {
  findNext();
  line_ = next_line_;
  if (next_.empty()) fail(fmt::format("the file ends where {} should stand", expected), "is the file complete?");
  has_next_ = false;
  return next_;
}

double TextScanner::takeNumber(std::string_view expected) {
  return number(take(expected), expected);
}

void TextScanner::takeLine(std::vector<std::string_view>& words) {
  words.clear();
  findNext();
  line_ = next_line_;
  takeRestOfLine(words);
}

void TextScanner::takeRestOfLine(std::vector<std::string_view>& words) {
  words.clear();
  for (findNext(); !next_.empty() && next_line_ == line_; findNext()) {
    words.push_back(next_);
    has_next_ = false;
  }
}

double TextScanner::number(std::string_view word, std::string_view expected) const {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // A number too small for a double is zero, as in files that print rounding noise.
  const bool underflow = result.ec == std::errc::result_out_of_range && digits.find("e-") != std::string_view::npos;
  if (underflow && result.ptr == digits.data() + digits.size()) return 0.0;
  if (result.ec != std::errc{} || result.ptr != digits.data() + digits.size() || !std::isfinite(value)) {
    fail(fmt::format("'{}' stands where {} should stand", printable(word, kShownBytes), expected));
  }
  if (std::abs(value) > kMaxMagnitude) fail(fmt::format("the number {} is out of range", printable(word, kShownBytes)));
  return value;
}

void TextScanner::checkJointFrames(std::size_t count) const {
  constexpr std::size_t kBytesAJoint = 6;            // "0 0 0 ", three angles as short as they can be
  constexpr std::size_t kStandingStill = 1'000'000;  // joints times frames of a motion with joints that never move
  if (count <= kStandingStill + text_.size() / kBytesAJoint) return;
  fail("the motion has far more frames of joints than values", "are most of the joints without channels?");
}

void TextScanner::fail(const std::string& what, const std::string& advice) const {
  throw Error(what, fmt::format("{}:{}", path_, line_), advice);
}

std::string lowerCase(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

}  // namespace depthmocap
