#include "ros/input/frame_buffer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/number_text.h"
#include "ros/threads/gate.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_ros {
namespace {

using geometry_msgs::TransformStamped;

constexpr char kMover = '\1';  // ends the name of what moves in tf2 in place of a frame that was static; no name has it
const ros::Duration kHistory(tf2::BufferCore::DEFAULT_CACHE_TIME);
const ros::Duration kInstant(0, 1);

TransformStamped toMover(TransformStamped transform) {
  transform.child_frame_id += kMover;
  return transform;
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

bool FrameBuffer::set(const TransformStamped& transform, const std::string& publisher, bool is_static) {
  return is_static ? setStatic(transform, publisher) : setMoving(transform, publisher);
}

bool FrameBuffer::setStatic(const TransformStamped& transform, const std::string& publisher) {
  if (moves(transform.child_frame_id)) return false;
  static_[transform.child_frame_id] = transform;
  return buffer_.setTransform(transform, publisher, /*is_static=*/true);
}

bool FrameBuffer::setMoving(const TransformStamped& transform, const std::string& publisher) {
  const std::string& child = transform.child_frame_id;
  if (!isNew(child, transform.header.stamp)) return false;
  const auto rest = static_.find(child);
  if (rest == static_.end()) return buffer_.setTransform(transform, publisher, /*is_static=*/false);
  buffer_.setTransform(toMover(transform), publisher, /*is_static=*/false);
  if (on_mover_.count(child) == 0) beginToMove(rest->second, transform.header.stamp, publisher);
  return true;
}

// As tf2's cache of a frame finds it.
bool FrameBuffer::isNew(const std::string& child, ros::Time stamp) {
  std::deque<ros::Time>& stamps = stamps_[child];
  if (!stamps.empty() && stamp + kHistory < stamps.back()) throw tooOld(stamps.back() - stamp);
  const auto place = std::lower_bound(stamps.begin(), stamps.end(), stamp);
  if (place != stamps.end() && *place == stamp) return false;
  stamps.insert(place, stamp);
  while (stamps.front() + kHistory < stamps.back()) stamps.pop_front();
  return true;
}

// In tf2, a static frame stays static, but may come to stand on another: on what moves in its place, with nothing between both.
// Then all that stands on the frame moves with it, also what was sampled on it before.
void FrameBuffer::beginToMove(const TransformStamped& rest, ros::Time first, const std::string& publisher) {
  TransformStamped sample = toMover(rest);
  for (std::int32_t seconds = kHistory.sec; seconds >= 0; --seconds) {
    sample.header.stamp = earlierBy(first, std::max(ros::Duration(seconds, 0), kInstant));
    if (sample.header.stamp < first && isNew(rest.child_frame_id, sample.header.stamp))
      buffer_.setTransform(sample, publisher, /*is_static=*/false);
  }
  TransformStamped stand;
  stand.header.frame_id = sample.child_frame_id;
  stand.child_frame_id = rest.child_frame_id;
  stand.transform.rotation.w = 1.0;
  buffer_.setTransform(stand, publisher, /*is_static=*/true);
  on_mover_.insert(rest.child_frame_id);  // last: what fails is tried again
}

TransformStamped FrameBuffer::lookup(const std::string& target, const std::string& source, ros::Time stamp) const {
  return buffer_.lookupTransform(target, source, stamp);
}

void FrameBuffer::clear() {
  buffer_.clear();
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
