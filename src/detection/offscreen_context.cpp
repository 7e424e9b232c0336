#include "sweep_guard/detection/offscreen_context.h"

#include <GL/osmesa.h>

#include <array>
#include <cstdlib>
#include <mutex>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard {
namespace {

// Mesa ends the process over a driver name it does not know. Selection never rasterises, so it needs no worker threads.
void chooseDriver() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  const bool known = driver != nullptr && (std::string(driver) == "llvmpipe" || std::string(driver) == "softpipe");
  if (!known) setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  setenv("LP_NUM_THREADS", "0", 0);
}

class OsMesaContext : public OffscreenContext {
 public:
  OsMesaContext() {
    static std::once_flag driver_chosen;
    std::call_once(driver_chosen, chooseDriver);
    context_ = OSMesaCreateContext(OSMESA_RGBA, nullptr);
    if (context_ == nullptr) {
      throw DeviceError(
          "OSMesa gives no off-screen context: check that libosmesa6 is installed, or set detector to reference");
    }
  }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;
  ~OsMesaContext() override { OSMesaDestroyContext(context_); }

  void makeCurrent() override {
    if (OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
      throw DeviceError("OSMesa refuses to make its context current");
    }
  }

  void release() override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  Function function(const char* name) override { return OSMesaGetProcAddress(name); }

 private:
  OSMesaContext context_;
  std::array<unsigned char, 4> pixel_ = {};  // selection draws nothing; OSMesa wants a buffer all the same
};

}  // namespace

std::unique_ptr<OffscreenContext> makeOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace sweep_guard
