#include "detection/offscreen_context.h"

#include <dlfcn.h>

#include <cstdlib>
#include <mutex>

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {
namespace {

// Mesa ends the process if it does not know the driver's name. Selection never rasterizes, so it needs no worker
// threads.
// Mesa writes to stderr if its cache has no home directory.
void chooseDriver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  const bool known = driver != nullptr && (std::string(driver) == "llvmpipe" || std::string(driver) == "softpipe");
  if (!known) setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 0);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  setenv("MESA_GLSL_CACHE_DISABLE", "true", 0);  // the same before Mesa 21
}

}  // namespace

std::unique_ptr<OffscreenContext> makeOffscreenContext(const std::string& name) {
  if (name == "osmesa") return makeOsMesaContext();
  if (name == "egl") return makeEglContext();
  throw InvalidInput("gl_context '" + name + "' is unknown: use auto, osmesa or egl");
}

const std::vector<std::string>& offscreenContextNames() {
  static const std::vector<std::string> names = {"osmesa", "egl"};
  return names;
}

GlLibrary::GlLibrary(const char* file, std::string advice) : file_(file), advice_(std::move(advice)) {
  static std::once_flag driver_chosen;
  std::call_once(driver_chosen, chooseDriver);
  handle_ = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (handle_ == nullptr) throw unusable("it cannot be loaded");
}

DeviceError GlLibrary::unusable(const std::string& reason) const {
  return DeviceError("no off-screen context from " + file_ + ", " + reason + ": " + advice_);
}

void* GlLibrary::symbol(const char* name) const {
  void* const found = dlsym(handle_, name);
  if (found == nullptr) throw unusable(std::string("it has no ") + name);
  return found;
}

}  // namespace sweep_guard_core
