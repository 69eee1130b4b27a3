#include <cstdio>
#include <cstdlib>
#include <memory>

#include "apps/view/recording_desk.h"
#include "tests/fuzz/connection.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/made_recording.h"
#include "tests/support/page_files.h"
#include "tests/support/temporary_folder.h"

using namespace depthmocap;

namespace {

constexpr std::string_view kSecret = "no request may read this";  // in files that the page does not list

// Writes a file and ends.
class FakeTracker : public RecordingTracker {
 public:
  [[nodiscard]] const std::vector<ExportFormat>& formats() const override { return formats_; }
  void track(const TrackTask& task, FrameSink&, const ReplayHooks&) override {
    writeBytes(task.folder / (task.name + ".bvh"), "motion");
  }

 private:
  std::vector<ExportFormat> formats_ = {{"bvh", "BVH", ".bvh"}};
};

// The live page with two recordings to open, of which one is broken.
class Page {
 public:
  Page() {
    setenv("TMPDIR", folder_.path().c_str(), 1);  // exports lie beside the secret, so that "../" would reach it
    setenv("DEPTHMOCAP_SHARE", folder_.path().c_str(), 1);
    makeRecording(folder_ / "mine/take", smallCamera(), 2);
    writeBytes(folder_ / "mine/broken/recording.json", "{");
    writeBytes(folder_ / "secret.bvh", std::string(kSecret));
    writeBytes(folder_ / "mine/secret.bvh", std::string(kSecret));
    makePageFiles(folder_ / "page");
    page_ = std::make_unique<LivePage>(WebServerConfig{.port = 0}, folder_ / "page", LivePageInfo{"idle", "none", {}});
    desk_ = std::make_unique<RecordingDesk>(*page_, RecordingShelf(folder_ / "mine"), tracker_, 1);
    page_->start();
    host_ = "127.0.0.1:" + std::to_string(page_->server().port());
  }
  // Ends the program where the answer holds what no request may read.
  void give(std::string_view bytes) const {
    if (askedOnce(page_->server().port(), bytes).find(kSecret) == std::string::npos) return;
    std::fputs("a file that is not listed was sent\n", stderr);
    std::abort();
  }
  void get(std::string_view target) const {
    give("GET " + std::string(target) + " HTTP/1.1\r\nHost: " + host_ + "\r\nConnection: close\r\n\r\n");
  }
  // A text of the stream's client (RFC 6455, section 5.2; the mask is 0).
  void say(std::string_view text) const {
    std::string frame = "\x81";
    if (text.size() < 126) {
      frame += static_cast<char>(0x80 | text.size());
    } else {
      frame += "\xfe";
      frame += static_cast<char>(text.size() >> 8 & 0xff);
      frame += static_cast<char>(text.size() & 0xff);
    }
    give(webSocketHandshake(host_) + frame + std::string(4, '\0') + std::string(text));
  }

 private:
  TemporaryFolder folder_;
  FakeTracker tracker_;
  std::unique_ptr<LivePage> page_;
  std::unique_ptr<RecordingDesk> desk_;
  std::string host_;
};

}  // namespace

// First byte: 0 a connection's bytes as they are, 1 the target of a GET, 2 the query of GET /export, else a message of
// the page.
static void give(std::string_view bytes) {
  static const Page page;
  if (bytes.empty()) return;
  const std::string_view rest = bytes.substr(1);
  if (bytes[0] == 0) return page.give(rest);
  if (bytes[0] == 1) return page.get(rest);
  if (bytes[0] == 2) return page.get("/export?" + std::string(rest));
  page.say(rest);
}
DEPTHMOCAP_FUZZ(give)
