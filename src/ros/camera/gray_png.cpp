#include "ros/camera/gray_png.h"

#include <png.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <string>
#include <string_view>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

// At 0: signature, length and name of the header. At 16: width and height. At 24: bits, color type, compression,
// filter, interlace.
constexpr size_t kHeaderSize = 33;  // [byte]
constexpr std::string_view kBegin("\x89PNG\r\n\x1A\n\0\0\0\x0DIHDR", 16);
constexpr std::string_view kGray("\x10\0\0\0\0", 5);
constexpr size_t kMaxDeflate = 1032;  // two bits make 258 bytes

[[noreturn]] void refusePng(const std::string& problem) {
  throw sweep_guard_core::InvalidInput("depth image is packed in a PNG that cannot be read: " + problem);
}

struct PngSource {
  Wire left;
  std::array<char, 120> problem;
};

void takeBytes(png_structp reader, png_bytep to, size_t count) {
  Wire& left = static_cast<PngSource*>(png_get_io_ptr(reader))->left;
  if (count > left.size) png_error(reader, "it is cut off");
  std::memcpy(to, left.bytes, count);
  left = {left.bytes + count, left.size - count};
}

[[noreturn]] void keepProblem(png_structp reader, png_const_charp problem) {
  auto& kept = static_cast<PngSource*>(png_get_error_ptr(reader))->problem;
  std::snprintf(kept.data(), kept.size(), "%s", problem);
  png_longjmp(reader, 1);
}

void passOverWarning(png_structp /*reader*/, png_const_charp /*warning*/) {}

void readRows(png_structp reader, png_infop info, png_bytep pixels) {
  png_set_keep_unknown_chunks(reader, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // all but those that a gray picture needs
  png_read_info(reader, info);
  png_set_swap(reader);
  for (png_uint_32 rows = png_get_image_height(reader, info); rows > 0; --rows) {
    png_read_row(reader, pixels, nullptr);
    pixels += png_get_rowbytes(reader, info);
  }
  png_read_end(reader, nullptr);
}

// png_longjmp() comes back to here and skips no destructor: neither readRows() nor what libpng calls has an object with
// one.
bool couldReadRows(png_structp reader, png_infop info, png_bytep pixels) {
  if (setjmp(png_jmpbuf(reader)) != 0) return false;
  readRows(reader, info, pixels);
  return true;
}

}  // namespace

ImageSize sizeOfGrayPng(Wire png) {
  const std::string_view bytes(reinterpret_cast<const char*>(png.bytes), png.size);
  if (bytes.size() < kHeaderSize || bytes.substr(0, kBegin.size()) != kBegin) refusePng("it does not begin as a PNG");
  if (bytes.substr(24, kGray.size()) != kGray) refusePng("it is not 16-bit gray without interlacing");
  const ImageSize size{png_get_uint_32(png.bytes + 16), png_get_uint_32(png.bytes + 20)};
  if (std::uint64_t{size.width} * size.height / (kMaxDeflate / 2) > png.size) refusePng("it is cut off");
  return size;
}

void readGrayPng(Wire png, std::uint8_t* pixels) {
  PngSource source{png, {"no memory"}};
  png_structp reader = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, keepProblem, passOverWarning);
  png_infop info = png_create_info_struct(reader);
  png_set_read_fn(reader, &source, takeBytes);
  const bool read = info != nullptr && couldReadRows(reader, info, pixels);
  png_destroy_read_struct(&reader, &info, nullptr);
  if (!read) refusePng(sweep_guard_core::printable(source.problem.data()));
}

}  // namespace sweep_guard_ros
