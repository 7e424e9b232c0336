#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "guard/prediction_pace.h"
#include "monitor/work_queue.h"
#include "ros/guard/guard_steps.h"
#include "ros/threads/supervisor.h"

namespace sweep_guard_ros {

/// Runs the guard in one thread: takes the queued poses in batches, and sweeps to each or passes it (GuardSteps::take()), so
/// that a backlog is swept as one motion. Without poses, sweeps against frames that are known further than before.
///
/// Predicts after a sweep, from its pose if that is fresh: if no pose waits, and PredictionPace says so or the workpieces have
/// other triangles; or if the last prediction began a cycle ago. Otherwise waits for a later pose, but not beyond that cycle.
/// Poses that come during a prediction are swept between its steps until 50 ms after its begin, or until a sweep throws.
///
/// Runs queued tasks between two batches of poses, or two tries of a pose whose sweep throws; never during a prediction.
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
  /// @throws sweep_guard_core::Error if the thread does not begin with it within 0.5 s, other parameters were set or the
  ///     tool was exchanged meanwhile, too many tasks wait, or the guard is shutting down; then nothing is set, also later
  void apply(const std::shared_ptr<const Parameters>& next);
  /// Exchanges the tool. Forgets what reset() does, except what was learned: the warning is UNKNOWN or CONTACT until two other
  /// poses have arrived. Returns when that is done. Any thread.
  /// @param before        parameters that `next` was made from
  /// @param change_store  takes the payload out of the workpieces or puts it back, between the same two sweeps; may throw
  /// @throws sweep_guard_core::Error as apply(); then nothing is exchanged
  void exchangeTool(const std::shared_ptr<const Parameters>& before, const std::shared_ptr<const Parameters>& next,
                    const std::function<void()>& change_store);
  /// Returns the newest swept pose. Any thread. The future throws as GuardSteps::freshPose(), or std::future_error at shutdown.
  std::future<sweep_guard_core::PoseWithFrames> newestPose();
  /// Sets the trajectory under way, as Guard::setTrajectory(). Does not wait. Any thread.
  /// @throws sweep_guard_core::Error if too many tasks wait, or the guard is shutting down; then it is not set
  void setTrajectory(const std::shared_ptr<const sweep_guard_core::JointTrajectory>& trajectory);
  /// Forgets poses, contacts, intentions and what was learned; keeps workpieces, parameters, touches and what is attached.
  /// Returns when that is done. Any thread.
  /// @throws sweep_guard_core::Error as apply(); then nothing is forgotten, also later
  void reset();
  /// Acknowledges a warning, see WarningMonitor. Returns when that is done. Any thread.
  /// @param id  of the workpiece; empty: the one that the warning names
  /// @returns the id
  /// @throws sweep_guard_core::Error if there is nothing to acknowledge, or the tool is farther away than
  ///     warning/acknowledge_distance; or as apply(); then nothing is acknowledged, also later
  std::string acknowledge(const std::string& id);
  /// Predicts the motion up to a horizon counted from now. Any thread. The future throws as GuardSteps::motion(), or
  /// std::future_error at shutdown.
  std::future<PredictService::Motion> predictMotion(sweep_guard_core::Duration horizon);

 private:
  sweep_guard_core::GuardChange changeTo(const Parameters& next, const Parameters& before);
  void requireUnchanged(const Parameters& before) const;
  void runInTime(const std::function<void()>& task, const std::string& otherwise);
  void setPriority() const;
  void run();
  bool hasPose();
  bool takeWork();
  bool takeNext();
  bool pauseAfterFailure();
  bool timeToPredict() const;
  bool predictIfDue();
  std::optional<sweep_guard_core::SteadyTime> latestPrediction() const;
  void predict();
  bool takeMore();
  bool sweepWaiting();
  void show(const std::vector<std::shared_ptr<const sweep_guard_core::Workpiece>>& images);

  const GuardThreadDependencies dependencies_;

  // After the start, used by the thread only:
  GuardSteps steps_;
  sweep_guard_core::WorkQueue::Work work_;
  size_t next_ = 0;                            // of work_.poses: those before it are done
  sweep_guard_core::SteadyTime predicted_at_;  // time of the newest prediction
  sweep_guard_core::PredictionPace pace_;
  ThreadTop* top_ = nullptr;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
