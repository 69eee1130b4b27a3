#include <CLI/CLI.hpp>
#include <chrono>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "apps/commands.h"
#include "apps/ik/routes.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/page_tracking.h"
#include "apps/track/start_page.h"
#include "apps/view/view_options.h"

namespace depthmocap {
namespace {

struct ServeOptions {
  ViewOptions view;
  IkCommandOptions ik;
  std::vector<std::string> allowed_origins;
  int threads = 2;
};

void serve(const ServeOptions& options) {
  const StopRequest on_ctrl_c;
  const IkRequests ik(options.ik);
  WebServerConfig config = webServerConfig(options.view);
  config.workers = options.threads;
  config.allowed_origins = options.allowed_origins;
  ReplayOptions replay;
  replay.track.threads = options.threads;
  PageTracking tracking(replay);
  StartPage start(config, options.view, StartPage::Cameras::Listed, tracking);
  addIkRoutes(start.page().server(), ik);
  start.page().start();
  std::cerr << "serving " << start.page().server().url() << std::endl;
  while (!StopRequest::made()) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

}  // namespace

void addServeCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "serve", "Serves a page to begin with, which replays recordings, and poses over HTTP, until Ctrl-C.");
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
  command
      ->add_option("--allow-origin", options->allowed_origins,
                   "Page of another origin that may use the server, as http://localhost:3000; may be repeated")
      ->type_name("ORIGIN");
  command->add_option("--folder", options->view.folder, "Folder whose recordings the page offers")
      ->capture_default_str();
  command->add_option("--threads", options->threads, "Poses that are solved at once; threads that track a recording")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  addIkOptions(*command, options->ik);
  command->footer(
      "GET /health answers 200; POST /ik solves for a pose; GET /openapi.json describes all of it. Example:\n  "
      "depthmocap "
      "serve --port 8010 --allow-origin http://localhost:3000");
  command->callback([options] { serve(*options); });
}

}  // namespace depthmocap
