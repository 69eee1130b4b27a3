#include "apps/track/animation_files.h"

#include "libtracker/body/builtin_body.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/output/edit_motion.h"
#include "libtracker/output/gltf.h"
#include "libtracker/output/usd.h"

namespace depthmocap {
namespace {

constexpr double kCentimetres = 100.0;

// The motion as the animator wants it.
MotionTrack edited(const TrackOptions& options, const MotionTrack& tracked) {
  MotionTrack track = options.fps_out > 0 ? resampled(tracked, options.fps_out) : tracked;
  if (options.in_place) keepInPlace(track);
  if (options.loop) closeLoop(track, options.in_place);
  return track;
}

void writeBvhFile(const TrackOptions& options, const std::filesystem::path& path, const MotionTrack& track,
                  double fps) {
  const bool moving = track.sizeChanges() && options.bvh_moving;
  const double scale = options.bvh_unit == "cm" ? kCentimetres : 1.0;
  BvhWriter writer(path, makeSkeleton(track.lengths), 1.0 / track.frameTime_s(fps), scale, moving,
                   rigStyle(options.rig));
  for (const MotionTrack::Frame& frame : track.frames) {
    if (moving) {
      writer.write(frame.q, makeSkeleton(track.lengths.scaled(frame.scale)));
    } else {
      writer.write(frame.q);
    }
  }
  writer.finish();
}

}  // namespace

void writeAnimationFiles(const TrackOptions& options, const CollectedMotion& motion,
                         const std::vector<const CollectedMotion::Person*>& people,
                         const std::vector<MotionTrack>& tracks, double fps) {
  const bool with_body = !options.gltf.empty() || !options.usd.empty();
  const RigStyle style = rigStyle(options.rig);
  std::vector<AnimatedPerson> found;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const MotionTrack track = edited(options, tracks[i]);
    if (!options.bvh.empty()) writeBvhFile(options, motion.pathOf(options.bvh, *people[i]), track, fps);
    if (with_body) found.push_back({people[i]->number, makeBuiltinBody(track.lengths), track});
  }
  if (!options.gltf.empty()) writeGltf(options.gltf, found, style);
  if (!options.usd.empty()) writeUsd(options.usd, found, 1.0 / found.front().track.frameTime_s(fps), style);
}

}  // namespace depthmocap
