#include "libtracker/repair/marker_site.h"

#include <array>
#include <cctype>
#include <string>

namespace depthmocap {
namespace {

// [m] A joint of another tracker or a marker lies so far from the place that its name says.
constexpr double kJointDeviation_m = 0.02;
constexpr double kMarkerDeviation_m = 0.04;
// [m] Of a name of which only the beginning is known.
constexpr double kVagueDeviation_m = 0.08;

struct NamedSite {
  std::string_view name;
  MarkerSite site;
};

MarkerSite joint(Bone bone, double along = 0) {
  return {bone, along, Eigen::Vector3d::Zero(), kJointDeviation_m};
}
MarkerSite marker(Bone bone, double along, double x, double y, double z) {
  return {bone, along, {x, y, z}, kMarkerDeviation_m};
}

const auto kMiddle = std::to_array<NamedSite>({
    {"pelvis", joint(Bone::Root)},
    {"hips", joint(Bone::Root)},
    {"root", joint(Bone::Root)},
    {"spine", joint(Bone::UpperBack)},
    {"neck", joint(Bone::Neck)},
    {"head", joint(Bone::Head, 1)},
    {"c7", marker(Bone::UpperBack, 1, 0, -0.01, -0.07)},
    {"t10", marker(Bone::UpperBack, 0.3, 0, 0, -0.11)},
    {"clav", marker(Bone::UpperBack, 1, 0, -0.07, 0.06)},
    {"strn", marker(Bone::UpperBack, 0.4, 0, 0, 0.11)},
    {"sternum", marker(Bone::UpperBack, 0.6, 0, 0, 0.10)},
    {"sacr", marker(Bone::Root, 0, 0, 0.03, -0.11)},
    {"vsacral", marker(Bone::Root, 0, 0, 0.03, -0.11)},
    {"tophead", marker(Bone::Head, 1, 0, 0.12, 0)},
});

// Of the left side; the right one is its mirror image.
const auto kSided = std::to_array<NamedSite>({
    {"shoulder", joint(Bone::LeftHumerus)},
    {"elbow", joint(Bone::LeftRadius)},
    {"wrist", joint(Bone::LeftRadius, 1)},
    {"hip", joint(Bone::LeftFemur)},
    {"knee", joint(Bone::LeftTibia)},
    {"ankle", joint(Bone::LeftFoot)},
    {"toe", joint(Bone::LeftFoot, 1)},
    {"arm", joint(Bone::LeftHumerus)},
    {"upperarm", joint(Bone::LeftHumerus)},
    {"forearm", joint(Bone::LeftRadius)},
    {"lowerarm", joint(Bone::LeftRadius)},
    {"hand", joint(Bone::LeftRadius, 1)},
    {"upleg", joint(Bone::LeftFemur)},
    {"upperleg", joint(Bone::LeftFemur)},
    {"leg", joint(Bone::LeftTibia)},
    {"lowerleg", joint(Bone::LeftTibia)},
    {"foot", joint(Bone::LeftFoot)},
    {"toebase", joint(Bone::LeftFoot, 1)},
    {"fhd", marker(Bone::Head, 1, 0.07, 0.04, 0.09)},
    {"bhd", marker(Bone::Head, 1, 0.07, 0.03, -0.09)},
    {"sho", marker(Bone::LeftClavicle, 1, 0, 0.05, 0)},
    {"acromion", marker(Bone::LeftClavicle, 1, 0, 0.05, 0)},
    {"upa", marker(Bone::LeftHumerus, 0.5, 0, 0.03, -0.03)},
    {"elb", marker(Bone::LeftRadius, 0, 0, 0.04, 0)},
    {"frm", marker(Bone::LeftRadius, 0.5, 0, 0.03, 0)},
    {"fra", marker(Bone::LeftRadius, 0.5, 0, 0.03, 0)},
    {"wra", marker(Bone::LeftRadius, 1, 0, 0.03, 0)},
    {"wrb", marker(Bone::LeftRadius, 1, 0, -0.03, 0)},
    {"wri", marker(Bone::LeftRadius, 1, 0, 0, 0)},
    {"fin", marker(Bone::LeftRadius, 1, 0.09, 0, 0)},
    {"asi", marker(Bone::Root, 0, 0.12, 0.05, 0.09)},
    {"psi", marker(Bone::Root, 0, 0.05, 0.05, -0.10)},
    {"troc", marker(Bone::LeftFemur, 0, 0.08, 0, 0)},
    {"thi", marker(Bone::LeftFemur, 0.5, 0.07, 0, 0.02)},
    {"kne", marker(Bone::LeftTibia, 0, 0.05, 0, 0)},
    {"mkn", marker(Bone::LeftTibia, 0, -0.05, 0, 0)},
    {"tib", marker(Bone::LeftTibia, 0.5, 0.04, 0, 0.02)},
    {"shank", marker(Bone::LeftTibia, 0.5, 0.04, 0, 0.02)},
    {"ank", marker(Bone::LeftFoot, 0, 0.04, 0, 0)},
    {"man", marker(Bone::LeftFoot, 0, -0.04, 0, 0)},
    {"hee", marker(Bone::LeftFoot, 0, 0, -0.04, -0.05)},
    {"mt5", marker(Bone::LeftFoot, 1, 0.03, 0, -0.02)},
    {"mt1", marker(Bone::LeftFoot, 1, -0.03, 0, -0.01)},
});

std::string plain(std::string_view name) {
  if (const auto colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
  std::string result;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return result;
}

template <typename Table>
std::optional<MarkerSite> exactly(const Table& table, std::string_view name) {
  for (const NamedSite& entry : table) {
    if (entry.name == name) return entry.site;
  }
  return std::nullopt;
}

// The entry with the longest name that this name begins with.
template <typename Table>
std::optional<MarkerSite> beginning(const Table& table, std::string_view name) {
  const NamedSite* longest = nullptr;
  for (const NamedSite& entry : table) {
    if (entry.name.size() < 3 || !name.starts_with(entry.name)) continue;
    if (longest == nullptr || entry.name.size() > longest->name.size()) longest = &entry;
  }
  if (longest == nullptr) return std::nullopt;
  MarkerSite site = longest->site;
  site.deviation_m = kVagueDeviation_m;
  return site;
}

MarkerSite mirrored(MarkerSite site) {
  // Bones with two sides stand in pairs, the right one first and at an even place.
  const bool has_sides =
      site.bone != Bone::Root && site.bone != Bone::UpperBack && site.bone != Bone::Neck && site.bone != Bone::Head;
  if (has_sides) site.bone = static_cast<Bone>(static_cast<int>(site.bone) ^ 1);
  site.offset.x() = -site.offset.x();
  return site;
}

// The name without its side, and whether that is the right one; nothing if it names no side so.
struct Side {
  std::string_view mark;
  bool is_right;
};
constexpr std::array<Side, 4> kSides = {{{"left", false}, {"right", true}, {"l", false}, {"r", true}}};

template <typename Find>
std::optional<MarkerSite> onASide(std::string_view name, const Find& find) {
  for (const Side& side : kSides) {
    std::string_view rest = name;
    if (name.starts_with(side.mark)) {
      rest.remove_prefix(side.mark.size());
    } else if (name.ends_with(side.mark)) {
      rest.remove_suffix(side.mark.size());
    } else {
      continue;
    }
    if (auto site = find(rest)) return side.is_right ? mirrored(*site) : *site;
  }
  return std::nullopt;
}

Eigen::Vector3d endOf(Bone bone, const Skeleton& s) {
  const auto origin = [&](Bone child) { return s.offset[static_cast<std::size_t>(child)]; };
  switch (bone) {
    case Bone::Root:
      return origin(Bone::UpperBack);
    case Bone::UpperBack:
      return origin(Bone::Neck);
    case Bone::RightClavicle:
      return origin(Bone::RightHumerus);
    case Bone::LeftClavicle:
      return origin(Bone::LeftHumerus);
    case Bone::RightHumerus:
      return origin(Bone::RightRadius);
    case Bone::LeftHumerus:
      return origin(Bone::LeftRadius);
    case Bone::RightRadius:
      return s.right_wrist;
    case Bone::LeftRadius:
      return s.left_wrist;
    case Bone::Neck:
      return origin(Bone::Head);
    case Bone::Head:
      return s.head_center;
    case Bone::RightFemur:
      return origin(Bone::RightTibia);
    case Bone::LeftFemur:
      return origin(Bone::LeftTibia);
    case Bone::RightTibia:
      return origin(Bone::RightFoot);
    case Bone::LeftTibia:
      return origin(Bone::LeftFoot);
    case Bone::RightFoot:
      return s.right_toe;
    case Bone::LeftFoot:
      break;
  }
  return s.left_toe;
}

}  // namespace

BonePoint sitePoint(const MarkerSite& site, const Skeleton& skeleton) {
  return {site.bone, site.along * endOf(site.bone, skeleton) + site.offset};
}

std::optional<MarkerSite> siteNamed(std::string_view name) {
  const std::string words = plain(name);
  if (auto site = exactly(kMiddle, words)) return site;
  if (auto site = onASide(words, [](std::string_view rest) { return exactly(kSided, rest); })) return site;
  if (auto site = onASide(words, [](std::string_view rest) { return beginning(kSided, rest); })) return site;
  return beginning(kMiddle, words);
}

}  // namespace depthmocap
