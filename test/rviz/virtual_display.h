#pragma once

#include <sys/types.h>

#include <string>

namespace sweep_guard_rviz {

/// Runs an X server without a screen for this process, and sets DISPLAY to it.
class VirtualDisplay {
 public:
  VirtualDisplay();
  ~VirtualDisplay();
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  bool running() const { return !name_.empty(); }  ///< false if Xvfb is not installed

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace sweep_guard_rviz
