#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

/// A place where OpenGL runs without a window. Its functions are asked for by name, never linked: with libGL in the
/// same process, linked calls can reach the wrong library, which answers a selection with silence.
class OffscreenContext {
 public:
  using Function = void (*)();

  virtual ~OffscreenContext() = default;

  /// Makes the context current in the calling thread; a context serves one thread at a time.
  /// @throws DeviceError if that fails
  virtual void makeCurrent() = 0;

  /// Lets go of the context, so that another thread may take it. It must be current.
  virtual void release() = 0;

  /// The OpenGL function of that name, null if there is none. The context must be current.
  virtual Function function(const char* name) = 0;

  /// The same, with its type.
  /// @throws DeviceError if there is none
  template <typename Type>
  void load(const char* name, Type*& loaded) {
    loaded = reinterpret_cast<Type*>(function(name));
    if (loaded == nullptr) throw DeviceError(std::string("the off-screen context has no OpenGL function ") + name);
  }

 protected:
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = default;
  OffscreenContext& operator=(const OffscreenContext&) = default;
};

/// Keeps a context current while it is used and no longer: the next use may come from another thread.
class CurrentContext {
 public:
  /// @throws DeviceError if it cannot be made current
  explicit CurrentContext(OffscreenContext& context) : context_(context) { context_.makeCurrent(); }
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;
  ~CurrentContext() { context_.release(); }

 private:
  OffscreenContext& context_;
};

/// A context of OSMesa, which Mesa has up to 25.0, rendering in software. Each takes some ms to make and some memory
/// that Mesa never gives back: make one per thread, for life.
/// @throws DeviceError that says what to do if there is no OSMesa, or it gives none
std::unique_ptr<OffscreenContext> makeOsMesaContext();

/// A context of Mesa's EGL without any surface, on its software device, with a framebuffer object to draw to. It
/// renders as OSMesa's does, and outlives it. Make one per thread, for life.
/// @throws DeviceError that says what to do if there is no EGL, it has no software device or gives no context
std::unique_ptr<OffscreenContext> makeEglContext();

/// @param name  `osmesa` or `egl`
/// @throws InvalidInput on any other name, DeviceError if there is no such context
std::unique_ptr<OffscreenContext> makeOffscreenContext(const std::string& name);

/// The names that makeOffscreenContext() knows.
const std::vector<std::string>& offscreenContextNames();

}  // namespace sweep_guard_core
