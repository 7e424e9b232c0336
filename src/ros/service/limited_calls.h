#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "ros/connection/bounded.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

constexpr size_t kMaxRequest = 1024;  ///< [bytes]; of a request that holds little more than names
constexpr auto kTransformWait = std::chrono::milliseconds(100);  ///< of a call for one transform
constexpr auto kGuardTimeout = std::chrono::seconds(1);          ///< of a call for a guard that is stuck in a sweep

/// Hands the calls of one or more services to a thread that runs them and others. Lets five of these calls in, which wait or
/// run. Any more are answered BUSY at once, in another thread. Both threads must be stopped first, and then the servers
/// be destroyed.
class LimitedCalls : public ros::CallbackQueueInterface {
 public:
  static constexpr int kMaxWaiting = 4;  ///< while one of them runs

  /// @param worker    runs the calls
  /// @param refusals  answers those that find no room; both must outlive this
  LimitedCalls(QueueThread& worker, QueueThread& refusals) : worker_(worker), refusals_(refusals) {}
  LimitedCalls(const LimitedCalls&) = delete;
  LimitedCalls& operator=(const LimitedCalls&) = delete;

  /// Advertises a service. Its requests are checked before they are read.
  /// @param max_size  of a request [bytes]
  /// @param refused   as for advertiseBounded(); the reason may be that there is no room
  template <typename Spec>
  ros::ServiceServer advertise(ros::NodeHandle node, const std::string& name, size_t max_size,
                               typename BoundedCalls<Spec>::Base::Callback callback,
                               typename BoundedCalls<Spec>::Refused refused) {
    node.setCallbackQueue(this);
    return advertiseBounded<Spec>(node, name, max_size, std::move(callback), std::move(refused),
                                  [this] { throwIfBusy(); });
  }

  /// Does the same for a service whose response has a message: it answers by the reason.
  template <typename Spec>
  ros::ServiceServer advertise(const ros::NodeHandle& node, const std::string& name, size_t max_size,
                               typename BoundedCalls<Spec>::Base::Callback callback) {
    return advertise<Spec>(node, name, max_size, std::move(callback), [](const std::string& reason, auto& response) {
      response.message = reason;
      return true;
    });
  }

  /// Throws sweep_guard_core::Error in a call that found no room.
  void throwIfBusy() const;
  /// Returns when the running call came: it may have waited since. Only in a call that found room.
  sweep_guard_core::SteadyTime arrival() const { return state_->arrival; }

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;
  void removeByID(std::uint64_t owner) override;

 private:
  struct State {
    std::atomic<int> inside = 0;           // that wait or run
    sweep_guard_core::SteadyTime arrival;  // of the call that runs; used by the worker only
  };
  class CountedCall;

  QueueThread& worker_;
  QueueThread& refusals_;
  const std::shared_ptr<State> state_ = std::make_shared<State>();
};

/// Fills the response of a call. Errors are answered by a message: a failed ROS call gives the caller none.
/// @param serve  returns the message; may throw
template <typename Response, typename Serve>
void answerWith(Response& response, const Serve& serve) {
  try {
    response.message = serve();
    response.success = true;
  } catch (const std::exception& error) {
    response.message = error.what();
  }
}

}  // namespace sweep_guard_ros
