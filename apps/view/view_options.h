#pragma once
#include <filesystem>

#include "apps/track/track_options.h"
#include "apps/view/web_server.h"

namespace CLI {
class App;
}

namespace depthmocap {

// --view-port and its like, for commands that can show a page.
void addViewOptions(CLI::App& command, ViewOptions& options);

// The server that the options ask for. Where the address is no loopback and no token is given, one is made.
WebServerConfig webServerConfig(const ViewOptions& options);

// Where the page's files are.
std::filesystem::path pageFolder();

}  // namespace depthmocap
