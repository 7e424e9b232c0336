#include <GL/gl.h>

#include <array>

#include "detection/gl_library.h"
#include "detection/offscreen_context.h"

namespace sweep_guard_core {
namespace {

// Declares what is used of OSMesa, whose header disappears together with the library.
struct OsMesa {
  using Context = struct osmesa_context*;
  using CreateContext = Context(GLenum format, Context shared);
  using DestroyContext = void(Context context);
  using MakeCurrent = GLboolean(Context context, void* buffer, GLenum type, GLsizei width, GLsizei height);
  using GetProcAddress = OffscreenContext::Function(const char* name);

  GlLibrary library{"libOSMesa.so.8", "install libosmesa6"};
  CreateContext* createContext = library.function<CreateContext>("OSMesaCreateContext");
  DestroyContext* destroyContext = library.function<DestroyContext>("OSMesaDestroyContext");
  MakeCurrent* makeCurrent = library.function<MakeCurrent>("OSMesaMakeCurrent");
  GetProcAddress* getProcAddress = library.function<GetProcAddress>("OSMesaGetProcAddress");
};

const OsMesa& osMesa() {
  static const OsMesa loaded;
  return loaded;
}

class OsMesaContext : public OffscreenContext {
 public:
  OsMesaContext() : context_(osMesa().createContext(GL_RGBA, nullptr)) {
    if (context_ == nullptr) throw osMesa().library.unusable("it gives none");
  }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;
  ~OsMesaContext() override { osMesa().destroyContext(context_); }

  void makeCurrent() override {
    if (osMesa().makeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) != GL_TRUE) {
      throw DeviceError("OSMesa refuses to make its context current");
    }
  }

  void release() override { osMesa().makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  Function function(const char* name) override { return osMesa().getProcAddress(name); }

 private:
  OsMesa::Context context_;
  std::array<unsigned char, 4> pixel_ = {};  // selection draws nothing, but OSMesa requires a buffer
};

}  // namespace

std::unique_ptr<OffscreenContext> makeOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace sweep_guard_core
