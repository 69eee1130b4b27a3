#include "apps/view/live_page.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "apps/view/person_colors.h"
#include "depthmocap/error.h"
#include "depthmocap/joints.h"
#include "depthmocap/parts.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/core/json_file.h"
#include "libtracker/output/gltf.h"
#include "libtracker/recording/part_colors.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr double kBodyStature_m = 1.72;  // of the body that the page shows; it scales it to the actor

struct PageFile {
  const char* path;
  const char* name;
  const char* type;
};
constexpr const char* kScript = "text/javascript; charset=utf-8";
constexpr std::array<PageFile, 13> kFiles = {{{"/", "index.html", "text/html; charset=utf-8"},
                                              {"/view.css", "view.css", "text/css; charset=utf-8"},
                                              {"/connection.js", "connection.js", kScript},
                                              {"/colors.js", "colors.js", kScript},
                                              {"/figure.js", "figure.js", kScript},
                                              {"/scene.js", "scene.js", kScript},
                                              {"/people.js", "people.js", kScript},
                                              {"/library.js", "library.js", kScript},
                                              {"/view.js", "view.js", kScript},
                                              {"/keys.js", "keys.js", kScript},
                                              {"/three.min.js", "three.min.js", kScript},
                                              {"/OrbitControls.js", "OrbitControls.js", kScript},
                                              {"/GLTFLoader.js", "GLTFLoader.js", kScript}}};

constexpr std::size_t kMostPageBytes = mebibytes(16);  // of a file; three.js has 1 MB

std::string dumped(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

template <typename Colors>
json colorsIn(const Colors& colors) {
  json list = json::array();
  for (const auto& color : colors) list.push_back({color[0], color[1], color[2]});
  return list;
}

}  // namespace

LivePage::LivePage(const WebServerConfig& config, const std::filesystem::path& folder, LivePageInfo info)
    : command_(std::move(info)), info_(command_), server_(config) {
  for (const PageFile& file : kFiles) {
    const bool open = std::string_view(file.path) != "/";
    server_.serveFile(file.path, {file.type, readFile(folder / file.name, "a file of the page", kMostPageBytes)}, open);
  }
  server_.onGet("/health", [](const std::string&) {
    return WebContent{"application/json", dumped({{"status", "ok"}, {"version", DEPTHMOCAP_VERSION}})};
  });
  server_.onGet("/body.glb", [this](const std::string&) {
    const BoneLengths lengths = averageBoneLengths(kBodyStature_m);
    if (body_glb_.empty()) body_glb_ = gltfBytes(makeBuiltinBody(lengths), {lengths, {}});
    return WebContent{"model/gltf-binary", body_glb_};
  });
  server_.setGreeting([this] { return hello(); });
  server_.onText([this](const std::string& text) { return received(text); });
}

std::vector<std::string> LivePage::controls() const {
  std::vector<std::string> all = info_.controls;
  if (opening_) all.emplace_back("open");
  if (opening_) all.emplace_back("close");
  return all;
}

std::string LivePage::hello() {
  const std::lock_guard lock(mutex_);
  return dumped({{"type", "hello"},
                 {"version", 1},
                 {"mode", info_.mode},
                 {"source", info_.source},
                 {"opened", holder_ == PageHolder::Opened},
                 {"controls", controls()},
                 {"people", info_.people},
                 {"joints", kJointNames},
                 {"parts", kPartNames},
                 {"part_colors", colorsIn(kPartColors)},
                 {"person_colors", colorsIn(kPersonColors)},
                 {"body_stature_m", kBodyStature_m}});
}

std::string LivePage::received(const std::string& text) {
  try {
    const ViewCommand command = parseViewCommand(text);
    const std::string name = parseJson(text, "message")["type"];
    const bool opens = command.action == ViewAction::Open || command.action == ViewAction::Close;
    if (opens && opening_) {
      opening_(command);
      return {};
    }
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(info_.controls, name) == info_.controls.end()) {
      throw Error("\"" + name + "\" does not work here", "message");
    }
    if (commands_.size() >= kMaxCommands) throw Error("too many commands are waiting", "message");
    commands_.push_back(command);
    return {};
  } catch (const Error& error) {
    return dumped({{"type", "error"}, {"error", error.what()}});
  }
}

void LivePage::open(LivePageInfo info) {
  hand(PageHolder::Opened, std::move(info));
}

void LivePage::close() {
  hand(PageHolder::Command, command_);
}

void LivePage::hand(PageHolder holder, LivePageInfo info) {
  {
    const std::lock_guard lock(mutex_);
    holder_ = holder;
    info_ = std::move(info);
    commands_.clear();  // they were meant for the one before
  }
  server_.sendText(hello());
}

void LivePage::sendFrame(PageHolder holder, std::string message) {
  if (holder_ == holder) server_.sendFrame(std::make_shared<const std::string>(std::move(message)));
}

void LivePage::sendEvent(const std::string& what, const std::string& text) {
  server_.sendText(dumped({{"type", "event"}, {"what", what}, {"text", text}}));
}

std::optional<ViewCommand> LivePage::nextCommand(PageHolder holder) {
  const std::lock_guard lock(mutex_);
  if (holder_ != holder || commands_.empty()) return std::nullopt;
  ViewCommand command = std::move(commands_.front());
  commands_.pop_front();
  return command;
}

}  // namespace depthmocap
