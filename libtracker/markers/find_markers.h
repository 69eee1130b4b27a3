#pragma once
#include <array>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/marker_set.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/markers/mean_shift.h"
#include "libtracker/markers/voxel_votes.h"

namespace depthmocap {

struct MarkerConfig {
  double bandwidth_m = 0.07;      // [m] (> 0) of the MeanShift kernel, times bandwidth_scale of the part
  double min_probability = 0.15;  // [0, 1] a pixel votes for a part from this probability on
  double min_area_m2 = 0.002;     // [m^2] (> 0) probability-weighted surface below which a part gives no marker
  int max_iterations = 20;        // (>= 1) of MeanShift
  bool push_in = true;            // beyond the paper: move the mode into the body along the viewing ray
  // Long and wide parts get a wider kernel: along a limb the density is flat at the scale of its radius, so that a
  // narrow kernel's mode wanders along the bone. With true labels these halve the scatter of the lower arms and lower
  // legs. All 1 is one bandwidth for every part. Index = partIndex(part). (> 0)
  std::array<double, kPartCount> bandwidth_scale{1.0, 0.8, 1.2, 1.2, 2.0, 2.0, 3.0, 3.0,
                                                 3.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0};
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// Finds at most one labelled 3D point per part: the strongest mode of the part's density over the seen surface
// (Comaniciu & Meer 2002; the density of Shotton 2011, section 3.3, with pixel weight = probability * surface area of
// the pixel). Keeps working memory: reuse one object in a loop, nothing is allocated once the frame size has been seen.
// Not thread-safe.
class MarkerFinder {
 public:
  // Throws Error for an invalid config.
  explicit MarkerFinder(const MarkerConfig& config);

  // Markers in the camera frame [m] from the classified pixels. `radii_m` [m] is how far push_in moves each part's
  // mode. `prediction` (null = none): where the markers are expected, camera frame, inside the body where push_in is
  // on, confidence 0 where unknown. It starts one more ascent and decides between modes of similar density; it never
  // makes a marker by itself. Confidence of a found marker, in (0, 1], falls with too little seen surface, with unsure
  // pixels and with a rival mode of the same part; 0 = not found.
  void find(const ClassifiedPixels& pixels, const CameraModel& camera, const std::array<double, kPartCount>& radii_m,
            const MarkerSet* prediction, MarkerSet& out);

 private:
  struct Mode {
    Eigen::Vector3f position;  // camera frame [m], on the surface
    float density = 0;         // [m^2]
    float score = 0;           // density, raised near the prediction
  };

  void findPart(int part, double radius_m, const MarkerSet* prediction, MarkerSet& out);
  void collectModes(const PartVotes& votes, float bandwidth_m, const Eigen::Vector3f* expected);
  void addMode(const PartVotes& votes, const Eigen::Vector3f& start, float bandwidth_m,
               const Eigen::Vector3f* expected);
  [[nodiscard]] double confidenceOf(const PartVotes& votes, const Mode& best, float bandwidth_m, double radius_m) const;

  MarkerConfig config_;
  VoxelVotes voxels_;
  PartVotes votes_;
  MeanShift mean_shift_;
  std::vector<float> start_density_;
  std::vector<int> start_index_;
  std::vector<Mode> modes_;
};

}  // namespace depthmocap
