#include "libtracker/choreography/procedural_motions.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/choreography/body_solver.h"
#include "libtracker/choreography/motion_library.h"
#include "libtracker/choreography/motion_reader.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

const std::vector<MotionClip>& clips() {
  static const std::vector<MotionClip> all = proceduralMotions(1);
  return all;
}

bool startsWith(const std::string& name, std::string_view prefix) {
  return name.rfind(prefix, 0) == 0;
}
bool leavesTheFloor(const MotionClip& clip) {
  for (const char* prefix : {"run", "jog", "jump", "hop", "skip"}) {
    if (clip.name.find(prefix) != std::string::npos) return true;
  }
  return false;
}
bool climbs(const MotionClip& clip) {
  return clip.name.find("stairs") != std::string::npos || startsWith(clip.name, "climb");
}

TEST(ProceduralMotions, NamesAreUniqueAndMatchTheClips) {
  const auto names = proceduralMotionNames();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  ASSERT_EQ(names.size(), clips().size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(names[i], clips()[i].name);
}

TEST(ProceduralMotions, EveryMotionFileIsBuiltIn) {
  std::set<std::string> built_in;
  for (const MotionFile& file : motionLibrary()) {
    for (const MotionScript& motion : file.motions) built_in.insert(motion.name);
  }
  const std::filesystem::path folder(DEPTHMOCAP_SOURCE_DIR "/libtracker/choreography/motions");
  const auto text = [](const std::filesystem::path& path) {
    std::ifstream stream(path);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const MotionFile shared = readMotionFile(text(folder / "shared.json"), "shared.json");
  std::size_t motions = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename() == "shared.json") continue;
    for (const MotionScript& motion : readMotionFile(text(entry.path()), entry.path(), shared).motions) {
      EXPECT_TRUE(built_in.contains(motion.name)) << entry.path() << " " << motion.name;
      ++motions;
    }
  }
  EXPECT_EQ(motions, built_in.size());
}

TEST(ProceduralMotions, UnknownNameSuggestsANearOne) {
  try {
    proceduralMotion("walk_fats", 1);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("walk_fast"), std::string::npos) << error.what();
  }
}

TEST(ProceduralMotions, OneMotionIsTheSameAloneAndAmongAll) {
  for (std::size_t i = 0; i < clips().size(); i += 7) {
    const MotionClip alone = proceduralMotion(clips()[i].name, 1);
    ASSERT_EQ(alone.poses.size(), clips()[i].poses.size());
    for (std::size_t t = 0; t < alone.poses.size(); ++t) ASSERT_EQ(alone.poses[t], clips()[i].poses[t]);
  }
}

// A number that any change of a pose, of the order of draws or of the tempo changes.
double digest(const MotionClip& clip) {
  double sum = 0;
  for (std::size_t t = 0; t < clip.poses.size(); ++t) {
    const double late = static_cast<double>(t + 1) / static_cast<double>(clip.poses.size());
    for (int i = 0; i < kDofCount; ++i) sum += (i + 1) * late * clip.poses[t][i];
  }
  return sum;
}

// Every kind of step and several motions of each file, as they were when motions were C++ (0.1.0). Another choreography
// changes the pose database that ships: a change here is deliberate.
TEST(ProceduralMotions, ASampleIsPerformedAsEver) {
  struct Sample {
    std::string name;
    std::size_t frames;
    double digest;
  };
  const Sample samples[] = {
      {"walk_2", 121, 1690.340438428},
      {"run_3", 76, 2295.365493697},
      {"walk_to_and_fro", 217, 3795.127829336},
      {"jump_turn", 173, 4795.287296317},
      {"kick_roundhouse_3", 117, 2117.057312819},
      {"clap_3", 191, -2260.478455445},
      {"draw_zigzag", 188, 1660.144471521},
      {"free_lines_2", 244, -520.993705257},
      {"tennis_serve_2", 186, 672.201955681},
      {"climb_ladder", 152, -1994.387496761},
      {"stairs_down", 136, 973.426520203},
      {"sit_and_talk", 167, 1062.547342986},
      {"balance_one_leg_3", 234, -890.745065748},
      {"idle_2", 192, 1469.747353940},
      {"turn_around_2", 140, -24.448301711},
      {"dance_freestyle_4", 174, -725.532806534},
      {"dance_walk", 196, -1622.270716462},
  };
  for (const Sample& sample : samples) {
    const MotionClip clip = proceduralMotion(sample.name, 1);
    EXPECT_EQ(clip.poses.size(), sample.frames) << sample.name;
    EXPECT_NEAR(digest(clip), sample.digest, 1e-6) << sample.name;
  }
}

TEST(ProceduralMotions, AnotherSeedGivesAnotherPerformance) {
  const MotionClip a = proceduralMotion("walk", 1);
  const MotionClip b = proceduralMotion("walk", 2);
  EXPECT_GT((a.poses[10] - b.poses[10]).norm(), 0.05);
}

TEST(ProceduralMotions, StaysWithinJointLimits) {
  for (const MotionClip& clip : clips()) {
    for (std::size_t t = 0; t < clip.poses.size(); ++t) {
      const Pose& q = clip.poses[t];
      ASSERT_TRUE(q.allFinite()) << clip.name << " " << t;
      for (int i = kFirstBodyDof; i < kDofCount; ++i) {
        ASSERT_GE(q[i], jointLimits().lower[i])
            << clip.name << " " << t << " " << kDofNames[static_cast<std::size_t>(i)];
        ASSERT_LE(q[i], jointLimits().upper[i])
            << clip.name << " " << t << " " << kDofNames[static_cast<std::size_t>(i)];
      }
    }
  }
}

TEST(ProceduralMotions, MovesAtHumanSpeeds) {
  constexpr double kFastest = 20.0;     // [rad/s] kicks, punches and swings
  constexpr double kFastestRoot = 4.5;  // [m/s]
  for (const MotionClip& clip : clips()) {
    EXPECT_GE(clip.poses.size(), 40U) << clip.name;
    for (std::size_t t = 1; t < clip.poses.size(); ++t) {
      const Pose step = (clip.poses[t] - clip.poses[t - 1]) * clip.fps;
      int dof = 0;
      const double speed = step.tail<kDofCount - kFirstRotationDof>().cwiseAbs().maxCoeff(&dof);
      ASSERT_LT(speed, kFastest) << clip.name << " " << t << " "
                                 << kDofNames[static_cast<std::size_t>(dof + kFirstRotationDof)];
      ASSERT_LT(step.head<3>().norm(), kFastestRoot) << clip.name << " " << t;
    }
  }
}

// Directions from the shoulder to the wrist in the upper back's frame, in cells of 30 degrees: 12 around the vertical,
// 6 up.
int armCell(const Skeleton& skeleton, const Pose& q, Bone humerus, const BonePoint& wrist) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  Eigen::Vector3d d = fk.R_world_bone(Bone::UpperBack).transpose() * (fk.position(wrist) - fk.origin(humerus));
  d.normalize();
  constexpr double kCell = 3.14159265358979 / 6.0;
  const int around = std::clamp(static_cast<int>((std::atan2(d.x(), d.z()) + 6 * kCell) / kCell), 0, 11);
  const int up = std::clamp(static_cast<int>((std::asin(std::clamp(d.y(), -1.0, 1.0)) + 3 * kCell) / kCell), 0, 5);
  return 12 * up + around;
}

TEST(ProceduralMotions, ArmsCoverTheSphereOfTheShoulder) {
  std::vector<int> left(72), right(72);
  for (const MotionClip& clip : clips()) {
    const Skeleton skeleton = makeSkeleton(clip.lengths);
    for (std::size_t t = 0; t < clip.poses.size(); t += 3) {
      ++left[static_cast<std::size_t>(
          armCell(skeleton, clip.poses[t], Bone::LeftHumerus, {Bone::LeftRadius, skeleton.left_wrist}))];
      ++right[static_cast<std::size_t>(
          armCell(skeleton, clip.poses[t], Bone::RightHumerus, {Bone::RightRadius, skeleton.right_wrist}))];
    }
  }
  // No arm reaches behind the body across the other side: about a quarter of the sphere stays empty.
  for (const auto* cells : {&left, &right}) {
    EXPECT_GE(std::count_if(cells->begin(), cells->end(), [](int n) { return n >= 5; }), 50);
  }
}

TEST(ProceduralMotions, TheBodyBendsTurnsKicksAndCrouches) {
  Pose lowest = Pose::Constant(1e9);
  Pose highest = Pose::Constant(-1e9);
  std::size_t frames = 0;
  for (const MotionClip& clip : clips()) {
    frames += clip.poses.size();
    for (const Pose& q : clip.poses) {
      lowest = lowest.cwiseMin(q);
      highest = highest.cwiseMax(q);
    }
  }
  EXPECT_GT(frames, 15000U);
  const double root_height = standingPelvisHeight(makeSkeleton(BoneLengths{}));
  EXPECT_LT(lowest[kRootTy], root_height - 0.45);
  EXPECT_GT(highest[kRootTy], root_height + 0.25);
  EXPECT_GT(highest[kRootRx], 1.0);
  EXPECT_GT(highest[kHeadRy], 0.9);
  EXPECT_GT(highest[kUpperbackRy], 0.6);
  EXPECT_LT(lowest[kRfemurRx], -1.6);
  EXPECT_GT(highest[kRtibiaRx], 2.0);
  EXPECT_LT(lowest[kRfemurRz], -0.7);
}

// Lowest point of both soles [m].
double lowestSole(const Skeleton& skeleton, const Pose& q) {
  const Sole sole = soleOf(skeleton);
  ForwardKinematics fk;
  fk.update(skeleton, q);
  double lowest = 1e9;
  for (const Bone foot : {Bone::LeftFoot, Bone::RightFoot}) {
    for (const Eigen::Vector3d& point : {sole.toe, sole.heel}) {
      const double below = point == sole.toe ? sole.ball.y() - sole.toe.y() : 0.0;
      lowest = std::min(lowest, fk.position({foot, point}).y() + below);
    }
  }
  return lowest;
}

TEST(ProceduralMotions, StandsOnTheFloor) {
  for (const MotionClip& clip : clips()) {
    if (climbs(clip)) continue;
    const Skeleton skeleton = makeSkeleton(clip.lengths);
    for (std::size_t t = 0; t < clip.poses.size(); ++t) {
      const double lowest = lowestSole(skeleton, clip.poses[t]);
      ASSERT_GT(lowest, -0.02) << clip.name << " " << t;
      ASSERT_LT(lowest, leavesTheFloor(clip) ? 0.8 : 0.02) << clip.name << " " << t;
    }
  }
}

TEST(ProceduralMotions, PlantedToesDoNotSlide) {
  for (const MotionClip& clip : clips()) {
    if (climbs(clip)) continue;
    const Skeleton skeleton = makeSkeleton(clip.lengths);
    const Sole sole = soleOf(skeleton);
    const double toe_height = sole.toe.y() - sole.ball.y();
    // [m a frame] a kicker's standing foot turns on the floor; a walker's does not.
    const double limit = startsWith(clip.name, "walk") ? 0.004 : 0.02;
    for (const auto& [toe, ankle] :
         {std::pair{Joint::LeftToe, Joint::LeftAnkle}, {Joint::RightToe, Joint::RightAnkle}}) {
      JointPositions last = jointPositions(skeleton, clip.poses[0]);
      for (std::size_t t = 1; t < clip.poses.size(); ++t) {
        const JointPositions now = jointPositions(skeleton, clip.poses[t]);
        const Eigen::Vector3d a = last.col(static_cast<int>(toe));
        const Eigen::Vector3d b = now.col(static_cast<int>(toe));
        const bool planted = a.y() < toe_height + 2e-4 && b.y() < toe_height + 2e-4;
        ASSERT_LT(planted ? (a - b).norm() : 0.0, limit) << clip.name << " " << t;
        last = now;
      }
    }
  }
}

}  // namespace
}  // namespace depthmocap
