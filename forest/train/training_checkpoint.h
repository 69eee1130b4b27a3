#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "forest/train/trained_tree.h"

namespace depthmocap {

// The trees of an unfinished training, some of them empty or partly grown. `identity` describes the training.
void saveCheckpoint(const std::filesystem::path& path, const std::string& identity,
                    const std::vector<TrainedTree>& trees);

// Nothing where there is no such file. Throws Error where it is damaged or belongs to a training of another identity.
std::vector<TrainedTree> loadCheckpoint(const std::filesystem::path& path, const std::string& identity);

}  // namespace depthmocap
