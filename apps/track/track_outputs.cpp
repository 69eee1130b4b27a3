#include "apps/track/track_outputs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/draw/preview.h"
#include "apps/track/motion_files.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/error.h"
#include "libtracker/clinical/angles_file.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/output/tracker_sender.h"
#include "libtracker/output/vmc_sender.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/session/people_labels.h"
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
  void write(std::span<const TrackedFrame* const> people) {
    const TrackedFrame& first = *people.front();
    const PartImage& labels = labelsOfAll(people, kPersonLabelStep, all_);
    char name[32];
    std::snprintf(name, sizeof name, "%06lld.png", static_cast<long long>(first.frame));
    writePng8(folder_ / name, labels);
  }
  void finish() { syncFolder(folder_); }

 private:
  fs::path folder_;
  PartImage all_;
};

// A stream for each of several people: the first to the port that was named, the others to those that follow.
template <typename Sender>
std::vector<Sender> senders(const std::string& target, int people) {
  std::vector<Sender> all;
  if (target.empty()) return all;
  all.reserve(static_cast<std::size_t>(people));
  const std::size_t colon = target.rfind(':');
  const std::optional<std::int64_t> port =
      colon == std::string::npos ? std::nullopt : parseInteger(target.substr(colon + 1));
  for (int k = 0; k < people; ++k) {
    all.emplace_back(k == 0 || !port ? target : fmt::format("{}:{}", target.substr(0, colon), *port + k));
  }
  return all;
}

}  // namespace

struct TrackOutputs::Files {
  Files(const TrackOptions& options, const RecordingInfo& info) : motion(options, info.fps) {}

  std::optional<JointsWriter> joints;
  std::optional<PoseWriter> pose;
  std::optional<LabelWriter> labels;
  std::optional<PreviewWriter> preview;
  std::optional<ContactSheet> contact_sheet;
  std::optional<AnglesWriter> angles;
  std::vector<ClinicalAngleReader> angle_readers;  // one per person
  MotionFiles motion;
  std::vector<VmcSender> vmc;           // one per person
  std::vector<TrackerSender> trackers;  // likewise
  bool several = false;
  PartImage all_parts;
};

TrackOutputs::TrackOutputs(const TrackOptions& options, const RecordingInfo& info)
    : files_(std::make_unique<Files>(options, info)) {
  Files& f = *files_;
  f.several = options.people > 1;
  const FileOf kind = f.several ? FileOf::People : FileOf::OneActor;
  if (!options.joints.empty()) f.joints.emplace(options.joints, kind);
  if (!options.pose.empty()) f.pose.emplace(options.pose, kind);
  if (!options.angles.empty()) f.angles.emplace(options.angles, kind);
  if (!options.labels.empty()) f.labels.emplace(options.labels);
  if (!options.preview.empty()) f.preview.emplace(options.preview, info.camera, info.fps);
  f.vmc = senders<VmcSender>(options.vmc, options.people);
  f.trackers = senders<TrackerSender>(options.osc_trackers, options.people);
  if (!options.contact_sheet.empty()) f.contact_sheet.emplace(options.contact_sheet, info.camera);
}

// Rows as in a joints file.
void TrackOutputs::writeAngles(Files& f, std::span<const TrackedFrame* const> people) {
  f.angle_readers.resize(people.size());
  bool anybody = false;
  for (std::size_t i = 0; i < people.size(); ++i) {
    const bool there = people[i]->state != TrackState::Lost;
    if (there || !f.several) f.angles->write(anglesRow(*people[i], f.angle_readers[i]));
    anybody = anybody || there;
  }
  if (f.several && !anybody) f.angles->write(anglesRow(*people.front(), f.angle_readers.front()));
}

TrackOutputs::~TrackOutputs() {
  try {
    files_->motion.write();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): another failure is already being reported
  }
}

void TrackOutputs::onFrame(const SessionFrame& frame) {
  Files& f = *files_;
  std::vector<JointsRow> rows;
  for (const TrackedFrame* person : frame.people) rows.push_back(jointsRow(*person));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const TrackedFrame& person = *frame.people[i];
    const bool there = person.state != TrackState::Lost;
    if (f.joints && (there || !f.several)) f.joints->write(rows[i]);
    if (f.pose && there) {
      f.pose->write({person.frame, person.time_s, person.q, person.R_world_camera, person.person});
    }
    if (i < f.vmc.size()) f.vmc[i].send(person.time_s, person.state, person.lengths, person.q);
    if (i < f.trackers.size()) f.trackers[i].send(person.time_s, person.state, person.lengths, person.q);
  }
  if (f.angles) writeAngles(f, frame.people);
  const bool nobody = std::ranges::all_of(rows, [](const JointsRow& row) { return row.state == TrackState::Lost; });
  if (f.joints && f.several && nobody) f.joints->write(rows.front());
  if (f.labels) f.labels->write(frame.people);
  const PartImage& parts = labelsOfAll(frame.people, 0, f.all_parts);
  const PreviewFrame preview{&frame.depth.depth, &parts, &frame.tracked.markers_camera,
                             rows.data(),        {},     std::span(rows).subspan(1)};
  if (f.preview) f.preview->write(preview);
  if (f.contact_sheet) f.contact_sheet->add(preview);
  f.motion.add(frame.people);
}

void TrackOutputs::finish() {
  Files& f = *files_;
  if (f.joints) f.joints->finish();
  if (f.pose) f.pose->finish();
  if (f.angles) f.angles->finish();
  if (f.labels) f.labels->finish();
  if (f.preview) f.preview->finish();
  if (f.contact_sheet) f.contact_sheet->finish();
  f.motion.write();
}

}  // namespace depthmocap
