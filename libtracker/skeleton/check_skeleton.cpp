#include "libtracker/skeleton/check_skeleton.h"

#include <algorithm>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

constexpr double kLongest_m = 3.0;  // longer than any bone, shorter than what makes sums inexact
constexpr const char* kAdvice = "take averageActor(), readActorFile() or a calibration's";

bool isPlausible(const Eigen::Vector3d& offset) {
  return offset.allFinite() && offset.norm() <= kLongest_m;
}

}  // namespace

void checkSkeleton(const Skeleton& s, const std::string& where) {
  for (std::size_t i = 0; i < kBoneLengthCount; ++i) {
    const double length = s.lengths.*kBoneLengthFields[i];
    if (length > 0 && length <= kLongest_m) continue;
    throw Error(fmt::format("{} must be above 0 and at most {} m, not {}", kBoneLengthNames[i], kLongest_m, length),
                where, kAdvice);
  }
  const bool joints = std::ranges::all_of(s.offset, isPlausible) && isPlausible(s.head_center) &&
                      isPlausible(s.right_wrist) && isPlausible(s.left_wrist) && isPlausible(s.right_toe) &&
                      isPlausible(s.left_toe);
  if (!joints) throw Error("a joint of the skeleton lies nowhere near it", where, kAdvice);
}

}  // namespace depthmocap
