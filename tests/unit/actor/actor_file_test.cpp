#include <gtest/gtest.h>

#include "depthmocap/actor.h"
#include "libtracker/actor/make_actor.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/marker_model.h"
#include "libtracker/skeleton/typical_bone_lengths.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

Actor someActor() {
  ActorMeasurement measured;
  measured.sex = Sex::Female;
  measured.shape = shapeVector(typicalBoneLengths(Sex::Female, 1.68), 1.1);
  measured.shape[kBoneLengthCount + static_cast<int>(Girth::TorsoDepth)] = 1.4;
  measured.upper_arm_radius_m = 0.045;
  measured.depth_scale = 1.05;
  measured.camera = "kinect1";
  measured.fit = {10, 4, 0.004, 0.02, 0.9};
  Actor actor = measuredActor(measured);
  actor.markers[0].p_bone.z() += 0.01;
  return actor;
}

TEST(ActorFile, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const Actor written = someActor();
  writeActorFile(folder / "a.json", written);
  const Actor read = readActorFile(folder / "a.json");
  EXPECT_TRUE(read.measured->shape.isApprox(written.measured->shape, 1e-3));
  EXPECT_EQ(read.measured->sex, written.measured->sex);
  EXPECT_NEAR(read.stature_m(), written.stature_m(), 1e-3);
  for (std::size_t i = 0; i < kPartCount; ++i) {
    EXPECT_EQ(read.markers[i].bone, written.markers[i].bone);
    EXPECT_LT((read.markers[i].p_bone - written.markers[i].p_bone).norm(), 2e-4);
    EXPECT_NEAR(read.radii_m[i], written.radii_m[i], 1e-4);
  }
  EXPECT_NEAR(read.measured->upper_arm_radius_m, 0.045, 1e-4);
  EXPECT_NEAR(read.measured->depth_scale, 1.05, 1e-4);
  EXPECT_EQ(read.measured->camera, "kinect1");
  EXPECT_EQ(read.measured->fit.tpose_frames, 10);
  EXPECT_NEAR(read.measured->fit.confidence, 0.9, 1e-4);
}

TEST(ActorFile, WritingTwiceGivesTheSameBytes) {
  const TemporaryFolder folder;
  writeActorFile(folder / "a.json", someActor());
  writeActorFile(folder / "b.json", readActorFile(folder / "a.json"));
  EXPECT_EQ(readBytes(folder / "a.json"), readBytes(folder / "b.json"));
}

TEST(ActorFile, NineLengthsAreEnough) {
  const Actor actor = readActorFile(testData("actors/lengths_only.json"));
  EXPECT_NEAR(actor.measured->shape[0], 0.29, 1e-9);
  EXPECT_NEAR(actor.skeleton.lengths.spine, 0.18, 1e-9);  // the average body's
  const MarkerModel average = averageMarkerModel(actor.skeleton);
  EXPECT_TRUE(actor.markers[3].p_bone.isApprox(average[3].p_bone));
  EXPECT_EQ(actor.measured->depth_scale, 1.0);
}

TEST(ActorFile, ReadsTheGoldenFile) {
  const Actor actor = readActorFile(testData("actors/good.json"));
  EXPECT_NEAR(actor.stature_m(), 1.705, 0.001);
  EXPECT_EQ(actor.measured->sex, Sex::Female);
}

struct Damage {
  const char* file;
  const char* says;
};

class DamagedActorFile : public testing::TestWithParam<Damage> {};

TEST_P(DamagedActorFile, IsRefusedWithItsNameAndTheReason) {
  const auto path = testData(std::string("actors/") + GetParam().file);
  const std::string error = errorOf([&] { readActorFile(path); });
  EXPECT_NE(error.find(GetParam().file), std::string::npos) << error;
  EXPECT_NE(error.find(GetParam().says), std::string::npos) << error;
}

INSTANTIATE_TEST_SUITE_P(
    ActorFile, DamagedActorFile,
    testing::Values(Damage{"missing.json", "cannot read"}, Damage{"cut_short.json", "is not valid JSON"},
                    Damage{"other_format.json", "\"format\" must be"}, Damage{"future_version.json", "version 7"},
                    Damage{"no_lengths.json", "\"bone_lengths_m\" is missing"},
                    Damage{"no_foot.json", "\"foot\" is missing"}, Damage{"text_length.json", "must be a number"},
                    Damage{"huge_length.json", "\"upper_leg\" is 4.25"},
                    Damage{"wrong_stature.json", "the bone lengths make a body of 1.7"},
                    Damage{"unknown_bone.json", "there is no bone \"tail\""},
                    Damage{"unknown_part.json", "there is no body part \"wing\""},
                    Damage{"spine_above_neck.json", "\"spine\" must be less"},
                    Damage{"array.json", "must hold a JSON object"}),
    [](const auto& tested) {
      std::string name = tested.param.file;
      return name.substr(0, name.find('.'));
    });

// Any damage to the bytes is refused or gives a body of possible size: never a crash, never a number that is not
// finite.
TEST(ActorFile, SurvivesRandomDamage) {
  const TemporaryFolder folder;
  const std::string good = readBytes(testData("actors/good.json"));
  Random random(7);
  int accepted = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = good;
    for (std::uint32_t hits = 1 + random.below(4); hits > 0; --hits) {
      char& byte = bytes[random.below(static_cast<std::uint32_t>(bytes.size()))];
      const bool other_number = byte >= '0' && byte <= '9' && random.below(2) == 0;
      byte = static_cast<char>(other_number ? '0' + random.below(10) : random.below(256));
    }
    if (random.below(8) == 0) bytes.resize(random.below(static_cast<std::uint32_t>(bytes.size())));
    writeBytes(folder / "a.json", bytes);
    try {
      const Actor actor = readActorFile(folder / "a.json");
      ++accepted;
      EXPECT_TRUE(actor.measured->shape.allFinite());
      EXPECT_GT(actor.stature_m(), 0.4);
      EXPECT_LT(actor.stature_m(), 3.0);
    } catch (const std::runtime_error&) {
    }
  }
  EXPECT_GT(accepted, 10);
}

}  // namespace
}  // namespace depthmocap
