#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace sweep_guard_benchmark {

/// Runs a program during the lifetime of this object.
class ChildProcess {
 public:
  /// @param command  path of the program, then its arguments
  /// @throws sweep_guard_core::DeviceError if it cannot be started
  explicit ChildProcess(const std::vector<std::string>& command);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  ///< interrupts the program and waits for its end

  pid_t id() const { return id_; }

 private:
  pid_t id_ = 0;
};

/// Resources that a process has used since its start.
struct Usage {
  double processor_s;
  double resident_mb;
};

/// Returns the resources used by a process.
/// @throws sweep_guard_core::DeviceError if there is no such process
Usage usageOf(pid_t process);

/// Returns the path of a program in the folder of this program.
std::string programBeside(const std::string& program);

}  // namespace sweep_guard_benchmark
