#pragma once
#include <array>
#include <vector>

#include "libtracker/clinical/angles_file.h"
#include "libtracker/evaluation/evaluate_joints.h"

namespace depthmocap {

// Clinical angles against the truth. A figure about nothing is NaN.
struct AngleFigures {
  static constexpr int kBins = 4;  // of confidence, equally wide, from 0 to 1
  int compared = 0;                // frames that both have
  ClinicalAngles rms_deg;          // root mean square difference, wrapped to at most 180 degrees
  ClinicalAngles bias_deg;         // mean of tracked less true
  // Over all angles but those of the pelvis, by the confidence of the joint.
  std::array<double, kBins> rms_by_confidence_deg;
  std::array<long, kBins> angles_by_confidence;
};

// Frames are matched by number. The true poses are of any body; their world is that of the tracked ones.
AngleFigures evaluateAngles(const std::vector<AnglesRow>& tracked, const std::vector<PoseRow>& truth,
                            const EvaluationOptions& options);

}  // namespace depthmocap
