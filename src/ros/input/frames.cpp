#include "ros/input/frames.h"

#include <new>
#include <thread>

#include "common/heartbeat.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::printable;

constexpr auto kPollPeriod = std::chrono::milliseconds(1);
constexpr std::uint32_t kTransformsQueued = 1000;
constexpr size_t kMaxReason = 400;    // [bytes]
constexpr size_t kMaxFrames = 10000;  // tf2 forgets none

void check(const geometry_msgs::TransformStamped& transform) {
  for (const std::string& frame : {transform.header.frame_id, transform.child_frame_id}) {
    if (!sweep_guard_core::isName(frame)) {
      throw sweep_guard_core::InvalidInput("a frame is no name of up to 128 printable characters");
    }
  }
  fromMsg(transform.transform);
}

FrameError noTransform(const std::string& target, const std::string& source, const std::string& why) {
  return FrameError("no transform from '" + printable(source) + "' to '" + printable(target) +
                    "': " + printable(why, kMaxReason));
}

FrameError notRigid(const std::string& target, const std::string& source, const std::string& why) {
  return FrameError("transform from '" + printable(source) + "' to '" + printable(target) + "' is not rigid: " + why);
}

std::string withoutSlash(const std::string& frame) { return frame.substr(frame.find_first_not_of('/') == 1 ? 1 : 0); }

}  // namespace

Frames::Frames(const ros::NodeHandle& node, size_t max_message_size,
               std::function<void(const std::string&, const std::string&)> on_static_change)
    : on_static_change_(std::move(on_static_change)) {
  buffer_.setUsingDedicatedThread(true);
  const auto subscribe = [&](const std::string& topic, bool is_static) {
    return subscribeBounded<tf2_msgs::TFMessage>(
        thread_.on(node), {topic, kTransformsQueued, max_message_size},
        [this, is_static](const auto& event) { onTransforms(event, is_static); },
        [this, topic](const std::string& reason) { log_.error(topic, topic + ": " + reason); });
  };
  moving_ = subscribe("/tf", /*is_static=*/false);
  static_ = subscribe("/tf_static", /*is_static=*/true);
}

// Does what tf2's listener does, which reserves whatever memory a message announces and logs names as they come.
void Frames::onTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool is_static) {
  checkClock();
  for (const geometry_msgs::TransformStamped& transform : event.getConstMessage()->transforms) {
    sweep_guard_core::beat();
    try {
      check(transform);
      if (!is_static) checkStamp(transform.header.stamp);
      countFrames(transform);
      const std::string publisher = printable(event.getPublisherName());
      if (is_static && isHeldBack(transform, publisher)) continue;
      buffer_.setTransform(transform, publisher, is_static);
      tree_.add(withoutSlash(transform.header.frame_id), withoutSlash(transform.child_frame_id));
      if (is_static || !tree_.isUsed(withoutSlash(transform.child_frame_id))) continue;
      notePublisher(transform, event.getPublisherName());
      moved();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      log_.error("transform", "transform to '" + printable(transform.child_frame_id) + "' refused: " + error.what());
    }
  }
}

void Frames::checkClock() {
  const sweep_guard_core::Lock lock(clock_mutex_);
  if (clock_.hasGoneBack(now())) buffer_.clear();
}

void Frames::checkStamp(const ros::Time& stamp) {
  const sweep_guard_core::Lock lock(clock_mutex_);
  const std::string refusal = clock_.refusal(fromMsg(stamp), now());
  if (!refusal.empty()) throw sweep_guard_core::InvalidInput(refusal);
}

void Frames::notePublisher(const geometry_msgs::TransformStamped& transform, const std::string& node) {
  publishers_.add(
      withoutSlash(transform.child_frame_id), node,
      {fromMsg(transform.header.stamp), withoutSlash(transform.header.frame_id), fromMsg(transform.transform)},
      std::chrono::steady_clock::now());
}

std::string Frames::conflict() const {
  if (!publishers_.hasConflicts()) return {};
  for (const auto& [frame, text, found] : publishers_.conflicts(std::chrono::steady_clock::now())) {
    if (tree_.isUsed(frame)) return text;
  }
  return {};
}

// A change that counts waits until what moved before it is swept. It is told of once it waits: a pose that is received later
// finds it.
bool Frames::isHeldBack(const geometry_msgs::TransformStamped& transform, const std::string& publisher) {
  const std::string child = withoutSlash(transform.child_frame_id);
  const auto known = static_transforms_.emplace(child, transform).first;
  const bool same =
      known->second.header.frame_id == transform.header.frame_id && known->second.transform == transform.transform;
  known->second = transform;
  {
    const sweep_guard_core::Lock lock(changes_mutex_);
    if (same) return held_back_.count(child) != 0;
    if (!tree_.isUsed(child)) return false;
    if (held_back_.empty()) held_back_since_ = std::chrono::steady_clock::now();
    held_back_[child] = {transform, publisher};
    ++static_changes_;
  }
  on_static_change_(transform.header.frame_id, transform.child_frame_id);
  return true;
}

std::uint64_t Frames::staticChanges() const {
  const sweep_guard_core::Lock lock(changes_mutex_);
  return static_changes_;
}

bool Frames::holdsBack(sweep_guard_core::Duration longer_than) const {
  const sweep_guard_core::Lock lock(changes_mutex_);
  return !held_back_.empty() && std::chrono::steady_clock::now() - held_back_since_ > longer_than;
}

bool Frames::applyStaticChanges() {
  std::map<std::string, StaticChange> changes;
  {
    const sweep_guard_core::Lock lock(changes_mutex_);
    std::swap(changes, held_back_);
  }
  for (const auto& [child, change] : changes) {
    buffer_.setTransform(change.transform, change.publisher, /*is_static=*/true);
    tree_.add(withoutSlash(change.transform.header.frame_id), child);
  }
  return !changes.empty();
}

void Frames::use(const std::string& user, const std::string& target, const std::set<std::string>& sources) {
  std::set<std::string> names;
  for (const std::string& source : sources) names.insert(withoutSlash(source));
  tree_.use(user, withoutSlash(target), names);
}

void Frames::moved() {
  std::shared_ptr<Gate<>> on_move;
  {
    const sweep_guard_core::Lock lock(moves_mutex_);
    on_move = on_move_;
  }
  if (on_move) on_move->pass();
}

std::shared_ptr<void> Frames::onMove(std::function<void()> callback) {
  const auto gate = std::make_shared<Gate<>>(std::move(callback));
  const auto set = [this](const std::shared_ptr<Gate<>>& next) {
    const sweep_guard_core::Lock lock(moves_mutex_);
    on_move_ = next;
  };
  set(gate);
  return std::shared_ptr<void>(nullptr, [set, gate](void*) {
    set(nullptr);
    gate->close();
  });
}

void Frames::countFrames(const geometry_msgs::TransformStamped& transform) {
  for (const std::string& frame : {transform.header.frame_id, transform.child_frame_id}) {
    if (known_.count(frame) != 0) continue;
    if (known_.size() >= kMaxFrames) throw sweep_guard_core::InvalidInput("there are 10000 frames already");
    known_.insert(frame);
  }
}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source,
                                 sweep_guard_core::Time stamp) const {
  if (withoutSlash(target) == withoutSlash(source)) return Eigen::Isometry3d::Identity();
  try {
    return fromMsg(buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), toMsg(stamp)).transform);
  } catch (const tf2::TransformException& error) {
    throw noTransform(target, source, error.what());
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw notRigid(target, source, error.what());
  }
}

std::optional<Eigen::Isometry3d> Frames::find(const std::string& target, const std::string& source,
                                              sweep_guard_core::Time stamp) const {
  try {
    return lookup(target, source, stamp);
  } catch (const FrameError&) {
    return std::nullopt;
  }
}

Eigen::Isometry3d Frames::lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp,
                                 sweep_guard_core::Duration wait) const {
  const auto deadline = std::chrono::steady_clock::now() + wait;
  while (true) {
    try {
      return lookup(target, source, stamp);
    } catch (const FrameError&) {
      if (std::chrono::steady_clock::now() >= deadline) throw;
    }
    std::this_thread::sleep_for(kPollPeriod);
  }
}

NewestPose Frames::newestPose(const std::string& target, const std::string& source) const {
  if (withoutSlash(target) == withoutSlash(source)) return {};
  try {
    const auto newest = buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), ros::Time(0));
    return {fromMsg(newest.header.stamp), fromMsg(newest.transform)};
  } catch (const tf2::TransformException& error) {
    throw noTransform(target, source, error.what());
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw notRigid(target, source, error.what());
  }
}

std::optional<sweep_guard_core::Time> Frames::newest(const std::string& target, const std::string& source) const {
  if (withoutSlash(target) == withoutSlash(source)) return sweep_guard_core::Time();
  try {
    return fromMsg(buffer_.lookupTransform(withoutSlash(target), withoutSlash(source), ros::Time(0)).header.stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

// Removing a callback from tf2 does not wait for one that is running; the gate does.
std::shared_ptr<void> Frames::onChange(std::function<void()> callback) {
  auto gate = std::make_shared<Gate<>>(std::move(callback));
  const auto connection = buffer_._addTransformsChangedListener([gate] { gate->pass(); });
  return std::shared_ptr<void>(nullptr, [this, gate, connection](void*) {
    buffer_._removeTransformsChangedListener(connection);
    gate->close();
  });
}

}  // namespace sweep_guard_ros
