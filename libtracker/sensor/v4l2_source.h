#pragma once
#include <memory>
#include <string>

#include "libtracker/sensor/open_source.h"
#include "libtracker/sensor/v4l2_system.h"

namespace depthmocap {

// A V4L2 camera. Pictures of 512x424 are taken for those of a Kinect of 2013 as libfreenect2 gives them (millimetres,
// with the lens's distortion) unless `options` bring another calibration. Unplugged, it stays lost: ReturningSource
// opens it anew. `system` outlives the camera.
std::unique_ptr<DepthSource> openV4l2Camera(const std::string& path, const SourceOptions& options,
                                            V4l2System& system = realV4l2System());

}  // namespace depthmocap
