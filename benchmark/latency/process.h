#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace sweep_guard_benchmark {

/// A program that runs while this object lives.
class ChildProcess {
 public:
  /// @param command  path of the program, then its arguments
  /// @throws sweep_guard_core::DeviceError if it cannot be started
  explicit ChildProcess(const std::vector<std::string>& command);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  ///< ends it as Ctrl-C does, and waits

  pid_t id() const { return id_; }

 private:
  pid_t id_ = 0;
};

/// What a process has used so far.
struct Usage {
  double processor_s;
  double resident_mb;
};

/// @throws sweep_guard_core::DeviceError if there is no such process
Usage usageOf(pid_t process);

/// Path of a program beside this one.
std::string neighbour(const std::string& program);

}  // namespace sweep_guard_benchmark
