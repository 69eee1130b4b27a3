#pragma once
#include <filesystem>
#include <memory>

#include "depthmocap/export.h"

namespace depthmocap {

class PartClassifier;
class RoomClassifier;
struct PoseDatabase;

// The learned models of the tracker. Constant and cheap to copy: trackers on several threads share them.
struct DEPTHMOCAP_API Models {
  std::shared_ptr<const PartClassifier> classifier;  // which body part a pixel belongs to
  std::shared_ptr<const RoomClassifier> room;        // where people are in a room
  std::shared_ptr<const PoseDatabase> database;      // poses of people

  // The models that come with the library (share/depthmocap). Throws Error saying where they were looked for.
  static Models shipped();
  // A forest and a pose database from files; an empty path means the shipped one. Throws Error where a file is missing
  // or damaged.
  static Models load(const std::filesystem::path& forest, const std::filesystem::path& pose_database);
};

}  // namespace depthmocap
