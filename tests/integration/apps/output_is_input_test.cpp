// No command writes to what it reads.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

namespace depthmocap {
namespace {

constexpr const char* kSkeleton =
    "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n{\nOFFSET 0 1 0\n}\n}\n"
    "MOTION\nFrames: 1\nFrame Time: 0.03\n0 0 0\n";

struct Clash {
  const char* name;
  const char* arguments;  // of the program; in the folder where `file` lies
  const char* file;       // read and written
};

class OutputIsInput : public testing::TestWithParam<Clash> {};

TEST_P(OutputIsInput, IsRefusedBeforeWork) {
  const TemporaryFolder folder;
  copyExcerpt("walk", 2, folder / "rec");
  std::filesystem::create_directory(folder / "motions");
  const auto file = folder / GetParam().file;
  writeBytes(file, kSkeleton);
  const ProgramResult result = runProgram(
      "-c 'cd " + quoted(folder.path()) + " && exec \"$0\" \"$@\"' " + DEPTHMOCAP_PROGRAM + " " + GetParam().arguments,
      "/bin/bash");
  EXPECT_EQ(result.exit_code, 1) << result.errors;
  EXPECT_NE(result.errors.find("is read, and"), std::string::npos) << result.errors;
  EXPECT_EQ(readBytes(file), kSkeleton);
}

INSTANTIATE_TEST_SUITE_P(
    Commands, OutputIsInput,
    testing::Values(Clash{"Motion", "motion a.bvh --joints a.bvh", "a.bvh"},
                    Clash{"PosedbMotion", "posedb build --motions motions --out motions/a.bvh", "motions/a.bvh"},
                    Clash{"PosedbSkeleton", "posedb build --motions motions --asf a.asf --out a.asf", "a.asf"},
                    Clash{"ShapeSpace", "shape-space --motions motions --out motions/a.bvh", "motions/a.bvh"},
                    Clash{"IkEvaluate", "ik evaluate --posedb a.db --picture a.db", "a.db"},
                    Clash{"IkEvaluatePriors", "ik evaluate --posedb a.db --priors p.bin --picture p.bin", "p.bin"},
                    Clash{"ForestTrain", "forest train --posedb a.db --out a.db", "a.db"},
                    Clash{"ForestReport", "forest train --posedb a.report.md --out a.forest", "a.report.md"},
                    Clash{"Rooms", "rooms draw --posedb a.db --out a.db", "a.db"},
                    Clash{"ReplayCamera", "replay rec --camera c.json --stats c.json", "c.json"},
                    Clash{"CalibrateCamera", "calibrate rec --camera c.json --out c.json", "c.json"}),
    [](const auto& tested) { return std::string(tested.param.name); });

}  // namespace
}  // namespace depthmocap
