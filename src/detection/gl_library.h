#pragma once

#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

/// Loads a library that makes OpenGL contexts by name, when the first context is requested. A machine without the
/// library runs everything else, and its symbols (OSMesa: all of OpenGL) stay hidden from the rest of the process. The
/// library stays loaded.
///
/// Sets Mesa to render in software in the calling thread and to keep no cache on disk, unless the environment variables
/// GALLIUM_DRIVER, LP_NUM_THREADS and MESA_SHADER_CACHE_DISABLE say otherwise.
class GlLibrary {
 public:
  /// @param file    file name with version, as the dynamic linker finds it
  /// @param advice  what the user can do if the library is unusable
  /// @throws DeviceError if the library cannot be loaded
  GlLibrary(const char* file, std::string advice);

  /// Returns a function of the library.
  /// @throws DeviceError if there is no such function
  template <typename Type>
  Type* function(const char* name) const {
    return reinterpret_cast<Type*>(symbol(name));
  }

  /// Makes an error that says why the library is unusable, and what the user can do.
  DeviceError unusable(const std::string& reason) const;

 private:
  void* symbol(const char* name) const;

  std::string file_;
  std::string advice_;
  void* handle_;
};

}  // namespace sweep_guard_core
