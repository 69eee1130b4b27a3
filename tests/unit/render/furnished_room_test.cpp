#include "forest/render/furnished_room.h"

#include <gtest/gtest.h>

#include "forest/render/room_occupancy.h"
#include "libtracker/skeleton/typical_bone_lengths.h"
#include "tests/unit/render/test_meshes.h"

namespace depthmocap {
namespace {

constexpr double kFloor = -1.0;
const CameraModel kCamera{.width = 160, .height = 120, .fx = 144.0, .fy = 144.0, .cx = 79.5, .cy = 59.5};

class FurnishedRoom : public ::testing::Test {
 protected:
  FurnishedRoom() {
    Pose q = Pose::Zero();
    q[kRootTz] = -2.7;
    q[kRootTy] = kFloor + 0.95;
    poses_.push_back(q);
    people_.floor_y = kFloor;
    people_.skeleton = &skeleton_;
    people_.actor = poses_;
  }

  TriangleMesh make(SceneKind kind, std::uint64_t seed) const {
    Random random(seed);
    return makeFurnishedRoom(kind, people_, random);
  }
  [[nodiscard]] RenderedView see(const TriangleMesh& room) const {
    DepthRenderer renderer;
    renderer.setBackground(room);
    RenderedView view;
    renderer.render(kCamera, testing::uprightCamera(), {}, view);
    return view;
  }
  // How many of the actor's points the room hides.
  [[nodiscard]] int hidden(const TriangleMesh& room) const {
    const RenderedView view = see(room);
    int count = 0;
    for (const Eigen::Vector3d& p : bodyPoints(skeleton_, poses_)) {
      const Eigen::Vector3d c(p.x(), -p.y(), -p.z());
      const Eigen::Vector2d uv = kCamera.project(c);
      const int x = static_cast<int>(std::lround(uv.x()));
      const int y = static_cast<int>(std::lround(uv.y()));
      if (!view.depth.contains(x, y)) continue;
      count += view.depth.at(x, y) < c.z() - 0.02 ? 1 : 0;
    }
    return count;
  }

  const Skeleton skeleton_ = makeSkeleton(typicalBoneLengths(Sex::Male, 1.75));
  std::vector<Pose> poses_;
  RoomPeople people_;
};

TEST_F(FurnishedRoom, SeedsGiveDifferentRooms) {
  EXPECT_EQ(make(SceneKind::Sofa, 4).vertices, make(SceneKind::Sofa, 4).vertices);
  EXPECT_NE(make(SceneKind::Sofa, 4).vertices, make(SceneKind::Sofa, 5).vertices);
}

TEST_F(FurnishedRoom, IsClosed) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const float depth : see(make(SceneKind::Cluttered, seed)).depth.data) ASSERT_GT(depth, 0.0F);
  }
}

TEST_F(FurnishedRoom, NothingHidesTheActorButWhatIsMeantTo) {
  int behind_sofa = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const SceneKind kind : {SceneKind::Sofa, SceneKind::Bed, SceneKind::Chair, SceneKind::Corner}) {
      EXPECT_EQ(hidden(make(kind, seed)), 0) << kSceneNames[static_cast<std::size_t>(kind)] << ' ' << seed;
    }
    behind_sofa += hidden(make(SceneKind::BehindSofa, seed)) > 4 ? 1 : 0;
  }
  EXPECT_GT(behind_sofa, 15);
}

TEST_F(FurnishedRoom, SeatsCarryWhoSits) {
  Pose& q = poses_.front();
  q[kRootTy] = kFloor + 0.52;
  q[kLfemurRx] = q[kRfemurRx] = -1.5;
  q[kLtibiaRx] = q[kRtibiaRx] = 1.5;
  if (!isSeated(skeleton_, q)) GTEST_FAIL() << "the test's pose does not sit";
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const TriangleMesh room = make(SceneKind::Chair, seed);
    DepthRenderer renderer;
    renderer.setBackground(room);
    // Straight down onto the seat.
    Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
    T_camera_world.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
    T_camera_world.translation() = -(T_camera_world.linear() * Eigen::Vector3d(0, kFloor + 1.5, -2.7 + 0.12));
    RenderedView view;
    renderer.render(kCamera, T_camera_world, {}, view);
    const double seat = 1.5 - static_cast<double>(view.depth.at(80, 60));
    EXPECT_NEAR(seat, 0.52 - 0.09, 0.04) << seed;
  }
}

}  // namespace
}  // namespace depthmocap
