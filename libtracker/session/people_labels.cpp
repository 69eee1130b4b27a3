#include "libtracker/session/people_labels.h"

namespace depthmocap {

const PartImage& labelsOfAll(std::span<const TrackedFrame* const> people, int step, PartImage& all) {
  if (people.size() == 1) return people.front()->labels;
  all = people.front()->labels;
  for (const TrackedFrame* person : people.subspan(1)) {
    for (std::size_t i = 0; i < all.data.size(); ++i) {
      const std::uint8_t part = person->labels.data[i];
      if (part != 0) all.data[i] = static_cast<std::uint8_t>(part + step * (person->person - 1));
    }
  }
  return all;
}

}  // namespace depthmocap
