#pragma once
#include <deque>
#include <filesystem>
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
  std::vector<std::string> controls;  // commands that work; the others are greyed
};

// The page and its stream: serves the files of the page and the body, sends frames and texts, and collects commands.
class LivePage {
 public:
  // `folder` holds the page's files (share/depthmocap/view). Error where one is missing or the address is taken.
  LivePage(const WebServerConfig& config, const std::filesystem::path& folder, LivePageInfo info);

  [[nodiscard]] WebServer& server() { return server_; }
  // After routes of one's own were added.
  void start() { server_.start(); }
  // Any thread. Whether a frame would reach somebody now: else making one is wasted.
  [[nodiscard]] bool frameWanted() const { return server_.frameWanted(); }
  void sendFrame(std::string message);
  // {"type": "event", "what": ..., "text": ...} for all pages: what came of a command.
  void sendEvent(const std::string& what, const std::string& text);
  // The oldest command that was not fetched; at most kMaxCommands wait, more are refused.
  std::optional<ViewCommand> nextCommand();

 private:
  static constexpr std::size_t kMaxCommands = 64;

  std::string received(const std::string& text);
  [[nodiscard]] std::string hello() const;

  LivePageInfo info_;
  std::mutex mutex_;
  std::deque<ViewCommand> commands_;
  std::string body_glb_;  // server's thread only
  WebServer server_;      // last: its thread ends first
};

}  // namespace depthmocap
