#include "libtracker/sensor/v4l2_driver.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <linux/videodev2.h>

#include "libtracker/core/parse_number.h"
#include "libtracker/sensor/camera_driver.h"
#include "libtracker/sensor/returning_source.h"
#include "libtracker/sensor/v4l2_format.h"
#include "libtracker/sensor/v4l2_source.h"

namespace depthmocap {

namespace {

constexpr int kDevices = 64;

// Names of the formats that may hold depth; "" if there are none.
std::string depthFormats(V4l2System& system, int device) {
  std::vector<std::uint32_t> formats = offeredFourccs(system, device);
  const auto known = depthFourccs();
  std::erase_if(formats, [&](std::uint32_t f) { return std::find(known.begin(), known.end(), f) == known.end(); });
  return fourccNames(formats);
}

std::string checkAddress(std::optional<std::string_view> address) {
  return address.value_or("").empty() ? "v4l2 needs a device: v4l2:/dev/video0" : "";
}

std::unique_ptr<DepthSource> open(const std::string& path, const SourceOptions& options) {
  return std::make_unique<ReturningSource>([path, options] { return openV4l2Camera(path, options); });
}

std::string setPixelFormat(const std::string& text, SourceOptions& options) {
  for (const std::uint32_t fourcc : depthFourccs()) {
    if (fourccName(fourcc) != text) continue;
    options.pixel_format = text;
    return "";
  }
  return "'" + text + "' is none of " + fourccNames(depthFourccs());
}

}  // namespace

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

CameraDriver v4l2Driver() {
  return {.prefix = "v4l2",
          .title = "V4L2",
          .names = {"v4l2:/dev/videoN"},
          .remark = "",
          .options = {{"--pixel-format", "FOURCC", "V4L2: the fourcc to use, one of " + fourccNames(depthFourccs()), "",
                       setPixelFormat}},
          .check = checkAddress,
          .open = open,
          .list = [] { return listV4l2Cameras(); }};
}

}  // namespace depthmocap
