#include "libtracker/body/makehuman_files.h"
#include "tests/fuzz/fuzz.h"

using namespace depthmocap;

static void read(std::string_view bytes) {
  const MemoryFile file(bytes);
  MakeHumanMesh mesh;
  mesh.vertices.resize(8);
  each([&] { (void)readMakeHumanTarget(file.path(), 8); }, [&] { (void)readMakeHumanWeights(file.path(), 8); },
       [&] { (void)readMakeHumanRig(file.path(), mesh); }, [&] { (void)readMakeHumanMesh(file.path()); });
}
DEPTHMOCAP_FUZZ(read)
