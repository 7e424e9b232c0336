#include "ros/sound/sound_player.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::DeviceError;

constexpr int kPipeSize = 4096;  // [bytes] the smallest that Linux has

pid_t run(const std::vector<std::string>& command, int standard_input) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, standard_input, STDIN_FILENO);
  pid_t process = 0;
  const int failure = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    throw DeviceError(command.front() + " cannot be run: " + std::strerror(failure) +
                      "; install it (Debian: alsa-utils)" + " or name another one with `player`");
  }
  return process;
}

}  // namespace

SoundPlayer::SoundPlayer(const std::vector<std::string>& command) : name_(command.front()) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw DeviceError("no pipe for " + name_ + ": " + std::strerror(errno));
  samples_in_ = ends[1];
  fcntl(samples_in_, F_SETPIPE_SZ, kPipeSize);
  fcntl(samples_in_, F_SETFL, O_NONBLOCK);
  try {
    process_ = run(command, ends[0]);
  } catch (...) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  close(ends[0]);
}

SoundPlayer::~SoundPlayer() {
  close(samples_in_);
  kill(process_, SIGTERM);
  while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

size_t SoundPlayer::play(const std::vector<std::int16_t>& samples) {
  const ssize_t written = write(samples_in_, samples.data(), samples.size() * sizeof samples[0]);
  if (written >= 0) return static_cast<size_t>(written) / sizeof samples[0];
  if (errno == EAGAIN || errno == EINTR) return 0;
  throw DeviceError(name_ + " has ended: see what it says; `player` names another one or another device");
}

}  // namespace sweep_guard_ros
