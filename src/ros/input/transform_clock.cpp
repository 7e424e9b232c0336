#include "ros/input/transform_clock.h"

#include <utility>

#include "common/number_text.h"

namespace sweep_guard_ros {
namespace {

constexpr auto kMaxLead = std::chrono::seconds(10);
constexpr auto kOnItsWay = std::chrono::seconds(1);
constexpr auto kMaxLeadThen = std::chrono::milliseconds(200);

}  // namespace

bool TransformClock::hasGoneBack(const sweep_guard_core::Instant& now) {
  if (now.stamp >= std::exchange(newest_, now.stamp)) return false;
  went_back_ = now.steady;
  return true;
}

std::string TransformClock::refusal(sweep_guard_core::Time stamp, const sweep_guard_core::Instant& now) const {
  if (now.stamp == sweep_guard_core::Time()) return "";
  if (stamp > now.stamp + kMaxLead)
    return "its stamp lies " + sweep_guard_core::inSeconds(stamp - now.stamp) + " in the future, more than 10 s";
  const bool just_went_back = went_back_ && now.steady < *went_back_ + kOnItsWay;
  return just_went_back && stamp > now.stamp + kMaxLeadThen ? "its stamp is of the time before it went back" : "";
}

}  // namespace sweep_guard_ros
