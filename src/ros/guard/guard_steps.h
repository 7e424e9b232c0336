#pragma once

#include <boost/shared_ptr.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/pool.h"
#include "guard/command_queue.h"
#include "guard/cross_check.h"
#include "guard/intention_store.h"
#include "guard/prediction_pace.h"
#include "guard/tool_distances.h"
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
#include "ros/parameters/live_parameters.h"
#include "ros/process/log_throttle.h"
#include "ros/service/predict.h"
#include "ros/threads/thread_top.h"
#include "sweep_guard/guard/frame_motion.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/monitor/warning_monitor.h"

namespace sweep_guard_ros {

/// What the publishers need of a tool that is exchanged for the present one.
struct ToolShapes {
  /// Any thread. Takes seconds for ten thousand corners.
  explicit ToolShapes(const Parameters& parameters);

  sweep_guard_core::InterpenetrationFinders pieces;
  boost::shared_ptr<sweep_guard::ToolSurface> surface;
};

struct GuardThreadDependencies {
  LiveParameters& parameters;
  sweep_guard_core::WorkpieceStore& workpieces;
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
  sweep_guard_core::ToolDistances* distances = nullptr;  ///< null: nobody asks for them
  sweep_guard_core::CommandQueue* commands = nullptr;    ///< that go to the robot; null: none is listened to
};

/// A prediction under way, see GuardSteps::beginPrediction().
struct RunningPrediction {
  sweep_guard_core::Instant begin;
  sweep_guard_core::Duration age;  ///< of the pose that it begins at
  std::shared_ptr<sweep_guard_core::Prediction> prediction;
  sweep_guard_core::PredictionPace::Charge charge;
  sweep_guard_core::PredictionRun run;
};

/// The steps that the guard's thread makes: the sweep to a pose, the sweep to a frame that is known further, a prediction.
/// Each tells the monitor what it found, and publishes it. Used by that thread only, but for the constructor and Guard::stop().
class GuardSteps {
 public:
  /// @throws sweep_guard_core::InvalidInput if a parameter is refused
  /// @throws sweep_guard_core::DeviceError if the detector cannot be created
  GuardSteps(const ros::NodeHandle& private_node, const GuardThreadDependencies& dependencies);

  sweep_guard_core::Guard& guard() { return guard_; }
  /// Exchanges the tool that is published.
  /// @param shapes  of the same parameters; those before when it returns
  void setTool(const Parameters& parameters, ToolShapes& shapes);

  /// Sets what catches failures of the publishers: they do not keep a pose from being swept.
  void setTop(ThreadTop& top) { top_ = &top; }

  enum class Taken { kOutdated, kPassed, kToSweep };
  /// Takes a pose, unless it need not be swept (WarningMonitor::isToBeSwept()). Passes it if the next one knows all its frames, or
  /// if it is `anew`: it is then part of the motion to the next one. If not, sweep() comes next. What throws in either leaves
  /// the pose to be taken again.
  /// @param next  pose behind it in the same batch; null: there is none
  Taken take(sweep_guard_core::QueuedPose& queued, const sweep_guard_core::QueuedPose* next);
  /// Sweeps to the pose that was taken.
  void sweep(sweep_guard_core::QueuedPose& queued);
  /// Sweeps against what is known further of frames, up to the newest pose. If it fails, the next sweep makes up for it.
  void sweepOn();
  /// Puts what a camera sees into the store, and sweeps against it up to the newest pose. If a sweep fails, the next one makes up
  /// for it.
  /// @param image  as for WorkpieceStore::show()
  void show(const std::shared_ptr<const sweep_guard_core::Workpiece>& image);

  /// Returns whether a prediction may begin: none has begun at the newest swept pose, and no pose was passed since, but for
  /// those that are `anew`.
  bool mayPredict() const { return prediction_due_ && passed_.empty(); }
  /// Returns whether the workpieces had other triangles at the newest pose than at the last prediction.
  bool trianglesAreNew() const { return triangles_are_new_; }
  /// Chooses the newest pose for a prediction. Returns whether it is fresh; if not, none may begin.
  bool choosePose(const sweep_guard_core::Instant& now);
  /// Begins a prediction from the chosen pose. Between its steps, take() and sweep() may be called, then resumePrediction().
  RunningPrediction beginPrediction(const sweep_guard_core::Instant& now, sweep_guard_core::PredictionPace& pace);
  void resumePrediction();
  void endPrediction(const RunningPrediction& running);

  void forget();  ///< begins a new epoch; keeps the workpieces and what the predictor has learned

  /// Returns the newest swept pose.
  /// @throws sweep_guard_core::Error if there is none, it is stale, or the guard is disabled
  const sweep_guard_core::QueuedPose& freshPose() const;
  /// Predicts the motion up to a horizon counted from now.
  /// @throws sweep_guard_core::Error as freshPose(), and if no motion is known
  PredictService::Motion motion(sweep_guard_core::Duration horizon) const;
  /// Acknowledges the warning of a workpiece; see GuardThread.
  std::string acknowledge(const std::string& id);

 private:
  void resetMotion();
  void takeCommands();
  sweep_guard_core::Time follow(sweep_guard_core::PoseWithFrames& pose);
  void forgetFrames();
  void pass(const sweep_guard_core::PoseWithFrames& pose);
  void beginSweep(const sweep_guard_core::QueuedPose& queued, const sweep_guard_core::Workpieces& workpieces);
  void warn(const sweep_guard_core::SweepReport& report, const sweep_guard_core::QueuedPose& queued);
  bool sweptAll() const;
  void sweepAgain();
  void publish(const std::shared_ptr<sweep_guard_core::SweepReport>& report, const sweep_guard_core::QueuedPose& queued,
               const sweep_guard_core::Workpieces& workpieces);
  void measureDistances(const sweep_guard_core::PoseWithFrames& pose, const sweep_guard_core::Workpieces& workpieces);
  void reportFailures(const std::vector<sweep_guard_core::SweepFailure>& failures);

  const GuardThreadDependencies dependencies_;
  const ResultPublisher results_;
  ProximityPublisher proximity_;  // these publish what is known of the tool beside warnings, at every swept pose
  InteractionPublisher interaction_;
  BodiesPublisher bodies_;
  sweep_guard_core::Guard guard_;
  Acknowledgements acknowledgements_;
  ThreadTop* top_ = nullptr;
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
  std::shared_ptr<const sweep_guard_core::FrameMotions> frames_;  // at the newest sweep or prediction
  sweep_guard_core::Time frames_known_to_;               // all that are followed, at the newest sweep; at most its pose
  std::vector<sweep_guard_core::SentCommand> sent_;      // by takeCommands(): keeps its memory
  std::vector<const sweep_guard_core::Tool*> measured_;  // by measureDistances(): keeps its memory
  sweep_guard_core::Pool<sweep_guard_core::SweepReport> reports_;
  sweep_guard_core::Pool<sweep_guard_core::Prediction> predictions_;
  LogThrottle log_;
};

}  // namespace sweep_guard_ros
