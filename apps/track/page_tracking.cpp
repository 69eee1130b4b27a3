#include "apps/track/page_tracking.h"

#include <array>
#include <utility>

#include "apps/track/tracker_setup.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct Output {
  const char* name;
  const char* title;
  const char* ending;
  fs::path TrackOptions::*path;
};

// Every file of a motion that `replay` writes. Pictures (--preview, --contact-sheet, --labels) are none.
constexpr std::array<Output, 9> kOutputs = {{{"bvh", "BVH", ".bvh", &TrackOptions::bvh},
                                             {"gltf", "glTF", ".glb", &TrackOptions::gltf},
                                             {"usd", "USD", ".usda", &TrackOptions::usd},
                                             {"joints", "Joints, CSV", ".joints.csv", &TrackOptions::joints},
                                             {"pose", "Pose, CSV", ".pose.csv", &TrackOptions::pose},
                                             {"angles", "Angles, CSV", ".angles.csv", &TrackOptions::angles},
                                             {"trc", "TRC", ".trc", &TrackOptions::trc},
                                             {"c3d", "C3D", ".c3d", &TrackOptions::c3d},
                                             {"mot", "OpenSim, MOT", ".mot", &TrackOptions::mot}}};

std::vector<ExportFormat> allFormats() {
  std::vector<ExportFormat> all;
  all.reserve(kOutputs.size());
  for (const Output& output : kOutputs) all.push_back({output.name, output.title, output.ending});
  return all;
}

}  // namespace

TrackOptions withoutOutputs(TrackOptions options) {
  for (const Output& output : kOutputs) (options.*output.path).clear();
  for (fs::path* path :
       {&options.labels, &options.preview, &options.contact_sheet, &options.stats, &options.save_config}) {
    path->clear();
  }
  options.vmc.clear();
  options.osc_trackers.clear();
  options.view.on = false;
  return options;
}

PageTracking::PageTracking(ReplayOptions options, std::optional<Models> models)
    : options_(std::move(options)), models_(std::move(models)) {}

const std::vector<ExportFormat>& PageTracking::formats() const {
  static const std::vector<ExportFormat> all = allFormats();
  return all;
}

ReplayOptions PageTracking::optionsFor(const TrackTask& task) const {
  ReplayOptions options = options_;
  options.track = withoutOutputs(options.track);
  options.track.people = task.people;
  for (const Output& output : kOutputs) options.track.*output.path = task.folder / (task.name + output.ending);
  if (task.recording.path == options_.recording) return options;
  options.recording = task.recording.path;
  options.session.first_frame = ReplaySessionOptions{}.first_frame;
  options.session.last_frame = ReplaySessionOptions{}.last_frame;
  return options;
}

void PageTracking::track(const TrackTask& task, FrameSink& watcher, const ReplayHooks& hooks) {
  if (!models_) models_ = loadModels(options_.track);
  const ReplayOptions options = optionsFor(task);
  RecordingRun run(options, *models_, task.recording.correction);
  run.session.addSink(run.outputs);
  run.session.addSink(watcher);
  run.session.run(hooks);
  if (!hooks.stopped()) run.outputs.finish();
}

}  // namespace depthmocap
