#include "forest/train/room_accuracy.h"

#include <atomic>
#include <vector>

#include "libtracker/core/parallel.h"
#include "libtracker/core/room_class.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {
namespace {

constexpr int kFewestPixels = 50;  // of people, in pictures of 160 x 120

struct Counts {
  int both = 0;
  int found = 0;
  int people = 0;
};

Counts measurePicture(const RoomClassifier& classifier, const TrainingImage& image, int most_people) {
  CameraModel camera;
  camera.width = image.depth.width;
  camera.height = image.depth.height;
  camera.fx = camera.fy = image.focal_px;
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  const SegmentConfig range;
  RoomClassifier::Memory memory;
  RoomMap map;
  const auto look = [&](const DepthImage& depth) -> const RoomMap& {
    classifier.classify(depth, camera, range.min_depth_m, range.max_depth_m, 1, memory, map);
    return map;
  };
  Segmenter segmenter(range);
  Segmentation seen;
  segmenter.segment(image.depth, camera, look, ExpectedPeople(static_cast<std::size_t>(most_people)), seen);
  Counts counts;
  for (std::size_t i = 0; i < image.labels.data.size(); ++i) {
    bool in = false;
    for (const PersonRegion& person : seen.people) in |= person.mask.data[i] != 0;
    const bool is_person = image.labels.data[i] == static_cast<std::uint8_t>(RoomClass::Person);
    counts.both += in && is_person ? 1 : 0;
    counts.found += in ? 1 : 0;
    counts.people += is_person ? 1 : 0;
  }
  return counts;
}

}  // namespace

RoomAccuracy measureRooms(const RoomClassifier& classifier, TrainingImageSource& source, int most_people, int threads,
                          const std::function<void(double)>& progress) {
  std::vector<Counts> counts(source.count());
  std::atomic<std::size_t> done = 0;
  parallelFor(threads, counts.size(), [&](std::size_t i) {
    TrainingImage image;
    source.render(i, image);
    counts[i] = measurePicture(classifier, image, most_people);
    progress(static_cast<double>(++done) / static_cast<double>(counts.size()));
  });
  RoomAccuracy result;
  for (const Counts& c : counts) {
    if (c.people == 0) {
      ++result.empty_pictures;
      result.false_people += c.found > 0 ? 1 : 0;
    } else if (c.people >= kFewestPixels) {
      ++result.pictures;
      result.overlap += static_cast<double>(c.both) / (c.found + c.people - c.both);
      result.recall += static_cast<double>(c.both) / c.people;
      if (c.found == 0) continue;
      ++result.found;
      result.precision += static_cast<double>(c.both) / c.found;
    }
  }
  if (result.pictures > 0) {
    result.overlap /= static_cast<double>(result.pictures);
    result.recall /= static_cast<double>(result.pictures);
  }
  if (result.found > 0) result.precision /= static_cast<double>(result.found);
  return result;
}

}  // namespace depthmocap
