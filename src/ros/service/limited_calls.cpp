#include "ros/service/limited_calls.h"

#include <boost/make_shared.hpp>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using SteadyClock = std::chrono::steady_clock;

thread_local bool refused_here = false;
thread_local SteadyClock::time_point arrival_of_call;

// Counts as inside until it has run or is dropped.
class CountedCall : public ros::CallbackInterface {
 public:
  CountedCall(ros::CallbackInterfacePtr call, std::shared_ptr<void> inside)
      : call_(std::move(call)), inside_(std::move(inside)) {}

  CallResult call() override {
    arrival_of_call = arrival_;
    const CallResult result = call_->call();
    if (result != TryAgain) inside_.reset();
    return result;
  }
  bool ready() override { return call_->ready(); }

 private:
  const ros::CallbackInterfacePtr call_;
  const SteadyClock::time_point arrival_ = SteadyClock::now();
  std::shared_ptr<void> inside_;
};

}  // namespace

void LimitedCalls::throwIfBusy() {
  if (!refused_here) return;
  throw sweep_guard_core::Error("BUSY: " + std::to_string(kMaxWaiting) + " calls wait already; ask again");
}

SteadyClock::time_point LimitedCalls::arrival() { return arrival_of_call; }

// Before any call: calls may come before the threads start.
LimitedCalls::LimitedCalls(const char* name) : name_(name) {
  worker_.post([] { refused_here = false; });
  refusals_.post([] { refused_here = true; });
}

void LimitedCalls::start(Supervisor& supervisor) {
  worker_.start(supervisor, {name_, sweep_guard_core::Stage::kOther, /*watched=*/false});
  refusals_.start(supervisor, {"busy", sweep_guard_core::Stage::kOther, /*watched=*/false});
}

void LimitedCalls::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  if (inside_->fetch_add(1) > kMaxWaiting) {
    inside_->fetch_sub(1);
    refusals_.queue().addCallback(callback, owner);
    return;
  }
  const std::shared_ptr<void> inside(nullptr, [count = inside_](void*) { count->fetch_sub(1); });
  worker_.queue().addCallback(boost::make_shared<CountedCall>(callback, inside), owner);
}

void LimitedCalls::removeByID(std::uint64_t owner) {
  worker_.queue().removeByID(owner);
  refusals_.queue().removeByID(owner);
}

}  // namespace sweep_guard_ros
