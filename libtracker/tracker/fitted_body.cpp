#include "libtracker/tracker/fitted_body.h"

#include <algorithm>

#include "libtracker/tracker/tracker_impl.h"

namespace depthmocap {

bool FittedBody::isWanted(const Tracker& tracker) {
  const auto& people = tracker.impl_->people;
  return std::any_of(people.begin(), people.end(), [](const auto& p) { return p->memory.body().fitsShape(); });
}

void FittedBody::keep(Tracker& tracker) {
  for (const auto& person : tracker.impl_->people) person->memory.keepBody();
}

}  // namespace depthmocap
