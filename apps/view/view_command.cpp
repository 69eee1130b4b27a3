#include "apps/view/view_command.h"

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {
namespace {

using nlohmann::json;

constexpr const char* kWhere = "message";
constexpr std::array<std::pair<std::string_view, ViewAction>, 10> kNames = {{{"play", ViewAction::Play},
                                                                             {"pause", ViewAction::Pause},
                                                                             {"seek", ViewAction::Seek},
                                                                             {"speed", ViewAction::Speed},
                                                                             {"record", ViewAction::Record},
                                                                             {"calibrate", ViewAction::Calibrate},
                                                                             {"reset", ViewAction::Reset},
                                                                             {"lock", ViewAction::Lock},
                                                                             {"open", ViewAction::Open},
                                                                             {"close", ViewAction::Close}}};

double numberIn(const json& message, const char* key, double low, double high) {
  const double value = jsonNumber(message, key, kWhere);
  if (value < low || value > high) throw Error(fmt::format("\"{}\" lies outside {} .. {}", key, low, high), kWhere);
  return value;
}

ViewAction actionOf(const std::string& name) {
  for (const auto& [known, action] : kNames) {
    if (name == known) return action;
  }
  throw Error("\"type\" is no command", kWhere,
              "play, pause, seek, speed, record, calibrate, reset, lock, open or close");
}

}  // namespace

ViewCommand parseViewCommand(const std::string& text) {
  const json message = parseJson(text, kWhere);
  ViewCommand command;
  command.action = actionOf(jsonString(message, "type", kWhere));
  constexpr double kLastFrame = 1e9;
  if (command.action == ViewAction::Seek) {
    command.frame = static_cast<std::int64_t>(numberIn(message, "frame", 0, kLastFrame));
  }
  if (command.action == ViewAction::Speed) command.speed = numberIn(message, "value", 0.1, 8);
  if (command.action == ViewAction::Record) command.on = numberIn(message, "on", 0, 1) > 0;
  if (command.action == ViewAction::Lock) {
    command.x = numberIn(message, "x", 0, 1);
    command.y = numberIn(message, "y", 0, 1);
  }
  if (command.action == ViewAction::Open) {
    command.recording = jsonString(message, "recording", kWhere);
    if (message.contains("people")) command.people = static_cast<int>(numberIn(message, "people", 1, kMostPeople));
  }
  return command;
}

}  // namespace depthmocap
