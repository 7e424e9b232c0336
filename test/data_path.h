#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

/// Returns the path of an input that is not part of the project. Tests skip if it is missing.
inline std::filesystem::path dataPath(const std::string& name) {
  const char* const folder = std::getenv("SWEEP_GUARD_DATA");
  return std::filesystem::path(folder != nullptr ? folder : SWEEP_GUARD_SOURCE_DIR "/../shared/data") / name;
}
