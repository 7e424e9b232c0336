#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstring>

#include "detection/gl_library.h"
#include "sweep_guard/detection/offscreen_context.h"

namespace sweep_guard_core {
namespace {

constexpr GLsizei kFramebufferSize = 16;  // pixels; selection draws nothing

// Mesa's software renderer by name, where EGL's surfaceless platform would take the graphics card, and warn on stderr
// of one that it may not open: selection is to answer alike everywhere.
class Egl {
 public:
  Egl() {
    load("eglBindAPI", bindApi);
    load("eglCreateContext", createContext);
    load("eglDestroyContext", destroyContext);
    load("eglGetPlatformDisplayEXT", get_platform_display_);
    load("eglInitialize", initialize);
    load("eglMakeCurrent", makeCurrent);
    load("eglQueryDevicesEXT", query_devices_);
    load("eglQueryDeviceStringEXT", query_device_string_);
  }

  // Initialized once more each time: that costs nothing, and someone else may have terminated it.
  EGLDisplay softwareDisplay() const {
    EGLDisplay display = get_platform_display_(EGL_PLATFORM_DEVICE_EXT, softwareDevice(), nullptr);
    if (initialize(display, nullptr, nullptr) != EGL_TRUE) throw library.unusable("its software device does not start");
    return display;
  }

  GlLibrary library{"libEGL.so.1",
                    "install libegl1 and libegl-mesa0, or set gl_context to osmesa, or detector to reference"};
  decltype(::eglGetProcAddress)* getProcAddress = library.function<decltype(::eglGetProcAddress)>("eglGetProcAddress");
  decltype(::eglBindAPI)* bindApi;
  decltype(::eglCreateContext)* createContext;
  decltype(::eglDestroyContext)* destroyContext;
  decltype(::eglInitialize)* initialize;
  decltype(::eglMakeCurrent)* makeCurrent;

 private:
  template <typename Type>
  void load(const char* name, Type*& loaded) {
    loaded = reinterpret_cast<Type*>(getProcAddress(name));
    if (loaded == nullptr) throw library.unusable(std::string("it has no ") + name);
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

  std::remove_pointer_t<PFNEGLGETPLATFORMDISPLAYEXTPROC>* get_platform_display_;
  std::remove_pointer_t<PFNEGLQUERYDEVICESEXTPROC>* query_devices_;
  std::remove_pointer_t<PFNEGLQUERYDEVICESTRINGEXTPROC>* query_device_string_;
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
    egl().bindApi(EGL_OPENGL_API);  // a thread's own choice
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

// Without one, selection sees nothing, and OpenGL reports an invalid framebuffer.
void bindFramebuffer(OffscreenContext& context) {
  std::remove_pointer_t<PFNGLGENFRAMEBUFFERSPROC>* genFramebuffers;
  std::remove_pointer_t<PFNGLBINDFRAMEBUFFERPROC>* bindFramebuffer;
  std::remove_pointer_t<PFNGLGENRENDERBUFFERSPROC>* genRenderbuffers;
  std::remove_pointer_t<PFNGLBINDRENDERBUFFERPROC>* bindRenderbuffer;
  std::remove_pointer_t<PFNGLRENDERBUFFERSTORAGEPROC>* renderbufferStorage;
  std::remove_pointer_t<PFNGLFRAMEBUFFERRENDERBUFFERPROC>* framebufferRenderbuffer;
  std::remove_pointer_t<PFNGLCHECKFRAMEBUFFERSTATUSPROC>* checkFramebufferStatus;
  decltype(::glViewport)* viewport;
  context.load("glGenFramebuffers", genFramebuffers);
  context.load("glBindFramebuffer", bindFramebuffer);
  context.load("glGenRenderbuffers", genRenderbuffers);
  context.load("glBindRenderbuffer", bindRenderbuffer);
  context.load("glRenderbufferStorage", renderbufferStorage);
  context.load("glFramebufferRenderbuffer", framebufferRenderbuffer);
  context.load("glCheckFramebufferStatus", checkFramebufferStatus);
  context.load("glViewport", viewport);

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
