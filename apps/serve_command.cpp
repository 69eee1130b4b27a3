#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "apps/commands.h"
#include "apps/stop_request.h"
#include "apps/view/live_page.h"
#include "apps/view_options.h"

namespace depthmocap {
namespace {

void serve(const ViewOptions& options) {
  const StopRequest on_ctrl_c;
  LivePage page(webServerConfig(options), pageFolder(), {"idle", "no source", {}});
  page.start();
  std::cerr << "serving " << page.server().url() << std::endl;
  while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void addServeCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("serve", "Serves HTTP and the live page, until Ctrl-C.");
  const auto options = std::make_shared<ViewOptions>();
  command->add_option("--port", options->port, "Port; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command->add_option("--address", options->address, "Numeric address to listen on; others than 127.0.0.1 need a token")
      ->capture_default_str();
  command->add_option("--token", options->token, "Token that requests must show (default: a random one where needed)");
  command->footer("GET /health answers 200. Example:\n  depthmocap serve --port 8010");
  command->callback([options] { serve(*options); });
}

}  // namespace depthmocap
