#include "depthmocap/ik.h"

#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/rotations.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

template <typename Value, std::size_t N>
Value named(const std::array<std::string_view, N>& names, const std::string& name, const char* what) {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw Error(fmt::format("'{}' is none of {}", name, fmt::join(names, ", ")), what);
  return static_cast<Value>(found - names.begin());
}

struct Solution {
  IkResult result;
  JointPositions joints;
};

std::unique_ptr<Ik> makeIk(const std::optional<Actor>& actor, const std::string& prior, const std::string& solver) {
  IkOptions options;
  options.method = named<IkMethod>(kIkMethodNames, solver, "solver");
  options.prior = named<IkPrior>(kIkPriorNames, prior, "prior");
  if (options.method != IkMethod::Lm) options.prior = IkPrior::None;
  const py::gil_scoped_release released;
  return actor ? std::make_unique<Ik>(*actor, options) : std::make_unique<Ik>(options);
}

Solution solve(const Ik& ik, const std::map<std::string, std::array<double, 3>>& targets) {
  JointTargets wanted;
  for (const auto& [name, p] : targets) {
    const std::optional<Joint> joint = jointNamed(name);
    if (!joint) throw Error(fmt::format("there is no joint '{}'", name), "targets", "see depthmocap.JOINTS");
    const std::string refused = wanted.add(*joint, {p[0], p[1], p[2]});
    if (!refused.empty()) throw Error(refused, name);
  }
  const py::gil_scoped_release released;
  const IkResult result = ik.solve(wanted);
  return {result, ik.joints(result.q)};
}

}  // namespace

void bindIk(py::module_& module) {
  py::class_<Solution>(module, "IkSolution", "A whole pose that was found.")
      .def_property_readonly(
          "joints",
          [](const Solution& s) {
            return arrayOf(s.joints, {kJointCount, 3});
          },
          "Joint centres (JOINTS): shape (18, 3), metres, in the frame of the targets.")
      .def_property_readonly(
          "q", [](const Solution& s) { return arrayOf(s.result.q, {kDofCount}); },
          "Degrees of freedom (DOFS): shape (36,), metres and radians.")
      .def_property_readonly(
          "rotations",
          [](const Solution& s) {
            return arrayOf(boneRotations(s.result.q), {kBoneCount, 4});
          },
          "Rotation of each bone (BONES) in its parent: shape (16, 4), quaternions w x y z.")
      .def_property_readonly(
          "residual", [](const Solution& s) { return s.result.residual_m; },
          "Root mean square distance of the targets from their joints, metres.");
  py::class_<Ik>(module, "Ik", "Finds whole poses from the places of some joints.")
      .def(py::init(&makeIk), py::kw_only(), "actor"_a = py::none(), "prior"_a = "gmm", "solver"_a = "lm",
           "actor: whose body; default an adult of average proportions. prior: none, ppca, gmm, autoencoder or vae.\n"
           "solver: lm, or jacobian, ccd, fabrik, which take no prior.")
      .def("solve", &solve, "targets"_a,
           "The pose whose joints lie at {name of JOINTS: (x, y, z)}, metres, y up: IkSolution.");
}

}  // namespace depthmocap
