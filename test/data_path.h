#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

/// Returns the path of a large input, which is no part of the repository. Tests skip if it is missing.
inline std::filesystem::path dataPath(const std::string& name) {
  const char* const folder = std::getenv("SWEEP_GUARD_DATA");
  return std::filesystem::path(folder != nullptr ? folder : SWEEP_GUARD_SOURCE_DIR "/../shared/data") / name;
}

/// Returns why a test that needs this path is skipped.
inline std::string missing(const std::filesystem::path& path) {
  return path.string() +
         " is missing: it is no part of the repository; SWEEP_GUARD_DATA names the folder of such inputs";
}
