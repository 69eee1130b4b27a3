#pragma once
#include <atomic>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/view_command.h"
#include "apps/view/web_server.h"

namespace depthmocap {

// What a page is about.
struct LivePageInfo {
  std::string mode;                   // "live", "replay" or "idle"
  std::string source;                 // camera or recording, for people
  std::vector<std::string> controls;  // commands that work; the others are not offered
  int people = 1;                     // most that a frame may hold
};

// Who has the page: what the command is about, or a recording that somebody opened in its place.
enum class PageHolder { Command, Opened };

// The page and its stream: serves the files of the page and the body, sends frames and texts, and collects commands.
class LivePage {
 public:
  // `folder` holds the page's files (share/depthmocap/view). Error where one is missing or the address is taken.
  LivePage(const WebServerConfig& config, const std::filesystem::path& folder, LivePageInfo info);

  [[nodiscard]] WebServer& server() { return server_; }
  // After routes of one's own were added.
  void start() { server_.start(); }
  // Before start(). Who does what "open" and "close" ask for, on the server's thread; Error refuses. Without one they
  // do not work.
  void onOpening(std::function<void(const ViewCommand&)> opening) { opening_ = std::move(opening); }

  // Any thread. A recording takes the page, and gives it back; all pages are told.
  void open(LivePageInfo info);
  void close();
  [[nodiscard]] bool isOpened() const { return holder_ == PageHolder::Opened; }
  // Any thread. Whether a frame would reach somebody now: else making one is wasted.
  [[nodiscard]] bool frameWanted(PageHolder holder) const { return holder_ == holder && server_.frameWanted(); }
  // Dropped where another has the page.
  void sendFrame(PageHolder holder, std::string message);
  // {"type": "event", "what": ..., "text": ...} for all pages: what came of a command.
  void sendEvent(const std::string& what, const std::string& text);
  // The oldest command to this holder that was not fetched; at most kMaxCommands wait, more are refused.
  std::optional<ViewCommand> nextCommand(PageHolder holder);

 private:
  static constexpr std::size_t kMaxCommands = 64;

  std::string received(const std::string& text);
  void hand(PageHolder holder, LivePageInfo info);
  [[nodiscard]] std::string hello();
  [[nodiscard]] std::vector<std::string> controls() const;

  const LivePageInfo command_;
  std::function<void(const ViewCommand&)> opening_;
  std::mutex mutex_;
  LivePageInfo info_;  // of the holder; guarded by the mutex, as are
  std::deque<ViewCommand> commands_;
  std::atomic<PageHolder> holder_{PageHolder::Command};
  std::string body_glb_;  // server's thread only
  WebServer server_;      // last: its thread ends first
};

}  // namespace depthmocap
