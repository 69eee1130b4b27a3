// Values that no program should hand over: each is an Error that names it, never a bug, and none makes a pose of NaN.
#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/depthmocap.h"
#include "tests/support/recording_excerpt.h"

namespace depthmocap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

const Models& models() {
  static const Models kModels = Models::shipped();
  return kModels;
}

template <typename Action>
void refuses(Action&& action, const char* says) {
  try {
    action();
    ADD_FAILURE() << "took what has no " << says;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
  }
}

std::string walk() {
  return "replay:" + bundledRecording("walk").string();
}

TEST(Border, OfCameraOptions) {
  for (const double speed : {kNaN, -1.0, kInfinity, 1e300}) {
    CameraOptions options;
    options.speed = speed;
    refuses([&] { Camera(walk(), options); }, "speed");
  }
  for (const double unit_m : {kNaN, 0.0, -0.001, kInfinity}) {
    CameraOptions options;
    options.correction.depth_unit_m = unit_m;
    refuses([&] { Camera(walk(), options); }, "depth_unit_m");
  }
  for (const DepthMode& mode : {DepthMode{0, 480, 30}, {640, -1, 30}, {640, 480, kNaN}, {640, 480, -1}}) {
    CameraOptions options;
    options.mode = mode;
    refuses([&] { Camera(walk(), options); }, "mode.");
  }
}

TEST(Border, OfSessionOptions) {
  const auto with = [](auto&& change) {
    return [change] {
      SessionOptions options;
      options.models = models();
      change(options);
      Session(Recording(bundledRecording("walk")), options);
    };
  };
  for (const double value : {kNaN, -1.0}) {
    refuses(with([&](SessionOptions& o) { o.look_ahead_s = value; }), "look_ahead_s");
    refuses(with([&](SessionOptions& o) { o.smooth = value; }), "smooth");
    refuses(with([&](SessionOptions& o) { o.seconds = value; }), "seconds");
  }
  refuses(with([](SessionOptions& o) { o.people = 0; }), "people");
  refuses(with([](SessionOptions& o) { o.threads = -1; }), "threads");
}

TEST(Border, OfCameras) {
  for (double CameraModel::*field : {&CameraModel::fx, &CameraModel::fy, &CameraModel::cx, &CameraModel::cy}) {
    for (const double value : {kNaN, kInfinity, 1e9}) {
      CameraModel camera;
      camera.*field = value;
      refuses([&] { Tracker(models(), camera); }, "CameraModel");
      refuses([&] { Calibration(models(), camera); }, "CameraModel");
    }
  }
  CameraModel camera;
  camera.fx = 1e-300;
  refuses([&] { Tracker(models(), camera); }, "fx");
  camera = {};
  camera.width = 1 << 30;
  refuses([&] { Tracker(models(), camera); }, "width");
}

TEST(Border, OfActors) {
  const auto with = [](double value) {
    Actor actor = averageActor(1.75);
    actor.skeleton.lengths.upper_arm = value;
    return actor;
  };
  for (const double value : {kNaN, 0.0, -0.3, kInfinity, 100.0}) {
    refuses([&] { Tracker(models(), CameraModel{}, with(value)); }, "upper_arm");
    refuses([&] { static_cast<void>(Ik(with(value))); }, "upper_arm");
    refuses([&] { Tracker(models(), CameraModel{}).use(with(value)); }, "upper_arm");
  }
  refuses([] { averageActor(kNaN); }, "stature");
}

TEST(Border, OfFrames) {
  Recording recording(bundledRecording("walk"));
  const DepthFrame frame = recording.read(0);
  Tracker tracker(models(), recording.camera());
  for (const double time_s : {kNaN, kInfinity}) {
    refuses([&] { tracker.process({0, time_s, frame.depth}); }, "time");
  }
  refuses([&] { tracker.process({0, 0, DepthImage(3, 3, 1.0F)}); }, "3x3");
  DepthImage shorter = frame.depth;
  shorter.data.pop_back();
  refuses([&] { tracker.process({0, 0, shorter}); }, "values");
  refuses([&] { tracker.lockOn({kNaN, 0, 2}); }, "point");
  Calibration calibration(models(), recording.camera());
  refuses([&] { calibration.add({0, 0, DepthImage(3, 3, 1.0F)}); }, "3x3");
}

TEST(Border, OfPixels) {
  Recording recording(bundledRecording("walk"));
  Tracker tracker(models(), recording.camera());
  Calibration calibration(models(), recording.camera());
  const std::array<float, 6> salt = {std::numeric_limits<float>::quiet_NaN(),
                                     std::numeric_limits<float>::infinity(),
                                     -std::numeric_limits<float>::infinity(),
                                     -2.0F,
                                     1e30F,
                                     1e-30F};
  for (std::size_t i = 0; i < 6; ++i) {
    DepthFrame frame = recording.read(i);
    for (std::size_t p = i; p < frame.depth.data.size(); p += 97) frame.depth.data[p] = salt[p % salt.size()];
    const TrackedFrame& tracked = tracker.process(frame);
    EXPECT_EQ(tracked.state, TrackState::Tracking) << i;
    EXPECT_TRUE(tracked.q.allFinite() && tracked.joints_camera.allFinite()) << i;
    calibration.add(frame);
  }
  for (std::size_t i = 0; i < salt.size(); ++i) {
    const DepthImage all(recording.camera().width, recording.camera().height, salt[i]);
    const TrackedFrame& tracked = tracker.process({100, 100.0 + static_cast<double>(i), all});
    EXPECT_NE(tracked.state, TrackState::Tracking);
  }
}

TEST(Border, OfJointTargets) {
  const Ik ik;
  for (const double value : {kNaN, kInfinity, 1e9}) {
    JointTargets targets;
    targets.given[0] = true;
    targets.p_world(1, 0) = value;
    refuses([&] { static_cast<void>(ik.solve(targets)); }, "pelvis");
  }
  for (const double weight : {kNaN, kInfinity, 0.0, -1.0}) {
    JointTargets targets;
    targets.add(Joint::Head, {0, 1.6, 0});
    targets.weight[static_cast<std::size_t>(Joint::Head)] = weight;
    refuses([&] { static_cast<void>(ik.solve(targets)); }, "weight");
  }
  for (const double weight_m : {kNaN, kInfinity, -1.0}) {
    IkOptions options;
    options.weight_m = weight_m;
    refuses([&] { Ik ik_of(options); }, "weight_m");
  }
}

TEST(Border, OfCalibrationOptions) {
  for (const double stature_m : {kNaN, 0.0, 5.0}) {
    CalibrationOptions options;
    options.stature_m = stature_m;
    refuses([&] { Calibration(models(), CameraModel{}, options); }, "stature_m");
  }
  CalibrationOptions options;
  options.threads = 0;
  refuses([&] { Calibration(models(), CameraModel{}, options); }, "threads");
}

}  // namespace
}  // namespace depthmocap
