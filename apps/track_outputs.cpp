#include "apps/track_outputs.h"

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "apps/preview.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/error.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

JointsRow jointsRow(const TrackedFrame& tracked) {
  JointsRow row;
  row.frame = tracked.frame;
  row.time_s = tracked.time_s;
  row.state = tracked.state;
  if (tracked.state == TrackState::Lost) return row;
  row.p_camera = tracked.joints_camera;
  row.confidence = tracked.confidence;
  return row;
}

class LabelWriter {
 public:
  explicit LabelWriter(fs::path folder) : folder_(std::move(folder)) {
    std::error_code failure;
    fs::create_directories(folder_, failure);
    if (failure) throw Error("cannot make the folder: " + failure.message(), folder_.string());
  }
  void write(const TrackedFrame& tracked) const {
    char name[32];
    std::snprintf(name, sizeof name, "%06lld.png", static_cast<long long>(tracked.frame));
    const PartImage& labels = tracked.labels;
    const cv::Mat image(labels.height, labels.width, CV_8UC1, const_cast<std::uint8_t*>(labels.data.data()));
    std::vector<std::uint8_t> png;
    cv::imencode(".png", image, png, {cv::IMWRITE_PNG_COMPRESSION, 3});
    writeFileAtomically(folder_ / name, {reinterpret_cast<const char*>(png.data()), png.size()});
  }

 private:
  fs::path folder_;
};

}  // namespace

struct TrackOutputs::Files {
  std::optional<JointsWriter> joints;
  std::optional<PoseWriter> pose;
  std::optional<LabelWriter> labels;
  std::optional<PreviewWriter> preview;
  std::optional<ContactSheet> contact_sheet;
  // A body's bone lengths are known only at the end, so the BVH waits for them.
  fs::path bvh;
  double fps = 30;
  std::vector<Pose> bvh_poses;
  std::size_t bvh_before_first = 0;  // frames before the actor was first seen

  void writeBvh(const ActorModel& actor);
};

TrackOutputs::TrackOutputs(const TrackOptions& options, const RecordingInfo& info) : files_(std::make_unique<Files>()) {
  Files& f = *files_;
  if (!options.joints.empty()) f.joints.emplace(options.joints);
  if (!options.pose.empty()) f.pose.emplace(options.pose);
  if (!options.labels.empty()) f.labels.emplace(options.labels);
  if (!options.preview.empty()) f.preview.emplace(options.preview, info.camera, info.fps);
  if (!options.contact_sheet.empty()) f.contact_sheet.emplace(options.contact_sheet, info.camera);
  f.bvh = options.bvh;
  f.fps = info.fps;
}

TrackOutputs::~TrackOutputs() = default;

void TrackOutputs::write(const DepthFrame& frame, const TrackedFrame& tracked) {
  Files& f = *files_;
  const JointsRow row = jointsRow(tracked);
  const bool lost = tracked.state == TrackState::Lost;
  if (f.joints) f.joints->write(row);
  if (f.pose && !lost) f.pose->write({tracked.frame, tracked.time_s, tracked.q});
  if (f.labels) f.labels->write(tracked);
  const PreviewFrame preview{&frame.depth, &tracked.labels, &tracked.markers_camera, &row};
  if (f.preview) f.preview->write(preview);
  if (f.contact_sheet) f.contact_sheet->add(preview);
  if (f.bvh.empty()) return;
  // An animation has no gaps: the pose rests while the actor is lost.
  if (!lost) {
    f.bvh_poses.push_back(tracked.q);
  } else if (!f.bvh_poses.empty()) {
    f.bvh_poses.push_back(Pose(f.bvh_poses.back()));
  } else {
    ++f.bvh_before_first;
  }
}

void TrackOutputs::Files::writeBvh(const ActorModel& actor) {
  if (bvh_poses.empty()) throw Error("nobody was tracked, so there is no motion to write", bvh.string());
  bvh_poses.insert(bvh_poses.begin(), bvh_before_first, Pose(bvh_poses.front()));
  BvhWriter writer(bvh, actor.skeleton, fps);
  for (const Pose& q : bvh_poses) writer.write(q);
  writer.finish();
}

void TrackOutputs::finish(const ActorModel& actor) {
  Files& f = *files_;
  if (f.joints) f.joints->finish();
  if (f.pose) f.pose->finish();
  if (f.preview) f.preview->finish();
  if (f.contact_sheet) f.contact_sheet->finish();
  if (!f.bvh.empty()) f.writeBvh(actor);
}

}  // namespace depthmocap
