#include "libtracker/openni/openni_runtime.h"

#include <cctype>
#include <mutex>

#include <OpenNI.h>

#include "depthmocap/error.h"

namespace depthmocap {

std::string openNiError() {
  std::string text;
  for (const char c : std::string(openni::OpenNI::getExtendedError())) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space) text += c;
    if (space && !text.empty() && text.back() != ' ') text += ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text.empty() ? "no reason given" : text;
}

OpenNiRuntime::OpenNiRuntime() {
  if (openni::OpenNI::initialize() == openni::STATUS_OK) return;
  const std::string why = openNiError();
  openni::OpenNI::shutdown();
  throw Error("cannot be started: " + why, "OpenNI2",
              "drivers lie in OpenNI2/Drivers beside libOpenNI2.so, or where OpenNI.ini says");
}

OpenNiRuntime::~OpenNiRuntime() {
  openni::OpenNI::shutdown();
}

std::shared_ptr<OpenNiRuntime> OpenNiRuntime::start() {
  static std::mutex mutex;
  static std::weak_ptr<OpenNiRuntime> running;
  const std::lock_guard lock(mutex);
  std::shared_ptr<OpenNiRuntime> runtime = running.lock();
  if (!runtime) {
    runtime.reset(new OpenNiRuntime);
    running = runtime;
  }
  return runtime;
}

std::vector<OpenNiDevice> openNiDevices(const OpenNiRuntime&) {
  openni::Array<openni::DeviceInfo> list;
  openni::OpenNI::enumerateDevices(&list);
  std::vector<OpenNiDevice> devices;
  devices.reserve(static_cast<std::size_t>(list.getSize()));
  for (int i = 0; i < list.getSize(); ++i) {
    devices.push_back({list[i].getUri(), list[i].getVendor(), list[i].getName()});
  }
  return devices;
}

}  // namespace depthmocap
