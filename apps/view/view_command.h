#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace depthmocap {

// What a viewer asks for.
enum class ViewAction { Play, Pause, Seek, Speed, Record, Calibrate, Reset, Lock, Open, Close };

struct ViewCommand {
  ViewAction action = ViewAction::Play;
  std::int64_t frame = 0;      // Seek: index of the frame among those that were tracked (>= 0)
  double speed = 1;            // Speed: 1 = as recorded (0.1 .. 8)
  bool on = false;             // Record
  double x = 0, y = 0;         // Lock: place in the depth picture as shares of its width and height (0 .. 1)
  std::string recording = {};  // Open: its id in the list of recordings
  int people = 0;              // Open: most that are tracked (1 .. kMostPeople); 0: as the command was told
};

// The command that a text message of the stream gives (docs/reference/stream.md). Error says what is wrong with it.
ViewCommand parseViewCommand(const std::string& text);

}  // namespace depthmocap
