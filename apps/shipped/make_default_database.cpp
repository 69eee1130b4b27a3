// Makes the pose database that comes with the library: a step of the build.
//
// Usage: depthmocap_make_database MIXTURE DATABASE
#include <algorithm>
#include <exception>
#include <iostream>
#include <thread>

#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb_build/compose_pose_database.h"

int main(int argc, char** argv) {
  using namespace depthmocap;
  if (argc != 3) {
    std::cerr << "usage: depthmocap_make_database MIXTURE DATABASE\n";
    return 2;
  }
  try {
    PoseDatabaseSources sources;
    sources.procedural = true;
    sources.clips = proceduralMotions(sources.seed);
    sources.mixture = loadPoseMixture(argv[1]);
    PoseDatabaseConfig config;
    config.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    savePoseDatabase(composePoseDatabase(sources, config).database, argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "depthmocap_make_database: " << error.what() << '\n';
    return 1;
  }
}
