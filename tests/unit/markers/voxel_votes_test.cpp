#include "libtracker/markers/voxel_votes.h"

#include <gtest/gtest.h>

#include "libtracker/core/classified_pixels.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

TEST(VoxelVotes, KeepsEveryVoteAndTheCentreOfMass) {
  const CameraModel camera;
  ClassifiedPixels pixels;
  pixels.stride = 2;
  Random random(5);
  double area = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 5000; ++i) {
    ClassifiedPixels::Pixel pixel;
    pixel.x = static_cast<std::int16_t>(random.below(640));
    pixel.y = static_cast<std::int16_t>(random.below(480));
    pixel.depth_m = 2.0F;
    pixel.probability[4] = 0.5F;
    pixels.pixels.push_back(pixel);
    area += 4.0 * 4.0 / (camera.fx * camera.fy);
    sum += camera.unproject(pixel.x, pixel.y, 2.0);
  }
  VoxelVotes voxels;
  voxels.build(pixels, camera, 0.15, 0.025);
  PartVotes votes;
  voxels.gather(4, votes);
  double weight = 0;
  Eigen::Vector3d weighted = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < votes.size(); ++i) {
    weight += static_cast<double>(votes.weight[i]);
    weighted +=
        static_cast<double>(votes.weight[i]) * Eigen::Vector3f(votes.x[i], votes.y[i], votes.z[i]).cast<double>();
  }
  EXPECT_LT(votes.size(), pixels.pixels.size());
  EXPECT_NEAR(weight, 0.5 * area, 1e-4 * area);
  EXPECT_LT((weighted / weight - sum / 5000.0).norm(), 1e-4);
  voxels.gather(5, votes);
  EXPECT_EQ(votes.size(), 0U);
}

TEST(VoxelVotes, PointsEitherSideOfTheAxisAreDifferentCubes) {
  CameraModel camera;
  camera.cx = 320.0;  // pixels 319 and 321 lie at -4 mm and +4 mm
  ClassifiedPixels pixels;
  for (const int x : {319, 321}) {
    ClassifiedPixels::Pixel pixel;
    pixel.x = static_cast<std::int16_t>(x);
    pixel.y = 240;
    pixel.depth_m = 2.0F;
    pixel.probability[0] = 1.0F;
    pixels.pixels.push_back(pixel);
  }
  VoxelVotes voxels;
  voxels.build(pixels, camera, 0.15, 0.025);
  PartVotes votes;
  voxels.gather(0, votes);
  EXPECT_EQ(votes.size(), 2U);
}

}  // namespace
}  // namespace depthmocap
