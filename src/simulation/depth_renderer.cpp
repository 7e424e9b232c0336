#include "simulation/depth_renderer.h"

#include <GL/gl.h>
#include <GL/glext.h>

#include <limits>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using sweep_guard_core::CurrentContext;
using sweep_guard_core::DeviceError;
using sweep_guard_core::OffscreenContext;

namespace {

std::unique_ptr<OffscreenContext> makeContext() {
  try {
    return sweep_guard_core::makeOsMesaContext();
  } catch (const DeviceError&) {
    return sweep_guard_core::makeEglContext();
  }
}

// Row 0 of the image is the first that OpenGL has, which calls it the lowest.
Eigen::Matrix4d projectionOf(const sweep_guard_core::Pinhole& camera, double width, double height) {
  constexpr double kNear = DepthRenderer::kNearest;
  constexpr double kFar = DepthRenderer::kFarthest;
  Eigen::Matrix4d projection;
  projection << 2.0 * camera.fx / width, 0.0, (2.0 * camera.cx + 1.0) / width - 1.0, 0.0,  //
      0.0, 2.0 * camera.fy / height, (2.0 * camera.cy + 1.0) / height - 1.0, 0.0,          //
      0.0, 0.0, (kFar + kNear) / (kFar - kNear), -2.0 * kFar * kNear / (kFar - kNear),     //
      0.0, 0.0, 1.0, 0.0;
  return projection;
}

// The inverse of the third row of the projection, of what the buffer holds in [0, 1].
float depthOf(float buffered) {
  constexpr auto kNear = static_cast<float>(DepthRenderer::kNearest);
  constexpr auto kFar = static_cast<float>(DepthRenderer::kFarthest);
  return buffered < 1.0F ? kNear * kFar / (kFar - buffered * (kFar - kNear)) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

DepthRenderer::DepthRenderer(std::uint32_t width, std::uint32_t height, const sweep_guard_core::Pinhole& camera)
    : width_(static_cast<int>(width)),
      height_(static_cast<int>(height)),
      projection_(projectionOf(camera, width, height)),
      context_(makeContext()),
      depths_(size_t{width} * height) {
  const CurrentContext current(*context_);
  bindFramebuffer();
}

void DepthRenderer::bindFramebuffer() {
  GLuint framebuffer = 0;
  GLuint depths = 0;
  context_->load<PFNGLGENFRAMEBUFFERSPROC>("glGenFramebuffers")(1, &framebuffer);
  context_->load<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
  context_->load<PFNGLGENRENDERBUFFERSPROC>("glGenRenderbuffers")(1, &depths);
  context_->load<PFNGLBINDRENDERBUFFERPROC>("glBindRenderbuffer")(GL_RENDERBUFFER, depths);
  context_->load<PFNGLRENDERBUFFERSTORAGEPROC>("glRenderbufferStorage")(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width_,
                                                                        height_);
  context_->load<PFNGLFRAMEBUFFERRENDERBUFFERPROC>("glFramebufferRenderbuffer")(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT,
                                                                                GL_RENDERBUFFER, depths);
  context_->load<decltype(&::glDrawBuffer)>("glDrawBuffer")(GL_NONE);
  context_->load<decltype(&::glReadBuffer)>("glReadBuffer")(GL_NONE);
  context_->load<decltype(&::glViewport)>("glViewport")(0, 0, width_, height_);
  context_->load<decltype(&::glEnable)>("glEnable")(GL_DEPTH_TEST);
  context_->load<decltype(&::glEnableClientState)>("glEnableClientState")(GL_VERTEX_ARRAY);
}

const std::vector<float>& DepthRenderer::render(const std::vector<VisibleSurface>& surfaces) {
  const CurrentContext current(*context_);
  context_->load<decltype(&::glClear)>("glClear")(GL_DEPTH_BUFFER_BIT);
  const auto draw = context_->load<decltype(&::glDrawElements)>("glDrawElements");
  for (const auto& [X_CS, positions_S, triangles] : surfaces) {
    context_->load<decltype(&::glLoadMatrixd)>("glLoadMatrixd")((projection_ * X_CS.matrix()).eval().data());
    context_->load<decltype(&::glVertexPointer)>("glVertexPointer")(3, GL_FLOAT, 0, positions_S.data());
    draw(GL_TRIANGLES, static_cast<GLsizei>(3 * triangles.size()), GL_UNSIGNED_INT, triangles.data());
  }
  context_->load<decltype(&::glReadPixels)>("glReadPixels")(0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_FLOAT,
                                                            depths_.data());
  if (const GLenum error = context_->load<decltype(&::glGetError)>("glGetError")(); error != GL_NO_ERROR)
    throw DeviceError("OpenGL reports error " + std::to_string(error) + " while it renders depths");
  for (float& depth : depths_) depth = depthOf(depth);
  return depths_;
}

}  // namespace sweep_guard_simulation
