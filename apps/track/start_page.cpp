#include "apps/track/start_page.h"

#include <nlohmann/json.hpp>

#include "apps/view/recording_desk.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/sensor/usb_cameras.h"

namespace depthmocap {
namespace {

using nlohmann::json;

// What is plugged in with what keeps it from working, and what can be opened.
WebContent camerasIn(bool waited_for) {
  json plugged = json::array();
  for (const UsbCamera& camera : findUsbCameras()) {
    plugged.push_back({{"name", camera.name}, {"use", camera.use}, {"mends", camera.mends}});
  }
  json ready = json::array();
  for (const FoundCamera& camera : cameraDrivers().list()) {
    ready.push_back({{"name", camera.name}, {"source", camera.source}});
  }
  const json all = {{"plugged", plugged}, {"ready", ready}, {"waits", waited_for}};
  return {"application/json", all.dump(-1, ' ', false, json::error_handler_t::replace)};
}

}  // namespace

struct StartPage::Impl {
  Impl(const WebServerConfig& config, const ViewOptions& options, RecordingTracker& tracker)
      : page(config, pageFolder(), {"idle", "no camera", {}}), desk(page, RecordingShelf(options.folder), tracker, 1) {}

  LivePage page;
  RecordingDesk desk;
};

StartPage::StartPage(const WebServerConfig& config, const ViewOptions& options, Cameras cameras,
                     RecordingTracker& tracker)
    : impl_(std::make_unique<Impl>(config, options, tracker)) {
  const bool waited_for = cameras == Cameras::WaitedFor;
  page().server().onGetAside("/cameras", [waited_for](const std::string&) { return camerasIn(waited_for); });
}

StartPage::~StartPage() = default;

LivePage& StartPage::page() {
  return impl_->page;
}

}  // namespace depthmocap
