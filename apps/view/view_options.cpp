#include "apps/view/view_options.h"

#include <CLI/CLI.hpp>

#include "apps/view/request_guard.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {

void addViewOptions(CLI::App& command, ViewOptions& o) {
  command.add_flag("--view", o.on, "Serves a page that shows the tracking, and prints its address");
  command.add_option("--view-port", o.port, "Port of the page; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command.add_option("--view-address", o.address, "Numeric address to listen on; others than 127.0.0.1 need a token")
      ->capture_default_str();
  command
      .add_option("--vmc-listen", o.vmc_listen,
                  "UDP port, as a rule 39540, on which a VMC assistant may start the calibration of live --view")
      ->check(CLI::Range(1, 65535))
      ->needs("--view");
  command.add_option("--view-folder", o.folder, "Folder for what the page records and calibrates")
      ->capture_default_str();
  command.add_option("--view-token", o.token, "Token that requests must show (default: a random one where needed)");
}

WebServerConfig webServerConfig(const ViewOptions& options) {
  WebServerConfig config;
  config.address = options.address;
  config.port = static_cast<std::uint16_t>(options.port);
  config.token = options.token;
  if (config.token.empty() && !isLoopback(config.address)) config.token = randomToken();
  return config;
}

std::filesystem::path pageFolder() {
  return shippedFile("view/index.html").parent_path();
}

}  // namespace depthmocap
