#pragma once

#include <ros/service_server.h>
#include <sweep_guard/Predict.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "ros/input/workpiece_store.h"
#include "ros/parameters/parameters.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/ros/queue_thread.h"

namespace sweep_guard_ros {

/// The message `~prediction` of an prediction, complete.
/// @param age  of the pose that the prediction begins at, at the moment of the prediction
sweep_guard::Prediction predictionMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                                      const Parameters& parameters);

/// The service `~predict`: where the tool will be, and what it meets there, for any horizon. Only the poses are
/// predicted where the guard's predictor lives, in microseconds between two sweeps; what they meet is tested here, in a
/// thread and by a detector of its own, on a snapshot of the meshes: it never delays the guard.
class PredictService {
 public:
  struct Answer {
    sweep_guard_core::PredictedMotion motion;
    sweep_guard_core::Duration age;  ///< of the pose that it begins at
  };
  /// Asks for the poses up to a horizon counted from now. The guard's thread answers between two sweeps, or has a
  /// sweep_guard_core::Error thrown where it can promise none.
  using Ask = std::function<std::future<Answer>(sweep_guard_core::Duration horizon)>;

  PredictService(const ros::NodeHandle& private_node, const LiveParameters& live, const WorkpieceStore& workpieces,
                 Ask ask);

  ~PredictService() { stopping_ = true; }
  PredictService(const PredictService&) = delete;
  PredictService& operator=(const PredictService&) = delete;

  void start() { thread_.start(); }

 private:
  bool onCall(sweep_guard::Predict::Request& request, sweep_guard::Predict::Response& response);
  void refreshParameters();
  sweep_guard::Prediction predict(sweep_guard_core::Duration horizon);
  sweep_guard_core::SweepPlan plan() const;

  const LiveParameters& live_;
  std::shared_ptr<const Parameters> parameters_;  // of the newest call
  const WorkpieceStore& workpieces_;
  const Ask ask_;
  std::optional<sweep_guard_core::PathChecker> checker_;  // made when first asked, with these
  std::unique_ptr<sweep_guard_core::Detector> detector_;  // likewise
  std::atomic<bool> stopping_ = false;
  QueueThread thread_;  // outlives what calls back on it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
