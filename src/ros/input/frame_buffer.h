#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>

#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/guarded_by.h"
#include "ros/threads/gate.h"

namespace sweep_guard_ros {

/// Keeps the transforms of the last 10 s in tf2. A frame that was static may move later, which tf2 does not allow, and a transform
/// that tf2 would not take is refused in words or passed over: tf2 logs a line for each. Names are without a slash before them.
/// Any thread.
class FrameBuffer {
 public:
  FrameBuffer() { buffer_.setUsingDedicatedThread(true); }

  /// Takes a transform. Passes over a moving one whose stamp its frame has already, and a static one of a frame that moves. A
  /// static frame moves from its first moving transform on: until then, it was where it is.
  /// @param transform  between two frames, finite, its quaternion of unit length; not checked
  /// @throws sweep_guard_core::InvalidInput if its stamp is more than 10 s older than the newest of its frame
  void set(const geometry_msgs::TransformStamped& transform, const std::string& publisher, bool is_static);

  /// As lookupTransform() of tf2.
  /// @throws tf2::TransformException
  geometry_msgs::TransformStamped lookup(const std::string& target, const std::string& source, ros::Time stamp) const;

  /// Returns whether a frame has ever moved.
  bool moves(const std::string& child) const;

  /// Forgets the transforms that move. A frame that has moved does not become static again.
  void clear();

  /// Calls back after every transform that is taken, in the thread of set(), until the handle is destroyed.
  std::shared_ptr<void> onChange(std::function<void()> callback);

 private:
  bool isNew(const std::string& child, ros::Time stamp);
  void beginToMove(const std::string& child, ros::Time first, const std::string& publisher);
  void rename(const std::string& child);
  bool isStatic(const std::string& child) const;
  std::vector<geometry_msgs::TransformStamped> standingOn(const std::string& parent) const;
  bool setStatic(const geometry_msgs::TransformStamped& transform);
  std::string nameOf(const std::string& frame) const;
  geometry_msgs::TransformStamped named(geometry_msgs::TransformStamped transform) const;

  mutable sweep_guard_core::Mutex mutex_;  // of the next ones; not held while tf2 is called, which calls back
  std::map<std::string, geometry_msgs::TransformStamped> static_ GUARDED_BY(mutex_);  // by child that never moved
  std::set<std::string> renamed_ GUARDED_BY(mutex_);                                  // in tf2: they were static
  std::unordered_map<std::string, std::deque<ros::Time>> stamps_ GUARDED_BY(mutex_);  // ascending, by child that moves
  tf2_ros::Buffer buffer_;
};

}  // namespace sweep_guard_ros
