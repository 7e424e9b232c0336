#pragma once

#include <boost/shared_ptr.hpp>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "common/pool.h"
#include "guard/cross_check.h"
#include "guard/intention_store.h"
#include "guard/prediction_pace.h"
#include "guard/workpiece_store.h"
#include "monitor/sweep_statistics.h"
#include "monitor/work_queue.h"
#include "ros/guard/acknowledgements.h"
#include "ros/output/bodies_publisher.h"
#include "ros/output/interaction_publisher.h"
#include "ros/output/proximity_publisher.h"
#include "ros/output/result_publisher.h"
#include "ros/output/scene_publisher.h"
#include "ros/output/touches_publisher.h"
#include "ros/output/warning_publisher.h"
#include "ros/parameters/parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/service/predict.h"
#include "ros/threads/supervisor.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// What the publishers need of another tool.
struct ToolShapes {
  /// Any thread. Takes seconds for ten thousand corners.
  explicit ToolShapes(const Parameters& parameters);

  sweep_guard_core::InterpenetrationFinders pieces;
  boost::shared_ptr<sweep_guard::ToolSurface> surface;
};

/// Publishes what is known of the tool beside warnings, at every swept pose. One thread.
struct ToolPublishers {
  ToolPublishers(const ros::NodeHandle& private_node, const LiveParameters& parameters,
                 const sweep_guard_core::WarningMonitor& monitor);

  /// Exchanges the tool.
  /// @param shapes  of the same parameters; those before when it returns
  void setTool(const Parameters& parameters, ToolShapes& shapes);

  void reset();  ///< forgets all motion

  ProximityPublisher proximity;
  InteractionPublisher interaction;
  BodiesPublisher bodies;
};

struct GuardThreadDependencies {
  LiveParameters& parameters;
  const sweep_guard_core::WorkpieceStore& workpieces;
  sweep_guard_core::WarningMonitor& monitor;
  sweep_guard_core::SweepStatistics& statistics;
  sweep_guard_core::WorkQueue& queue;
  WarningPublisher& warnings;
  ScenePublisher& scene;
  TouchesPublisher& touches;
  sweep_guard_core::QuerySampler& sampler;
  sweep_guard_core::IntentionStore& intentions;
  sweep_guard_core::FrameMotionStore* frame_motions = nullptr;  ///< of frames that move on their own; null: none does
  std::function<std::unique_ptr<sweep_guard_core::Detector>(const Parameters&)> make_detector =
      [](const Parameters& wanted) { return makeDetector(wanted.detector.name, wanted.detector.options); };
  std::function<ToolShapes(const Parameters&)> make_shapes = [](const Parameters& wanted) {
    return ToolShapes(wanted);
  };
};

/// Runs the guard in one thread: sweeps every queued pose, sweeps a backlog of poses as one motion, predicts from the
/// newest pose, and runs the queued tasks between two sweeps. A pose that comes during a prediction is swept between two
/// of its sweeps, for up to 50 ms; then the prediction ends first. Predictions begin when PredictionPace says, but one
/// begins every cycle: a pose that is not predicted from is still swept. One begins at once after the sweep of other triangles. A
/// frame that is known further than at the newest pose is swept against at once.
class GuardThread {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  /// @throws sweep_guard_core::DeviceError if the detector cannot be created
  GuardThread(const ros::NodeHandle& private_node, const GuardThreadDependencies& dependencies);
  ~GuardThread() { stop(); }
  GuardThread(const GuardThread&) = delete;
  GuardThread& operator=(const GuardThread&) = delete;

  void start(Supervisor& supervisor);
  void stop();  ///< drops the queued work

  /// Sets other parameters for the guard and the node. Returns when they are set. Any thread.
  /// @throws sweep_guard_core::DeviceError if a new detector cannot be created or fails its test; then nothing is set
  /// @throws sweep_guard_core::Error if a sweep lasts longer than 0.5 s, or the guard is shutting down; then nothing is
  ///     set, also later
  void apply(const std::shared_ptr<const Parameters>& next);
  /// Exchanges the tool, and forgets the poses and what rests on them, as reset() does: the warning is UNKNOWN until two
  /// other poses have arrived. Returns when that is done. Any thread.
  /// @param before        parameters that `next` was made from
  /// @param change_store  takes the payload out of the workpieces or puts it back, between the same two sweeps; may throw
  /// @throws sweep_guard_core::Error as apply(), or if other parameters were set meanwhile; then nothing is exchanged
  void exchangeTool(const std::shared_ptr<const Parameters>& before, const std::shared_ptr<const Parameters>& next,
                    const std::function<void()>& change_store);
  /// Returns the newest swept pose. Any thread. The future throws sweep_guard_core::Error if there is none, or it is stale.
  std::future<sweep_guard_core::PoseWithFrames> newestPose();
  /// Forgets everything but the workpieces. Returns when that is done. Any thread.
  /// @throws sweep_guard_core::Error as apply(); then nothing is forgotten, also later
  void reset();
  /// Acknowledges a warning, see WarningMonitor. Returns when that is done. Any thread.
  /// @param id  of the workpiece; empty: the one that the warning names
  /// @returns the id
  /// @throws sweep_guard_core::Error if there is nothing to acknowledge, or the tool is farther away than
  ///     warning/acknowledge_distance; or as apply(); then nothing is acknowledged, also later
  std::string acknowledge(const std::string& id);
  /// Predicts the motion up to a horizon counted from now. Any thread. The future throws sweep_guard_core::Error if the
  /// motion is unknown.
  std::future<PredictService::Motion> predictMotion(sweep_guard_core::Duration horizon);

 private:
  sweep_guard_core::GuardChange changeTo(const Parameters& next, const Parameters& before);
  void forget();
  void resetMotion();
  const sweep_guard_core::QueuedPose& freshPose() const;
  void run();
  bool workOnce();
  void setPriority() const;
  void runInTime(const std::function<void()>& task, const std::string& otherwise);
  bool sweepPoses();
  bool sweepOrRepeat();
  void sweepNext();
  bool sweepWaiting();
  bool takeMore();
  bool process(sweep_guard_core::QueuedPose& queued, const sweep_guard_core::QueuedPose* next);
  sweep_guard_core::Time follow(sweep_guard_core::PoseWithFrames& pose);
  void forgetFrames();
  void pass(const sweep_guard_core::PoseWithFrames& pose);
  void sweep(const sweep_guard_core::QueuedPose& queued);
  void sweepOn();
  void beginSweep(const sweep_guard_core::QueuedPose& queued, const sweep_guard_core::Workpieces& workpieces);
  void warn(const sweep_guard_core::SweepReport& report, const sweep_guard_core::QueuedPose& queued);
  void predict();
  void predictInterrupted(sweep_guard_core::Duration age, const sweep_guard_core::Workpieces& workpieces,
                          sweep_guard_core::Prediction& prediction, sweep_guard_core::Duration& interrupted);
  bool mayPredict() const;
  bool timeToPredict() const;
  std::optional<sweep_guard_core::SteadyTime> latestPrediction() const;
  void reportFailures(const std::vector<sweep_guard_core::SweepFailure>& failures);
  PredictService::Motion motion(sweep_guard_core::Duration horizon) const;

  const GuardThreadDependencies dependencies_;
  const ResultPublisher results_;
  ToolPublishers tool_;      // after the start, used by the thread only
  std::mutex change_mutex_;  // one change of the guard at a time

  // Used by the thread only:
  sweep_guard_core::WorkQueue::Work work_;
  size_t next_ = 0;  // of work_.poses: those before it are done
  sweep_guard_core::Guard guard_;
  Acknowledgements acknowledgements_;
  sweep_guard_core::WarningMonitor::Checkpoint checkpoint_;  // of the newest pose in the guard
  std::optional<sweep_guard_core::QueuedPose> swept_;        // newest swept pose
  bool prediction_due_ = false;                              // from that pose
  sweep_guard_core::QueuedPose predicted_from_;              // newest swept pose at the last prediction
  sweep_guard_core::Workpieces predicted_with_;              // at the last prediction
  bool triangles_are_new_ = false;                           // there were others at the last prediction
  std::vector<sweep_guard_core::SteadyTime> passed_;         // when the poses passed since then were received
  struct {
    bool any = false;
    std::set<std::string> frames = {};
  } placed_anew_;                                                 // since then
  sweep_guard_core::SteadyTime predicted_at_;                     // time of the newest prediction
  std::shared_ptr<const sweep_guard_core::FrameMotions> frames_;  // at the newest sweep or prediction
  sweep_guard_core::Time frames_known_to_;  // all that are followed, at the newest sweep; at most its pose
  sweep_guard_core::PredictionPace pace_;
  sweep_guard_core::Pool<sweep_guard_core::SweepReport> reports_;
  sweep_guard_core::Pool<sweep_guard_core::Prediction> predictions_;
  LogThrottle log_;
  ThreadTop* top_ = nullptr;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
