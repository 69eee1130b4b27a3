#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace depthmocap {

// One depth picture of an .oni file.
struct OniPicture {
  std::int64_t frame = 0;    // the recorder's number
  double time_s = 0;         // [s]
  std::uint64_t offset = 0;  // of the packed picture in the file [bytes]
  std::uint32_t size = 0;    // [bytes]
};

// The depth stream of an OpenNI recording.
struct OniDepth {
  std::array<char, 4> codec{};  // "16zT", "16zP" or "NONE"
  int width = 0;                // [px]
  int height = 0;               // [px]
  double fps = 0;               // [1/s]
  double fov_x = 0;             // [rad] 0 = the file does not say
  double fov_y = 0;
  double depth_unit_m = 0.001;
  bool mirrored = false;
  std::vector<OniPicture> pictures;  // in the file's order; none is unpacked yet
};

// Reads the whole list of records. Not through OpenNI's own player: that one hands pictures over between threads, tells
// numbers and times only with the pictures, and waits for ever on some files. A file that is cut short is read up to
// the cut. Error if the file cannot be read, is no OpenNI recording, or holds no depth picture. Format: OpenNI2
// (Apache 2), Source/Drivers/OniFile; also files of OpenNI 1, whose record headers are shorter.
OniDepth readOniFile(const std::filesystem::path& file);

}  // namespace depthmocap
