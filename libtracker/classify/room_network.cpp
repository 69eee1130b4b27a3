#include "libtracker/classify/room_network.h"

#include <algorithm>
#include <string_view>

#include "libtracker/core/byte_reader.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

enum Layer : std::size_t { kC1, kC2, kC3, kC4, kC5, kC6, kC7, kC8, kU3, kU2, kU1, kOut };

constexpr std::string_view kMagic = "DMRN";
constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kMostMaps = 512;  // of a layer

// Layers whose outputs a layer takes; the last three of the way up take two.
constexpr std::array<int, 12> kFrom = {-1, kC1, kC2, kC3, kC4, kC5, kC6, kC7, kC8, kU3, kU2, kU1};
constexpr std::array<int, 12> kSkip = {-1, -1, -1, -1, -1, -1, -1, -1, kC5, kC3, kC1, -1};

ConvolutionLayer readLayer(ByteReader& file) {
  ConvolutionLayer layer;
  layer.inputs = static_cast<int>(file.count(kMostMaps));
  layer.outputs = static_cast<int>(file.count(kMostMaps));
  layer.kernel = static_cast<int>(file.count(5));
  layer.stride = static_cast<int>(file.count(2));
  layer.dilation = static_cast<int>(file.count(2));
  file.check(layer.inputs > 0 && layer.outputs > 0 && layer.kernel % 2 == 1 && layer.stride > 0 && layer.dilation > 0);
  file.check(layer.dilation * (layer.kernel / 2) <= PairedMaps::kBorder);
  const auto taps = static_cast<std::size_t>(layer.kernel) * static_cast<std::size_t>(layer.kernel) *
                    static_cast<std::size_t>(layer.inputs);
  layer.weights.resize(static_cast<std::size_t>(layer.outputs) * taps);
  layer.biases.resize(static_cast<std::size_t>(layer.outputs));
  for (std::vector<float>* values : {&layer.weights, &layer.biases}) {
    file.require(values->size() * sizeof(float));
    file.raw(values->data(), values->size() * sizeof(float));
    file.check(std::ranges::all_of(*values, [](float v) { return v > -1e6F && v < 1e6F; }));
  }
  layer.prepare();
  return layer;
}

// Twice as large, each pixel four times; then the maps of `skip`.
void join(const FeatureMaps& small, const FeatureMaps& skip, FeatureMaps& joined) {
  joined.resize(small.maps() + skip.maps(), skip.width(), skip.height());
  for (int m = 0; m < joined.maps(); ++m) {
    for (int y = 0; y < joined.height(); ++y) {
      float* to = joined.row(m, y);
      if (m >= small.maps()) {
        std::copy_n(skip.row(m - small.maps(), y), joined.width(), to);
        continue;
      }
      const float* from = small.row(m, y / 2);
      for (int x = 0; x < joined.width(); ++x) to[x] = from[x / 2];
    }
  }
}

}  // namespace

RoomNetwork loadRoomNetwork(const std::filesystem::path& path) {
  ByteReader file(path, "the room network");
  std::array<char, 4> magic{};
  file.raw(magic.data(), magic.size());
  file.check(std::string_view(magic.data(), magic.size()) == kMagic);
  file.check(file.count(kVersion) == kVersion);
  RoomNetwork network;
  file.check(file.count(static_cast<std::uint32_t>(network.layers.size())) == network.layers.size());
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    network.layers[i] = readLayer(file);
    int inputs = RoomNetwork::kInputs;
    if (kFrom[i] >= 0) inputs = network.layers[static_cast<std::size_t>(kFrom[i])].outputs;
    if (kSkip[i] >= 0) inputs += network.layers[static_cast<std::size_t>(kSkip[i])].outputs;
    const bool halves = i == kC1 || i == kC2 || i == kC4 || i == kC6;
    file.check(network.layers[i].inputs == inputs && network.layers[i].stride == (halves ? 2 : 1));
  }
  file.check(network.layers.back().outputs == kRoomClasses);
  file.end();
  return network;
}

const FeatureMaps& evaluate(const RoomNetwork& network, int threads, RoomNetworkMemory& memory) {
  DMC_CHECK(memory.input.width() % RoomNetwork::kMultiple == 0 && memory.input.height() % RoomNetwork::kMultiple == 0);
  for (std::size_t i = 0; i < network.layers.size(); ++i) {
    const FeatureMaps* input = kFrom[i] < 0 ? &memory.input : &memory.maps[static_cast<std::size_t>(kFrom[i])];
    if (kSkip[i] >= 0) {
      FeatureMaps& joined = memory.joined[i - kU3];
      join(*input, memory.maps[static_cast<std::size_t>(kSkip[i])], joined);
      input = &joined;
    }
    convolve(network.layers[i], *input, {.rectify = i != kOut, .threads = threads}, memory.paired[i], memory.maps[i]);
  }
  return memory.maps[kOut];
}

}  // namespace depthmocap
