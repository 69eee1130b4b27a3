#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <thread>

#include "apps/commands.h"
#include "apps/ik/request.h"
#include "apps/terminal/stop_request.h"
#include "apps/view/live_page.h"
#include "apps/view/view_options.h"

namespace depthmocap {
namespace {

struct ServeOptions {
  ViewOptions view;
  IkCommandOptions ik;
};

void serve(const ServeOptions& options) {
  const StopRequest on_ctrl_c;
  const IkRequests ik(options.ik);
  LivePage page(webServerConfig(options.view), pageFolder(), {"idle", "no source", {}});
  page.server().onPostAside("/ik", [&](const std::string& body) {
    return WebContent{"application/json", ik.answer(body)};
  });
  page.start();
  std::cerr << "serving " << page.server().url() << std::endl;
  while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void addServeCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("serve", "Serves HTTP and the live page, until Ctrl-C.");
  const auto options = std::make_shared<ServeOptions>();
  command->add_option("--port", options->view.port, "Port; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
  command
      ->add_option("--address", options->view.address,
                   "Numeric address to listen on; others than 127.0.0.1 need a token")
      ->capture_default_str();
  command->add_option("--token", options->view.token,
                      "Token that requests must show (default: a random one where needed)");
  addIkOptions(*command, options->ik);
  command->footer(
      "GET /health answers 200; POST /ik solves for a pose (docs/reference/stream.md). Example:\n  depthmocap serve "
      "--port 8010");
  command->callback([options] { serve(*options); });
}

}  // namespace depthmocap
