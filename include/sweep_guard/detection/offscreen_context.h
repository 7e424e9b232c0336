#pragma once

#include <memory>

namespace sweep_guard {

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

 protected:
  OffscreenContext() = default;
  OffscreenContext(const OffscreenContext&) = default;
  OffscreenContext& operator=(const OffscreenContext&) = default;
};

/// A context of OSMesa, rendering in software. Each takes about 5 ms to make and some memory that Mesa never gives
/// back: make one per thread, for life.
/// @throws DeviceError if OSMesa gives none
std::unique_ptr<OffscreenContext> makeOsMesaContext();

}  // namespace sweep_guard
