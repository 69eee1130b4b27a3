#pragma once
#include <array>
#include <filesystem>

#include "libtracker/classify/convolution.h"

namespace depthmocap {

// What the network is asked about each pixel.
inline constexpr int kRoomClasses = 3;  // person; floor, walls and ceiling; furniture

// A convolutional network of the form of U-Net (Ronneberger, Fischer and Brox 2015), small enough for every frame: it
// halves the picture four times, and goes back to half the size of the picture, taking in what it saw on the way down.
// Learnt by scripts/train-rooms (forest/models/rooms.report.md).
struct RoomNetwork {
  // c1 .. c8 on the way down, u3 u2 u1 on the way up, and the last layer.
  std::array<ConvolutionLayer, 12> layers;

  static constexpr int kInputs = 4;  // see scripts/train-rooms: depth, whether measured, its inverse, size of a pixel
  static constexpr int kMultiple = 16;  // [px] width and height of the input are multiples of this
};

// Throws Error where the file is missing or damaged, or its layers do not fit each other.
RoomNetwork loadRoomNetwork(const std::filesystem::path& path);

// The working memory of evaluate(), for reuse.
struct RoomNetworkMemory {
  FeatureMaps input;
  std::array<PairedMaps, 12> paired;  // the input of each layer, in whole numbers
  std::array<FeatureMaps, 12> maps;   // the output of each layer
  std::array<FeatureMaps, 3> joined;  // the inputs of u3, u2, u1
};

// memory.input (kInputs maps) to the returned kRoomClasses maps of half its size: the classes' scores. The same bits
// for any number of threads.
const FeatureMaps& evaluate(const RoomNetwork& network, int threads, RoomNetworkMemory& memory);

}  // namespace depthmocap
