#include "ros/input/frame_buffer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/number_text.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::TransformStamped;

constexpr char kMoved = '\1';  // after a name in tf2; no name has it
const ros::Duration kHistory(tf2::BufferCore::DEFAULT_CACHE_TIME);
const ros::Duration kInstant(0, 1);
const ros::Duration kRestPeriod(1.0);  // of the samples that say where a frame was before it moved

std::string withoutMarks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), kMoved), text.end());
  return text;
}

ros::Time earlierBy(ros::Time stamp, ros::Duration by) {
  const ros::Time first = ros::Time() + kInstant;  // 0 would be the newest
  return stamp > first + by ? stamp - by : first;
}

sweep_guard_core::InvalidInput tooOld(ros::Duration age) {
  return sweep_guard_core::InvalidInput("its stamp is " +
                                        sweep_guard_core::inSeconds(std::chrono::nanoseconds(age.toNSec())) +
                                        " older than the newest of its frame, more than 10 s");
}

}  // namespace

void FrameBuffer::set(const TransformStamped& transform, const std::string& publisher, bool is_static) {
  const std::string& child = transform.child_frame_id;
  if (is_static) {
    if (setStatic(transform)) buffer_.setTransform(named(transform), publisher, /*is_static=*/true);
    return;
  }
  if (isStatic(child)) beginToMove(child, transform.header.stamp, publisher);
  if (isNew(child, transform.header.stamp)) buffer_.setTransform(named(transform), publisher, /*is_static=*/false);
}

// As tf2's cache of a frame finds it.
bool FrameBuffer::isNew(const std::string& child, ros::Time stamp) {
  const sweep_guard_core::Lock lock(mutex_);
  std::deque<ros::Time>& stamps = stamps_[child];
  if (!stamps.empty() && stamp + kHistory < stamps.back()) throw tooOld(stamps.back() - stamp);
  const auto place = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (place != stamps.end() && *place == stamp) return false;
  stamps.insert(place, stamp);
  while (stamps.front() + kHistory < stamps.back()) stamps.pop_front();
  return true;
}

// It has its new name when all is there that it is looked up by, and what stands on it follows.
void FrameBuffer::beginToMove(const std::string& child, ros::Time first, const std::string& publisher) {
  TransformStamped rest;
  {
    const sweep_guard_core::Lock lock(mutex_);
    rest = static_.at(child);
  }
  rest = named(std::move(rest));
  rest.child_frame_id += kMoved;
  const auto add = [&](ros::Duration earlier) {
    rest.header.stamp = earlierBy(first, earlier);
    if (rest.header.stamp < first && isNew(child, rest.header.stamp))
      buffer_.setTransform(rest, publisher, /*is_static=*/false);
  };
  for (ros::Duration earlier = kHistory; earlier > kInstant; earlier -= kRestPeriod) add(earlier);
  add(kInstant);
  rename(child);
  for (const TransformStamped& other : standingOn(child))
    buffer_.setTransform(named(other), publisher, /*is_static=*/true);
}

void FrameBuffer::rename(const std::string& child) {
  const sweep_guard_core::Lock lock(mutex_);
  static_.erase(child);
  renamed_.insert(child);
}

bool FrameBuffer::moves(const std::string& child) const {
  const sweep_guard_core::Lock lock(mutex_);
  return stamps_.count(child) != 0;
}

bool FrameBuffer::isStatic(const std::string& child) const {
  const sweep_guard_core::Lock lock(mutex_);
  return static_.count(child) != 0;
}

std::vector<TransformStamped> FrameBuffer::standingOn(const std::string& parent) const {
  const sweep_guard_core::Lock lock(mutex_);
  std::vector<TransformStamped> transforms;
  for (const auto& [child, transform] : static_) {
    if (transform.header.frame_id == parent) transforms.push_back(transform);
  }
  return transforms;
}

// Returns whether it is taken.
bool FrameBuffer::setStatic(const TransformStamped& transform) {
  const sweep_guard_core::Lock lock(mutex_);
  const std::string& child = transform.child_frame_id;
  if (stamps_.count(child) != 0) return false;
  static_[child] = transform;
  return true;
}

std::string FrameBuffer::nameOf(const std::string& frame) const {
  const sweep_guard_core::Lock lock(mutex_);
  return renamed_.count(frame) == 0 ? frame : frame + kMoved;
}

TransformStamped FrameBuffer::named(TransformStamped transform) const {
  transform.header.frame_id = nameOf(transform.header.frame_id);
  transform.child_frame_id = nameOf(transform.child_frame_id);
  return transform;
}

TransformStamped FrameBuffer::lookup(const std::string& target, const std::string& source, ros::Time stamp) const {
  try {
    return buffer_.lookupTransform(nameOf(target), nameOf(source), stamp);
  } catch (const tf2::TransformException& error) {
    throw tf2::TransformException(withoutMarks(error.what()));
  }
}

void FrameBuffer::clear() {
  buffer_.clear();
  const sweep_guard_core::Lock lock(mutex_);
  for (auto& [child, stamps] : stamps_) stamps.clear();
}

// Removing a callback from tf2 does not wait for one that is running; the gate does.
std::shared_ptr<void> FrameBuffer::onChange(std::function<void()> callback) {
  auto gate = std::make_shared<Gate<>>(std::move(callback));
  const auto connection = buffer_._addTransformsChangedListener([gate] { gate->pass(); });
  return std::shared_ptr<void>(nullptr, [this, gate, connection](void*) {
    buffer_._removeTransformsChangedListener(connection);
    gate->close();
  });
}

}  // namespace sweep_guard_ros
