#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

namespace depthmocap {

// An MP4 film that is being written. Its writer is a module that is loaded when the first film is asked for: it brings
// OpenCV's video, which loads two hundred libraries, and most runs make no film.
class Film {
 public:
  Film() = default;
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  virtual ~Film() = default;
  virtual void write(const std::uint8_t* bgr) = 0;  // width x height x 3 bytes, rows without gaps
  virtual void close() = 0;                         // completes the file; the disk may have been full all the same
};

// `path` ends in .mp4; H.264 where this OpenCV can write it, else MPEG-4 part 2. Throws Error where the module is
// missing or the file cannot be written; `named` is what the message calls the file.
std::unique_ptr<Film> openFilm(const std::filesystem::path& path, double fps, int width, int height,
                               const std::filesystem::path& named);

// Of the module: null where the file cannot be written.
inline constexpr const char* kFilmModule = "film.so";
inline constexpr const char* kFilmEntry = "openFilmModule";
using FilmEntry = Film* (*)(const char* path, double fps, int width, int height);

}  // namespace depthmocap
