#include "detection/offscreen_context.h"

#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

std::unique_ptr<OffscreenContext> makeOffscreenContext(const std::string& name) {
  if (name == "osmesa") return makeOsMesaContext();
  if (name == "egl") return makeEglContext();
  throw InvalidInput("gl_context '" + name + "' is unknown: use auto, osmesa or egl");
}

const std::vector<std::string>& offscreenContextNames() {
  static const std::vector<std::string> names = {"osmesa", "egl"};
  return names;
}

}  // namespace sweep_guard_core
