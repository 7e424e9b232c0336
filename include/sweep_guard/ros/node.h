#pragma once

#include <ros/publisher.h>
#include <ros/steady_timer.h>
#include <sweep_guard/Warning.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <optional>
#include <thread>

#include "sweep_guard/common/pool.h"
#include "sweep_guard/ros/check_sweep.h"
#include "sweep_guard/ros/controls.h"
#include "sweep_guard/ros/diagnostics.h"
#include "sweep_guard/ros/markers.h"
#include "sweep_guard/ros/predict.h"
#include "sweep_guard/ros/tuning.h"
#include "sweep_guard/ros/view_output.h"

namespace sweep_guard_ros {

/// The guard of one tool as a ROS node, and as a nodelet: inputs on threads of their own, one thread that sweeps every
/// pose, those that had to wait at once, and looks ahead from the newest, and steady timers that warn whatever the
/// inputs do. Topics, services and parameters: README.md.
class SweepGuardNode {
 public:
  /// @throws sweep_guard::InvalidInput if a parameter is refused, sweep_guard::DeviceError if there is no detector
  SweepGuardNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);
  ~SweepGuardNode();
  SweepGuardNode(const SweepGuardNode&) = delete;
  SweepGuardNode& operator=(const SweepGuardNode&) = delete;

 private:
  void enqueue(PlacedPose pose);
  template <typename Result>
  std::future<Result> betweenSweeps(std::function<Result()> task);
  void reset();
  void adopt(const std::shared_ptr<const Parameters>& next);
  void work();
  void process(const std::deque<PlacedPose>& poses);
  void process(const PlacedPose& placed, const PlacedPose* next);
  void pass(const PlacedPose& placed);
  void sweep(const PlacedPose& placed);
  void lookAhead(const PlacedPose& placed);
  void tellFailure(const sweep_guard::SweepFailure& failure);
  bool timeToLookAhead();
  PredictService::Answer forecast(sweep_guard::Duration horizon) const;
  void publishContacts(const sweep_guard::SweepReport& report);
  void publishPrediction(const sweep_guard::Outlook& outlook, sweep_guard::Duration age);
  void watch();
  void watchClock();
  void warn(bool only_on_change);
  using Flag = sweep_guard::Warning::_reflex_type sweep_guard::Warning::*;
  void repeat(const ros::Publisher& publisher, Flag flag);
  MarkerScene sceneNow();
  void publishMarkers();

  LiveParameters parameters_;
  ros::Publisher contacts_publisher_;
  ros::Publisher prediction_publisher_;
  ros::Publisher time_to_collision_publisher_;
  ros::Publisher warning_publisher_;
  ros::Publisher reflex_publisher_;
  ros::Publisher considered_publisher_;
  ros::Publisher marker_publisher_;

  std::mutex warning_mutex_;
  sweep_guard::Verdict verdict_;  // newest
  sweep_guard::Warning warning_;  // counters and level last sent
  std::atomic<sweep_guard::SteadyTime> warned_ = sweep_guard::SteadyTime();
  sweep_guard::Time clock_seen_;

  std::mutex adopting_mutex_;  // what the guard goes on with

  std::mutex queue_mutex_;
  std::condition_variable queue_changed_;
  std::deque<PlacedPose> queue_;
  std::deque<std::function<void()>> tasks_;  // of the sweeping thread, between two sweeps
  bool stopping_ = false;

  std::mutex scene_mutex_;
  MarkerScene scene_;

  // What follows calls back on what stands above.
  sweep_guard::Ledger ledger_;
  sweep_guard::Guard guard_;                     // of the sweeping thread, as all down to log_
  std::uint64_t guard_epoch_ = 0;                // that the guard's poses are of
  std::optional<sweep_guard::Seen> swept_;       // newest pose that the guard knows
  std::vector<sweep_guard::SteadyTime> passed_;  // when the poses passed since then came in
  sweep_guard::SteadyTime looked_ahead_;         // when it did so last
  sweep_guard::Pool<sweep_guard::SweepReport> reports_;
  sweep_guard::Pool<sweep_guard::Outlook> outlooks_;
  LogThrottle log_;
  Frames frames_;
  WorkpieceStore workpieces_;
  PoseInput poses_;
  MeshInput meshes_;
  CheckSweepService check_sweep_;
  PredictService predict_;
  Workload workload_;
  Markers markers_;
  ViewOutput view_;
  Controls controls_;
  Tuning tuning_;
  Diagnostics diagnostics_;

  QueueThread warning_thread_;
  QueueThread report_thread_;
  ros::SteadyTimer warning_timer_;
  ros::SteadyTimer reflex_timer_;
  ros::SteadyTimer considered_timer_;
  ros::SteadyTimer marker_timer_;
  ros::SteadyTimer view_timer_;
  ros::SteadyTimer diagnostics_timer_;
  std::thread sweeping_thread_;
};

}  // namespace sweep_guard_ros
