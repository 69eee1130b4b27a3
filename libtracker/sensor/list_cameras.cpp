#include "libtracker/sensor/list_cameras.h"

#include <algorithm>

#include <linux/videodev2.h>

#include "depthmocap/error.h"
#include "libtracker/sensor/v4l2_format.h"
#ifdef DEPTHMOCAP_OPENNI2
#include "libtracker/openni/openni_runtime.h"
#endif

namespace depthmocap {

namespace {

constexpr int kDevices = 64;
constexpr std::uint32_t kMostFormats = 64;

// Names of the formats that may hold depth; "" if there are none.
std::string depthFormats(V4l2System& system, int device) {
  std::string names;
  for (std::uint32_t i = 0; i < kMostFormats; ++i) {
    v4l2_fmtdesc description{};
    description.index = i;
    description.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;
    if (system.control(device, VIDIOC_ENUM_FMT, &description) < 0) break;
    const auto known = depthFourccs();
    if (std::find(known.begin(), known.end(), description.pixelformat) == known.end()) continue;
    names += (names.empty() ? "" : ", ") + fourccName(description.pixelformat);
  }
  return names;
}

}  // namespace

std::vector<FoundCamera> listOpenNiCameras() {
  std::vector<FoundCamera> found;
#ifdef DEPTHMOCAP_OPENNI2
  try {
    for (const OpenNiDevice& device : openNiDevices(*OpenNiRuntime::start())) {
      found.push_back({"openni2:" + device.uri, device.vendor + " " + device.name, ""});
    }
  } catch (const Error&) {
    return {};  // no driver, no camera
  }
#endif
  return found;
}

std::vector<FoundCamera> listV4l2Cameras(V4l2System& system) {
  std::vector<FoundCamera> found;
  for (int i = 0; i < kDevices; ++i) {
    const std::string path = "/dev/video" + std::to_string(i);
    const int device = system.open(path.c_str());
    if (device < 0) continue;
    v4l2_capability capability{};
    const bool camera = system.control(device, VIDIOC_QUERYCAP, &capability) >= 0;
    const std::string formats = camera ? depthFormats(system, device) : "";
    system.close(device);
    if (formats.empty()) continue;
    const auto* card = reinterpret_cast<const char*>(capability.card);
    found.push_back({"v4l2:" + path, std::string(card, std::find(card, card + sizeof capability.card, '\0')), formats});
  }
  return found;
}

}  // namespace depthmocap
