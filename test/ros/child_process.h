#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace sweep_guard_ros {

/// A program that a test runs, ended with the test.
class ChildProcess {
 public:
  /// @param environment  variables that are set in addition, "NAME=VALUE"
  explicit ChildProcess(std::vector<std::string> command, const std::vector<std::string>& environment = {});
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  void signal(int number) const;
  /// Waits for the end and returns the exit status; that of a signal is negative. Empty: it still runs after 20 s.
  std::optional<int> wait();
  std::string output() const { return output_; }  ///< standard output and error, after wait()
  pid_t pid() const { return pid_; }

 private:
  pid_t pid_ = 0;
  int out_ = -1;
  int status_ = 0;
  bool ended_ = false;
  std::string output_;
};

}  // namespace sweep_guard_ros
