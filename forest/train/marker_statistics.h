#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "depthmocap/parts.h"
#include "forest/render/training_view.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/classify/forest.h"
#include "libtracker/markers/find_markers.h"

namespace depthmocap {

// Where the MeanShift modes of a part lie on rendered bodies: mode + radius * viewing ray = offset, in the frame of the
// marker's bone, the same for all views in the least-squares sense. In units of the average body (statureOf equal to
// that of BoneLengths{}), so that averageMarkerModel can scale them.
struct MarkerStatistics {
  struct PartStatistics {
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m]
    double radius_m = 0;                               // [m] >= 0
    double median_m = 0;                               // [m] of the distance between pushed-in mode and offset
    double p95_m = 0;                                  // [m]
    int count = 0;                                     // modes measured
    int seen = 0;                                      // images that show enough of the part for a marker
    int missing = 0;                                   // of them without a marker
  };
  std::array<PartStatistics, kPartCount> parts;
  // What the confidence of a marker says: of the markers of all parts with a confidence in [k, k + 1) /
  // kConfidenceBins.
  struct ConfidenceBin {
    int count = 0;
    double median_m = 0;  // [m]
    double within = 0;    // share nearer than kNear_m, [0, 1]
  };
  static constexpr int kConfidenceBins = 10;
  static constexpr double kNear_m = 0.05;  // [m]
  std::array<ConfidenceBin, kConfidenceBins> by_confidence;
};

struct MarkerStatisticsConfig {
  int images = 2000;
  std::uint64_t seed = 7;
  int threads = 2;
  TrainingViewConfig view;
  MarkerConfig markers;
};

// Renders random views of the poses on the bodies and classifies them with `forest`, or with the truth where it is
// null. Deterministic for any number of threads.
MarkerStatistics measureMarkers(const std::vector<BodySurface>& bodies,
                                const std::vector<Eigen::Matrix<float, kDofCount, 1>>& poses, const Forest* forest,
                                const MarkerStatisticsConfig& config);

}  // namespace depthmocap
