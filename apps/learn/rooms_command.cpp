#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/learn/forest_data.h"
#include "apps/program/learning.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "depthmocap/error.h"
#include "forest/train/room_accuracy.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/parallel.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {
namespace {

constexpr std::size_t kPicturesATime = 256;  // rendered before they are written; bounds the memory

template <typename T>
void append(std::string& bytes, T value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// One picture as scripts/train-rooms reads it, little-endian: width, height (uint16), focal length [px] (float), depth
// [mm] (uint16 each), RoomClass (uint8 each), row by row.
std::string packed(const TrainingImage& image) {
  std::string bytes;
  append(bytes, static_cast<std::uint16_t>(image.depth.width));
  append(bytes, static_cast<std::uint16_t>(image.depth.height));
  append(bytes, static_cast<float>(image.focal_px));
  for (const float z : image.depth.data) append(bytes, static_cast<std::uint16_t>(std::lround(z * 1000.0F)));
  bytes.append(reinterpret_cast<const char*>(image.labels.data.data()), image.labels.data.size());
  return bytes;
}

void drawRooms(const DataOptions& data, PoseUse use, std::size_t images, const std::string& out) {
  OutputCheck check;
  readsData(check, data);
  check.writes("--out", out);
  const ImageSet set = makeImageSet(data, use, images);
  AtomicFile file(out);
  const StopRequest on_ctrl_c;
  Progress bar("rendering", images);
  std::vector<std::string> pictures;
  for (std::size_t first = 0; first < images; first += kPicturesATime) {
    if (StopRequest::made()) throw Error("stopped before the end; nothing was written", out);
    pictures.assign(std::min(kPicturesATime, images - first), {});
    parallelFor(data.threads, pictures.size(), [&](std::size_t i) {
      TrainingImage image;
      set.source->render(first + i, image);
      pictures[i] = packed(image);
    });
    for (const std::string& picture : pictures) file.write(picture);
    bar.update(first + pictures.size());
  }
  file.commit();
  std::cerr << set.source->description() << '\n';
}

void addRoomOptions(CLI::App& command, DataOptions& data) {
  data.rooms = true;
  addDataOptions(command, data);
  command.add_option("--sitter-share", data.sitter_share, "Share of the people whose pose is drawn anew until it sits")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

void addRoomsDraw(CLI::App& rooms) {
  struct Options {
    DataOptions data;
    std::string out;
    std::size_t images = 40000;
    bool held_out = false;
  };
  auto c = std::make_shared<Options>();
  CLI::App* command = rooms.add_subcommand("draw", "Renders furnished rooms for scripts/train-rooms to learn from");
  command->add_option("--out", c->out, "File of pictures with labels")->required();
  command->add_option("--images", c->images, "Rooms to render")->capture_default_str();
  command->add_flag("--held-out", c->held_out, "Rooms, bodies and poses that training never sees");
  addRoomOptions(*command, c->data);
  command->callback([c] { drawRooms(c->data, c->held_out ? PoseUse::Validate : PoseUse::Train, c->images, c->out); });
}

void addRoomsMeasure(CLI::App& rooms) {
  struct Options {
    DataOptions data;
    std::string file;
    std::size_t images = 1000;
    int people = kMostPeople;
  };
  auto c = std::make_shared<Options>();
  CLI::App* command =
      rooms.add_subcommand("measure", "Measures how well people are found in furnished rooms, on held-out renders");
  command->add_option("FILE", c->file, "Network, of scripts/train-rooms")->required();
  command->add_option("--images", c->images, "Rendered rooms to measure on")->capture_default_str();
  command->add_option("--people", c->people, "Most people that are looked for in a picture")
      ->check(CLI::Range(1, kMostPeople))
      ->capture_default_str();
  addRoomOptions(*command, c->data);
  command->callback([c] {
    const RoomClassifier classifier(loadRoomNetwork(c->file));
    const ImageSet set = makeImageSet(c->data, PoseUse::Validate, c->images);
    Progress bar("measuring", c->images);
    const RoomAccuracy a = measureRooms(classifier, *set.source, c->people, c->data.threads, [&](double done) {
      bar.update(static_cast<std::size_t>(done * static_cast<double>(c->images)));
    });
    std::cout << fmt::format(
        "{}\n{} pictures with people: somebody found in {:.1f} %, overlap {:.3f}, recall {:.3f}, precision {:.3f}\n"
        "{} pictures without: somebody found in {}\n",
        set.source->description(), a.pictures,
        100.0 * static_cast<double>(a.found) / std::max<double>(1, static_cast<double>(a.pictures)), a.overlap,
        a.recall, a.precision, a.empty_pictures, a.false_people);
  });
}

}  // namespace

void addRoomsCommand(CLI::App& app) {
  CLI::App* rooms = app.add_subcommand(kRoomsCommand.name, kRoomsCommand.help);
  rooms->require_subcommand(1);
  addRoomsDraw(*rooms);
  addRoomsMeasure(*rooms);
}

}  // namespace depthmocap
