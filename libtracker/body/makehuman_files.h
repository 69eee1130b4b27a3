#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Readers for MakeHuman's CC0 data files. All lengths are turned from decimetres to metres. All throw Error, naming the
// file.

// base.obj: all vertices; the triangles of the group `body`; the vertices of each joint cube (group `joint-...`).
struct MakeHumanMesh {
  std::vector<Eigen::Vector3f> vertices;                // [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  // of the body, which uses vertices 0 .. body_vertices - 1
  std::size_t body_vertices = 0;
  std::map<std::string, std::vector<std::uint32_t>> joint_cubes;
};
MakeHumanMesh readMakeHumanMesh(const std::filesystem::path& file);

// A .target.gz morph: displacements of some vertices.
struct MakeHumanTarget {
  std::vector<std::uint32_t> vertex;
  std::vector<Eigen::Vector3f> delta;  // [m]
};
MakeHumanTarget readMakeHumanTarget(const std::filesystem::path& file, std::size_t vertex_count);

// rig.cmu_mb.json: for each bone the vertices whose mean is the joint at its head.
using MakeHumanJoints = std::map<std::string, std::vector<std::uint32_t>>;
MakeHumanJoints readMakeHumanRig(const std::filesystem::path& file, const MakeHumanMesh& mesh);

// weights.cmu_mb.json with the rig's 31 bones merged to ours: hips and lower back to the root, the upper spine to the
// upper back, hands and fingers to the radius, toes to the foot. One row per body vertex, sum 1.
using BoneWeights = std::array<float, kBoneCount>;
std::vector<BoneWeights> readMakeHumanWeights(const std::filesystem::path& file, std::size_t body_vertices);

}  // namespace depthmocap
