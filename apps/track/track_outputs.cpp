#include "apps/track/track_outputs.h"

#include <cstdio>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "apps/draw/preview.h"
#include "apps/track/animation_files.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/output/vmc_sender.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

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
  Files(const TrackOptions& options, const RecordingInfo& info) : animation(options, info.fps) {}

  std::optional<JointsWriter> joints;
  std::optional<PoseWriter> pose;
  std::optional<LabelWriter> labels;
  std::optional<PreviewWriter> preview;
  std::optional<ContactSheet> contact_sheet;
  AnimationFiles animation;
  std::optional<VmcSender> vmc;
  BoneLengths last_lengths;
};

TrackOutputs::TrackOutputs(const TrackOptions& options, const RecordingInfo& info)
    : files_(std::make_unique<Files>(options, info)) {
  Files& f = *files_;
  if (!options.joints.empty()) f.joints.emplace(options.joints);
  if (!options.pose.empty()) f.pose.emplace(options.pose);
  if (!options.labels.empty()) f.labels.emplace(options.labels);
  if (!options.preview.empty()) f.preview.emplace(options.preview, info.camera, info.fps);
  if (!options.vmc.empty()) f.vmc.emplace(options.vmc);
  if (!options.contact_sheet.empty()) f.contact_sheet.emplace(options.contact_sheet, info.camera);
}

TrackOutputs::~TrackOutputs() {
  try {
    files_->animation.write(files_->last_lengths);
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): another failure is already being reported
  }
}

void TrackOutputs::onFrame(const SessionFrame& frame) {
  Files& f = *files_;
  const TrackedFrame& shown = frame.tracked;
  const JointsRow row = jointsRow(shown);
  if (f.joints) f.joints->write(row);
  if (f.pose && shown.state != TrackState::Lost)
    f.pose->write({shown.frame, shown.time_s, shown.q, shown.R_world_camera});
  if (f.labels) f.labels->write(shown);
  const PreviewFrame preview{&frame.depth.depth, &shown.labels, &shown.markers_camera, &row};
  if (f.preview) f.preview->write(preview);
  if (f.contact_sheet) f.contact_sheet->add(preview);
  f.animation.add(shown);
  if (f.vmc) f.vmc->send(shown.time_s, shown.state, shown.lengths, shown.q);
  f.last_lengths = shown.lengths;
}

void TrackOutputs::finish(const Actor& actor) {
  Files& f = *files_;
  if (f.joints) f.joints->finish();
  if (f.pose) f.pose->finish();
  if (f.preview) f.preview->finish();
  if (f.contact_sheet) f.contact_sheet->finish();
  f.animation.write(actor.skeleton.lengths);
}

}  // namespace depthmocap
