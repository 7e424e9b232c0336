#include "simulation/depth_renderer.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <limits>
#include <string>

#include "detection/offscreen_context.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_simulation {

using sweep_guard_core::CurrentContext;
using sweep_guard_core::DeviceError;
using sweep_guard_core::OffscreenContext;

namespace {

std::unique_ptr<OffscreenContext> makeContext() {
  std::string problems;
  for (const std::string& name : sweep_guard_core::offscreenContextNames()) {
    try {
      return sweep_guard_core::makeOffscreenContext(name);
    } catch (const DeviceError& error) {
      problems += (problems.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  throw DeviceError(problems);
}

// Row 0 of the image is the first that OpenGL has, which calls it the lowest.
Eigen::Matrix4d projectionOf(const sweep_guard_core::Pinhole& camera, double width, double height) {
  constexpr double kRange = DepthRenderer::kFarthest - DepthRenderer::kNearest;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = 2.0 * camera.fx / width;
  projection(0, 2) = (2.0 * camera.cx + 1.0) / width - 1.0;
  projection(1, 1) = 2.0 * camera.fy / height;
  projection(1, 2) = (2.0 * camera.cy + 1.0) / height - 1.0;
  projection(2, 2) = (DepthRenderer::kFarthest + DepthRenderer::kNearest) / kRange;
  projection(2, 3) = -2.0 * DepthRenderer::kFarthest * DepthRenderer::kNearest / kRange;
  projection(3, 2) = 1.0;
  return projection;
}

// The inverse of the third row of the projection, of what the buffer holds in [0, 1].
float depthOf(float buffered) {
  constexpr auto kNearest = static_cast<float>(DepthRenderer::kNearest);
  constexpr auto kFarthest = static_cast<float>(DepthRenderer::kFarthest);
  if (!(buffered < 1.0F)) return std::numeric_limits<float>::quiet_NaN();
  return kNearest * kFarthest / (kFarthest - buffered * (kFarthest - kNearest));
}

}  // namespace

struct DepthRenderer::Functions {
  OffscreenContext& context;
  PFNGLGENFRAMEBUFFERSPROC genFramebuffers = context.load<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers");
  PFNGLBINDFRAMEBUFFERPROC bindFramebuffer = context.load<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer");
  PFNGLGENRENDERBUFFERSPROC genRenderbuffers = context.load<PFNGLGENRENDERBUFFERSPROC>("glGenRenderbuffers");
  PFNGLBINDRENDERBUFFERPROC bindRenderbuffer = context.load<PFNGLBINDRENDERBUFFERPROC>("glBindRenderbuffer");
  PFNGLRENDERBUFFERSTORAGEPROC renderbufferStorage =
      context.load<PFNGLRENDERBUFFERSTORAGEPROC>("glRenderbufferStorage");
  PFNGLFRAMEBUFFERRENDERBUFFERPROC framebufferRenderbuffer =
      context.load<PFNGLFRAMEBUFFERRENDERBUFFERPROC>("glFramebufferRenderbuffer");
  PFNGLCHECKFRAMEBUFFERSTATUSPROC checkFramebufferStatus =
      context.load<PFNGLCHECKFRAMEBUFFERSTATUSPROC>("glCheckFramebufferStatus");
  decltype(&::glClear) clear = context.load<decltype(&::glClear)>("glClear");
  decltype(&::glDrawBuffer) drawBuffer = context.load<decltype(&::glDrawBuffer)>("glDrawBuffer");
  decltype(&::glDrawElements) drawElements = context.load<decltype(&::glDrawElements)>("glDrawElements");
  decltype(&::glEnable) enable = context.load<decltype(&::glEnable)>("glEnable");
  decltype(&::glEnableClientState) enableClientState =
      context.load<decltype(&::glEnableClientState)>("glEnableClientState");
  decltype(&::glGetError) getError = context.load<decltype(&::glGetError)>("glGetError");
  decltype(&::glLoadMatrixd) loadMatrix = context.load<decltype(&::glLoadMatrixd)>("glLoadMatrixd");
  decltype(&::glReadBuffer) readBuffer = context.load<decltype(&::glReadBuffer)>("glReadBuffer");
  decltype(&::glReadPixels) readPixels = context.load<decltype(&::glReadPixels)>("glReadPixels");
  decltype(&::glVertexPointer) vertexPointer = context.load<decltype(&::glVertexPointer)>("glVertexPointer");
  decltype(&::glViewport) viewport = context.load<decltype(&::glViewport)>("glViewport");
};

DepthRenderer::DepthRenderer(std::uint32_t width, std::uint32_t height, const sweep_guard_core::Pinhole& camera)
    : width_(width),
      height_(height),
      projection_(projectionOf(camera, width, height)),
      context_(makeContext()),
      depths_(size_t{width} * height) {
  const CurrentContext current(*context_);
  gl_.reset(new Functions{*context_});
  bindFramebuffer();
}

DepthRenderer::~DepthRenderer() = default;

void DepthRenderer::bindFramebuffer() {
  GLuint framebuffer = 0;
  GLuint depths = 0;
  const auto width = static_cast<GLsizei>(width_);
  const auto height = static_cast<GLsizei>(height_);
  gl_->genFramebuffers(1, &framebuffer);
  gl_->bindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  gl_->genRenderbuffers(1, &depths);
  gl_->bindRenderbuffer(GL_RENDERBUFFER, depths);
  gl_->renderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
  gl_->framebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depths);
  gl_->drawBuffer(GL_NONE);
  gl_->readBuffer(GL_NONE);
  gl_->viewport(0, 0, width, height);
  gl_->enable(GL_DEPTH_TEST);
  gl_->enableClientState(GL_VERTEX_ARRAY);
  if (gl_->checkFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw DeviceError("the off-screen context has no framebuffer for depths");
}

const std::vector<float>& DepthRenderer::render(const std::vector<VisibleSurface>& surfaces) {
  const CurrentContext current(*context_);
  gl_->clear(GL_DEPTH_BUFFER_BIT);
  for (const VisibleSurface& surface : surfaces) {
    gl_->loadMatrix((projection_ * surface.X_CS.matrix()).eval().data());
    gl_->vertexPointer(3, GL_FLOAT, 0, surface.positions_S.data());
    gl_->drawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * surface.triangles.size()), GL_UNSIGNED_INT,
                      surface.triangles.data());
  }
  gl_->readPixels(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_), GL_DEPTH_COMPONENT, GL_FLOAT,
                  depths_.data());
  if (const GLenum error = gl_->getError(); error != GL_NO_ERROR)
    throw DeviceError("OpenGL reports error " + std::to_string(error) + " while it renders depths");
  for (float& depth : depths_) depth = depthOf(depth);
  return depths_;
}

}  // namespace sweep_guard_simulation
