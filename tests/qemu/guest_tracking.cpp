// Runs inside the guest: tracks what a real kernel's /dev/video device delivers, and tracks the recording that was made
// meanwhile again: both must give the same poses.
//
// Usage: guest_tracking LOOPBACK RECORDING CAMERA.json ...
//   LOOPBACK: a v4l2loopback device, to which the pictures of RECORDING are written by a thread.
#include <atomic>
#include <cstdio>
#include <map>
#include <thread>

#include "apps/track/tracker_setup.h"
#include "libtracker/recording/recording_header.h"
#include "libtracker/sensor/v4l2_source.h"
#include "libtracker/session/live_session.h"
#include "tests/qemu/feeder.h"

namespace depthmocap {
namespace {

constexpr int kPictures = 12;
constexpr double kSameJoint_m = 1e-6;  // times are written to the microsecond

class Collector : public FrameSink {
 public:
  void onFrame(const SessionFrame& given) override {
    const TrackedFrame& tracked = given.tracked;
    joints_[tracked.frame] = tracked.joints_camera;
    tracking_ += tracked.state == TrackState::Tracking ? 1 : 0;
    ++count;
  }
  std::atomic<int> count{0};
  [[nodiscard]] const std::map<std::int64_t, JointPositions>& joints() const { return joints_; }
  [[nodiscard]] int tracking() const { return tracking_; }

 private:
  std::map<std::int64_t, JointPositions> joints_;
  int tracking_ = 0;
};

void trackLive(const std::string& device, const std::string& recording, const std::string& camera_file) {
  SourceOptions options;
  options.camera = readRecordingHeader(camera_file);
  const auto pictures = readPictures(recording, options.camera->camera, kPictures);
  const Feeder feeder(device, options.camera->camera);
  feeder.send(pictures[0]);
  const auto source = openV4l2Camera(device, options);
  TrackOptions defaults;
  defaults.threads = 1;
  const auto models = loadModels(defaults);
  std::puts("tracking: models loaded");
  Tracker live(models, source->info().camera, trackerConfig(defaults));
  Recorder recorder("/tmp/recorded", source->info(), true);
  LiveSession loop(*source, live, &recorder, {});
  Collector collector;
  loop.addSink(collector);
  std::atomic<bool> fed{false};
  std::thread feeding([&] {
    sendOneByOne(feeder, pictures, collector.count);
    fed = true;
  });
  loop.run([&] { return fed.load(); });
  feeding.join();
  recorder.finish(loop.figures().missing);

  const auto recorded = openRecording("/tmp/recorded");
  Tracker again(models, recorded->info().camera, trackerConfig(defaults));
  DepthFrame frame;
  std::size_t compared = 0;
  double largest_m = 0;
  for (std::size_t i = 0; i < recorded->frameCount(); ++i) {
    const auto seen = collector.joints().find(recorded->frameNumber(i));
    if (seen == collector.joints().end()) continue;
    recorded->read(i, frame);
    const TrackedFrame& tracked = again.process(frame);
    largest_m = std::max(largest_m, (tracked.joints_camera - seen->second).cwiseAbs().maxCoeff());
    ++compared;
  }
  const Durations::Summary latency = loop.figures().latency.summary();
  std::printf(
      "tracking: %zu frames live, %d with a pose, latency p50 %.0f ms p99 %.0f ms; replayed %zu, largest difference "
      "of a joint %.9f m\n",
      collector.joints().size(), collector.tracking(), latency.p50, latency.p99, compared, largest_m);
  require(compared == collector.joints().size(), "frames that were tracked are missing in the recording");
  require(static_cast<int>(compared) >= kPictures / 2, "too few frames came");
  require(2 * collector.tracking() > static_cast<int>(compared), "nobody was tracked");
  require(largest_m < kSameJoint_m, "live and replay differ");
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    depthmocap::require(argc >= 4, "usage: guest_tracking LOOPBACK RECORDING CAMERA.json");
    depthmocap::trackLive(argv[1], argv[2], argv[3]);
    std::puts("GUEST OK");
    return 0;
  } catch (const std::exception& error) {
    std::printf("GUEST FAILED: %s\n", error.what());
    return 1;
  }
}
