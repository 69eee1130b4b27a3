#include "apps/film/film.h"

#include <array>
#include <string>
#include <system_error>

#include <dlfcn.h>

#include "depthmocap/error.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// lib/depthmocap beside the program (build tree), and where the installation puts modules.
fs::path modulePath() {
  std::error_code ignored;
  const fs::path program = programFolder();
  const fs::path above = program.parent_path();
  const std::array<fs::path, 3> folders = {program / "lib" / "depthmocap", above / "lib" / "depthmocap",
                                           above / DEPTHMOCAP_MODULES};
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / kFilmModule, ignored)) return folder / kFilmModule;
  }
  throw Error("the part that writes films is missing", (folders.back() / kFilmModule).string(),
              "build the target 'program', or install all of it");
}

FilmEntry loadEntry() {
  const std::string path = modulePath().string();
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays until the program ends
  void* entry = module != nullptr ? dlsym(module, kFilmEntry) : nullptr;
  if (entry == nullptr) throw Error(std::string("cannot be loaded: ") + dlerror(), path);
  return reinterpret_cast<FilmEntry>(entry);
}

}  // namespace

std::unique_ptr<Film> openFilm(const fs::path& path, double fps, int width, int height, const fs::path& named) {
  static const FilmEntry open = loadEntry();
  std::unique_ptr<Film> film(open(path.c_str(), fps, width, height));
  if (!film) throw Error("cannot write an MP4 film", named.string(), "was OpenCV built with FFmpeg?");
  return film;
}

}  // namespace depthmocap
