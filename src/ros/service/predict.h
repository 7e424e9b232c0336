#pragma once

#include <ros/service_server.h>
#include <sweep_guard/Predict.h>

#include <atomic>
#include <functional>
#include <future>
#include <memory>

#include "guard/body_prediction.h"
#include "guard/workpiece_store.h"
#include "ros/parameters/live_parameters.h"
#include "ros/service/limited_calls.h"
#include "ros/service/service_threads.h"

namespace sweep_guard_ros {

/// Converts a prediction to the complete message `~prediction`.
/// @param age  age that the first pose had at the time of the prediction
sweep_guard::Prediction predictionMsg(const sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration age,
                                      const Parameters& parameters);

/// Serves `~predict`: predicts the motion and its contacts for a horizon of up to 5 s. The guard's thread predicts only the
/// poses, in microseconds, as a task. The path is tested here, with a detector of its own and on a snapshot of the meshes,
/// so the guard does not wait for a test; after 1 s, coarsely beyond the reflex interval. Five calls are let in; any more
/// are answered BUSY.
class PredictService {
 public:
  struct Motion {
    sweep_guard_core::PredictedMotion predicted;
    sweep_guard_core::Duration age;  ///< age of its first pose
  };
  /// See GuardThread::predictMotion().
  using PredictMotion = std::function<std::future<Motion>(sweep_guard_core::Duration horizon)>;

  PredictService(const ros::NodeHandle& private_node, ServiceThreads& threads, const LiveParameters& live,
                 const sweep_guard_core::WorkpieceStore& workpieces, PredictMotion predict_motion);

  void stop() { stopping_ = true; }  ///< tests what is beyond the reflex interval coarsely, to end soon. Any thread

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
