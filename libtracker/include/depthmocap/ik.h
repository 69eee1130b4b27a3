#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "depthmocap/actor.h"
#include "depthmocap/export.h"
#include "depthmocap/ik_result.h"
#include "depthmocap/joint_targets.h"
#include "depthmocap/joints.h"

namespace depthmocap {

// Solvers. Lm is Levenberg-Marquardt as in MNN-IK (Hu, Zhang, Xia 2021), the only one that takes a prior; Latent is
// latent IK (after VPoser, Pavlakos et al. 2019), whose poses are those that the variational autoencoder can make; the
// others are the classic baselines.
enum class IkMethod { Lm, Jacobian, Ccd, Fabrik, Latent };
inline constexpr std::array<std::string_view, 5> kIkMethodNames = {"lm", "jacobian", "ccd", "fabrik", "latent"};

// What says how natural a pose is, learned from captured poses: a Gaussian, a mixture of Gaussians, two networks.
enum class IkPrior { None, Ppca, Gmm, Autoencoder, Vae };
inline constexpr int kIkPriorCount = 5;
inline constexpr std::array<std::string_view, kIkPriorCount> kIkPriorNames = {"none", "ppca", "gmm", "autoencoder",
                                                                              "vae"};

struct IkOptions {
  IkMethod method = IkMethod::Lm;
  IkPrior prior = IkPrior::Gmm;           // with IkMethod::Lm only; IkPrior::None for the others
  std::filesystem::path learned_poses{};  // of the prior and of Latent; empty: those that come with the library
  // [m] (>= 0) how far a joint may stay from its target for one unit of the prior: 1 mm suits exact targets, half of
  // what each coordinate is off by suits others.
  double weight_m = 0.001;
};

// Finds whole poses from the places of some joints. Constant after construction: threads may share one. Deterministic.
class DEPTHMOCAP_API Ik {
 public:
  // `actor`: the body; the other form takes an adult of average proportions. Throws Error where learned poses are
  // missing or damaged, or where the options do not go together.
  explicit Ik(const IkOptions& options = {});
  Ik(const Actor& actor, const IkOptions& options = {});
  ~Ik();
  Ik(Ik&& other) noexcept;
  Ik& operator=(Ik&& other) noexcept;

  // The pose whose joints lie at the targets [m] (world, y up), within joint limits; the nearest pose that is found
  // where targets are out of reach. Throws Error where there is no target.
  [[nodiscard]] IkResult solve(const JointTargets& targets) const;

  // The joints of this body in a pose [m], in the pose's world.
  [[nodiscard]] JointPositions joints(const Pose& q) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace depthmocap
