#pragma once

#include <ros/service_server.h>
#include <sweep_guard/Predict.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>

#include "guard/body_prediction.h"
#include "guard/workpiece_store.h"
#include "ros/parameters/parameters.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Converts a prediction to the complete message `~prediction`.
/// @param age  age that the first pose had at the time of the prediction
sweep_guard::Prediction predictionMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                                      const Parameters& parameters);

/// Serves `~predict`: predicts the motion and its contacts for any horizon. The guard's thread predicts only the poses,
/// in microseconds between two sweeps. The path is tested here, with a detector of its own and on a snapshot of the meshes,
/// so the guard does not wait for a test. At most 4 calls wait while one runs; any more are answered BUSY.
class PredictService {
 public:
  struct Motion {
    sweep_guard_core::PredictedMotion predicted;
    sweep_guard_core::Duration age;  ///< age of its first pose
  };
  /// Predicts the motion up to a horizon counted from now. The future throws sweep_guard_core::Error if the motion is
  /// unknown.
  using PredictMotion = std::function<std::future<Motion>(sweep_guard_core::Duration horizon)>;

  PredictService(const ros::NodeHandle& private_node, ServiceThreads& threads, const LiveParameters& live,
                 const sweep_guard_core::WorkpieceStore& workpieces, PredictMotion predict_motion);

  void stop() { stopping_ = true; }  ///< tests the rest of each path coarsely: a running call ends soon. Any thread

 private:
  bool onCall(sweep_guard::Predict::Request& request, sweep_guard::Predict::Response& response);
  void refreshParameters();
  void predict(sweep_guard_core::Duration horizon, sweep_guard::Predict::Response& response);

  const LiveParameters& live_;
  std::shared_ptr<const Parameters> parameters_;  // of the newest call
  const sweep_guard_core::WorkpieceStore& workpieces_;
  const PredictMotion predict_motion_;
  std::unique_ptr<sweep_guard_core::Detector> detector_;  // for parameters_
  std::atomic<bool> stopping_ = false;
  LimitedCalls calls_;  // before the server, which uses it
  ros::ServiceServer server_;
};

}  // namespace sweep_guard_ros
