#pragma once
#include <filesystem>
#include <string>

#include "apps/view/web_server.h"

namespace CLI {
class App;
}

namespace depthmocap {

// The page that shows the tracking.
struct ViewOptions {
  bool on = false;
  std::string address = "127.0.0.1";
  int port = 8010;
  std::string token;
  int vmc_listen = 0;                  // UDP port; 0 = none
  std::filesystem::path folder = ".";  // for what the page records and calibrates
};

// --view-port and its like, for commands that can show a page.
void addViewOptions(CLI::App& command, ViewOptions& options);

// The server that the options ask for. Where the address is no loopback and no token is given, one is made.
WebServerConfig webServerConfig(const ViewOptions& options);

// Where the page's files are.
std::filesystem::path pageFolder();

}  // namespace depthmocap
