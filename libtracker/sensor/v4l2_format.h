#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "depthmocap/image.h"

namespace depthmocap {

// How a V4L2 camera lays depth out in memory.
struct V4l2Format {
  std::uint32_t fourcc = 0;
  int width = 0;           // [px]
  int height = 0;          // [px]
  int bytes_per_line = 0;  // of Z16 and Y16, >= 2 * width; the others have no gaps between rows
};

// The pixel formats that hold depth, the best first: Z16 and INZI (infrared, then depth) say so, Y10B is the Kinect of
// 2010 under the kernel's gspca_kinect, Y16 may be a picture, but some cameras and loopback pipes send depth as such.
std::span<const std::uint32_t> depthFourccs();
std::string fourccName(std::uint32_t fourcc);                     // "Z16"
std::string fourccNames(std::span<const std::uint32_t> fourccs);  // "Z16, Y16"
std::uint32_t fourccNamed(const std::string& name);

// Metres a step of what unpack() gives, where nobody says otherwise: Z16 and Y16 a millimetre, INZI an eighth of one
// (SR300), Y10B a millimetre, by the table of kinectMillimetres().
double defaultDepthUnit_m(std::uint32_t fourcc);

// Bytes of a whole picture.
std::size_t pictureBytes(const V4l2Format& format);

// Takes depth out of a picture: steps, 0 = no measurement. `bytes` holds at least pictureBytes(). `raw`: leaves Y10B as
// the camera's own numbers (0 where it has none) for a unit that the user gives.
void unpack(const V4l2Format& format, std::span<const std::uint8_t> bytes, bool raw, Image<std::uint16_t>& steps);

// Depth [mm] for a disparity of the Kinect of 2010, 11 bits; 0 = none (2047). From libfreenect's defaults of the zero
// plane: reference at 1200 mm, emitter 75 mm aside, 0.1042 mm a pixel.
std::uint16_t kinectMillimetres(int disparity);

}  // namespace depthmocap
