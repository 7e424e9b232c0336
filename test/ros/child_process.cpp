#include "child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

namespace sweep_guard_ros {
namespace {

constexpr auto kPatience = std::chrono::seconds(20);

}  // namespace

ChildProcess::ChildProcess(std::vector<std::string> command, const std::vector<std::string>& environment) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  pid_ = fork();
  if (pid_ == 0) {
    dup2(ends[1], STDOUT_FILENO);
    dup2(ends[1], STDERR_FILENO);
    for (const std::string& variable : environment) putenv(strdup(variable.c_str()));
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (std::string& argument : command) arguments.push_back(argument.data());
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(ends[1]);
  out_ = ends[0];
}

ChildProcess::~ChildProcess() {
  if (!ended_) {
    signal(SIGKILL);
    waitpid(pid_, &status_, 0);
  }
  close(out_);
}

void ChildProcess::signal(int number) const {
  if (!ended_) kill(pid_, number);
}

// Its output ends with it: reading waits for the end.
std::optional<int> ChildProcess::wait() {
  const auto deadline = std::chrono::steady_clock::now() + kPatience;
  while (!ended_) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd events{out_, POLLIN, 0};
    if (left.count() <= 0 || poll(&events, 1, static_cast<int>(left.count())) <= 0) return std::nullopt;
    std::array<char, 4096> bytes{};
    const ssize_t count = read(out_, bytes.data(), bytes.size());
    if (count > 0) {
      output_.append(bytes.data(), static_cast<size_t>(count));
    } else {
      ended_ = waitpid(pid_, &status_, 0) == pid_;
    }
  }
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
}

}  // namespace sweep_guard_ros
