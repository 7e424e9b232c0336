#include "pictures/tip_script.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using sweep_guard_core::InvalidInput;

TipScript::TipScript(const std::vector<std::string>& poses) {
  if (poses.size() < 2) throw InvalidInput("a motion needs at least two poses");
  for (const std::string& line : poses) {
    poses_.push_back(parse(line));
    const size_t count = poses_.size();
    if (count > 1 && !(poses_[count - 2].t < poses_[count - 1].t)) {
      throw InvalidInput("pose '" + line + "' is not later than the previous pose");
    }
  }
  chooseRates();
}

TipScript::Pose TipScript::parse(const std::string& line) {
  std::istringstream numbers(line);
  numbers.imbue(std::locale::classic());
  Pose pose{};
  numbers >> pose.t;
  for (Eigen::Index i = 0; i < pose.at.size(); ++i) numbers >> pose.at[i];
  std::string rest;
  if (!numbers || numbers >> rest || !std::isfinite(pose.t) || !pose.at.allFinite()) {
    throw InvalidInput("pose '" + line + "' is not 't x y z rx ry rz'");
  }
  return pose;
}

// Mean rate between the neighbors.
void TipScript::chooseRates() {
  for (size_t i = 0; i < poses_.size(); ++i) {
    const Pose& from = poses_[i == 0 ? 0 : i - 1];
    const Pose& to = poses_[std::min(i + 1, poses_.size() - 1)];
    poses_[i].rate = (to.at - from.at) / (to.t - from.t);
  }
}

Eigen::Isometry3d TipScript::pose(double t) const {
  t = std::clamp(t, begin(), end());
  const auto next = std::find_if(poses_.begin() + 1, poses_.end() - 1, [t](const Pose& pose) { return t < pose.t; });
  const Pose& from = *(next - 1);
  const double span = next->t - from.t;
  const double s = (t - from.t) / span;
  const double rise = s * s * (3.0 - 2.0 * s);
  const Vector6d at =
      (1.0 - rise) * from.at + rise * next->at + span * s * (1.0 - s) * ((1.0 - s) * from.rate - s * next->rate);
  const Eigen::Vector3d turn = at.tail<3>();
  const Eigen::Quaterniond down(0.0, 1.0, 0.0, 0.0);
  return Eigen::Translation3d(at.head<3>()) * Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()) * down;
}

}  // namespace sweep_guard_simulation
