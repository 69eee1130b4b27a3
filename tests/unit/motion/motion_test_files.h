#pragma once
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap::test {

namespace fs = std::filesystem;

// A folder of its own for each test, removed afterwards.
class MotionFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() /
              (std::string("motion_") + info->test_suite_name() + "_" + info->name() + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
  fs::path write(const std::string& name, const std::string& text) const {
    fs::create_directories(file(name).parent_path());
    std::ofstream(file(name), std::ios::binary) << text;
    return file(name);
  }
  static std::string textOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  fs::path folder_;
};

// The message of the Error that a call throws; empty if it throws none.
template <typename Call>
std::string errorOf(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Root, one bone straight up, one to the left of its end; lengths of 0.9 and 0.45 in units of :length 0.45 inch.
inline const std::string kAsf = R"(# a comment
:version 1.10
:name TINY
:units
  mass 1.0
  length 0.45
  angle deg
:documentation
   free text, which may contain name and begin
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name up
     direction 0 1 0
     length 0.9
     axis 0 0 0 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
    bodymass 1
  end
  begin
     id 2
     name left
     direction 1 0 0
     length 0.45
     axis 0 0 90 XYZ
    dof rx
  end
:hierarchy
  begin
    root up
    up left
  end
)";

inline const std::string kAmc = R"(#!OML:ASF made by hand
:FULLY-SPECIFIED
:DEGREES
1
root 0.45 0 0 0 0 90
up 0 0 0
left 0
2
root 0 0.9 0 0 0 0
up 90 0 90
left 90
)";

inline const std::string kBvh = R"(HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Arm
  {
    OFFSET 1 0 0
    CHANNELS 3 Zrotation Yrotation Xrotation
    End Site
    {
      OFFSET 2 0 0
    }
  }
}
MOTION
Frames: 2
Frame Time: 0.0333333
0 0 0 0 0 0 0 0 0
1 2 3 90 90 0 0 0 90
)";

// A pose within the joint limits, the same for the same random state; `share` of each range is used.
inline Pose randomPose(Random& random, double share) {
  Pose q = Pose::Zero();
  const JointLimits& limits = jointLimits();
  for (int i = kFirstBodyDof; i < kDofCount; ++i) q[i] = share * random.uniform(limits.lower[i], limits.upper[i]);
  q.head<3>() << random.uniform(-1, 1), random.uniform(0.7, 1.1), random.uniform(-1, 1);
  q[kRootRx] = share * random.uniform(-0.6, 0.6);
  q[kRootRy] = random.uniform(-3, 3);
  q[kRootRz] = share * random.uniform(-0.6, 0.6);
  return q;
}

// The folder with the optional data; nothing where it is not there.
inline std::string dataFolder() {
  const char* given = std::getenv("DEPTHMOCAP_DATA");
  const fs::path folder =
      given != nullptr ? fs::path(given) : fs::path(DEPTHMOCAP_SOURCE_DIR) / ".." / "shared" / "data";
  return fs::is_directory(folder / "cmu") ? folder.string() : std::string();
}

}  // namespace depthmocap::test
