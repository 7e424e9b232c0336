#include "ros/input/frames.h"

#include <new>
#include <thread>

#include "common/frame_name.h"
#include "common/heartbeat.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::isSameFrame;
using sweep_guard_core::printable;
using sweep_guard_core::withoutSlash;

constexpr auto kPollPeriod = std::chrono::milliseconds(1);
constexpr std::uint32_t kTransformsQueued = 1000;
constexpr size_t kMaxReason = 400;    // [bytes]
constexpr size_t kMaxFrames = 10000;  // tf2 forgets none

void normalize(geometry_msgs::Quaternion& q) {
  const double length = Eigen::Vector4d(q.x, q.y, q.z, q.w).norm();
  for (double* const value : {&q.x, &q.y, &q.z, &q.w}) *value /= length;
}

// Returns the transform with plain names of frames and a quaternion of unit length.
geometry_msgs::TransformStamped checked(geometry_msgs::TransformStamped transform) {
  for (std::string* const frame : {&transform.header.frame_id, &transform.child_frame_id}) {
    *frame = withoutSlash(*frame);
    if (!sweep_guard_core::isName(*frame) || (*frame)[0] == '/') {
      throw sweep_guard_core::InvalidInput("a frame is no name of up to 128 printable characters");
    }
  }
  if (transform.header.frame_id == transform.child_frame_id) {
    throw sweep_guard_core::InvalidInput("the frame is placed in itself");
  }
  fromMsg(transform.transform);
  normalize(transform.transform.rotation);
  return transform;
}

FrameError notRigid(const std::string& target, const std::string& source, const std::string& why) {
  return FrameError("transform from '" + printable(source) + "' to '" + printable(target) + "' is not rigid: " + why);
}

}  // namespace

Frames::Frames(const ros::NodeHandle& node, size_t max_message_size,
               std::function<void(const std::string&, const std::string&)> on_static_change)
    : on_static_change_(std::move(on_static_change)) {
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
      accept(checked(transform), event.getPublisherName(), is_static);
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      refuse(transform, event.getPublisherName(), error.what());
    }
  }
}

void Frames::accept(const geometry_msgs::TransformStamped& transform, const std::string& node, bool is_static) {
  const std::string& child = transform.child_frame_id;
  if (!is_static) checkStamp(transform.header.stamp);
  countFrames(transform);
  const std::string publisher = printable(node);
  const std::uint64_t changes = staticChanges();  // counted by this thread alone
  {
    const sweep_guard_core::Lock lock(order_mutex_);
    if (is_static && buffer_.moves(child)) {
      log_.error("moves", "frame '" + child + "' comes on /tf and on /tf_static: it counts as one that moves");
      return;
    }
    if (!is_static || !isHeldBack(transform, publisher)) set(transform, publisher, is_static);
  }
  if (staticChanges() != changes) on_static_change_(transform.header.frame_id, child);
  refused_.accepted(child);
  if (is_static || !tree_.isUsed(child)) return;
  notePublisher(transform, node);
  callBack(on_move_);
}

void Frames::set(const geometry_msgs::TransformStamped& transform, const std::string& publisher, bool is_static) {
  if (buffer_.set(transform, publisher, is_static)) tree_.add(transform.header.frame_id, transform.child_frame_id);
}

void Frames::refuse(const geometry_msgs::TransformStamped& transform, const std::string& node, const std::string& why) {
  const std::string child = withoutSlash(transform.child_frame_id);
  const std::string text =
      "transform to '" + printable(child) + "' from node '" + printable(node) + "' refused: " + why;
  log_.error("transform", text);
  if (!sweep_guard_core::isName(child)) return;
  refused_.add(child, text);
  if (tree_.isUsed(child)) callBack(on_refusal_);
}

std::string Frames::refusal() const {
  return refused_.find([this](const std::string& child) { return tree_.isUsed(child); });
}

std::string Frames::refusalFor(const std::string& user) const {
  return refused_.find([&](const std::string& child) { return tree_.isUsedBy(user, child); });
}

void Frames::checkClock() {
  const sweep_guard_core::Lock lock(clock_mutex_);
  if (!clock_.hasGoneBack(now())) return;
  const sweep_guard_core::Lock order_lock(order_mutex_);
  buffer_.clear();
}

void Frames::checkStamp(const ros::Time& stamp) {
  const sweep_guard_core::Lock lock(clock_mutex_);
  const std::string refusal = clock_.refusal(fromMsg(stamp), now());
  if (!refusal.empty()) throw sweep_guard_core::InvalidInput(refusal);
}

void Frames::notePublisher(const geometry_msgs::TransformStamped& transform, const std::string& node) {
  publishers_.add(transform.child_frame_id, node,
                  {fromMsg(transform.header.stamp), transform.header.frame_id, fromMsg(transform.transform)},
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
  const std::string& child = transform.child_frame_id;
  const auto known = static_transforms_.emplace(child, transform).first;
  const bool same =
      known->second.header.frame_id == transform.header.frame_id && known->second.transform == transform.transform;
  known->second = transform;
  const sweep_guard_core::Lock lock(changes_mutex_);
  if (same) return held_back_.count(child) != 0;
  if (!tree_.isUsed(child)) {
    held_back_.erase(child);  // one that counted then would replace it later
    return false;
  }
  if (held_back_.empty()) held_back_since_ = std::chrono::steady_clock::now();
  held_back_[child] = {transform, publisher};
  ++static_changes_;
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
  const sweep_guard_core::Lock order_lock(order_mutex_);
  std::map<std::string, StaticChange> changes;
  {
    const sweep_guard_core::Lock lock(changes_mutex_);
    std::swap(changes, held_back_);
  }
  for (const auto& [child, change] : changes) set(change.transform, change.publisher, /*is_static=*/true);
  return !changes.empty();
}

void Frames::use(const std::string& user, const std::string& target, const std::set<std::string>& sources) {
  std::set<std::string> names;
  for (const std::string& source : sources) names.insert(withoutSlash(source));
  tree_.use(user, withoutSlash(target), names);
}

void Frames::callBack(const Callback& slot) {
  Callback callback;
  {
    const sweep_guard_core::Lock lock(callbacks_mutex_);
    callback = slot;
  }
  if (callback) callback->pass();
}

std::shared_ptr<void> Frames::connect(Callback& slot, std::function<void()> callback) {
  const auto gate = std::make_shared<Gate<>>(std::move(callback));
  const auto set = [this, &slot](const Callback& next) {
    const sweep_guard_core::Lock lock(callbacks_mutex_);
    slot = next;
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
  if (isSameFrame(target, source)) return Eigen::Isometry3d::Identity();
  try {
    return fromMsg(buffer_.lookup(withoutSlash(target), withoutSlash(source), toMsg(stamp)).transform);
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
  if (isSameFrame(target, source)) return {};
  try {
    const auto newest = buffer_.lookup(withoutSlash(target), withoutSlash(source), ros::Time(0));
    return {fromMsg(newest.header.stamp), fromMsg(newest.transform)};
  } catch (const tf2::TransformException& error) {
    throw noTransform(target, source, error.what());
  } catch (const sweep_guard_core::InvalidInput& error) {
    throw notRigid(target, source, error.what());
  }
}

std::optional<sweep_guard_core::Time> Frames::newest(const std::string& target, const std::string& source) const {
  if (isSameFrame(target, source)) return sweep_guard_core::Time();
  try {
    return fromMsg(buffer_.lookup(withoutSlash(target), withoutSlash(source), ros::Time(0)).header.stamp);
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

FrameError Frames::noTransform(const std::string& target, const std::string& source, const std::string& why) const {
  const std::set<std::string> frames = tree_.between(withoutSlash(target), withoutSlash(source));
  const std::string refused = refused_.find([&](const std::string& child) { return frames.count(child) != 0; });
  std::string absent;
  for (const std::string& frame : {target, source}) {
    if (!buffer_.has(withoutSlash(frame)))
      absent += (absent.empty() ? "tf has no frame '" : " and no frame '") + printable(frame) + "'";
  }
  return FrameError("no transform from '" + printable(source) + "' to '" + printable(target) + "': " +
                    (absent.empty() ? printable(why, kMaxReason) : absent) + (refused.empty() ? "" : ": " + refused));
}

}  // namespace sweep_guard_ros
