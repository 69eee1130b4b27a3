#include "libtracker/skeleton/length_vector.h"

namespace depthmocap {

LengthVector lengthVector(const BoneLengths& lengths) {
  LengthVector s;
  for (int i = 0; i < kBoneLengthCount; ++i) s[i] = lengths.*kBoneLengthFields[static_cast<std::size_t>(i)];
  return s;
}

BoneLengths boneLengths(const LengthVector& s) {
  BoneLengths lengths;
  for (int i = 0; i < kBoneLengthCount; ++i) lengths.*kBoneLengthFields[static_cast<std::size_t>(i)] = s[i];
  return lengths;
}

}  // namespace depthmocap
