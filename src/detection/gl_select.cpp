#include "detection/gl_select.h"

#include <GL/gl.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "common/heartbeat.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

constexpr size_t kWordsPerRecord = 4;  // number of names, smallest and largest depth, the name
constexpr int kClipPlanes = 6;

}  // namespace

struct GlSelect::Functions {
  OffscreenContext& context;
  decltype(&::glClipPlane) clipPlane = context.load<decltype(&::glClipPlane)>("glClipPlane");
  decltype(&::glDisable) disable = context.load<decltype(&::glDisable)>("glDisable");
  decltype(&::glDrawArrays) drawArrays = context.load<decltype(&::glDrawArrays)>("glDrawArrays");
  decltype(&::glEnable) enable = context.load<decltype(&::glEnable)>("glEnable");
  decltype(&::glEnableClientState) enableClientState =
      context.load<decltype(&::glEnableClientState)>("glEnableClientState");
  decltype(&::glGetError) getError = context.load<decltype(&::glGetError)>("glGetError");
  decltype(&::glInitNames) initNames = context.load<decltype(&::glInitNames)>("glInitNames");
  decltype(&::glLoadIdentity) loadIdentity = context.load<decltype(&::glLoadIdentity)>("glLoadIdentity");
  decltype(&::glLoadName) loadName = context.load<decltype(&::glLoadName)>("glLoadName");
  decltype(&::glMatrixMode) matrixMode = context.load<decltype(&::glMatrixMode)>("glMatrixMode");
  decltype(&::glPolygonMode) polygonMode = context.load<decltype(&::glPolygonMode)>("glPolygonMode");
  decltype(&::glPushName) pushName = context.load<decltype(&::glPushName)>("glPushName");
  decltype(&::glRenderMode) renderMode = context.load<decltype(&::glRenderMode)>("glRenderMode");
  decltype(&::glSelectBuffer) selectBuffer = context.load<decltype(&::glSelectBuffer)>("glSelectBuffer");
  decltype(&::glVertexPointer) vertexPointer = context.load<decltype(&::glVertexPointer)>("glVertexPointer");
};

GlSelect::GlSelect(std::unique_ptr<OffscreenContext> context, size_t hit_records)
    : context_(std::move(context)), hit_buffer_(kWordsPerRecord * std::max<size_t>(hit_records, 1)) {
  const CurrentContext current(*context_);
  gl_.reset(new Functions{*context_});
}

GlSelect::~GlSelect() = default;

const std::vector<std::uint32_t>& GlSelect::hits(const Query& query) {
  assert(query.corners.size() % 9 == 0 && query.triangles_per_name >= 1 && query.clips.size() <= kClipPlanes);
  const auto triangles = query.corners.size() / 9;
  const auto per_name = static_cast<size_t>(query.triangles_per_name);
  const auto canary_name = static_cast<std::uint32_t>((triangles + per_name - 1) / per_name);

  const CurrentContext current(*context_);
  int records = draw(query, canary_name);
  while (records < 0) {  // the buffer overflowed; its contents are incomplete
    if (hit_buffer_.size() > kWordsPerRecord * canary_name) {
      throw DeviceError("OpenGL selection overflows a buffer with room for every name");
    }
    hit_buffer_.resize(2 * hit_buffer_.size());
    records = draw(query, canary_name);
  }
  readHits(records, canary_name);
  return names_;
}

int GlSelect::draw(const Query& query, std::uint32_t canary_name) {
  gl_->selectBuffer(static_cast<GLsizei>(hit_buffer_.size()), hit_buffer_.data());
  gl_->renderMode(GL_SELECT);
  setState(query);
  gl_->initNames();
  gl_->pushName(canary_name);

  const Eigen::Vector3f canary = query.canary.cast<float>();
  const std::array<float, 9> canary_corners = {canary.x(), canary.y(), canary.z(),        canary.x() + 0.1F, canary.y(),
                                               canary.z(), canary.x(), canary.y() + 0.1F, canary.z()};
  gl_->vertexPointer(3, GL_FLOAT, 0, canary_corners.data());
  gl_->drawArrays(GL_TRIANGLES, 0, 3);

  gl_->vertexPointer(3, GL_FLOAT, 0, query.corners.data());
  const auto corners = static_cast<GLint>(query.corners.size() / 3);
  const GLint step = 3 * query.triangles_per_name;
  GLuint name = 0;
  for (GLint first = 0; first < corners; first += step) {
    beat();
    gl_->loadName(name++);
    gl_->drawArrays(GL_TRIANGLES, first, std::min(step, corners - first));
  }
  const int records = gl_->renderMode(GL_RENDER);
  if (const GLenum error = gl_->getError(); error != GL_NO_ERROR) {
    throw DeviceError("OpenGL reports error " + std::to_string(error) + " during selection");
  }
  return records;
}

void GlSelect::setState(const Query& query) {
  for (const GLenum matrix : {GLenum{GL_PROJECTION}, GLenum{GL_MODELVIEW}}) {
    gl_->matrixMode(matrix);
    gl_->loadIdentity();
  }
  for (int i = 0; i < kClipPlanes; ++i) {
    const auto plane = static_cast<GLenum>(GL_CLIP_PLANE0 + i);
    if (static_cast<size_t>(i) < query.clips.size()) {
      gl_->clipPlane(plane, query.clips[static_cast<size_t>(i)].data());
      gl_->enable(plane);
    } else {
      gl_->disable(plane);
    }
  }
  gl_->disable(GL_CULL_FACE);
  gl_->polygonMode(GL_FRONT_AND_BACK, GL_FILL);
  gl_->enableClientState(GL_VERTEX_ARRAY);
}

void GlSelect::readHits(int records, std::uint32_t canary_name) {
  names_.clear();
  for (size_t i = 0; i < static_cast<size_t>(records); ++i) {
    const std::uint32_t* record = &hit_buffer_[kWordsPerRecord * i];
    if (record[0] != 1 || record[3] > canary_name)
      throw DeviceError("OpenGL selection reports a hit with an unknown name");
    names_.push_back(record[3]);
  }
  std::sort(names_.begin(), names_.end());
  names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
  if (names_.empty() || names_.back() != canary_name) {
    throw DeviceError("OpenGL selection misses the canary triangle: its answers cannot be trusted");
  }
  names_.pop_back();
}

}  // namespace sweep_guard_core
