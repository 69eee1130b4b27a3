#include "libtracker/ik/pose_sequence.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/parallel.h"
#include "libtracker/skeleton/block_band.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// First damping over the largest diagonal entry; small, because a sequence starts near its solution.
constexpr double kFirstDamping = 1e-6;
// The solve stops where a step lowers the energy by a smaller share.
constexpr double kGainTolerance = 1e-4;
constexpr int kMaxRejections = 8;  // in a row, then the solve stops
// [frames] at the end of a window that the next one solves again, because it knows what comes after.
constexpr std::size_t kOverlap = 64;

// The second difference about frame t, as weights of q_t-1, q_t and q_t+1, over its deviation.
struct Bend {
  std::array<double, 3> weight{};
};

// A window of the sequence: frames [first, last); those before `first` hold still.
class Window {
 public:
  Window(std::vector<SequenceFrame>& frames, const PosePrior* prior, const SequenceConfig& config, std::size_t first,
         std::size_t last)
      : frames_(frames), prior_(prior), config_(config), first_(first), last_(last), step_s_(typicalStep()) {
    deviation_.setConstant(std::sqrt(config.turn_density));
    deviation_.head<3>().setConstant(std::sqrt(config.move_density));
  }

  void solve(std::vector<Pose>& q);

 private:
  struct Normal {
    explicit Normal(std::size_t frames) : A(frames), g(frames) {}
    BlockBand A;
    std::vector<Pose> g;
  };
  [[nodiscard]] double typicalStep() const {
    const double span_s = frames_[last_ - 1].time_s - frames_[first_].time_s;
    return last_ - first_ > 1 ? span_s / static_cast<double>(last_ - first_ - 1) : 1.0;
  }
  [[nodiscard]] Bend bendAt(std::size_t t) const {
    const double before_s = frames_[t].time_s - frames_[t - 1].time_s;
    const double after_s = frames_[t + 1].time_s - frames_[t].time_s;
    const double mean_s = 0.5 * (before_s + after_s);
    const double scale = 1.0 / std::sqrt(mean_s);  // of a change of velocity over its deviation, but for the density
    return {{scale / before_s, -scale * (1.0 / before_s + 1.0 / after_s), scale / after_s}};
  }
  [[nodiscard]] Pose bent(const std::vector<Pose>& q, std::size_t t, const Bend& bend) const {
    const Pose change = bend.weight[0] * q[t - 1] + bend.weight[1] * q[t] + bend.weight[2] * q[t + 1];
    return change.cwiseQuotient(deviation_);
  }
  // Whether the second difference about t is one of this window's.
  [[nodiscard]] std::size_t firstBend() const { return std::max<std::size_t>(1, first_ == 0 ? 1 : first_ - 1); }

  double frameEnergy(std::size_t t, const Pose& q, PoseMatrix* A, Pose* g);
  double energy(const std::vector<Pose>& q, Normal* normal);
  void addBends(const std::vector<Pose>& q, Normal& normal) const;
  [[nodiscard]] std::vector<Pose> step(const Normal& normal, const std::vector<Pose>& q, double mu) const;

  std::vector<SequenceFrame>& frames_;
  const PosePrior* prior_;
  const SequenceConfig& config_;
  std::size_t first_;
  std::size_t last_;
  double step_s_;
  Pose deviation_;
};

double Window::frameEnergy(std::size_t t, const Pose& q, PoseMatrix* A, Pose* g) {
  double energy = 0;
  if (A != nullptr) {
    A->setZero();
    g->setZero();
  }
  if (PoseTerm* const measured = frames_[t].measured.get(); measured != nullptr) {
    Eigen::VectorXd r(measured->rows());
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(A == nullptr ? 0 : r.size(), kDofCount);
    RowsJacobian J_rows(J);
    measured->evaluate(q, r, A == nullptr ? nullptr : &J_rows);
    energy += r.squaredNorm();
    if (A != nullptr) {
      A->noalias() += J.transpose() * J;
      g->noalias() += J.transpose() * r;
    }
  }
  if (prior_ == nullptr) return energy;
  const double share = step_s_ / config_.prior_interval_s;
  Eigen::VectorXd r(prior_->rows());
  Eigen::MatrixXd J;
  prior_->evaluate(shapeOf(q), r, A == nullptr ? nullptr : &J);
  energy += share * r.squaredNorm();
  if (A == nullptr) return energy;
  const Eigen::MatrixXd JtJ = share * (J.transpose() * J);
  const Eigen::VectorXd Jtr = share * (J.transpose() * r);
  for (int i = 0; i < kShapeDofCount; ++i) {
    const int row = kShapeDofs[static_cast<std::size_t>(i)];
    (*g)[row] += Jtr[i];
    for (int k = 0; k < kShapeDofCount; ++k) (*A)(row, kShapeDofs[static_cast<std::size_t>(k)]) += JtJ(i, k);
  }
  return energy;
}

double Window::energy(const std::vector<Pose>& q, Normal* normal) {
  const std::size_t count = last_ - first_;
  std::vector<double> energies(count);
  parallelFor(config_.threads, count, [&](std::size_t i) {
    PoseMatrix* const A = normal == nullptr ? nullptr : &normal->A.diagonal[i];
    energies[i] = frameEnergy(first_ + i, q[first_ + i], A, normal == nullptr ? nullptr : &normal->g[i]);
  });
  double sum = 0;
  for (const double energy : energies) sum += energy;
  for (std::size_t t = firstBend(); t + 1 < last_; ++t) sum += bent(q, t, bendAt(t)).squaredNorm();
  if (normal != nullptr) addBends(q, *normal);
  return sum;
}

void Window::addBends(const std::vector<Pose>& q, Normal& normal) const {
  for (Pose& coupling : normal.A.back1) coupling.setZero();
  for (Pose& coupling : normal.A.back2) coupling.setZero();
  const Pose information = deviation_.cwiseAbs2().cwiseInverse();
  for (std::size_t t = firstBend(); t + 1 < last_; ++t) {
    const Bend bend = bendAt(t);
    const Pose pull = bent(q, t, bend).cwiseQuotient(deviation_);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t frame = t + k - 1;
      if (frame < first_) continue;
      const std::size_t i = frame - first_;
      normal.g[i] += bend.weight[k] * pull;
      normal.A.diagonal[i].diagonal() += bend.weight[k] * bend.weight[k] * information;
      if (k >= 1 && frame - 1 >= first_) normal.A.back1[i] += bend.weight[k] * bend.weight[k - 1] * information;
      if (k == 2 && frame - 2 >= first_) normal.A.back2[i] += bend.weight[2] * bend.weight[0] * information;
    }
  }
}

// -(A + mu I)^-1 g over what may move; a degree of freedom at its limit that the gradient pushes outwards rests.
std::vector<Pose> Window::step(const Normal& normal, const std::vector<Pose>& q, double mu) const {
  const JointLimits& limits = jointLimits();
  BlockBand A = normal.A;
  std::vector<Pose> b(normal.g.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    b[i] = -normal.g[i];
    const Pose& now = q[first_ + i];
    for (int dof = 0; dof < kDofCount; ++dof) {
      const double g = normal.g[i][dof];
      if ((now[dof] <= limits.lower[dof] && g > 0) || (now[dof] >= limits.upper[dof] && g < 0)) {
        A.diagonal[i].row(dof).setZero();
        A.diagonal[i].col(dof).setZero();
        A.diagonal[i](dof, dof) = 1;
        A.back1[i][dof] = A.back2[i][dof] = 0;
        if (i + 1 < b.size()) A.back1[i + 1][dof] = 0;
        if (i + 2 < b.size()) A.back2[i + 2][dof] = 0;
        b[i][dof] = 0;
      }
    }
    A.diagonal[i].diagonal().array() += mu;
  }
  return A.solve(b);
}

void Window::solve(std::vector<Pose>& q) {
  for (std::size_t t = first_; t < last_; ++t) q[t] = clampedToLimits(q[t]);
  Normal normal(last_ - first_);
  double now = energy(q, &normal);
  double largest = 0;
  for (const PoseMatrix& A : normal.A.diagonal) largest = std::max(largest, A.diagonal().maxCoeff());
  double mu = kFirstDamping * std::max(largest, 1e-12);
  double nu = 2.0;
  int rejections = 0;
  std::vector<Pose> next = q;
  for (int i = 0; i < config_.max_iterations && rejections < kMaxRejections; ++i) {
    const std::vector<Pose> dq = step(normal, q, mu);
    double model_gain = 0;
    std::vector<Pose> taken(dq.size());
    for (std::size_t k = 0; k < dq.size(); ++k) {
      next[first_ + k] = clampedToLimits(q[first_ + k] + dq[k]);
      taken[k] = next[first_ + k] - q[first_ + k];
    }
    const std::vector<Pose> A_taken = normal.A.times(taken);
    for (std::size_t k = 0; k < dq.size(); ++k) model_gain -= taken[k].dot(2.0 * normal.g[k] + A_taken[k]);
    const double gain = now - energy(next, nullptr);
    const double rho = gain / std::max(model_gain, 1e-300);
    if (!(rho > 0) || !(gain > 0)) {
      ++rejections;
      mu *= nu;
      nu *= 2.0;
      continue;
    }
    rejections = 0;
    q = next;
    const bool is_done = gain <= kGainTolerance * now;
    if (is_done) return;
    now = energy(q, &normal);
    mu *= std::max(1.0 / 3.0, 1.0 - std::pow(2.0 * rho - 1.0, 3));
    nu = 2.0;
  }
}

}  // namespace

void SequenceConfig::validate() const {
  checkConfig(prior_interval_s > 0, "SequenceConfig", "prior_interval_s", prior_interval_s, "above 0");
  checkConfig(turn_density > 0, "SequenceConfig", "turn_density", turn_density, "above 0");
  checkConfig(move_density > 0, "SequenceConfig", "move_density", move_density, "above 0");
  checkConfig(max_iterations >= 1, "SequenceConfig", "max_iterations", max_iterations, "at least 1");
  checkConfig(threads >= 1, "SequenceConfig", "threads", threads, "at least 1");
}

std::vector<Pose> solveSequence(std::vector<SequenceFrame>& frames, const PosePrior* prior,
                                const SequenceConfig& config, std::vector<Pose> start) {
  config.validate();
  DMC_CHECK(frames.size() == start.size());
  std::size_t first = 0;
  while (first < frames.size()) {
    const std::size_t last = std::min(first + kSequenceWindow, frames.size());
    Window(frames, prior, config, first, last).solve(start);
    if (last == frames.size()) break;
    first = last - kOverlap;
  }
  return start;
}

}  // namespace depthmocap
