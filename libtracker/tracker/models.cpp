#include "depthmocap/models.h"

#include "libtracker/classify/forest_classifier.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/room_classifier.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/posedb/pose_database.h"

namespace depthmocap {

Models Models::shipped() {
  return load({}, {});
}

Models Models::load(const std::filesystem::path& forest, const std::filesystem::path& pose_database) {
  Models models;
  models.classifier =
      std::make_shared<const ForestClassifier>(loadForest(forest.empty() ? shippedFile("general.forest") : forest));
  models.room = std::make_shared<const RoomClassifier>(loadRoomNetwork(shippedFile("rooms.network")));
  models.database = std::make_shared<const PoseDatabase>(
      loadPoseDatabase(pose_database.empty() ? shippedFile("default.posedb") : pose_database));
  return models;
}

}  // namespace depthmocap
