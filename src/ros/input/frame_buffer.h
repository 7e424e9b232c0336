#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <tf2_ros/buffer.h>

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>

namespace sweep_guard_ros {

/// Keeps the transforms of the last 10 s in tf2. A frame that was static may move later, which tf2 does not allow, and a transform
/// that tf2 would not take is refused in words or passed over: tf2 logs a line for each. Names are without a slash before them.
/// set(), clear() and moves() one thread at a time, others any thread.
class FrameBuffer {
 public:
  FrameBuffer() { buffer_.setUsingDedicatedThread(true); }

  /// Takes a transform. Passes over a moving one whose stamp its frame has already, and a static one of a frame that moves. A
  /// static frame moves from its first moving transform on: until then, it was where it is.
  /// @param transform  between two frames, finite, its quaternion of unit length; not checked
  /// @returns whether it is taken
  /// @throws sweep_guard_core::InvalidInput if its stamp is more than 10 s older than the newest of its frame
  bool set(const geometry_msgs::TransformStamped& transform, const std::string& publisher, bool is_static);

  /// As lookupTransform() of tf2.
  /// @throws tf2::TransformException
  geometry_msgs::TransformStamped lookup(const std::string& target, const std::string& source, ros::Time stamp) const;

  /// Returns whether tf has a frame of this name.
  bool has(const std::string& frame) const { return buffer_._frameExists(frame); }
  /// Returns whether a frame has ever moved.
  bool moves(const std::string& child) const { return stamps_.count(child) != 0; }

  /// Forgets the transforms that move. A frame that has moved does not become static again.
  void clear();

  /// Calls back after every transform that is taken, in the thread of set(), until the handle is destroyed.
  std::shared_ptr<void> onChange(std::function<void()> callback);

 private:
  bool setStatic(const geometry_msgs::TransformStamped& transform, const std::string& publisher);
  bool setMoving(const geometry_msgs::TransformStamped& transform, const std::string& publisher);
  bool isNew(const std::string& child, ros::Time stamp);
  void beginToMove(const geometry_msgs::TransformStamped& rest, ros::Time first, const std::string& publisher);

  std::map<std::string, geometry_msgs::TransformStamped> static_;  // by child, the newest; it may move since
  std::unordered_map<std::string, std::deque<ros::Time>> stamps_;  // ascending, by child that moves
  std::set<std::string> on_mover_;                                 // of static_, what has begun to move
  tf2_ros::Buffer buffer_;
};

}  // namespace sweep_guard_ros
