#pragma once
#include <stdexcept>

// A condition that only a bug can break. Stays in Release builds. Not for user input: that is an Error.
#define DMC_CHECK(condition)                                                                                \
  do {                                                                                                      \
    if (!(condition)) throw std::logic_error(__FILE__ ": bug: the condition " #condition " does not hold"); \
  } while (false)
