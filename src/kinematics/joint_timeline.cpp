#include "sweep_guard/kinematics/joint_timeline.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "common/number_text.h"
#include "sweep_guard/common/unwound.h"
#include "sweep_guard/geometry/motion.h"

namespace sweep_guard_core {
namespace {

constexpr double kMaxPosition = 1e4;  // [rad or m]
constexpr double kMaxTurned = 1e10;   // [rad], of a continuous joint: a double resolves 2e-6 rad there
constexpr Duration kForgetPublisher = std::chrono::seconds(1);

// Tracks of different types do the same:

template <typename Value>
bool isKnownUpTo(const Track<Value>& track, Time stamp) {
  return track.size() > 0 && track.newest().stamp >= stamp;
}

template <typename Value>
double shareAt(const Track<Value>& track, Time stamp) {
  const double length = toSeconds(track[1].stamp - track[0].stamp);
  return std::min(1.0, toSeconds(stamp - track[0].stamp) / length);
}

// @param past_all  of several samples at this stamp, the last one counts
template <typename Value>
void advance(Track<Value>& track, Time to, bool past_all) {
  bool more = true;
  while (more && track.size() > 1 && track[1].stamp <= to) {
    track.forgetFirst();
    more = past_all;
  }
}

}  // namespace

JointTimeline::JointTimeline(const KinematicTree& tree, std::vector<std::optional<double>> fixed, bool root_moves)
    : tree_(tree), joints_(tree.variables().size()), root_moves_(root_moves) {
  assert(fixed.size() == joints_.size());
  for (size_t i = 0; i < joints_.size(); ++i) joints_[i].fixed = fixed[i];
}

void JointTimeline::add(const std::string& publisher, Time stamp, const std::vector<Position>& positions) {
  check(publisher, stamp, positions);
  for (const auto& [variable, value] : positions) {
    Joint& joint = joints_[variable];
    if (joint.fixed) continue;
    if (joint.publisher != publisher) joint.publisher = publisher;
    dropped_ = !joint.track.add({stamp, unwound(variable, value)}) || dropped_;
  }
}

void JointTimeline::check(const std::string& publisher, Time stamp, const std::vector<Position>& positions) const {
  for (size_t i = 0; i < positions.size(); ++i) {
    if (!expects(positions[i].variable)) continue;
    const std::string& name = tree_.variables()[positions[i].variable].name;
    const bool continuous = tree_.variables()[positions[i].variable].continuous;
    if (!(std::abs(positions[i].value) <= (continuous ? kMaxTurned : kMaxPosition))) {
      throw InvalidInput("joint '" + name + "' is at " + shortText(positions[i].value) + ", but must be within " +
                         (continuous ? "1e10 rad" : "1e4 rad or m"));
    }
    for (size_t k = 0; k < i; ++k) {
      if (positions[k].variable == positions[i].variable) throw InvalidInput("joint '" + name + "' is named twice");
    }
    if (joints_[positions[i].variable].track.size() > 0) checkPublisher(publisher, stamp, positions[i]);
  }
}

void JointTimeline::checkPublisher(const std::string& publisher, Time stamp, const Position& position) const {
  const Joint& joint = joints_[position.variable];
  const std::string& name = tree_.variables()[position.variable].name;
  const Time newest = joint.track.newest().stamp;
  if (joint.publisher != publisher && stamp - newest < kForgetPublisher) {
    throw SeveralPublishers("joint '" + name + "' is published by " + joint.publisher + " and " + publisher +
                            ": let one of them");
  }
  if (stamp < newest) throw OutOfOrder("joint '" + name + "': its stamp is older than the one before");
}

double JointTimeline::unwound(size_t variable, double value) const {
  const Track<double>& track = joints_[variable].track;
  if (!tree_.variables()[variable].continuous || track.size() == 0) return value;
  return sweep_guard_core::unwound(value, track.newest().value);
}

void JointTimeline::addRoot(Time stamp, const Eigen::Isometry3d& X_WR) {
  assert(root_moves_ && (root_.size() == 0 || stamp >= root_.newest().stamp));
  dropped_ = !root_.add({stamp, X_WR}) || dropped_;
}

template <typename Visit>
void JointTimeline::forEachTrack(const Visit& visit) const {
  for (const Joint& joint : joints_) {
    if (!joint.fixed) visit(joint.track);
  }
  if (root_moves_) visit(root_);
}

std::optional<Time> JointTimeline::next(RobotState& state) {
  const std::optional<Time> stamp = begun_ ? nextStamp() : commonStart();
  if (!stamp) return std::nullopt;
  advance(*stamp, /*past_all=*/!begun_);
  leaves_out_ = begun_ && dropped_;
  dropped_ = false;
  begun_ = true;
  stateAt(*stamp, state);
  return stamp;
}

std::optional<Time> JointTimeline::commonStart() const {
  std::optional<Time> start;
  bool known = true;
  forEachTrack([&](const auto& track) {
    known = known && track.size() > 0;
    if (known) start = std::max(start.value_or(track[0].stamp), track[0].stamp);
  });
  forEachTrack([&](const auto& track) { known = known && isKnownUpTo(track, start.value_or(Time())); });
  return known ? start : std::nullopt;
}

std::optional<Time> JointTimeline::nextStamp() const {
  std::optional<Time> next;
  forEachTrack([&](const auto& track) {
    if (track.size() > 1) next = std::min(next.value_or(track[1].stamp), track[1].stamp);
  });
  bool known = next.has_value();
  forEachTrack([&](const auto& track) { known = known && isKnownUpTo(track, *next); });
  return known ? next : std::nullopt;
}

void JointTimeline::advance(Time to, bool past_all) {
  for (Joint& joint : joints_) {
    if (!joint.fixed) sweep_guard_core::advance(joint.track, to, past_all);
  }
  if (root_moves_) sweep_guard_core::advance(root_, to, past_all);
}

void JointTimeline::stateAt(Time stamp, RobotState& state) const {
  state.positions.resize(joints_.size());
  for (size_t i = 0; i < joints_.size(); ++i) {
    const Track<double>& track = joints_[i].track;
    double& position = state.positions[i];
    position = joints_[i].fixed ? *joints_[i].fixed : track[0].value;
    if (joints_[i].fixed || track[0].stamp >= stamp) continue;
    position += shareAt(track, stamp) * (track[1].value - position);
  }
  state.X_WR = Eigen::Isometry3d::Identity();
  if (!root_moves_) return;
  state.X_WR = root_[0].value;
  if (root_[0].stamp < stamp) state.X_WR = Motion{root_[0].value, root_[1].value}.at(shareAt(root_, stamp));
}

std::optional<Time> JointTimeline::newestOf(size_t variable) const {
  const Track<double>& track = joints_[variable].track;
  return track.size() == 0 ? std::nullopt : std::optional(track.newest().stamp);
}

std::optional<Time> JointTimeline::newestOfRoot() const {
  return root_.size() == 0 ? std::nullopt : std::optional(root_.newest().stamp);
}

std::vector<Time> JointTimeline::rootStamps() const {
  std::vector<Time> stamps;
  for (const StampedValue<Eigen::Isometry3d>& pose : root_) stamps.push_back(pose.stamp);
  return stamps;
}

void JointTimeline::moveRoot(const std::vector<Eigen::Isometry3d>& motions_W) {
  assert(motions_W.size() == root_.size());
  Track<Eigen::Isometry3d> moved;
  for (size_t i = 0; i < root_.size(); ++i) moved.add({root_[i].stamp, motions_W[i] * root_[i].value});
  root_ = std::move(moved);
}

void JointTimeline::reset() {
  for (Joint& joint : joints_) joint.track.clear();
  root_.clear();
  begun_ = dropped_ = leaves_out_ = false;
}

}  // namespace sweep_guard_core
