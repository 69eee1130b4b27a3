#include "libtracker/tracker/pose_fitter.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/actor/make_actor.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/posedb_build/build_pose_database.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr double kStature_m = 1.72;

// Somebody whole before a camera, with surface and markers where the true pose has them.
class ObservedSizeTest : public ::testing::Test {
 protected:
  ObservedSizeTest() : depth_(camera_.width, camera_.height, 0.0F) { region_.mask.reset(640, 480, 0); }

  // What is said of a body this much larger or smaller in the pose `truth`, where the pose `found` was solved.
  ObservedSize observe(const Pose& truth, double scale, const Pose& found) {
    const Actor actual = averageActor(averageBoneLengths(scale * kStature_m));
    Evidence evidence;
    evidence.markers_camera = evidence.markers_world = modelMarkers(actual, truth, fk_);
    fk_.update(actual.skeleton, truth);
    const double surface_scale = actual.stature_m() / actual.surface->stature_m;
    for (const auto& part : actual.surface->parts) {
      for (const SurfaceModel::Point& point : part) {
        const Eigen::Vector3d p = fk_.position({point.bone, surface_scale * point.p_bone.cast<double>()});
        const Eigen::Vector2d at = camera_.project(p);
        ClassifiedPixels::Pixel pixel;
        pixel.x = static_cast<std::int16_t>(std::lround(at.x()));
        pixel.y = static_cast<std::int16_t>(std::lround(at.y()));
        pixel.depth_m = static_cast<float>(p.z());
        evidence.pixels.pixels.push_back(pixel);
      }
    }
    fitter_.look(depth_, region_, camera_, Eigen::Matrix3d::Identity());
    return fitter_.observedSize(evidence, assumed_, found);
  }

  // 2.5 m before the camera, whose y axis points down.
  static Pose facingTheCamera() {
    Pose q = Pose::Zero();
    q[kRootTy] = -0.1;
    q[kRootTz] = 2.5;
    q[kRootRx] = std::numbers::pi;
    return q;
  }
  static Pose seated(double share = 1) {
    Pose q = facingTheCamera();
    q[kRfemurRx] = q[kLfemurRx] = -0.5 * std::numbers::pi * share;
    q[kRtibiaRx] = q[kLtibiaRx] = 0.5 * std::numbers::pi * share;
    return q;
  }

  CameraModel camera_;
  DepthImage depth_;
  PersonRegion region_;
  ForwardKinematics fk_;
  Actor assumed_ = averageActor(averageBoneLengths(kStature_m));
  PoseFitter fitter_{
      std::make_shared<const PoseDatabase>(buildPoseDatabase({proceduralMotion("idle", 1)}, {}).database), assumed_,
      TrackerConfig{}};
};

TEST_F(ObservedSizeTest, IsThatOfTheHeightWhereSomebodyStands) {
  for (const double scale : {0.9, 1.0, 1.1}) {
    const ObservedSize size = observe(facingTheCamera(), scale, facingTheCamera());
    EXPECT_TRUE(size.is_sure);
    EXPECT_NEAR(size.scale, scale, 0.03);
  }
}

TEST_F(ObservedSizeTest, IsNotSureOfSomebodyWhoSits) {
  const ObservedSize size = observe(seated(), 1.0, seated());
  EXPECT_FALSE(size.is_sure);
  EXPECT_NEAR(size.scale, 1.0, 0.03);
}

// Half seated, all of the missing height would make the body a sixth smaller.
TEST_F(ObservedSizeTest, ShrinksNobodyWhoIsTakenForStanding) {
  const ObservedSize size = observe(seated(), 1.0, seated(0.5));
  EXPECT_FALSE(size.is_sure);
  EXPECT_GT(size.scale, 0.92);
}

}  // namespace
}  // namespace depthmocap
