#pragma once

#include <deque>
#include <functional>

#include "sweep_guard/guard/contact_probability.h"
#include "sweep_guard/guard/expected_motion.h"
#include "sweep_guard/guard/outlook.h"
#include "sweep_guard/guard/sweep_test.h"
#include "sweep_guard/guard/swept_body.h"
#include "sweep_guard/guard/triangle_set.h"

namespace sweep_guard {

/// Tests the sweeps along a predicted path against one workpiece at a time. Keeps its buffers between calls.
class PathTest {
 public:
  struct Options {
    SweepOptions sweep;
    Duration finest;  ///< what seems to meet is halved until it lasts no longer, > 0
  };

  /// What to spend on a path where time is short.
  struct Effort {
    std::vector<size_t> sweep_ends;  ///< of sweepEnds(); empty: each pose ends a sweep
    std::function<bool()> spent;     ///< the time for what comes after the reflex interval is over; empty: it never is
  };

  explicit PathTest(const Options& options) : options_(options) {}

  /// A sweep whose volume seems to meet the workpiece, or might, is halved: short volumes are tight, and tell when it
  /// begins. What might meet is halved down to 25 ms, what seems to meet down to the finest pieces. Once one of these
  /// meets, those after it are not halved any more. Beyond the reflex interval nothing is halved, nor the detector
  /// asked, once the effort is spent: a triangle counts as met then as long as no plane of a volume separates it.
  /// @param X_WT  where the path begins
  /// @param X_WM  the workpiece's frame
  /// @throws DeviceError if the detector fails
  PredictedObject operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT,
                             const PredictedPath& path, size_t reflex_sweeps, const Eigen::Isometry3d& X_WM,
                             std::shared_ptr<const Workpiece> workpiece, const Effort& effort = {});

 private:
  struct Scene;
  struct Reading;
  struct Findings;

  std::vector<SweptBody> wholeTool(const Scene& scene, const Stretch& stretch) const;
  TriangleSet detected(const Scene& scene, const MeshPart& part, const std::vector<SweptBody>& bodies);
  Reading read(const Scene& scene, const MeshPart& part, const Stretch& stretch, const std::vector<SweptBody>& whole);
  void read(const Scene& scene, const MeshPart& part, const Stretch& stretch, const Tool::Node& node,
            const SweptBody& body, Reading& reading);
  void test(const Scene& scene, const MeshPart& around, const Stretch& stretch, const std::vector<SweptBody>& whole,
            Findings& findings, size_t halvings);
  MeshPart partInReach(const Scene& scene, const MeshPart& around, const Stretch& stretch, size_t halvings);

  Options options_;
  ClearanceMeter meter_;
  std::deque<PartFinder> finders_;  // of the whole path, of its sweeps, of their halves, ...
  Detection detection_;
};

}  // namespace sweep_guard
