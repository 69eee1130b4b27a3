#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "depthmocap/image.h"

namespace depthmocap {

// One-channel grey PNG files: 16 bit for depth, 8 bit for part labels. Written whole or not at all, at a fast
// compression.
//
// Reading throws Error if the file is missing, is no PNG, is cut short or damaged (every checksum is verified), has
// colour, alpha or another depth than the function's name says, or is not width x height pixels. `image` is reused.
// Written pictures reach the disk with their folder (syncFolder()).
void readPng16(const std::filesystem::path& path, int width, int height, Image<std::uint16_t>& image);
void readPng8(const std::filesystem::path& path, int width, int height, Image<std::uint8_t>& image);

// Width and height [px] of a picture that readPng16 may read, from its header alone.
struct PngSize {
  int width = 0;
  int height = 0;
};
PngSize png16Size(const std::filesystem::path& path);

void writePng16(const std::filesystem::path& path, const Image<std::uint16_t>& image);
void writePng8(const std::filesystem::path& path, const Image<std::uint8_t>& image);

// A picture of 8 bits a channel to look at, as the bytes of a PNG file. Throws Error where it cannot be encoded.
struct Picture {
  const std::uint8_t* pixels = nullptr;
  int width = 0, height = 0;  // (>= 1) [px]
  int channels = 3;           // 1: grey; 3: blue, green, red
  std::size_t row_bytes = 0;  // from one row to the next
};
std::string pngBytes(const Picture& picture);

}  // namespace depthmocap
