#pragma once

#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

/// A library that makes OpenGL contexts, loaded by name when the first is asked for: a machine without it runs
/// everything else, and what it exports (OSMesa: all of OpenGL) is hidden from the rest of the process. It stays
/// loaded.
///
/// Has Mesa render in software, in the calling thread, and keep nothing on disk, where the environment does not say
/// otherwise: GALLIUM_DRIVER, LP_NUM_THREADS, MESA_SHADER_CACHE_DISABLE.
class GlLibrary {
 public:
  /// @param file    as the linker knows it, with its version
  /// @param advice  what to do if it is of no use
  /// @throws DeviceError if it cannot be loaded
  GlLibrary(const char* file, std::string advice);

  /// @throws DeviceError if it has no such function
  template <typename Type>
  Type* function(const char* name) const {
    return reinterpret_cast<Type*>(symbol(name));
  }

  /// That the library is of no use, why, and what to do.
  DeviceError unusable(const std::string& reason) const;

 private:
  void* symbol(const char* name) const;

  std::string file_;
  std::string advice_;
  void* handle_;
};

}  // namespace sweep_guard_core
