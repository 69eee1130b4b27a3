#include "tests/drivers/served_recording.h"

#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include <png.h>

namespace depthmocap::testdriver {

namespace {

// A 16-bit grey PNG; empty if it is none.
std::vector<std::uint16_t> readPicture(const std::string& path) {
  std::vector<std::uint16_t> pixels;
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return pixels;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png)) == 0) {
    png_init_io(png, file);
    png_read_png(png, info, PNG_TRANSFORM_SWAP_ENDIAN, nullptr);
    const std::size_t width = png_get_image_width(png, info);
    const std::size_t height = png_get_image_height(png, info);
    if (png_get_rowbytes(png, info) == 2 * width) {
      pixels.resize(width * height);
      for (std::size_t y = 0; y < height; ++y) {
        std::memcpy(&pixels[y * width], png_get_rows(png, info)[y], 2 * width);
      }
    }
  }
  png_destroy_read_struct(&png, &info, nullptr);
  std::fclose(file);
  return pixels;
}

}  // namespace

ServedRecording readServedRecording(const std::string& folder) {
  ServedRecording recording;
  std::ifstream header_file(folder + "/recording.json");
  std::ifstream index(folder + "/frames.csv");
  if (!header_file || !index) return recording;
  const auto header = nlohmann::json::parse(header_file);
  recording.width = header.at("width");
  recording.height = header.at("height");
  recording.fx = header.at("intrinsics").at("fx");
  recording.fy = header.at("intrinsics").at("fy");
  std::string line;
  std::getline(index, line);
  while (std::getline(index, line)) {
    const std::size_t first = line.find(',');
    const std::size_t second = line.find(',', first + 1);
    ServedRecording::Frame frame;
    frame.time_us = static_cast<std::uint64_t>(std::llround(std::stod(line.substr(first + 1)) * 1e6));
    frame.steps = readPicture(folder + "/" + line.substr(second + 1));
    if (!frame.steps.empty()) recording.frames.push_back(std::move(frame));
  }
  return recording;
}

Faults parseFaults(const std::string& text) {
  Faults faults;
  std::istringstream words(text);
  std::string word;
  while (std::getline(words, word, ',')) {
    std::istringstream fields(word);
    std::string name;
    std::string first;
    std::string second;
    std::getline(fields, name, ':');
    std::getline(fields, first, ':');
    std::getline(fields, second, ':');
    const int a = std::atoi(first.c_str());
    const int b = std::atoi(second.c_str());
    if (name == "drop") faults.drop_every = a;
    if (name == "stall") faults.stall_after = a, faults.stall_ms = b;
    if (name == "unplug") faults.unplug_after = a, faults.unplug_ms = b;
    if (name == "mirror") faults.stuck_mirror = true;
  }
  return faults;
}

}  // namespace depthmocap::testdriver
