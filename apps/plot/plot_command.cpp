#include "apps/plot/plot_command.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "apps/plot/chart.h"
#include "apps/plot/plot_page.h"
#include "apps/terminal/output_check.h"
#include "depthmocap/error.h"
#include "libtracker/clinical/joint_angles.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/csv.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
  fs::path input;
  fs::path out;
  std::vector<std::string> angles;
  int person = 1;
  std::string title;
};

bool holdsAngles(const fs::path& path) {
  constexpr std::size_t kFirstAngle = 3;  // after frame, time_s, state
  CsvReader csv(path);
  return csv.next() && csv.fieldCount() > kFirstAngle && csv.field(kFirstAngle) == kClinicalAngleNames.front();
}

std::vector<AnglesRow> readRows(const PlotOptions& o) {
  std::vector<AnglesRow> rows =
      holdsAngles(o.input) ? readAnglesFile(o.input, o.person) : anglesOfJoints(readJointsFile(o.input, o.person));
  if (rows.empty()) throw Error(fmt::format("has no row of person {}", o.person), o.input.string());
  return rows;
}

void plotFile(const PlotOptions& o) {
  const std::string ending = o.out.extension().string();
  if (ending != ".png" && ending != ".html") {
    throw CLI::ValidationError("--out", fmt::format("{} is neither .png nor .html", o.out.string()));
  }
  OutputCheck check;
  check.reads(o.input);
  check.writes("--out", o.out);
  const std::string title = o.title.empty() ? o.input.filename().string() : o.title;
  const AnglePlot plot = anglePlot(readRows(o), o.angles, title);
  writeFileAtomically(o.out, ending == ".png" ? chartPng(plot) : plotPage(plot));
  for (const MovementEvent& event : plot.movements) {
    std::cout << fmt::format("{:8.2f} s  {}", event.start_s, kMovementNames[static_cast<std::size_t>(event.kind)]);
    if (event.end_s > event.start_s) std::cout << fmt::format(", {:.2f} s", event.end_s - event.start_s);
    std::cout << '\n';
  }
}

}  // namespace

void addPlotCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("plot", "Draws joint angles over time, with the movements found in them.");
  const auto o = std::make_shared<PlotOptions>();
  command->add_option("input", o->input, "Angles (replay --angles), or joints, from which fewer angles can be read")
      ->type_name("A.csv|J.csv")
      ->required();
  command->add_option("--out", o->out, "Picture, or page that holds picture and tables")
      ->type_name("P.png|P.html")
      ->required();
  command
      ->add_option("--angles", o->angles,
                   "Angles to show, as docs/reference/angles.md names them, with or without side")
      ->delimiter(',')
      ->type_name("ANGLE,...");
  command->add_option("--person", o->person, "Whose rows, in a file of several people")->check(CLI::Range(1, 1000));
  command->add_option("--title", o->title, "Title (default: the name of the file)");
  command->footer(
      "Prints steps, jumps and rising from a seat with their times.\n"
      "Example:\n"
      "  depthmocap replay recordings/squat --angles squat.csv\n"
      "  depthmocap plot squat.csv --out squat.html --angles knee_flexion,hip_flexion");
  command->callback([o] { plotFile(*o); });
}

}  // namespace depthmocap
