#pragma once
#include <iosfwd>

#include "depthmocap/export.h"
#include "depthmocap/tracked_frame.h"

namespace depthmocap {

// Writes a joints file (docs/reference/formats.md) to a stream, the same bytes as `depthmocap replay --joints`: a
// header row, then one row per frame with joint centres [m] in the camera frame and confidences. Not thread-safe.
class DEPTHMOCAP_API JointsCsv {
 public:
  // Writes the header. The stream must outlive the writer.
  explicit JointsCsv(std::ostream& out);

  // Writes one row; coordinates of a lost frame stay empty. Throws Error where the stream has failed.
  void write(const TrackedFrame& frame);

 private:
  std::ostream& out_;
};

}  // namespace depthmocap
