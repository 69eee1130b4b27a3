#include "libtracker/prior/local_prior_builder.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libtracker/core/check.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {
namespace {

constexpr double kLeastVariance_rad2 = 1e-9;  // [rad^2] a direction with less holds no motion
constexpr double kSingular = 1e-9;            // keeps (I - H) regular where a bone is not determined by the others
constexpr double kImpossible = std::numeric_limits<double>::infinity();

using Shape = Eigen::Matrix<double, kShapeDofCount, 1>;
using ShapeMatrix = Eigen::Matrix<double, kShapeDofCount, kShapeDofCount>;
using Basis = Eigen::Matrix<double, kShapeDofCount, kMaxPriorDims>;
using BoneMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;
using BoneVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;

// The rows of each bone in a Shape: kShapeDofs leaves out the root's translation and heading.
struct BoneRows {
  int first;
  int count;
};
constexpr std::array<BoneRows, kBoneCount> kBoneRows = [] {
  std::array<BoneRows, kBoneCount> rows{};
  rows[0] = {0, 2};
  for (std::size_t b = 1; b < kBoneCount; ++b) {
    rows[b] = {kBoneDofs[b].first - (kDofCount - kShapeDofCount), kBoneDofs[b].count};
  }
  return rows;
}();

// The K nearest poses: their mean and their scatter about it (sum over poses, [rad^2]).
struct Model {
  int neighbours = 0;
  Shape mean = Shape::Zero();
  ShapeMatrix scatter = ShapeMatrix::Zero();
};

// Sum over bones of the squared error [rad^2] of the bone's DoFs as predicted from all others: with d the pose about
// the mean, H = P P^T and e = d - H d, hiding the rows b and fitting phi to the rest leaves the residual (I - H_bb)^-1
// e_b.
double hiddenBoneError(const Eigen::Ref<const Eigen::MatrixXd>& P, const Shape& d) {
  const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxPriorDims, 1> phi = P.transpose() * d;
  const Shape e = d - P.lazyProduct(phi);
  double error = 0;
  for (const BoneRows& bone : kBoneRows) {
    const auto P_b = P.middleRows(bone.first, bone.count);
    BoneMatrix rest = -P_b.lazyProduct(P_b.transpose());
    rest.diagonal().array() += 1.0 + kSingular;
    const BoneVector e_b = e.segment(bone.first, bone.count);
    error += rest.ldlt().solve(e_b).squaredNorm();
  }
  return error;
}

}  // namespace

struct LocalPriorBuilder::Impl {
  PriorConfig config;
  std::vector<double> errors;  // [K index * number of dims + B index]
  std::vector<Model> models;   // one a K of the configuration
  Eigen::Matrix<double, kShapeDofCount, kMaxPriorNeighbours> poses;
  Eigen::SelfAdjointEigenSolver<ShapeMatrix> solver;

  void load(const PoseDatabase& database, const std::vector<PoseNeighbour>& neighbours, int count);
  void fit(int neighbours, Model& model);
  int principal(const ShapeMatrix& scatter, int neighbours, Basis& P);
  void judge(std::size_t i);
  void write(const Model& model, int dims, LocalPrior& prior);
};

LocalPriorBuilder::LocalPriorBuilder(const PriorConfig& config) : impl_(std::make_unique<Impl>()) {
  config.validate();
  impl_->config = config;
  impl_->errors.assign(config.neighbours.size() * config.dims.size(), kImpossible);
  impl_->models.resize(config.neighbours.size());
}
LocalPriorBuilder::~LocalPriorBuilder() = default;
LocalPriorBuilder::LocalPriorBuilder(LocalPriorBuilder&&) noexcept = default;

void LocalPriorBuilder::Impl::load(const PoseDatabase& database, const std::vector<PoseNeighbour>& neighbours,
                                   int count) {
  for (int k = 0; k < count; ++k) {
    const auto& q = database.poses[neighbours[static_cast<std::size_t>(k)].index];
    for (int i = 0; i < kShapeDofCount; ++i)
      poses(i, k) = static_cast<double>(q[kShapeDofs[static_cast<std::size_t>(i)]]);
  }
}

void LocalPriorBuilder::Impl::fit(int neighbours, Model& model) {
  model.neighbours = neighbours;
  model.mean = poses.leftCols(neighbours).rowwise().mean();
  model.scatter.setZero();
  for (int k = 0; k < neighbours; ++k) {
    const Shape d = poses.col(k) - model.mean;
    model.scatter += d.lazyProduct(d.transpose());
  }
}

// The eigenvectors of the largest eigenvalues, falling; returns the rank.
int LocalPriorBuilder::Impl::principal(const ShapeMatrix& scatter, int neighbours, Basis& P) {
  solver.compute(scatter);
  P = solver.eigenvectors().rightCols<kMaxPriorDims>().rowwise().reverse();
  return static_cast<int>((solver.eigenvalues().array() > kLeastVariance_rad2 * neighbours).count());
}

// Fills the errors of the i-th model's dimensions.
void LocalPriorBuilder::Impl::judge(std::size_t i) {
  const std::size_t count = config.dims.size();
  const auto first = errors.begin() + static_cast<std::ptrdiff_t>(i * count);
  std::fill_n(first, count, 0.0);
  const Model& model = models[i];
  const int rest = model.neighbours - 1;
  const double share = model.neighbours / static_cast<double>(std::max(rest, 1));
  const int held_out = rest > 0 ? std::min(config.held_out, model.neighbours) : 0;
  if (held_out == 0) std::fill_n(first, count, kImpossible);
  Basis P;
  for (int left_out = 0; left_out < held_out; ++left_out) {
    // Without pose j the scatter about the others' mean is less by K / (K - 1) d d^T, d = pose j about the mean of all.
    const Shape offset = poses.col(left_out) - model.mean;
    const int rank = principal(model.scatter - share * offset.lazyProduct(offset.transpose()), rest, P);
    const Shape d = share * offset;  // about the others' mean
    for (std::size_t j = 0; j < count; ++j) {
      const int dims = config.dims[j];
      first[static_cast<std::ptrdiff_t>(j)] += dims <= rank ? hiddenBoneError(P.leftCols(dims), d) : kImpossible;
    }
  }
}

void LocalPriorBuilder::Impl::write(const Model& model, int dims, LocalPrior& prior) {
  Basis P;
  const int rank = principal(model.scatter, model.neighbours, P);
  prior = LocalPrior{};
  prior.neighbours = model.neighbours;
  prior.dims = std::min(dims, rank);
  prior.residual_rad = config.residual_rad;
  for (int i = 0; i < kShapeDofCount; ++i) {
    const int dof = kShapeDofs[static_cast<std::size_t>(i)];
    prior.mean[dof] = model.mean[i];
    for (int b = 0; b < prior.dims; ++b) prior.basis(dof, b) = P(i, b);
  }
  for (int b = 0; b < prior.dims; ++b) {
    prior.deviation[b] = std::sqrt(solver.eigenvalues()[kShapeDofCount - 1 - b] / model.neighbours);
  }
}

void LocalPriorBuilder::build(const PoseDatabase& database, const std::vector<PoseNeighbour>& neighbours,
                              LocalPrior& prior) {
  DMC_CHECK(!neighbours.empty());
  Impl& impl = *impl_;
  const PriorConfig& config = impl.config;
  const int available = std::min(static_cast<int>(neighbours.size()), config.neighbours.back());
  impl.load(database, neighbours, available);
  std::fill(impl.errors.begin(), impl.errors.end(), kImpossible);
  if (config.residual_rad > 0) {
    impl.fit(available, impl.models[0]);
    return impl.write(impl.models[0], kMaxPriorDims, prior);
  }
  std::size_t model_count = 0;
  while (model_count < config.neighbours.size() && config.neighbours[model_count] <= available) {
    impl.fit(config.neighbours[model_count], impl.models[model_count]);
    impl.judge(model_count++);
  }
  if (model_count == 0) {
    impl.fit(available, impl.models[0]);
    impl.judge(0);
  }
  const auto best = std::min_element(impl.errors.begin(), impl.errors.end()) - impl.errors.begin();
  const auto at = static_cast<std::size_t>(best);
  impl.write(impl.models[at / config.dims.size()], config.dims[at % config.dims.size()], prior);
}

double LocalPriorBuilder::modelError(std::size_t i, std::size_t j) const {
  DMC_CHECK(i < impl_->config.neighbours.size() && j < impl_->config.dims.size());
  return impl_->errors[i * impl_->config.dims.size() + j];
}

}  // namespace depthmocap
