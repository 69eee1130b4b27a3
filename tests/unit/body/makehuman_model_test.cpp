#include "libtracker/body/makehuman_model.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/body/body_checks.h"
#include "tests/unit/body/makehuman_data.h"

namespace depthmocap {
namespace {

class MakeHuman : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(makeHumanFolder() / "base.obj")) GTEST_SKIP() << "no MakeHuman data";
    if (!model_) model_ = std::make_unique<MakeHumanModel>(makeHumanFolder());
  }
  static void TearDownTestSuite() { model_.reset(); }
  static const MakeHumanModel& model() { return *model_; }

 private:
  static inline std::unique_ptr<MakeHumanModel> model_;
};

const std::array<MakeHumanShape, 4> kShapes = {
    {{.male = 1, .stature_m = 1.78},
     {.male = 0, .stature_m = 1.62},
     {.male = 1, .age_years = 80, .weight = 1.0, .stature_m = 1.70},
     {.male = 0, .muscle = 0.1, .weight = 0.1, .height = 0.9, .stature_m = 1.80}}};

TEST_F(MakeHuman, IsClosedAndHasTheWantedStature) {
  for (const MakeHumanShape& shape : kShapes) {
    const BodySurface body = model().make(shape);
    EXPECT_EQ(openEdges(body), 0U);
    EXPECT_NEAR(heightOf(body), shape.stature_m, 1e-4);
    EXPECT_NEAR(statureOf(body.skeleton.lengths), shape.stature_m, 0.02);
    EXPECT_GT(kilogramsOf(body), 13.5 * shape.stature_m * shape.stature_m);
    EXPECT_LT(kilogramsOf(body), 36.0 * shape.stature_m * shape.stature_m);
  }
}

TEST_F(MakeHuman, HoldsItsJoints) {
  for (const MakeHumanShape& shape : kShapes) {
    const BodySurface body = model().make(shape);
    const JointPositions joints = jointPositions(body.skeleton, Pose::Zero());
    for (int j = 0; j < kJointCount; ++j) {
      EXPECT_NEAR(windingNumber(body, joints.col(j)), 1.0, 0.1) << kJointNames[static_cast<std::size_t>(j)];
    }
  }
}

TEST_F(MakeHuman, HasTheProportionsOfPeople) {
  const BoneLengths l = model().make(kShapes[0]).skeleton.lengths;
  const BoneLengths average = averageBoneLengths(1.78);
  for (int i = 0; i < kBoneLengthCount; ++i) {
    const auto field = kBoneLengthFields[static_cast<std::size_t>(i)];
    EXPECT_NEAR(l.*field, average.*field, 0.2 * (average.*field) + 0.02)
        << kBoneLengthNames[static_cast<std::size_t>(i)];
  }
}

TEST_F(MakeHuman, HasAllPartsAndPosesToItself) {
  const BodySurface body = model().make(kShapes[1]);
  std::array<int, kPartCount + 1> count{};
  for (const std::uint8_t part : body.part) ++count[part];
  EXPECT_EQ(count[0], 0);
  for (std::size_t n = 1; n <= kPartCount; ++n) {
    EXPECT_GT(count[n], 100) << kPartNames[n];
    EXPECT_NEAR(count[static_cast<std::size_t>(mirrored(static_cast<Part>(n)))], count[n], 0.05 * count[n]);
  }
  std::vector<Eigen::Vector3f> posed;
  poseSurface(body, Pose::Zero(), posed);
  for (std::size_t i = 0; i < posed.size(); i += 11) EXPECT_LT((posed[i] - body.vertices[i]).norm(), 1e-5F);
}

TEST_F(MakeHuman, MacrosChangeTheBody) {
  MakeHumanShape shape{.male = 0, .stature_m = 1.7};
  shape.weight = 0;
  const double thin = kilogramsOf(model().make(shape));
  shape.weight = 1;
  EXPECT_GT(kilogramsOf(model().make(shape)), 1.25 * thin);
  shape.stature_m = 0;
  shape.height = 0;
  const double low = heightOf(model().make(shape));
  shape.height = 1;
  EXPECT_GT(heightOf(model().make(shape)), 1.1 * low);
}

TEST_F(MakeHuman, RefusesImpossibleShapes) {
  EXPECT_THROW((void)model().make({.male = 2}), Error);
  EXPECT_THROW((void)model().make({.age_years = 5}), Error);
  EXPECT_THROW((void)model().make({.african = 0, .asian = 0, .caucasian = 0}), Error);
  EXPECT_THROW((void)model().make({.stature_m = -1}), Error);
}

TEST(MakeHumanModel, NamesTheMissingFile) {
  try {
    MakeHumanModel model("/nonexistent-folder");
    FAIL() << "no error";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("base.obj"), std::string::npos);
  }
}

TEST(MakeHumanModel, RefusesBrokenFiles) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "makehuman_broken";
  std::filesystem::create_directories(folder);
  const auto with = [&](const std::string& obj) {
    std::ofstream(folder / "base.obj") << obj;
    return folder;
  };
  EXPECT_THROW(readMakeHumanMesh(with("v 1 2\n") / "base.obj"), Error);
  EXPECT_THROW(readMakeHumanMesh(with("v 1 2 3\ng body\nf 1 2 3\n") / "base.obj"), Error);
  EXPECT_THROW(readMakeHumanMesh(with("v 1 2 3\nv 1 2 4\nv 1 3 4\ng other\nf 1 2 3\n") / "base.obj"), Error);
  const MakeHumanMesh mesh = readMakeHumanMesh(with("v 1 2 3\nv 1 2 4\nv 1 3 4\ng body\nf 1/1 2/2 3/3\n") / "base.obj");
  EXPECT_EQ(mesh.triangles.size(), 1U);
  std::ofstream(folder / "rig.json") << "{\"Hips\": 3";
  EXPECT_THROW(readMakeHumanRig(folder / "rig.json", mesh), Error);
  std::ofstream(folder / "rig.json") << R"({"Hips": {"head": {"strategy": "CUBE", "cube_name": "joint-none"}}})";
  EXPECT_THROW(readMakeHumanRig(folder / "rig.json", mesh), Error);
  std::ofstream(folder / "weights.json") << R"({"weights": {"Hips": []}})";
  EXPECT_THROW(readMakeHumanWeights(folder / "weights.json", 3), Error);
  std::ofstream(folder / "x.target.gz") << "0 1 2 zero\n";  // gzread passes plain text through
  EXPECT_THROW(readMakeHumanTarget(folder / "x.target.gz", 3), Error);
  std::ofstream(folder / "x.target.gz") << "7 1 2 3\n";
  EXPECT_THROW(readMakeHumanTarget(folder / "x.target.gz", 3), Error);
}

}  // namespace
}  // namespace depthmocap
