#pragma once
#include <memory>
#include <vector>

#include "calibration/calibrator.h"
#include "depthmocap/world_frame.h"
#include "forest/render/sensor_model.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Somebody before the camera, in its upright world; the floor is 0.95 m below it.
struct Stander {
  BodySurface body;
  Pose q = Pose::Zero();
};

// A T-pose at a place [m]; heading [rad], arms this far [rad] above the level.
inline Stander standing(BodySurface body, double x, double distance, double heading = 0, double arms_up = 0) {
  const BoneLengths& l = body.skeleton.lengths;
  Stander stander{std::move(body), Pose::Zero()};
  stander.q[kRootTx] = x;
  stander.q[kRootTy] = -0.95 + statureOf(l) - l.torso - 1.7 * l.neck_to_head;
  stander.q[kRootTz] = -distance;
  stander.q[kRootRy] = heading;
  stander.q[kLhumerusRz] = arms_up;
  stander.q[kRhumerusRz] = -arms_up;
  return stander;
}

// One frame of a noisy sensor; the seed is the frame's number.
inline DepthFrame photograph(const std::vector<Stander>& people, SensorKind kind, const CameraModel& camera,
                             int number) {
  TriangleMesh all;
  for (const Stander& person : people) {
    std::vector<Eigen::Vector3f> vertices;
    poseSurface(person.body, person.q, vertices);
    const auto offset = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), vertices.begin(), vertices.end());
    for (const auto& t : person.body.triangles) {
      all.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    }
    all.part.insert(all.part.end(), person.body.part.begin(), person.body.part.end());
  }
  DepthRenderer renderer;
  renderer.setBody(all.vertices, all.triangles, all.part);
  SensorModel sensor(kind);
  RenderedView view;
  const Eigen::Isometry3d T_camera_world(uprightWorldFromCamera());
  renderer.render(camera, T_camera_world, sensor.renderOptions(), view);
  Random random(static_cast<std::uint64_t>(number) + 1);
  PartImage parts;
  DepthFrame frame;
  frame.frame = number;
  frame.time_s = number / 30.0;
  sensor.apply(view, camera, random, frame.depth, parts);
  return frame;
}

// What comes with the program, read once.
inline std::shared_ptr<const CalibratorModels> shippedModels() {
  static const auto models = [] {
    const std::filesystem::path source = DEPTHMOCAP_SOURCE_DIR;
    auto loaded = std::make_shared<CalibratorModels>();
    loaded->tpose = std::make_shared<const ForestClassifier>(loadForest(source / "forest/models/tpose.forest"));
    loaded->room = std::make_shared<const RoomClassifier>(loadRoomNetwork(source / "forest/models/rooms.network"));
    loaded->general = std::make_shared<const ForestClassifier>(loadForest(source / "forest/models/general.forest"));
    loaded->space = loadShapeSpace(source / "calibration/models/shape_space.json");
    return loaded;
  }();
  return models;
}

}  // namespace depthmocap
