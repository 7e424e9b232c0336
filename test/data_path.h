#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

/// Where one of the inputs is that nobody on the project made. Tests that miss it are skipped.
inline std::filesystem::path dataPath(const std::string& name) {
  const char* const folder = std::getenv("SWEEP_GUARD_DATA");
  return std::filesystem::path(folder != nullptr ? folder : SWEEP_GUARD_SOURCE_DIR "/../shared/data") / name;
}
