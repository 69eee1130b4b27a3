#include "calibration/tpose_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr double kShoulderHeight = 0.815;  // share of the stature (Drillis and Contini 1966)
constexpr double kShortestSpan = 0.80;     // fingertip to fingertip over stature: less, and the arms are not out
constexpr double kHeadReach_m = 0.15;      // from the middle of the body to the sides: the head, not a hand above it
constexpr double kTipShare = 0.01;         // of the points: an outstretched hand
constexpr double kTrimmed = 0.0005;        // of the points at either end: stray ones
constexpr int kBorderPixels = 6;           // in the mask along a border: the body goes on outside
constexpr std::size_t kFewestPoints = 100;

double degrees(double rad) {
  return rad * 180.0 / std::numbers::pi;
}

// Mean of the points that lie farthest along x (sign +1) or against it.
Vector3d outermost(std::vector<Eigen::Vector3f> points, float sign) {
  const auto count =
      std::max<std::ptrdiff_t>(5, static_cast<std::ptrdiff_t>(kTipShare * static_cast<double>(points.size())));
  const auto by_x = [&](const auto& a, const auto& b) { return sign * a.x() > sign * b.x(); };
  std::nth_element(points.begin(), points.begin() + count, points.end(), by_x);
  Vector3d sum = Vector3d::Zero();
  for (auto p = points.begin(); p != points.begin() + count; ++p) sum += p->cast<double>();
  return sum / static_cast<double>(count);
}

struct BorderContact {
  int left = 0, right = 0, top = 0, bottom = 0;  // [px] of the mask along each border
};

BorderContact borderContact(const MaskImage& mask) {
  BorderContact contact;
  for (int x = 0; x < mask.width; ++x) {
    contact.top += mask.at(x, 0);
    contact.bottom += mask.at(x, mask.height - 1);
  }
  for (int y = 0; y < mask.height; ++y) {
    contact.left += mask.at(0, y);
    contact.right += mask.at(mask.width - 1, y);
  }
  return contact;
}

// The actor faces the camera: its left hand is on the right of the image.
std::string outOfImage(const MaskImage& mask) {
  const BorderContact contact = borderContact(mask);
  std::string parts;
  const auto add = [&](int pixels, const char* name) {
    if (pixels >= kBorderPixels) parts += (parts.empty() ? "" : " and ") + std::string(name);
  };
  add(contact.bottom, "the feet");
  add(contact.top, "the head");
  add(contact.right, "the left hand");
  add(contact.left, "the right hand");
  if (parts.empty()) return {};
  const bool many = parts.find(" and ") != std::string::npos || contact.bottom >= kBorderPixels;
  return parts + (many ? " are" : " is") + " out of the image: step back or move to its middle";
}

struct ArmAngle {
  double up;       // [rad] above the shoulder's height
  double reach_m;  // [m] from the middle of the body
};

ArmAngle armAngle(const Vector3d& hand, const BodyOutline& outline) {
  const double shoulder_y = outline.bottom + kShoulderHeight * outline.height();
  const double reach = std::hypot(hand.x() - outline.middle_x, hand.z() + outline.distance);
  return {std::atan2(hand.y() - shoulder_y, std::max(reach, 1e-3)), reach};
}

std::string armsNotLevel(const ArmAngle& left, const ArmAngle& right, double tolerance) {
  const auto say = [&](const char* side, const ArmAngle& arm) {
    return fmt::format("the {} hand is {:.0f} degrees {} the shoulders: {} it", side, degrees(std::abs(arm.up)),
                       arm.up < 0 ? "below" : "above", arm.up < 0 ? "raise" : "lower");
  };
  if (left.up < -tolerance && right.up < -tolerance) return "the arms are lower than the shoulders: raise both hands";
  if (left.up > tolerance && right.up > tolerance) return "the arms are higher than the shoulders: lower both hands";
  if (std::abs(left.up) > tolerance) return say("left", left);
  if (std::abs(right.up) > tolerance) return say("right", right);
  return {};
}

TPoseVerdict fault(TPoseFault which, const std::string& advice) {
  return {which, advice, 0};
}

TPoseVerdict checkPlace(const BodyOutline& outline, const TPoseCheckConfig& config) {
  if (outline.distance < config.min_distance_m) {
    return fault(TPoseFault::TooNear, fmt::format("too near, {:.1f} m: step back", outline.distance));
  }
  if (outline.distance > config.max_distance_m) {
    return fault(TPoseFault::TooFar, fmt::format("too far away, {:.1f} m: come nearer", outline.distance));
  }
  if (outline.height() < config.min_stature_m || outline.height() > config.max_stature_m) {
    return fault(TPoseFault::NoPersonsSize,
                 fmt::format("what stands there is {:.2f} m tall: no adult's size", outline.height()));
  }
  return {TPoseFault::None, {}, 0};
}

}  // namespace

void TPoseCheckConfig::validate() const {
  const char* name = "TPoseCheckConfig";
  checkConfig(tolerance_rad > 0 && tolerance_rad < 0.8, name, "tolerance_rad", tolerance_rad, "between 0 and 0.8");
  checkConfig(min_distance_m > 0, name, "min_distance_m", min_distance_m, "above 0");
  checkConfig(max_distance_m > min_distance_m, name, "max_distance_m", max_distance_m, "above min_distance_m");
  checkConfig(max_stature_m > min_stature_m, name, "max_stature_m", max_stature_m, "above min_stature_m");
}

BodyOutline measureOutline(const std::vector<Eigen::Vector3f>& points) {
  DMC_CHECK(points.size() >= kFewestPoints);
  const auto quantile = [&](int axis, double share, double reach_m, double middle_x) {
    std::vector<float> values;
    for (const auto& p : points) {
      if (std::abs(static_cast<double>(p.x()) - middle_x) < reach_m) values.push_back(p[axis]);
    }
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return static_cast<double>(*at);
  };
  constexpr double kEverything = 1e9;
  BodyOutline outline;
  outline.middle_x = quantile(0, 0.5, kEverything, 0.0);
  outline.bottom = quantile(1, kTrimmed, kEverything, 0.0);
  outline.top = quantile(1, 1.0 - kTrimmed, kHeadReach_m, outline.middle_x);  // not of raised hands
  outline.distance = -quantile(2, 0.5, kEverything, 0.0);
  outline.left_hand = outermost(points, 1.0F);
  outline.right_hand = outermost(points, -1.0F);
  return outline;
}

TPoseVerdict checkTPose(const MaskImage& mask, const BodyOutline& outline, const TPoseCheckConfig& config) {
  const std::string cut = outOfImage(mask);
  if (!cut.empty()) return fault(TPoseFault::OutOfImage, cut);
  TPoseVerdict place = checkPlace(outline, config);
  if (!place.good()) return place;

  const ArmAngle left = armAngle(outline.left_hand, outline);
  const ArmAngle right = armAngle(outline.right_hand, outline);
  const std::string uneven = armsNotLevel(left, right, config.tolerance_rad);
  const Vector3d span = outline.left_hand - outline.right_hand;
  const double turned = std::atan2(span.z(), span.x());
  if (std::abs(turned) > config.tolerance_rad && span.norm() > kShortestSpan * outline.height()) {
    // Positive: the actor's left hand is nearer to the camera, so it has turned to its right.
    return fault(TPoseFault::Turned, fmt::format("turned by {:.0f} degrees: turn to your {} until you face the camera",
                                                 degrees(std::abs(turned)), turned > 0 ? "left" : "right"));
  }
  if (!uneven.empty()) return fault(TPoseFault::ArmsNotLevel, uneven);
  if (span.norm() < kShortestSpan * outline.height()) {
    return fault(TPoseFault::ArmsNotOut, "the arms are not stretched out: stretch both to the sides");
  }
  return {TPoseFault::None, {}, std::max({std::abs(left.up), std::abs(right.up), std::abs(turned)})};
}

}  // namespace depthmocap
