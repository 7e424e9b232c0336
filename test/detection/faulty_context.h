#pragma once

#include <GL/gl.h>

#include <map>
#include <memory>
#include <string>
#include <utility>

#include "detection/offscreen_context.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {

inline GLenum GLAPIENTRY reportAnError() { return GL_INVALID_OPERATION; }

/// A context of which single functions are replaced.
class FaultyContext : public OffscreenContext {
 public:
  using Replacements = std::map<std::string, Function>;  ///< null: the function is missing

  FaultyContext(std::unique_ptr<OffscreenContext> context, Replacements replacements)
      : context_(std::move(context)), replacements_(std::move(replacements)) {}

  void makeCurrent() override {
    if (refuses) throw DeviceError("faulty context: cannot be made current");
    context_->makeCurrent();
  }

  void release() override { context_->release(); }

  Function function(const char* name) override {
    const auto replacement = replacements_.find(name);
    return replacement == replacements_.end() ? context_->function(name) : replacement->second;
  }

  bool refuses = false;  ///< makeCurrent() throws

 private:
  std::unique_ptr<OffscreenContext> context_;
  Replacements replacements_;
};

}  // namespace sweep_guard_core
