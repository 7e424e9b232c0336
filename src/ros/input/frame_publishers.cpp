#include "ros/input/frame_publishers.h"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <utility>

#include "monitor/recent_conflict.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/geometry/motion.h"
#include "sweep_guard/prediction/jump.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::Duration;
using sweep_guard_core::Moved;
using sweep_guard_core::movedBetween;
using sweep_guard_core::printable;
using sweep_guard_core::SteadyTime;
using sweep_guard_core::toSeconds;
using Transform = FramePublishers::Transform;
using Samples = sweep_guard_core::SampleBuffer<Transform>;

constexpr Duration kByTurns = std::chrono::milliseconds(1100);  // 1 s, and jitter
constexpr size_t kMaxNodes = 4;                                 // of a frame
constexpr size_t kMaxSamples = 256;                             // of a node
constexpr double kDistance = 1e-3;                              // [m]
constexpr double kTurn = 1e-3;                                  // [rad]

// How much of a difference between two nodes may come from the straight motion between two samples of one.
struct Difference {
  Moved apart;
  Moved curvature;
};

sweep_guard_core::Vector6d speedBetween(const Transform& from, const Transform& to) {
  const double seconds = toSeconds(to.stamp - from.stamp);
  const Eigen::AngleAxisd turn(from.X_PF.linear().transpose() * to.X_PF.linear());
  sweep_guard_core::Vector6d speed;
  speed << (to.X_PF.translation() - from.X_PF.translation()) / seconds, turn.angle() / seconds * turn.axis();
  return speed;
}

// The straight motion between samples errs by at most an eighth of the acceleration times the square of the period. Twice that, for
// the acceleration is estimated: from the change of speed to the next sample, or from the one before.
std::optional<Moved> curvatureOf(const Samples& samples, size_t i) {
  const bool has_next = i + 1 < samples.size();
  if (!has_next && i < 2) return std::nullopt;
  const sweep_guard_core::Vector6d change =
      (has_next ? speedBetween(samples[i], samples[i + 1]) : speedBetween(samples[i - 2], samples[i - 1])) -
      speedBetween(samples[i - 1], samples[i]);
  const double period = toSeconds(samples[i].stamp - samples[i - 1].stamp);
  return Moved{change.head<3>().norm() * period / 4.0, change.tail<3>().norm() * period / 4.0};
}

// Returns how far a node places the frame from where another one does at a stamp; empty: not known.
std::optional<Difference> differenceAt(const Transform& at, const Samples& samples) {
  const auto is_before = [](const Transform& sample, sweep_guard_core::Time stamp) { return sample.stamp < stamp; };
  const Transform* const next = std::lower_bound(samples.begin(), samples.end(), at.stamp, is_before);
  if (next == samples.end()) return std::nullopt;
  if (next->stamp == at.stamp) return Difference{movedBetween(next->X_PF, at.X_PF), {}};
  if (next == samples.begin()) return std::nullopt;
  const Transform& before = *(next - 1);
  const double share = toSeconds(at.stamp - before.stamp) / toSeconds(next->stamp - before.stamp);
  const auto curvature = curvatureOf(samples, static_cast<size_t>(next - samples.begin()));
  if (!curvature) return std::nullopt;
  return Difference{movedBetween(sweep_guard_core::Motion{before.X_PF, next->X_PF}.at(share), at.X_PF), *curvature};
}

bool differs(const Difference& difference) {
  const auto& [apart, curvature] = difference;
  return apart.distance > kDistance + curvature.distance || apart.turn > kTurn + curvature.turn;
}

std::string inWords(const Moved& apart) {
  char text[64];
  std::snprintf(text, sizeof text, ", which are %.1f mm and %.1f mrad apart", 1e3 * apart.distance, 1e3 * apart.turn);
  return text;
}

// A transform of the same stamp is ignored, as tf2 does; an earlier one means that time has gone back.
void keep(const Transform& transform, Samples& samples) {
  if (samples.size() > 0 && transform.stamp == samples.newest().stamp) return;
  if (samples.size() > 0 && transform.stamp < samples.newest().stamp) samples.clear();
  samples.add(transform);
  while (samples.size() > kMaxSamples || transform.stamp - samples[0].stamp > kByTurns) samples.forgetFirst();
}

}  // namespace

void FramePublishers::add(const std::string& frame, const std::string& node, const Transform& transform,
                          SteadyTime received) {
  std::vector<Node>& nodes = nodes_[frame];
  Node& newest = nodeOf(node, received, nodes);
  if (nodes.size() == 1) newest.samples.clear();
  keep(transform, newest.samples);
  const std::uint64_t previous = newest.number;
  const bool goes_on = previous > 0 && received - newest.received <= kByTurns;
  newest.number = ++count_;
  newest.received = received;
  for (const Node& other : nodes) {
    if (&other == &newest) continue;
    if (goes_on && other.number > previous) newest.by_turns = received;
    const SteadyTime last = std::max(newest.by_turns, other.by_turns);
    if (last != SteadyTime() && received - last <= kByTurns) compare(frame, newest, other, received);
  }
}

// Forgets those that are silent. Of more than there is room for, the newest takes the place of the one that was silent for longest.
FramePublishers::Node& FramePublishers::nodeOf(const std::string& name, SteadyTime received, std::vector<Node>& nodes) {
  if (nodes.size() == 1 && nodes[0].name == name) return nodes[0];
  const auto is_gone = [&](const Node& node) { return node.name != name && received - node.received > kByTurns; };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), is_gone), nodes.end());
  const auto known = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.name == name; });
  if (known != nodes.end()) return *known;
  const auto is_older = [](const Node& one, const Node& other) { return one.received < other.received; };
  if (nodes.size() == kMaxNodes) nodes.erase(std::min_element(nodes.begin(), nodes.end(), is_older));
  nodes.push_back({name, {}, 0, received, {}});
  return nodes.back();
}

// At the newest stamp of either that lies within the other's.
void FramePublishers::compare(const std::string& frame, const Node& one, const Node& other, SteadyTime received) {
  const Transform& newest = one.samples.newest();
  const Transform& others = other.samples.newest();
  const auto tell = [&](const std::string& how) {
    const auto [first, second] = std::minmax({printable(one.name), printable(other.name)});
    const std::string nodes = "'" + first + "' and '" + second + "'";
    found({frame, "frame '" + printable(frame) + "' is published by " + nodes + how, received});
  };
  if (newest.parent != others.parent) return tell(" in different frames");
  auto difference = differenceAt(newest, other.samples);
  if (!difference) difference = differenceAt(others, one.samples);
  if (difference && differs(*difference)) tell(inWords(difference->apart));
}

void FramePublishers::found(Conflict conflict) {
  const sweep_guard_core::Lock lock(mutex_);
  conflicts_[conflict.frame] = std::move(conflict);
  any_ = true;
}

std::vector<FramePublishers::Conflict> FramePublishers::conflicts(SteadyTime now) const {
  std::vector<Conflict> current;
  const sweep_guard_core::Lock lock(mutex_);
  for (auto conflict = conflicts_.begin(); conflict != conflicts_.end();) {
    const bool over = now - conflict->second.found > sweep_guard_core::kConflictShown;
    if (!over) current.push_back(conflict->second);
    conflict = over ? conflicts_.erase(conflict) : std::next(conflict);
  }
  any_ = !conflicts_.empty();
  return current;
}

}  // namespace sweep_guard_ros
