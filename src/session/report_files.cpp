#include "session/report_files.h"

#include <ros/console.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_session {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text << std::flush;
  if (!stream) throw sweep_guard_core::InvalidInput(path.string() + ": cannot be written; give output:=FOLDER");
}

void removePictures(const std::filesystem::path& folder) {
  std::error_code none;
  for (const char* const picture : {"timeline.png", "contacts.png", "touches.png"}) {
    std::filesystem::remove(folder / picture, none);
  }
}

bool drawPictures(std::string folder, std::string name) {
  std::string program = std::filesystem::read_symlink("/proc/self/exe").replace_filename("plot.py");
  const std::array<char*, 4> arguments{program.data(), folder.data(), name.data(), nullptr};
  pid_t process = 0;
  if (posix_spawn(&process, program.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
    ROS_WARN("no pictures: %s cannot be run: is python3 installed?", program.c_str());
    return false;
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return status == 0;
}

}  // namespace sweep_guard_session
