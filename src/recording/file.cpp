#include "recording/file.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "sweep_guard/common/error.h"

namespace sweep_guard_recording {

using sweep_guard_core::InvalidInput;

namespace {

constexpr std::uintmax_t kMaxFile = 256U << 20U;

}  // namespace

std::string readFile(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
    throw InvalidInput(path + ": no such file; check the path, and give nodes an absolute one");
  if (!std::filesystem::is_regular_file(status)) throw InvalidInput(path + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw InvalidInput(path + ": " + error.message());
  if (size > kMaxFile) throw InvalidInput(path + ": larger than 256 MiB; give a smaller file");
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw InvalidInput(path + ": cannot be read; check its permissions");
  return bytes;
}

}  // namespace sweep_guard_recording
