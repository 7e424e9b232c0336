#pragma once

#include "sweep_guard/guard/contact_probability.h"
#include "sweep_guard/guard/outlook.h"
#include "sweep_guard/guard/sweep_test.h"

namespace sweep_guard {

/// Tests the sweeps along a predicted path against one workpiece at a time. Keeps its buffers between calls.
class PathTest {
 public:
  struct Options {
    SweepOptions sweep;
    Duration finest;  ///< what seems to meet is halved until it lasts no longer, > 0
  };

  explicit PathTest(const Options& options) : options_(options) {}

  /// A sweep whose volume seems to meet the workpiece is halved: short volumes are tight, and tell when it begins. Once
  /// a piece as short as asked for meets, those after it are not halved any more.
  /// @param X_WT  where the path begins
  /// @param X_WM  the workpiece's frame
  /// @throws DeviceError if the detector fails
  PredictedObject operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                             const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                             std::shared_ptr<const Workpiece> workpiece);

 private:
  struct Piece;
  struct Query;

  void test(Query& query, const Piece& piece);

  Options options_;
  ClearanceMeter measure_;
};

}  // namespace sweep_guard
