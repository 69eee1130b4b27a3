#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/sensor/open_source.h"

namespace depthmocap {

// An option of the command line that only one driver has.
struct DriverOption {
  std::string_view flag;    // "--pixel-format"
  std::string_view value;   // what the help shows for its value
  std::string help;         // one line
  std::string_view preset;  // the value that holds without the option, as text; empty: none is shown
  // Puts the value into `options`. Returns "", or what is wrong with `text`.
  std::string (*set)(const std::string& text, SourceOptions& options);
};

// One kind of source. A source's name is the driver's prefix, alone or followed by a colon and an address.
struct CameraDriver {
  std::string_view prefix;         // "v4l2"; unique, without colon
  std::string_view title;          // what users call it: "V4L2"
  std::vector<std::string> names;  // the forms of its names, for people: "v4l2:/dev/videoN"
  std::string_view remark;         // on these names, in the help of --source; may be empty
  std::vector<DriverOption> options;

  // "" where the address can be one, else what is wrong with the name. No address: the name has no colon. Required.
  std::string (*check)(std::optional<std::string_view> address);
  // Opens the source; the address ("": none was given) has passed check(). Throws Error if that fails. A camera that
  // may be unplugged comes as a ReturningSource. Required.
  std::unique_ptr<DepthSource> (*open)(const std::string& address, const SourceOptions& options);
  // The cameras that are plugged in now; never throws Error. Null: it has none to list.
  std::vector<FoundCamera> (*list)();
};

}  // namespace depthmocap
