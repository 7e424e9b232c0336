#pragma once

#include <sys/types.h>

#include <string>

namespace sweep_guard_rviz {

/// An X server without a screen, of this process alone: DISPLAY names it as long as it lives.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool running() const { return !name_.empty(); }  ///< false: there is no Xvfb here

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace sweep_guard_rviz
