#pragma once
#include <cstddef>
#include <functional>

#include "forest/train/training_image.h"
#include "libtracker/classify/room_classifier.h"

namespace depthmocap {

// How well people are found in single pictures of rooms: the room classifier and the segmentation together.
struct RoomAccuracy {
  std::size_t pictures = 0;        // with people in them
  std::size_t found = 0;           // of those, with any person found
  double overlap = 0;              // mean intersection over union of all people's pixels, of those pictures
  double recall = 0;               // mean share of the people's pixels that are in the mask
  double precision = 0;            // mean share of the mask's pixels that are people's, where there is a mask
  std::size_t empty_pictures = 0;  // without anybody
  std::size_t false_people = 0;    // of those, with a person found
};

// Labels of the source are RoomClass. `most_people` are looked for in each picture. Pictures with fewer than 50 pixels
// of people are left out. `progress` hears the share done, from any thread.
RoomAccuracy measureRooms(const RoomClassifier& classifier, TrainingImageSource& source, int most_people, int threads,
                          const std::function<void(double)>& progress);

}  // namespace depthmocap
