#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/body/body_surface.h"
#include "libtracker/body/makehuman_files.h"

namespace depthmocap {

// MakeHuman's macro parameters.
struct MakeHumanShape {
  double male = 1.0;         // [0, 1] 0 woman, 1 man
  double age_years = 30;     // [a] (25 .. 90)
  double muscle = 0.5;       // [0, 1] 0.5 average
  double weight = 0.5;       // [0, 1] 0.5 average
  double height = 0.5;       // [0, 1] proportions of a short or tall person
  double proportions = 0.5;  // [0, 1] 0 uncommon, 1 ideal
  double african = 1.0;      // shares of the three races, any scale (>= 0, not all 0)
  double asian = 1.0;
  double caucasian = 1.0;
  double stature_m = 0;  // [m] scale to this stature; 0: as the macros give
};

// Human bodies from MakeHuman's CC0 base mesh and macro targets, brought into our zero pose with our bones.
// Files are read once; then make() is const, safe for several threads, and takes a few milliseconds.
class MakeHumanModel {
 public:
  // `folder` holds base.obj, rig.cmu_mb.json, weights.cmu_mb.json and targets/. Throws Error when something is missing.
  explicit MakeHumanModel(const std::filesystem::path& folder);

  // Throws Error when a parameter is outside its range.
  [[nodiscard]] BodySurface make(const MakeHumanShape& shape) const;

 private:
  struct Macro {
    int race = -1;         // 0 african, 1 asian, 2 caucasian; -1: for all
    int male = 0;          // 0, 1
    int old = -1;          // 0 young, 1 old; -1: for all ages
    int muscle = -1;       // 0 min, 1 average, 2 max; -1: for all
    int weight = -1;       // the same
    int height = -1;       // 0 min, 2 max; -1: for all
    int proportions = -1;  // 0 uncommon, 2 ideal; -1: for all
    MakeHumanTarget target;
  };
  void addMacro(const std::filesystem::path& file, Macro macro);
  [[nodiscard]] std::vector<Eigen::Vector3f> morphed(const MakeHumanShape& shape) const;

  MakeHumanMesh mesh_;
  MakeHumanJoints joints_;
  std::vector<BoneWeights> weights_;
  std::vector<Macro> macros_;
};

}  // namespace depthmocap
