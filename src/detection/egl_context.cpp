#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstring>
#include <vector>

#include "detection/offscreen_context.h"

namespace sweep_guard_core {
namespace {

constexpr GLsizei kFramebufferSize = 16;  // pixels; selection draws nothing

// Selects Mesa's software renderer by name, so that results are equal on all machines. EGL's surfaceless platform would
// use the graphics card, and write to stderr if it may not open the card.
class Egl {
 public:
  // Initializes every time: this costs nothing, and other code in the process may have terminated the display.
  EGLDisplay softwareDisplay() const {
    EGLDisplay display = get_platform_display_(EGL_PLATFORM_DEVICE_EXT, softwareDevice(), nullptr);
    if (initialize(display, nullptr, nullptr) != EGL_TRUE) throw library.unusable("its software device does not start");
    return display;
  }

  GlLibrary library{"libEGL.so.1", "install libegl1 and libegl-mesa0"};
  decltype(::eglGetProcAddress)* getProcAddress = library.function<decltype(::eglGetProcAddress)>("eglGetProcAddress");
  decltype(&::eglBindAPI) bindApi = load<decltype(&::eglBindAPI)>("eglBindAPI");
  decltype(&::eglCreateContext) createContext = load<decltype(&::eglCreateContext)>("eglCreateContext");
  decltype(&::eglDestroyContext) destroyContext = load<decltype(&::eglDestroyContext)>("eglDestroyContext");
  decltype(&::eglInitialize) initialize = load<decltype(&::eglInitialize)>("eglInitialize");
  decltype(&::eglMakeCurrent) makeCurrent = load<decltype(&::eglMakeCurrent)>("eglMakeCurrent");

 private:
  template <typename Pointer>
  Pointer load(const char* name) const {
    const auto loaded = getProcAddress(name);
    if (loaded == nullptr) throw library.unusable(std::string("it has no ") + name);
    return reinterpret_cast<Pointer>(loaded);
  }

  EGLDeviceEXT softwareDevice() const {
    EGLint count = 0;
    query_devices_(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    query_devices_(count, devices.data(), &count);
    for (EGLDeviceEXT device : devices) {
      const char* const extensions = query_device_string_(device, EGL_EXTENSIONS);
      if (extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr) return device;
    }
    throw library.unusable("it has no software device");
  }

  PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display_ =
      load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  PFNEGLQUERYDEVICESEXTPROC query_devices_ = load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  PFNEGLQUERYDEVICESTRINGEXTPROC query_device_string_ = load<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
};

const Egl& egl() {
  static const Egl loaded;
  return loaded;
}

class EglContext : public OffscreenContext {
 public:
  EglContext() : display_(egl().softwareDisplay()) {
    egl().bindApi(EGL_OPENGL_API);
    context_ = egl().createContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) throw egl().library.unusable("it gives none for desktop OpenGL");
  }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;
  ~EglContext() override { egl().destroyContext(display_, context_); }

  void makeCurrent() override {
    egl().bindApi(EGL_OPENGL_API);  // the API is bound per thread
    if (egl().makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      throw DeviceError("EGL refuses to make its context current");
    }
  }

  void release() override { egl().makeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  Function function(const char* name) override { return egl().getProcAddress(name); }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// Without a framebuffer, selection finds no hits, and OpenGL reports an invalid framebuffer.
void bindFramebuffer(OffscreenContext& context) {
  const auto genFramebuffers = context.load<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers");
  const auto bindFramebuffer = context.load<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer");
  const auto genRenderbuffers = context.load<PFNGLGENRENDERBUFFERSPROC>("glGenRenderbuffers");
  const auto bindRenderbuffer = context.load<PFNGLBINDRENDERBUFFERPROC>("glBindRenderbuffer");
  const auto renderbufferStorage = context.load<PFNGLRENDERBUFFERSTORAGEPROC>("glRenderbufferStorage");
  const auto framebufferRenderbuffer = context.load<PFNGLFRAMEBUFFERRENDERBUFFERPROC>("glFramebufferRenderbuffer");
  const auto checkFramebufferStatus = context.load<PFNGLCHECKFRAMEBUFFERSTATUSPROC>("glCheckFramebufferStatus");
  const auto viewport = context.load<decltype(&::glViewport)>("glViewport");

  GLuint framebuffer = 0;
  GLuint colors = 0;
  genFramebuffers(1, &framebuffer);
  bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  genRenderbuffers(1, &colors);
  bindRenderbuffer(GL_RENDERBUFFER, colors);
  renderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, kFramebufferSize, kFramebufferSize);
  framebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colors);
  viewport(0, 0, kFramebufferSize, kFramebufferSize);
  if (checkFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw egl().library.unusable("its framebuffer object is incomplete");
  }
}

}  // namespace

std::unique_ptr<OffscreenContext> makeEglContext() {
  auto context = std::make_unique<EglContext>();
  const CurrentContext current(*context);
  bindFramebuffer(*context);
  return context;
}

}  // namespace sweep_guard_core
