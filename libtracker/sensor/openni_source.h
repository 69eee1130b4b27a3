#pragma once
#include <memory>
#include <string>

#include "libtracker/sensor/open_source.h"

namespace depthmocap {

// A camera of the OpenNI2 runtime, by its URI; "" takes the first that is found. A URI whose camera was plugged in
// elsewhere (its part after '@' differs) is found, too. Error: no camera, or one that cannot be used. Unplugged, it
// stays lost: ReturningSource opens it anew.
std::unique_ptr<DepthSource> openOpenNiCamera(const std::string& uri, const SourceOptions& options);

}  // namespace depthmocap
