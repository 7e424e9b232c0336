#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "ros/input/workpiece_store.h"
#include "ros/log_throttle.h"
#include "ros/output/result_publisher.h"
#include "ros/output/scene_publisher.h"
#include "ros/output/sweep_statistics.h"
#include "ros/output/warning_publisher.h"
#include "ros/parameters/parameters.h"
#include "ros/service/predict.h"
#include "ros/work_queue.h"
#include "sweep_guard/common/pool.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// Where a guard_thread takes from and tells to.
struct GuardThreadDependencies {
  LiveParameters& parameters;
  const WorkpieceStore& workpieces;
  sweep_guard_core::WarningMonitor& monitor;
  SweepStatistics& statistics;
  WarningPublisher& warnings;
  ScenePublisher& scene;
};

/// One thread, which alone touches the guard: it sweeps every pose, those that had to wait at once, and looks ahead
/// from the newest. Who else wants something of the guard is served between two sweeps.
class GuardThread {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused, sweep_guard_core::DeviceError if there is no detector
  GuardThread(const ros::NodeHandle& private_node, const GuardThreadDependencies& parts);
  ~GuardThread() { stop(); }
  GuardThread(const GuardThread&) = delete;
  GuardThread& operator=(const GuardThread&) = delete;

  void start();
  void stop();  ///< lets everybody go who waits; what is still to be swept is not

  void sweepTo(QueuedPose pose);  ///< soon; any thread

  /// Goes on with other parameters, and puts them into force. Returns when that is done. Any thread.
  /// @throws sweep_guard_core::Error if the guard is busy or shuts down
  void adopt(const std::shared_ptr<const Parameters>& next);
  /// Forgets everything but the workpieces. Likewise.
  void reset();
  /// Where the tool will be, up to a horizon counted from now; a sweep_guard_core::Error where nothing is known.
  std::future<PredictService::Answer> predictMotion(sweep_guard_core::Duration horizon);

 private:
  void work();
  void process(const std::vector<QueuedPose>& poses);
  void process(const QueuedPose& placed, const QueuedPose* next);
  void pass(const QueuedPose& placed);
  void sweep(const QueuedPose& placed);
  void predict(const QueuedPose& placed);
  bool timeToPredict() const;
  void reportFailure(const sweep_guard_core::SweepFailure& failure);
  PredictService::Answer answer(sweep_guard_core::Duration horizon) const;

  const GuardThreadDependencies parts_;
  const ResultPublisher findings_;
  std::mutex adopting_mutex_;  // what the guard goes on with
  WorkQueue queue_;

  // Of the thread:
  sweep_guard_core::Guard guard_;
  std::uint64_t guard_epoch_ = 0;                      // that the guard's poses are of
  std::optional<sweep_guard_core::Timestamps> swept_;  // newest pose that the guard knows
  std::vector<sweep_guard_core::SteadyTime> passed_;   // when the poses passed since then came in
  sweep_guard_core::SteadyTime predicted_at_;          // when it did so last
  sweep_guard_core::Pool<sweep_guard_core::SweepReport> reports_;
  sweep_guard_core::Pool<sweep_guard_core::Prediction> predictions_;
  LogThrottle log_;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
