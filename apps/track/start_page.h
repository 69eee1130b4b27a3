#pragma once
#include <memory>

#include "apps/view/live_page.h"
#include "apps/view/recording_tracker.h"
#include "apps/view/view_options.h"

namespace depthmocap {

// The page where there is no camera and no recording yet: says which cameras are plugged in (GET /cameras) and offers
// recordings to open.
class StartPage {
 public:
  // Whether the command begins by itself once a camera is there.
  enum class Cameras { Listed, WaitedFor };

  // The tracker outlives the page. Error as LivePage.
  StartPage(const WebServerConfig& config, const ViewOptions& options, Cameras cameras, RecordingTracker& tracker);
  ~StartPage();
  StartPage(const StartPage&) = delete;
  StartPage& operator=(const StartPage&) = delete;

  // To be started.
  [[nodiscard]] LivePage& page();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap
