#pragma once

#include <memory>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

/// An OpenGL context without a window. Its functions are looked up by name, never linked: if libGL is in the same
/// process, linked calls can reach the wrong library, which reports no hits.
class OffscreenContext {
 public:
  using Function = void (*)();

  virtual ~OffscreenContext() = default;

  /// Makes the context current in the calling thread; one thread may use a context at a time.
  /// @throws DeviceError if that fails
  virtual void makeCurrent() = 0;

  /// Releases the context, so that another thread may make it current. It must be current.
  virtual void release() = 0;

  /// Returns the OpenGL function with this name, or null. The context must be current.
  virtual Function function(const char* name) = 0;

  /// Loads the OpenGL function with this name. The context must be current.
  /// @throws DeviceError if there is no such function
  template <typename Pointer>
  Pointer load(const char* name) {
    const Function loaded = function(name);
    if (loaded == nullptr) throw DeviceError(std::string("the off-screen context has no OpenGL function ") + name);
    return reinterpret_cast<Pointer>(loaded);
  }
};

/// Keeps a context current during its lifetime; another thread may use the context next.
class CurrentContext {
 public:
  /// @throws DeviceError if the context cannot be made current
  explicit CurrentContext(OffscreenContext& context) : context_(context) { context_.makeCurrent(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext() { context_.release(); }

 private:
  OffscreenContext& context_;
};

/// Makes a context of OSMesa, which is part of Mesa up to 25.0 and renders in software. Each context takes some ms to
/// make and some memory that Mesa never frees: make one per thread and keep it.
/// @throws DeviceError that says what to do if OSMesa is missing or makes no context
std::unique_ptr<OffscreenContext> makeOsMesaContext();

/// Makes a context of Mesa's EGL on its software device, without a surface, with a framebuffer object as render target.
/// It renders as OSMesa does, and is part of later Mesa releases, too. Make one per thread and keep it.
/// @throws DeviceError that says what to do if EGL is missing, has no software device or makes no context
std::unique_ptr<OffscreenContext> makeEglContext();

/// Makes a context by name.
/// @param name  one of offscreenContextNames()
/// @throws InvalidInput if the name is unknown, DeviceError if the context cannot be made
std::unique_ptr<OffscreenContext> makeOffscreenContext(const std::string& name);

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
