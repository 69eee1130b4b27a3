#include "libtracker/recording/png_file.h"

#include <bit>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <png.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/check.h"

// libpng itself, not OpenCV's imread: that one hands out a picture that is cut short half filled, with a warning only.
namespace depthmocap {

namespace {

constexpr png_uint_32 kLargestSide = 16384;  // [px] as of a recording
constexpr int kCompressionLevel = 1;         // of 9: a depth picture comes out hardly larger, several times as fast

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

// libpng reports an error by calling this, and it must not return.
[[noreturn]] void onError(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}  // about optional chunks only; libraries print nothing

struct Reader {
  std::string failure;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
  png_infop info = png_create_info_struct(png);

  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writer {
  std::string failure;
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, onError, onWarning);
  png_infop info = png_create_info_struct(png);

  Writer() = default;
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }
};

// The functions around setjmp hold no object with a destructor: longjmp would skip it. They return false when libpng
// gave up.
bool readHeader(Reader& reader, std::FILE* file) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  png_set_user_limits(reader.png, kLargestSide, kLargestSide);
  // Texts, profiles and their like say nothing of depth, and libpng would make room for whatever size they announce.
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_init_io(reader.png, file);
  png_read_info(reader.png, reader.info);
  return true;
}

bool readRows(Reader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png)) != 0) return false;
  if (std::endian::native == std::endian::little) png_set_swap(reader.png);
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

void appendBytes(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

bool writeRows(Writer& writer, int width, int height, int bits, png_bytepp rows) {
  if (setjmp(png_jmpbuf(writer.png)) != 0) return false;
  png_set_write_fn(writer.png, &writer.bytes, appendBytes, nullptr);
  png_set_IHDR(writer.png, writer.info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), bits,
               PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(writer.png, kCompressionLevel);
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, bits == 16 ? PNG_FILTER_SUB : PNG_FILTER_NONE);
  png_write_info(writer.png, writer.info);
  if (std::endian::native == std::endian::little) png_set_swap(writer.png);
  png_write_image(writer.png, rows);
  png_write_end(writer.png, nullptr);
  return true;
}

std::string sizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

PngSize sizeOf(const Reader& reader) {  // both are at most kLargestSide
  return {static_cast<int>(png_get_image_width(reader.png, reader.info)),
          static_cast<int>(png_get_image_height(reader.png, reader.info))};
}

void checkKind(const Reader& reader, int bits, const std::string& where) {
  if (png_get_color_type(reader.png, reader.info) != PNG_COLOR_TYPE_GRAY) {
    throw Error("is not a one-channel grey picture", where);
  }
  const int found_bits = png_get_bit_depth(reader.png, reader.info);
  if (found_bits != bits) {
    throw Error("has " + std::to_string(found_bits) + " bits a pixel, " + std::to_string(bits) + " are needed", where);
  }
}

using OpenFile = std::unique_ptr<std::FILE, Close>;

// Opens the file and reads its header; the file stays where the rows begin.
OpenFile openPng(const std::filesystem::path& path, int bits, Reader& reader) {
  OpenFile file(std::fopen(path.c_str(), "rb"));
  if (!file) throw Error(std::string("cannot be read: ") + std::strerror(errno), path.string());
  if (!readHeader(reader, file.get())) throw Error("is not a whole PNG picture: " + reader.failure, path.string());
  checkKind(reader, bits, path.string());
  return file;
}

template <typename Value>
std::vector<png_bytep> rowsOf(Image<Value>& image) {
  std::vector<png_bytep> rows;
  rows.reserve(static_cast<std::size_t>(image.height));
  for (int y = 0; y < image.height; ++y) rows.push_back(reinterpret_cast<png_bytep>(&image.at(0, y)));
  return rows;
}

template <typename Value>
void readPng(const std::filesystem::path& path, int width, int height, Image<Value>& image) {
  Reader reader;
  const OpenFile file = openPng(path, 8 * static_cast<int>(sizeof(Value)), reader);
  const PngSize found = sizeOf(reader);
  if (found.width != width || found.height != height) {
    throw Error("is " + sizeText(found.width, found.height) + " pixels, not " + sizeText(width, height), path.string());
  }
  image.reset(width, height, 0);
  if (!readRows(reader, rowsOf(image).data())) {
    throw Error("is damaged or cut short: " + reader.failure, path.string());
  }
}

template <typename Value>
void writePng(const std::filesystem::path& path, const Image<Value>& image) {
  DMC_CHECK(!image.empty());
  Writer writer;
  // libpng takes rows to write through a pointer to non-const; it does not change them.
  auto rows = rowsOf(const_cast<Image<Value>&>(image));
  const int bits = 8 * static_cast<int>(sizeof(Value));
  if (!writeRows(writer, image.width, image.height, bits, rows.data())) throw Error(writer.failure, path.string());
  writeFileAtomically(path, writer.bytes, Sync::WithFolder);
}

}  // namespace

void readPng16(const std::filesystem::path& path, int width, int height, Image<std::uint16_t>& image) {
  readPng(path, width, height, image);
}

void readPng8(const std::filesystem::path& path, int width, int height, Image<std::uint8_t>& image) {
  readPng(path, width, height, image);
}

PngSize png16Size(const std::filesystem::path& path) {
  Reader reader;
  const OpenFile file = openPng(path, 16, reader);
  return sizeOf(reader);
}

void writePng16(const std::filesystem::path& path, const Image<std::uint16_t>& image) {
  writePng(path, image);
}

void writePng8(const std::filesystem::path& path, const Image<std::uint8_t>& image) {
  writePng(path, image);
}

std::string pngBytes(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = picture.channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_BGR;
  const auto stride = static_cast<png_int_32>(picture.row_bytes);
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.pixels, stride, nullptr) == 0) {
    throw Error(std::string("a picture cannot be made: ") + static_cast<const char*>(image.message), "PNG");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace depthmocap
