#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "forest/pose_model/fit_pose_mixture.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/joint_limits.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr int kElbow = kLradiusRy;
constexpr int kKnee = kRtibiaRx;
constexpr float kSpread_rad = 0.05F;

// Poses about the middle of the joint ranges: two clouds, each along one line, three quarters of the poses in the
// first.
PoseDatabase twoClouds(std::size_t count) {
  PoseDatabase database;
  Random random(5);
  const Pose middle = 0.5 * (jointLimits().lower + jointLimits().upper);
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Matrix<float, kDofCount, 1> q = middle.cast<float>();
    q.head<6>().setZero();
    const bool first = i % 4 != 0;
    q[kElbow] += first ? 0.2F : -0.2F;
    const auto along = kSpread_rad * static_cast<float>(random.normal());
    q[kElbow] += along;
    q[kKnee] += first ? along : -along;
    database.poses.push_back(q);
  }
  return database;
}

PoseMixture fittedToTwoClouds() {
  PoseMixtureConfig config;
  config.components = 2;
  PoseMixture mixture = fitPoseMixture(twoClouds(800), config);
  mixture.origin = "two clouds";
  return mixture;
}

bool areEqual(const PoseMixture& a, const PoseMixture& b) {
  return std::equal(a.components.begin(), a.components.end(), b.components.begin(), b.components.end(),
                    [](const auto& x, const auto& y) {
                      return x.weight == y.weight && x.mean == y.mean && x.basis == y.basis &&
                             x.deviation == y.deviation;
                    });
}

TEST(PoseMixture, FindsWeightMeanDirectionAndSpreadOfEachCloud) {
  PoseMixture mixture = fittedToTwoClouds();
  ASSERT_EQ(mixture.components.size(), 2U);
  std::sort(mixture.components.begin(), mixture.components.end(),
            [](const auto& a, const auto& b) { return a.weight > b.weight; });
  const double middle = 0.5 * (jointLimits().lower[kElbow] + jointLimits().upper[kElbow]);
  EXPECT_NEAR(mixture.components[0].weight, 0.75, 0.01);
  EXPECT_NEAR(mixture.components[0].mean[kElbow], middle + 0.2, 0.02);
  EXPECT_NEAR(mixture.components[1].mean[kElbow], middle - 0.2, 0.02);
  for (const float sign : {1.0F, -1.0F}) {
    const auto& component = mixture.components[sign > 0 ? 0 : 1];
    EXPECT_NEAR(component.deviation[0], kSpread_rad * std::sqrt(2.0), 0.01);
    EXPECT_NEAR(component.deviation[1], 0, 1e-4);
    EXPECT_NEAR(component.basis(kElbow, 0) * component.basis(kKnee, 0), sign * 0.5, 0.01);
  }
}

TEST(PoseMixture, IsTheSameForAnyNumberOfThreads) {
  PoseMixtureConfig config;
  config.components = 5;
  config.threads = 1;
  const PoseMixture one = fitPoseMixture(twoClouds(400), config);
  config.threads = 3;
  EXPECT_TRUE(areEqual(one, fitPoseMixture(twoClouds(400), config)));
}

TEST(PoseMixture, DissolvesSmallClusters) {
  PoseMixtureConfig config;
  config.components = 50;
  config.min_poses = 40;
  const PoseMixture mixture = fitPoseMixture(twoClouds(400), config);
  ASSERT_FALSE(mixture.components.empty());
  EXPECT_LE(mixture.components.size(), 10U);
  float sum = 0;
  for (const auto& component : mixture.components) sum += component.weight;
  EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(PoseMixture, RefusesTooFewPosesAndBadOptions) {
  EXPECT_THROW(fitPoseMixture(twoClouds(39), {}), Error);
  EXPECT_THROW(fitPoseMixture(twoClouds(100), {.components = 0}), Error);
  EXPECT_THROW(fitPoseMixture(twoClouds(100), {.min_poses = 10}), Error);
  EXPECT_THROW(fitPoseMixture(twoClouds(100), {.iterations = 0}), Error);
  EXPECT_THROW(fitPoseMixture(twoClouds(100), {.threads = 0}), Error);
}

TEST(SamplePoses, LieWithinLimitsAndTwoDeviations) {
  PoseMixture mixture = fittedToTwoClouds();
  for (const auto& q : samplePoses(mixture, 500, 1)) {
    float nearest = 1;
    for (const auto& component : mixture.components) {
      const float along = (q - component.mean).norm();
      nearest = std::min(nearest, along - 2 * component.deviation[0]);
    }
    EXPECT_LE(nearest, 1e-3);
  }
  // A wide component reaches beyond the limits: its samples do not.
  mixture.components[0].deviation[0] = 3;
  for (const auto& q : samplePoses(mixture, 500, 1)) {
    const Pose pose = q.cast<double>();
    EXPECT_LT((pose - clampedToLimits(pose)).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(SamplePoses, DependOnTheSeedAloneAndDrawRareComponentsMoreOften) {
  const PoseMixture mixture = fittedToTwoClouds();
  const auto poses = samplePoses(mixture, 2000, 7);
  ASSERT_EQ(poses.size(), 2000U);
  EXPECT_EQ(poses, samplePoses(mixture, 2000, 7));
  EXPECT_NE(poses, samplePoses(mixture, 2000, 8));
  const float between = 0.5F * (mixture.components[0].mean[kElbow] + mixture.components[1].mean[kElbow]);
  const auto low = std::count_if(poses.begin(), poses.end(), [&](const auto& q) { return q[kElbow] < between; });
  EXPECT_NEAR(static_cast<double>(low) / 2000.0, 0.5 / (0.5 + std::sqrt(0.75)), 0.04);
}

TEST(SamplePoses, OfAnEmptyMixtureAreNone) {
  EXPECT_TRUE(samplePoses({}, 10, 1).empty());
}

TEST(PoseMixtureFile, KeepsWhatWasSaved) {
  const TemporaryFolder folder;
  const PoseMixture mixture = fittedToTwoClouds();
  savePoseMixture(mixture, folder / "a.bin");
  const PoseMixture loaded = loadPoseMixture(folder / "a.bin");
  EXPECT_EQ(loaded.origin, "two clouds");
  ASSERT_EQ(loaded.components.size(), mixture.components.size());
  for (std::size_t i = 0; i < mixture.components.size(); ++i) {
    const auto& a = mixture.components[i];
    const auto& b = loaded.components[i];
    EXPECT_EQ(a.weight, b.weight);
    EXPECT_LT((a.mean - b.mean).cwiseAbs().maxCoeff(), 0.51e-4);
    EXPECT_LT((a.basis - b.basis).cwiseAbs().maxCoeff(), 0.51 / 32767);
    EXPECT_LT((a.deviation - b.deviation).cwiseAbs().maxCoeff(), 0.51e-4);
  }
  savePoseMixture(loaded, folder / "b.bin");
  EXPECT_EQ(readBytes(folder / "a.bin"), readBytes(folder / "b.bin"));
}

TEST(PoseMixtureFile, RefusesDamage) {
  const TemporaryFolder folder;
  savePoseMixture(fittedToTwoClouds(), folder / "good.bin");
  const std::string good = readBytes(folder / "good.bin");
  const auto errorOfBytes = [&](const std::string& bytes) {
    writeBytes(folder / "bad.bin", bytes);
    return errorOf([&] { loadPoseMixture(folder / "bad.bin"); });
  };
  EXPECT_EQ(errorOfBytes(good), "");
  EXPECT_NE(errorOf([&] { loadPoseMixture(folder / "none.bin"); }).find("none.bin"), std::string::npos);
  for (std::size_t size = 0; size < good.size(); size += size < 40 ? 1 : 97) {
    EXPECT_NE(errorOfBytes(good.substr(0, size)).find("bad.bin"), std::string::npos) << size;
  }
  EXPECT_NE(errorOfBytes("x" + good), "");
  EXPECT_NE(errorOfBytes(good + "x"), "");
  std::string counts = good;
  counts.replace(8, 4, "\xff\xff\xff\xff");  // length of the origin
  EXPECT_NE(errorOfBytes(counts), "");
  std::string weight = good;
  weight.replace(8 + 4 + std::string("two clouds").size() + 4, 4, std::string("\x00\x00\xc0\x7f", 4));  // not a number
  EXPECT_NE(errorOfBytes(weight), "");
}

}  // namespace
}  // namespace depthmocap
