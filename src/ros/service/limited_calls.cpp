#include "ros/service/limited_calls.h"

#include <boost/make_shared.hpp>

#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {

// Counts as inside until it has run or is dropped.
class LimitedCalls::CountedCall : public ros::CallbackInterface {
 public:
  CountedCall(ros::CallbackInterfacePtr call, const std::shared_ptr<State>& state)
      : call_(std::move(call)), inside_(state.get(), [state](State* entered) { --entered->inside; }) {}

  CallResult call() override {
    inside_->arrival = arrival_;
    const CallResult result = call_->call();
    if (result != TryAgain) inside_.reset();
    return result;
  }
  bool ready() override { return call_->ready(); }

 private:
  const ros::CallbackInterfacePtr call_;
  const sweep_guard_core::SteadyTime arrival_ = std::chrono::steady_clock::now();
  std::shared_ptr<State> inside_;
};

void LimitedCalls::throwIfBusy() const {
  if (!refusals_.isCurrent()) return;
  throw sweep_guard_core::Error("BUSY: " + std::to_string(kMaxWaiting) + " calls wait already; ask again");
}

void LimitedCalls::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  if (state_->inside++ > kMaxWaiting) {
    --state_->inside;
    refusals_.queue().addCallback(callback, owner);
    return;
  }
  worker_.queue().addCallback(boost::make_shared<CountedCall>(callback, state_), owner);
}

void LimitedCalls::removeByID(std::uint64_t owner) {
  worker_.queue().removeByID(owner);
  refusals_.queue().removeByID(owner);
}

}  // namespace sweep_guard_ros
