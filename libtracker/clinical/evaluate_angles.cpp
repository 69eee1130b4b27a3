#include "libtracker/clinical/evaluate_angles.h"

#include <algorithm>
#include <cmath>

#include "libtracker/evaluation/match_frames.h"
#include "libtracker/evaluation/mean.h"

namespace depthmocap {
namespace {

// Differences of one frame [deg], at most half a turn.
ClinicalAngles difference(const AnglesRow& tracked, const Pose& q) {
  ForwardKinematics fk;
  fk.update(makeSkeleton(BoneLengths{}), q);
  ClinicalAngles d = tracked.angles - ClinicalAngleReader().read(fk);
  for (double& angle : d) angle -= 360.0 * std::round(angle / 360.0);
  return d;
}

int binOf(double confidence) {
  return std::clamp(static_cast<int>(AngleFigures::kBins * confidence), 0, AngleFigures::kBins - 1);
}

}  // namespace

AngleFigures evaluateAngles(const std::vector<AnglesRow>& tracked, const std::vector<PoseRow>& truth,
                            const EvaluationOptions& options) {
  AngleFigures figures;
  std::array<Mean, kClinicalAngleCount> square;
  std::array<Mean, kClinicalAngleCount> signed_mean;
  std::array<Mean, AngleFigures::kBins> by_confidence;
  figures.angles_by_confidence.fill(0);
  const FrameMatcher<AnglesRow> found(tracked);
  for (const PoseRow& row : truth) {
    if (row.frame < options.first || row.frame > options.last) continue;
    const AnglesRow* match = found.find(row.frame);
    if (match == nullptr || match->state == TrackState::Lost) continue;
    ++figures.compared;
    const ClinicalAngles d = difference(*match, row.q);
    for (int a = 0; a < kClinicalAngleCount; ++a) {
      square[static_cast<std::size_t>(a)].add(d[a] * d[a]);
      signed_mean[static_cast<std::size_t>(a)].add(d[a]);
      const int joint = clinicalJointOf(a);
      if (joint == 0) continue;  // the pelvis: where somebody faces, not how he is bent
      const auto bin = static_cast<std::size_t>(binOf(match->confidence[joint]));
      by_confidence[bin].add(d[a] * d[a]);
      ++figures.angles_by_confidence[bin];
    }
  }
  for (int a = 0; a < kClinicalAngleCount; ++a) {
    figures.rms_deg[a] = std::sqrt(square[static_cast<std::size_t>(a)].value());
    figures.bias_deg[a] = signed_mean[static_cast<std::size_t>(a)].value();
  }
  for (std::size_t bin = 0; bin < by_confidence.size(); ++bin) {
    figures.rms_by_confidence_deg[bin] = std::sqrt(by_confidence[bin].value());
  }
  return figures;
}

}  // namespace depthmocap
