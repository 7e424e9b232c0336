#pragma once

#include <cstdlib>
#include <string>
#include <vector>

/// What a missing library is called in messages.
const std::string kNoOsMesa =
    "osmesa: no off-screen context from libOSMesa.so.8, it cannot be loaded: install libosmesa6";
const std::string kNoEgl =
    "egl: no off-screen context from libEGL.so.1, it cannot be loaded: install libegl1 and libegl-mesa0";

/// Returns the LD_LIBRARY_PATH of a program that cannot load these libraries: in place of each, the dynamic linker finds
/// an empty file.
inline std::string pathWithout(const std::vector<std::string>& libraries) {
  const char* const before = std::getenv("LD_LIBRARY_PATH");
  std::string path = before == nullptr ? "" : before;
  for (const std::string& library : libraries) {
    path = SWEEP_GUARD_EMPTY_LIBRARIES "/" + library + (path.empty() ? "" : ":" + path);
  }
  return path;
}
