#include "forest/train/joint_hits.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "depthmocap/error.h"
#include "depthmocap/parts.h"
#include "libtracker/classify/classify.h"
#include "libtracker/classify/label_image.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {
namespace {

constexpr int kReach_px = 2;

using PartsAtJoint = std::array<Part, 3>;

// The parts that meet at each joint, in the order of Joint; None fills the lists.
constexpr std::array<PartsAtJoint, kJointCount> kPartsAtJoint = {{
    {},
    {},
    {Part::Neck, Part::Head, Part::Torso},
    {Part::Head},
    {Part::LeftShoulder, Part::LeftUpperArm},
    {Part::LeftUpperArm, Part::LeftLowerArm},
    {Part::LeftLowerArm},
    {Part::RightShoulder, Part::RightUpperArm},
    {Part::RightUpperArm, Part::RightLowerArm},
    {Part::RightLowerArm},
    {Part::LeftWaist, Part::LeftUpperLeg},
    {Part::LeftUpperLeg, Part::LeftLowerLeg},
    {Part::LeftLowerLeg},
    {},
    {Part::RightWaist, Part::RightUpperLeg},
    {Part::RightUpperLeg, Part::RightLowerLeg},
    {Part::RightLowerLeg},
    {},
}};

PartImage classifiedParts(const Forest& forest, const DepthImage& depth, double focal_px) {
  MaskImage mask(depth.width, depth.height, 0);
  for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = depth.data[i] > 0.0F ? 1 : 0;
  ClassifiedPixels pixels;
  classify(forest, depth, mask, focal_px, {.stride = 1}, pixels);
  PartImage labels;
  labelImage(pixels, mask, labels);
  return labels;
}

bool isHit(const PartImage& labels, int x, int y, const PartsAtJoint& parts) {
  for (int row = y - kReach_px; row <= y + kReach_px; ++row) {
    for (int column = x - kReach_px; column <= x + kReach_px; ++column) {
      if (!labels.contains(column, row)) continue;
      const auto label = static_cast<Part>(labels.at(column, row));
      if (label != Part::None && std::find(parts.begin(), parts.end(), label) != parts.end()) return true;
    }
  }
  return false;
}

void addFrame(const PartImage& labels, const CameraModel& camera, const JointPositions& joints, JointHits& hits) {
  for (std::size_t j = 0; j < kPartsAtJoint.size(); ++j) {
    if (kPartsAtJoint[j][0] == Part::None) continue;
    const Eigen::Vector2d px = camera.project(joints.col(static_cast<Eigen::Index>(j)));
    ++hits.all[j];
    const auto x = static_cast<int>(std::lround(px.x()));
    const auto y = static_cast<int>(std::lround(px.y()));
    hits.hit[j] += isHit(labels, x, y, kPartsAtJoint[j]) ? 1 : 0;
  }
}

}  // namespace

void JointHits::add(const JointHits& other) {
  for (std::size_t j = 0; j < all.size(); ++j) {
    hit[j] += other.hit[j];
    all[j] += other.all[j];
  }
}

double JointHits::shareOf(Joint joint) const {
  const auto j = static_cast<std::size_t>(joint);
  return all[j] == 0 ? 0.0 : static_cast<double>(hit[j]) / all[j];
}

double JointHits::meanShare() const {
  double sum = 0;
  int joints = 0;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (all[j] == 0) continue;
    sum += shareOf(static_cast<Joint>(j));
    ++joints;
  }
  return joints == 0 ? 0.0 : sum / joints;
}

JointHits measureJointHits(const Forest& forest, const std::filesystem::path& recording, int step) {
  if (step < 1) throw Error("every 0-th frame cannot be taken", "step", "use 1 or more");
  std::map<std::int64_t, JointPositions> reference;
  for (const JointsRow& row : readJointsFile(recording / "reference" / "joints.csv")) {
    if (row.state == TrackState::Tracking && row.frame % step == 0) reference[row.frame] = row.p_camera;
  }
  const auto reader = openRecording(recording);
  JointHits hits;
  DepthFrame frame;
  for (std::size_t i = 0; i < reader->frameCount(); ++i) {
    reader->read(i, frame);
    const auto joints = reference.find(frame.frame);
    if (joints == reference.end()) continue;
    const CameraModel& camera = reader->info().camera;
    addFrame(classifiedParts(forest, frame.depth, camera.fx), camera, joints->second, hits);
  }
  return hits;
}

}  // namespace depthmocap
