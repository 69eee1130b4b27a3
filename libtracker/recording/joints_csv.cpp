#include "depthmocap/joints_csv.h"

#include <ostream>

#include "depthmocap/error.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

JointsCsv::JointsCsv(std::ostream& out) : out_(out) {
  out_ << jointsHeader();
}

void JointsCsv::write(const TrackedFrame& frame) {
  out_ << jointsLine(jointsRow(frame));
  if (!out_) throw Error("cannot be written", "joints file");
}

}  // namespace depthmocap
