#include "simulation/joystick.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using sweep_guard_core::InvalidInput;

namespace {

double deflection(const std::vector<float>& axes, int axis, double dead_zone) {
  if (axis < 0) return 0.0;
  const auto index = static_cast<std::size_t>(axis);
  if (index >= axes.size()) {
    throw InvalidInput("axis " + std::to_string(axis) + " is missing: the device has " + std::to_string(axes.size()) +
                       " axes; correct the mapping");
  }
  const auto value = static_cast<double>(axes[index]);
  if (!std::isfinite(value)) throw InvalidInput("axis " + std::to_string(axis) + " is not finite");
  return std::copysign(std::max(std::min(std::abs(value), 1.0) - dead_zone, 0.0) / (1.0 - dead_zone), value);
}

}  // namespace

Joystick::Joystick(const Options& options) : options_(options) {
  if (!(options.dead_zone >= 0.0 && options.dead_zone < 1.0)) throw InvalidInput("the dead zone is not within [0, 1)");
  if (!(options.timeout > sweep_guard_core::Duration(0))) throw InvalidInput("the timeout is not above 0");
}

void Joystick::setAxes(const std::vector<float>& axes, sweep_guard_core::Time at) {
  Twist twist;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    twist.v_W[k] = options_.linear[k] * deflection(axes, options_.linear_axes[i], options_.dead_zone);
    twist.w_W[k] = options_.angular[k] * deflection(axes, options_.angular_axes[i], options_.dead_zone);
  }
  if (at < ignored_until_) return;
  newest_ = twist;
  newest_at_ = at;
}

void Joystick::ignoreUntil(sweep_guard_core::Time until) {
  newest_at_.reset();
  ignored_until_ = until;
}

Twist Joystick::velocity(sweep_guard_core::Time at) const {
  return newest_at_ && at - *newest_at_ <= options_.timeout ? newest_ : Twist();
}

}  // namespace sweep_guard_simulation
