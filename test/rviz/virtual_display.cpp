#include "virtual_display.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace sweep_guard_rviz {

VirtualDisplay::VirtualDisplay() {
  int pipe_ends[2];
  if (pipe(pipe_ends) != 0) return;
  server_ = fork();
  if (server_ == 0) {
    close(pipe_ends[0]);
    const std::string number = std::to_string(pipe_ends[1]);
    execlp("Xvfb", "Xvfb", "-displayfd", number.c_str(), "-screen", "0", "1024x768x24", "-nolisten", "tcp", nullptr);
    _exit(127);
  }
  close(pipe_ends[1]);
  char character = 0;
  while (read(pipe_ends[0], &character, 1) == 1 && character != '\n') name_ += character;
  close(pipe_ends[0]);
  if (name_.empty()) return;
  name_ = ":" + name_;
  setenv("DISPLAY", name_.c_str(), 1);
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ <= 0) return;
  kill(server_, SIGTERM);
  waitpid(server_, nullptr, 0);
}

}  // namespace sweep_guard_rviz
