#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "guard/predicted_path_request.h"
#include "guard/seen_share.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {

constexpr const char* kShuttingDown = "the guard is shutting down";

/// The prediction of a Guard that is under way: it tests one body after the other, first the one that may come nearest,
/// which leaves the least to measure for the others. Pose, path, frames and intentions stay as they were when it began,
/// whatever the guard sweeps meanwhile; only which links have touched as intended is known anew. Its time is that of begin() and of the steps. Keeps its buffers.
class Guard::Run {
 public:
  explicit Run(Guard& guard);

  void begin(Duration age, const Workpieces& workpieces, Prediction& prediction);
  bool done() const { return next_ == order_.size(); }
  void step();

 private:
  void beginPlan();
  void orderBodies();
  size_t consideredSweeps() const;
  void beginBody();
  void goOn();
  void finish();
  std::optional<double> seenShare();
  Duration spent() const;

  Guard& guard_;
  PredictedMotion motion_;
  Horizon horizon_;
  SweepPlan plan_;
  ClosestApproaches closest_;
  std::shared_ptr<const Intentions> intentions_;
  const Workpieces* workpieces_ = nullptr;
  Prediction* prediction_ = nullptr;
  std::vector<size_t> order_;     // of the bodies
  std::vector<double> nearness_;  // of the bodies [standard deviations]
  size_t considered_sweeps_ = 0;
  SeenShare seen_;
  size_t next_;       // place in the order of the body under test
  Duration spent_{};  // before the running step
  SteadyTime step_begin_;
};

}  // namespace sweep_guard_core
