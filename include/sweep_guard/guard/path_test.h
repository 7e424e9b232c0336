#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <vector>

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

    size_t sweepsAlong(const PredictedPath& path) const { return sweep_ends.empty() ? path.size() : sweep_ends.size(); }
  };

  explicit PathTest(const Options& options) : options_(options) {}

  /// A sweep whose volume seems to meet the workpiece, or might, is halved: short volumes are tight, and tell when it
  /// begins. What might meet is halved down to 25 ms, what seems to meet down to the finest pieces. Once one of these
  /// meets, those after it are not halved any more. Beyond the reflex interval nothing is halved, nor the detector
  /// asked, once the effort is spent: a triangle counts as met then as long as no plane of a volume separates it.
  /// @param X_WT  where the path begins
  /// @param X_WM         the workpiece's frame
  /// @param[out] object  what was in it is replaced
  /// @throws DeviceError if the detector fails
  void operator()(Detector& detector, const Tool& tool, const Eigen::Isometry3d& X_WT, const PredictedPath& path,
                  size_t reflex_sweeps, const Eigen::Isometry3d& X_WM, std::shared_ptr<const Workpiece> workpiece,
                  const Effort& effort, PredictedObject& object);

 private:
  struct Scene;
  struct Findings;

  /// A part of the tool, and how likely it is to meet the mesh.
  struct Chance {
    double probability = 0.0;
    std::optional<size_t> part = {};  // none where nothing may
  };
  struct Unseparated {
    SweptBody body;
    Chance chance;
  };

  void sweepWhole(const Scene& scene, const Stretch& stretch);
  void detectMet(const Scene& scene, const MeshPart& part);
  static const Chance& likelier(const Chance& one, const Chance& other);
  Chance read(const Scene& scene, const MeshPart& part, const Stretch& stretch);
  Chance read(const Scene& scene, const MeshPart& part, const Stretch& stretch, const Tool::Node& node,
              const SweptBody& body);
  void test(const Scene& scene, const MeshPart& around, const Stretch& stretch, Findings& findings, size_t halvings);
  MeshPart partInReach(const Scene& scene, const MeshPart& around, const Stretch& stretch, size_t halvings);

  Options options_;
  ClearanceMeter meter_;
  std::deque<PartFinder> finders_;  // of the whole path, of its sweeps, of their halves, ...
  Detection detection_;
  ExpectedMotion motion_;
  // Of the stretch that is tested:
  std::vector<Motion> motions_M_;
  std::vector<SweptBody> whole_;          // around all parts of the tool
  std::vector<Unseparated> unseparated_;  // parts of the tool that no plane tells apart from the mesh
  TriangleSet met_;                       // that these meet, as far as is known
  Chance meeting_;                        // the likeliest of those that do
};

}  // namespace sweep_guard
