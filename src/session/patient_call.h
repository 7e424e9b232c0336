#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <thread>
#include <utility>

namespace sweep_guard_session {

/// Starts a call that may never return. Nobody waits for it: neither the result, when it is destroyed, nor the end of the program.
/// @param call  owns all that it needs
inline std::future<bool> startCall(std::function<bool()> call) {
  std::packaged_task<bool()> task(std::move(call));
  std::future<bool> answer = task.get_future();
  std::thread(std::move(task)).detach();
  return answer;
}

inline bool hasReturned(const std::future<bool>& call) {
  return call.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace sweep_guard_session
