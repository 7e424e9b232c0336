#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/subscriber.h>

#include <atomic>
#include <boost/signals2/connection.hpp>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "sweep_guard/guard/ledger.h"
#include "sweep_guard/ros/frames.h"
#include "sweep_guard/ros/parameters.h"
#include "sweep_guard/ros/queue_thread.h"
#include "sweep_guard/ros/workpiece_store.h"

namespace sweep_guard_ros {

/// A tool pose that has been checked, in the fixed frame and in every frame that a workpiece lives in.
struct PlacedPose {
  sweep_guard::ToolPose tool;
  Eigen::Isometry3d X_WT;
  std::uint64_t faults_before;  ///< faultCount() of the ledger when the pose came
  std::uint64_t epoch;          ///< counts jumps of time: poses of different epochs have no motion between them
};

/// Takes tool poses from the topic or from tf, refuses bad ones, looks up their transforms, and hands them on in order.
/// Its own thread, because a transform may be up to 20 ms late.
class PoseInput {
 public:
  using Sink = std::function<void(PlacedPose)>;

  PoseInput(const ros::NodeHandle& node, const Parameters& parameters, Frames& frames, const WorkpieceStore& workpieces,
            sweep_guard::Ledger& ledger, Sink sink);
  ~PoseInput();
  PoseInput(const PoseInput&) = delete;
  PoseInput& operator=(const PoseInput&) = delete;

  void start() { thread_.start(); }
  /// Time went back: the next pose may be older than the last.
  void timeJumped() { ++epoch_; }

  std::uint64_t received() const { return received_; }  ///< poses, refused ones too
  std::uint64_t refused() const { return refused_; }
  std::string source() const;  ///< resolved topic, or the tf frame
  int publisherCount() const;  ///< of the topic; 0 for tf

 private:
  struct Incoming {
    sweep_guard::Time stamp;
    sweep_guard::SteadyTime received;
    std::string frame;
    Eigen::Isometry3d X_FT;
  };

  void onMessage(const geometry_msgs::PoseStamped& msg);
  void onTransforms();
  void acceptOrRefuse(const std::function<Incoming()>& read);
  void accept(const Incoming& incoming);
  void checkStamp(sweep_guard::Time stamp) const;
  std::map<std::string, Eigen::Isometry3d> placeIn(const std::set<std::string>& mesh_frames, sweep_guard::Time stamp,
                                                   const Eigen::Isometry3d& X_WT);
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, sweep_guard::Time stamp);
  void refuse(sweep_guard::Reason reason, const std::string& story);

  const std::string fixed_frame_;
  const std::string tool_frame_;
  Frames& frames_;
  const WorkpieceStore& workpieces_;
  sweep_guard::Ledger& ledger_;
  const Sink sink_;

  std::optional<sweep_guard::Time> last_;
  std::uint64_t last_epoch_ = 0;
  std::set<std::pair<std::string, std::string>>
      missing_;  // target and source of transforms that did not come last time
  std::atomic<std::uint64_t> epoch_ = 0;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<std::uint64_t> refused_ = 0;

  QueueThread thread_;  // outlives what calls back on it
  boost::signals2::connection transforms_changed_;
  ros::Subscriber subscriber_;
};

}  // namespace sweep_guard_ros
