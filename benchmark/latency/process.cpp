#include "latency/process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_benchmark {
namespace {

// The part of /proc/PID/stat after the name, which may contain spaces.
std::string statusOf(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string stat;
  std::getline(file, stat);
  if (!file) throw sweep_guard_core::DeviceError("process " + std::to_string(process) + " does not exist");
  return stat.substr(stat.rfind(')') + 1);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  if (posix_spawn(&id_, arguments.front(), nullptr, nullptr, arguments.data(), environ) != 0) {
    throw sweep_guard_core::DeviceError("cannot start " + command.front());
  }
}

ChildProcess::~ChildProcess() {
  kill(id_, SIGINT);
  waitpid(id_, nullptr, 0);
}

Usage usageOf(pid_t process) {
  constexpr int kUserTime = 11;  // words after the name: proc(5), stat
  constexpr int kSystemTime = 12;
  constexpr int kResidentPages = 21;
  std::istringstream status(statusOf(process));
  const std::vector<std::string> words{std::istream_iterator<std::string>(status), {}};
  const auto number = [&](size_t word) { return std::stod(words.at(word)); };
  return {(number(kUserTime) + number(kSystemTime)) / static_cast<double>(sysconf(_SC_CLK_TCK)),
          1e-6 * number(kResidentPages) * static_cast<double>(sysconf(_SC_PAGESIZE))};
}

std::string programBeside(const std::string& program) {
  return (std::filesystem::read_symlink("/proc/self/exe").parent_path() / program).string();
}

}  // namespace sweep_guard_benchmark
