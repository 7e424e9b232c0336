#include <GL/gl.h>

#include <set>
#include <vector>

#include "sweep_guard/common/mutex.h"

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

// The width of a context's buffer, unlike that of any other context [pixels]. In Mesa 20, contexts with buffers of the same size
// share one, and two threads that draw into it crash.
class BufferWidth {
 public:
  BufferWidth() {
    const Lock lock(mutex());
    while (!taken().insert(pixels_).second) ++pixels_;
  }
  BufferWidth(const BufferWidth&) = delete;
  BufferWidth& operator=(const BufferWidth&) = delete;
  ~BufferWidth() {
    const Lock lock(mutex());
    taken().erase(pixels_);
  }

  GLsizei pixels() const { return pixels_; }

 private:
  static Mutex& mutex() {
    static Mutex guards_taken;
    return guards_taken;
  }
  static std::set<GLsizei>& taken() {
    static std::set<GLsizei> widths;
    return widths;
  }

  GLsizei pixels_ = 1;
};

class OsMesaContext : public OffscreenContext {
 public:
  OsMesaContext() : row_(4 * static_cast<size_t>(width_.pixels())), context_(osMesa().createContext(GL_RGBA, nullptr)) {
    if (context_ == nullptr) throw osMesa().library.unusable("it gives none");
  }
  OsMesaContext(const OsMesaContext&) = delete;
  OsMesaContext& operator=(const OsMesaContext&) = delete;
  ~OsMesaContext() override { osMesa().destroyContext(context_); }

  void makeCurrent() override {
    if (osMesa().makeCurrent(context_, row_.data(), GL_UNSIGNED_BYTE, width_.pixels(), 1) != GL_TRUE) {
      throw DeviceError("OSMesa refuses to make its context current");
    }
  }

  void release() override { osMesa().makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  Function function(const char* name) override { return osMesa().getProcAddress(name); }

 private:
  BufferWidth width_;
  std::vector<unsigned char> row_;  // selection draws nothing, but OSMesa requires a buffer
  OsMesa::Context context_;
};

}  // namespace

std::unique_ptr<OffscreenContext> makeOsMesaContext() { return std::make_unique<OsMesaContext>(); }

}  // namespace sweep_guard_core
