#pragma once
#include <utility>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/classify/room_network.h"
#include "libtracker/core/room_map.h"

namespace depthmocap {

// Stage (0): which cells of a coarse image show people, which the room? A small network learnt from rendered rooms
// (docs/lab/rooms.md): evidence that does not depend on what hangs together. Constant, may be shared by threads.
class RoomClassifier {
 public:
  using Memory = RoomNetworkMemory;
  explicit RoomClassifier(RoomNetwork network) : network_(std::move(network)) {}

  // `depth` [m] has the camera's size; measurements outside [min_depth_m, max_depth_m] count as none. The same result
  // for any number of threads. No allocation once `memory` and `map` have seen an image of this size.
  void classify(const DepthImage& depth, const CameraModel& camera, double min_depth_m, double max_depth_m, int threads,
                Memory& memory, RoomMap& map) const;

 private:
  RoomNetwork network_;
};

}  // namespace depthmocap
