#pragma once

#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "common/guarded_by.h"
#include "ros/connection/bounded.h"
#include "ros/input/frame_buffer.h"
#include "ros/input/frame_publishers.h"
#include "ros/input/frame_tree.h"
#include "ros/input/refused_transforms.h"
#include "ros/input/transform_clock.h"
#include "ros/process/log_throttle.h"
#include "ros/threads/gate.h"
#include "ros/threads/queue_thread.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/time.h"

namespace sweep_guard_ros {

/// Reports a transform that is missing, or is not a rigid motion.
struct FrameError : sweep_guard_core::Error {
  using Error::Error;
};

/// The newest pose of a frame.
struct NewestPose {
  sweep_guard_core::Time stamp;  ///< 0: it never changes
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
};

/// Listens to /tf and /tf_static, and looks up poses of tf frames. Never extrapolates: a pose that lies beyond the known
/// transforms is missing. Normalizes quaternions that are almost of unit length, as in poses. Any thread.
///
/// A change of a static transform that counts, see use(), is held back until applyStaticChanges(): until then, frames are where
/// they were before.
class Frames {
 public:
  /// @param max_message_size  longer messages are refused unread [bytes]
  /// @param on_static_change  called with both frames when a transform on /tf_static that counts differs from the one before, in
  ///                          the thread of the listener
  Frames(const ros::NodeHandle& node, size_t max_message_size,
         std::function<void(const std::string& parent, const std::string& child)> on_static_change);

  void start(Supervisor& supervisor) {
    thread_.start(supervisor,
                  {"transforms", sweep_guard_core::Stage::kReceive, /*watched=*/true, /*loses_latched=*/true});
  }

  /// Returns the pose of frame `source` in frame `target` at a stamp; stamp 0: the newest. Does not wait.
  /// @throws FrameError if there is none
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp) const;

  /// Returns the same pose; empty: there is none.
  std::optional<Eigen::Isometry3d> find(const std::string& target, const std::string& source,
                                        sweep_guard_core::Time stamp) const;

  /// Returns the same pose, and waits up to `wait` on the steady clock for a transform that is late.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard_core::Time stamp,
                           sweep_guard_core::Duration wait) const;

  /// Returns the newest pose of frame `source` in frame `target`. Does not wait.
  /// @throws FrameError if there is none
  NewestPose newestPose(const std::string& target, const std::string& source) const;

  /// Returns the stamp of the newest transform between two frames; empty if there is none; 0 if it never changes.
  std::optional<sweep_guard_core::Time> newest(const std::string& target, const std::string& source) const;

  /// Forgets the transforms that move if time has gone back since the last call: their stamps mean another time now.
  /// Any thread.
  void checkClock();

  /// Returns what is wrong with a transform that counts and that several nodes publish (FramePublishers), in words; empty: nothing.
  std::string conflict() const;

  /// Calls back after every transform, in the thread of the listener, until the handle is destroyed. Also in the thread of
  /// applyStaticChanges().
  std::shared_ptr<void> onChange(std::function<void()> callback) { return buffer_.onChange(std::move(callback)); }

  /// Returns why a transform that counts was refused, with its frame, publisher and value, and no good one to that frame has come
  /// since; empty: none was.
  std::string refusal() const;
  /// Returns the same for transforms that count for one user.
  std::string refusalFor(const std::string& user) const;
  /// Calls back after every transform that counts and is refused, in the thread of the listener, until the handle is destroyed.
  std::shared_ptr<void> onRefusal(std::function<void()> callback) { return connect(on_refusal_, std::move(callback)); }

  /// Calls back after every transform that counts and moves, in the thread of the listener, until the handle is destroyed.
  std::shared_ptr<void> onMove(std::function<void()> callback) { return connect(on_move_, std::move(callback)); }

  /// Sets that transforms between `target` and each of these frames count for a user, in place of those it has set before.
  void use(const std::string& user, const std::string& target, const std::set<std::string>& sources);

  /// Returns how many static transforms that count have changed, held back or not.
  std::uint64_t staticChanges() const;
  /// Returns whether a change that counts has been held back for longer than this.
  bool holdsBack(sweep_guard_core::Duration longer_than) const;
  /// Applies the changes that are held back.
  /// @returns whether there were any
  bool applyStaticChanges();

 private:
  void onTransforms(const ros::MessageEvent<const tf2_msgs::TFMessage>& event, bool is_static);
  void accept(const geometry_msgs::TransformStamped& transform, const std::string& node, bool is_static);
  void set(const geometry_msgs::TransformStamped& transform, const std::string& publisher, bool is_static)
      REQUIRES(order_mutex_);
  void refuse(const geometry_msgs::TransformStamped& transform, const std::string& node, const std::string& why);
  void checkStamp(const ros::Time& stamp);
  FrameError noTransform(const std::string& target, const std::string& source, const std::string& why) const;
  void notePublisher(const geometry_msgs::TransformStamped& transform, const std::string& node);
  using Callback = std::shared_ptr<Gate<>>;
  std::shared_ptr<void> connect(Callback& slot, std::function<void()> callback);
  void callBack(const Callback& slot);
  bool isHeldBack(const geometry_msgs::TransformStamped& transform, const std::string& publisher);
  void countFrames(const geometry_msgs::TransformStamped& transform);

  const std::function<void(const std::string&, const std::string&)> on_static_change_;
  struct StaticChange {
    geometry_msgs::TransformStamped transform;
    std::string publisher;
  };
  std::map<std::string, geometry_msgs::TransformStamped> static_transforms_;  // by child; used by the listener only
  // From the decision about a transform until it is set: the listener does not overtake who applies static changes. Held while
  // onChange() calls back: it may look up.
  sweep_guard_core::Mutex order_mutex_;
  FrameTree tree_;
  RefusedTransforms refused_;
  sweep_guard_core::Mutex callbacks_mutex_;  // of the next ones
  Callback on_move_;
  Callback on_refusal_;
  mutable sweep_guard_core::Mutex changes_mutex_;                             // of the next ones
  std::map<std::string, StaticChange> held_back_ GUARDED_BY(changes_mutex_);  // by child
  sweep_guard_core::SteadyTime held_back_since_ GUARDED_BY(changes_mutex_);
  std::uint64_t static_changes_ GUARDED_BY(changes_mutex_) = 0;
  std::set<std::string> known_;  // frames in the buffer
  FramePublishers publishers_;
  LogThrottle log_;
  sweep_guard_core::Mutex clock_mutex_;  // of the next one
  TransformClock clock_ GUARDED_BY(clock_mutex_);
  FrameBuffer buffer_;
  QueueThread thread_;  // before the subscribers, which use its queue
  BoundedSubscriber moving_;
  BoundedSubscriber static_;
};

}  // namespace sweep_guard_ros
