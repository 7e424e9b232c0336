#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace sweep_guard_ros {

/// Takes SIGINT, SIGTERM and the call `shutdown` of a node's XML-RPC interface (rosnode kill) as a request to end.
/// roscpp's own handlers would close the publishers before the last warning. Once in a process, after ros::init() with
/// NoSigintHandler and before the first node handle: of two handlers of a call, roscpp keeps the first.
class EndRequest {
 public:
  /// @param time_to_end  that the process has from a request on
  explicit EndRequest(std::chrono::milliseconds time_to_end);
  ~EndRequest();  ///< the end is done
  EndRequest(const EndRequest&) = delete;
  EndRequest& operator=(const EndRequest&) = delete;

  /// Returns when the end is requested. What is not done in time is left to the kernel, and the exit status is 0. Before this
  /// call, a request ends the process at once.
  void await();

 private:
  void run();

  const std::chrono::milliseconds time_to_end_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool awaited_ = false;
  bool requested_ = false;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
