#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "sweep_guard/common/pool.h"
#include "sweep_guard/guard/guard.h"
#include "sweep_guard/guard/ledger.h"
#include "sweep_guard/ros/findings_output.h"
#include "sweep_guard/ros/log_throttle.h"
#include "sweep_guard/ros/parameters.h"
#include "sweep_guard/ros/predict.h"
#include "sweep_guard/ros/scene_output.h"
#include "sweep_guard/ros/warning_output.h"
#include "sweep_guard/ros/work_queue.h"
#include "sweep_guard/ros/workload.h"
#include "sweep_guard/ros/workpiece_store.h"

namespace sweep_guard_ros {

/// Where a sweeper takes from and tells to.
struct SweeperParts {
  LiveParameters& parameters;
  const WorkpieceStore& workpieces;
  sweep_guard::Ledger& ledger;
  Workload& workload;
  WarningOutput& warnings;
  SceneOutput& scene;
};

/// One thread, which alone touches the guard: it sweeps every pose, those that had to wait at once, and looks ahead
/// from the newest. Who else wants something of the guard is served between two sweeps.
class Sweeper {
 public:
  /// @throws sweep_guard::InvalidInput if a parameter is refused, sweep_guard::DeviceError if there is no detector
  Sweeper(const ros::NodeHandle& private_node, const SweeperParts& parts);
  ~Sweeper() { stop(); }
  Sweeper(const Sweeper&) = delete;
  Sweeper& operator=(const Sweeper&) = delete;

  void start();
  void stop();  ///< lets everybody go who waits; what is still to be swept is not

  void sweepTo(PlacedPose pose);  ///< soon; any thread

  /// Goes on with other parameters, and puts them into force. Returns when that is done. Any thread.
  /// @throws sweep_guard::Error if the guard is busy or shuts down
  void adopt(const std::shared_ptr<const Parameters>& next);
  /// Forgets everything but the workpieces. Likewise.
  void reset();
  /// Where the tool will be, up to a horizon counted from now; a sweep_guard::Error where nothing is known.
  std::future<PredictService::Answer> forecast(sweep_guard::Duration horizon);

 private:
  void work();
  void process(const std::vector<PlacedPose>& poses);
  void process(const PlacedPose& placed, const PlacedPose* next);
  void pass(const PlacedPose& placed);
  void sweep(const PlacedPose& placed);
  void lookAhead(const PlacedPose& placed);
  bool timeToLookAhead() const;
  void tellFailure(const sweep_guard::SweepFailure& failure);
  PredictService::Answer answer(sweep_guard::Duration horizon) const;

  const SweeperParts parts_;
  const FindingsOutput findings_;
  std::mutex adopting_mutex_;  // what the guard goes on with
  WorkQueue queue_;

  // Of the thread:
  sweep_guard::Guard guard_;
  std::uint64_t guard_epoch_ = 0;                // that the guard's poses are of
  std::optional<sweep_guard::Seen> swept_;       // newest pose that the guard knows
  std::vector<sweep_guard::SteadyTime> passed_;  // when the poses passed since then came in
  sweep_guard::SteadyTime looked_ahead_;         // when it did so last
  sweep_guard::Pool<sweep_guard::SweepReport> reports_;
  sweep_guard::Pool<sweep_guard::Outlook> outlooks_;
  LogThrottle log_;
  std::thread thread_;
};

}  // namespace sweep_guard_ros
