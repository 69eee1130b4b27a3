#pragma once
#include <cstdint>
#include <optional>
#include <string_view>

namespace depthmocap {

// The text without spaces and tabs (and a carriage return) at its ends.
std::string_view trimmed(std::string_view text);

// The text after the byte order mark of UTF-8, which editors on Windows write first.
std::string_view withoutByteOrderMark(std::string_view text);

// The number that the whole of `text` spells (spaces around it are allowed); nothing if it spells none, or one that is
// not finite or does not fit. Independent of the locale.
std::optional<double> parseDouble(std::string_view text);
std::optional<std::int64_t> parseInteger(std::string_view text);

}  // namespace depthmocap
