#include "apps/view/live_page.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

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
constexpr std::array<PageFile, 7> kFiles = {{{"/", "index.html", "text/html; charset=utf-8"},
                                             {"/view.css", "view.css", "text/css; charset=utf-8"},
                                             {"/scene.js", "scene.js", kScript},
                                             {"/view.js", "view.js", kScript},
                                             {"/three.min.js", "three.min.js", kScript},
                                             {"/OrbitControls.js", "OrbitControls.js", kScript},
                                             {"/GLTFLoader.js", "GLTFLoader.js", kScript}}};

constexpr std::size_t kMostPageBytes = mebibytes(16);  // of a file; three.js has 1 MB

std::string dumped(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

LivePage::LivePage(const WebServerConfig& config, const std::filesystem::path& folder, LivePageInfo info)
    : info_(std::move(info)), server_(config) {
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

std::string LivePage::hello() const {
  json colors = json::array();
  for (const auto& color : kPartColors) colors.push_back({color[0], color[1], color[2]});
  return dumped({{"type", "hello"},
                 {"version", 1},
                 {"mode", info_.mode},
                 {"source", info_.source},
                 {"controls", info_.controls},
                 {"joints", kJointNames},
                 {"parts", kPartNames},
                 {"part_colors", colors},
                 {"body_stature_m", kBodyStature_m}});
}

std::string LivePage::received(const std::string& text) {
  try {
    const ViewCommand command = parseViewCommand(text);
    const std::string name = parseJson(text, "message")["type"];
    if (std::find(info_.controls.begin(), info_.controls.end(), name) == info_.controls.end()) {
      throw Error("\"" + name + "\" does not work here", "message");
    }
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= kMaxCommands) throw Error("too many commands are waiting", "message");
    commands_.push_back(command);
    return {};
  } catch (const Error& error) {
    return dumped({{"type", "error"}, {"error", error.what()}});
  }
}

void LivePage::sendFrame(std::string message) {
  server_.sendFrame(std::make_shared<const std::string>(std::move(message)));
}

void LivePage::sendEvent(const std::string& what, const std::string& text) {
  server_.sendText(dumped({{"type", "event"}, {"what", what}, {"text", text}}));
}

std::optional<ViewCommand> LivePage::nextCommand() {
  const std::lock_guard lock(mutex_);
  if (commands_.empty()) return std::nullopt;
  const ViewCommand command = commands_.front();
  commands_.pop_front();
  return command;
}

}  // namespace depthmocap
