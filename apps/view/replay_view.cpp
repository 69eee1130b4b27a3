#include "apps/view/replay_view.h"

#include <iostream>

#include "apps/view/live_page.h"
#include "apps/view/recording_desk.h"
#include "apps/view/recording_player.h"

namespace depthmocap {

struct ReplayView::Impl {
  Impl(const ViewOptions& options, const NamedRecording& recording, std::size_t total, int people,
       RecordingTracker& tracker)
      : page(webServerConfig(options), pageFolder(),
             {"replay", recording.path.filename().string(), RecordingPlayer::kControls, people}),
        player(page, PageHolder::Command, openRecording(recording.path, recording.correction), total),
        desk(page, RecordingShelf(options.folder, recording), tracker, people) {}

  LivePage page;
  RecordingPlayer player;
  RecordingDesk desk;
};

ReplayView::ReplayView(const ViewOptions& options, const NamedRecording& recording, std::size_t total, int people,
                       RecordingTracker& tracker)
    : impl_(std::make_unique<Impl>(options, recording, total, people, tracker)) {
  impl_->page.start();
  std::cerr << "view: " << impl_->page.server().url() << std::endl;
}

ReplayView::~ReplayView() = default;

void ReplayView::onFrame(const SessionFrame& frame) {
  impl_->player.onFrame(frame);
}

void ReplayView::tracked() {
  impl_->player.tracked();
}

}  // namespace depthmocap
