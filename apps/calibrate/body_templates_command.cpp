#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "apps/commands.h"
#include "apps/terminal/output_check.h"
#include "libtracker/body/make_template_surface.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {

void addBodyTemplatesCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand(
      "body-templates",
      "Makes the sampled bodies that are built into the library (libtracker/actor/models/bodies.bin).");
  const auto out = std::make_shared<std::filesystem::path>();
  command->add_option("--out", *out, "File to write")->required();
  command->callback([out] {
    OutputCheck().writes("--out", *out);
    writeFileAtomically(*out, shippedBodiesToBytes(makeShippedBodies()));
  });
}

}  // namespace depthmocap
