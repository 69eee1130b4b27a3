#pragma once

namespace depthmocap {

// Lets the calling thread give way to those of the tracker where both want the processor. What the system refuses is
// passed over.
void runInBackground();

}  // namespace depthmocap
