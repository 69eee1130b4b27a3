#include "libtracker/ik/ik_experiment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <ctime>
#include <numbers>
#include <numeric>

#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"
#include "libtracker/ik/image_ik.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

double meanRotationErrorDeg(const Pose& a, const Pose& b) {
  double sum = 0;
  for (int bone = 0; bone < kBoneCount; ++bone) {
    const auto which = static_cast<Bone>(bone);
    sum += Eigen::AngleAxisd(localRotation(which, a).transpose() * localRotation(which, b)).angle();
  }
  return sum / kBoneCount * 180.0 / std::numbers::pi;
}

// Processor time of this thread: other programs do not count.
double threadTime_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

template <typename Solve>
IkFigures figuresOf(const IkSolver& solver, const Pose& q_true, const Solve& solve) {
  const double start_ms = threadTime_ms();
  const IkResult result = solve();
  const double time_ms = threadTime_ms() - start_ms;
  const JointPositions found = jointPositions(solver.skeleton(), result.q);
  const JointPositions truth = jointPositions(solver.skeleton(), q_true);
  return {(found - truth).colwise().norm().mean(), meanRotationErrorDeg(result.q, q_true), result.residual_m, time_ms};
}

IkFigures pictureFiguresOf(const IkSolver& solver, Pose truth, double yaw_rad) {
  constexpr double kScale = 200.0;  // picture units in a metre; the solver does not know it
  truth[kRootRy] = yaw_rad;
  const JointPositions joints = jointPositions(solver.skeleton(), truth);
  ImageTargets targets;
  for (int joint = 0; joint < kJointCount; ++joint) {
    targets.targets.push_back({static_cast<Joint>(joint), kScale * joints.col(joint).head<2>(), 1.0});
  }
  return figuresOf(solver, truth, [&] {
    IkResult result = solveImage(solver, {}, targets);
    result.q[kRootTz] = truth[kRootTz];
    return result;
  });
}

IkFigures meanOf(const std::vector<IkFigures>& figures) {
  IkFigures mean;
  const auto count = static_cast<double>(figures.size());
  for (const IkFigures& f : figures) {
    mean.position_m += f.position_m / count;
    mean.rotation_deg += f.rotation_deg / count;
    mean.residual_m += f.residual_m / count;
    mean.solve_ms += f.solve_ms / count;
  }
  return mean;
}

}  // namespace

std::vector<IkTask> ikTasks(const PoseDatabase& database, const Skeleton& skeleton, const IkExperimentConfig& config) {
  DMC_CHECK(database.size() > 0 && config.joints >= 1 && config.joints <= kJointCount);
  Random random(config.seed, static_cast<std::uint64_t>(config.joints));
  std::vector<IkTask> tasks(static_cast<std::size_t>(config.poses));
  for (IkTask& task : tasks) {
    task.truth = database.pose(random.below(static_cast<std::uint32_t>(database.size())));
    task.truth[kRootRy] = random.uniform(-std::numbers::pi, std::numbers::pi);
    const JointPositions joints = jointPositions(skeleton, task.truth);
    std::array<int, kJointCount> order{};
    std::iota(order.begin(), order.end(), 0);
    for (int i = 0; i < config.joints; ++i) {
      const auto at = static_cast<std::size_t>(i);
      std::swap(order[at], order[at + random.below(static_cast<std::uint32_t>(kJointCount - i))]);
      Eigen::Vector3d p = joints.col(order[at]);
      for (double& x : p) x += config.noise_m * random.normal();
      DMC_CHECK(task.targets.add(static_cast<Joint>(order[at]), p).empty());
    }
  }
  return tasks;
}

IkFigures measureIk(const IkSolver& solver, const std::vector<IkTask>& tasks, int threads) {
  std::vector<IkFigures> figures(tasks.size());
  parallelFor(threads, tasks.size(), [&](std::size_t i) {
    figures[i] = figuresOf(solver, tasks[i].truth, [&] { return solver.solve(tasks[i].targets); });
  });
  return meanOf(figures);
}

IkFigures measureImageIk(const IkSolver& solver, const std::vector<IkTask>& tasks, double yaw_rad, int threads) {
  std::vector<IkFigures> figures(tasks.size());
  parallelFor(threads, tasks.size(),
              [&](std::size_t i) { figures[i] = pictureFiguresOf(solver, tasks[i].truth, yaw_rad); });
  return meanOf(figures);
}

}  // namespace depthmocap
