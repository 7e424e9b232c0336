#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "guard/nearest_piece.h"
#include "guard/predicted_path_request.h"
#include "guard/segment_contacts.h"
#include "guard/swept_path.h"
#include "sweep_guard/detection/submesh.h"
#include "sweep_guard/guard/guard_options.h"
#include "sweep_guard/guard/prediction.h"

namespace sweep_guard_core {

/// Tests a predicted path of one body of the tool against one workpiece, one sweep at a time.
///
/// Idea: short volumes are tight, long ones are few. A segment is swept as a whole first. A sweep whose volume meets the
/// workpiece is halved down to `finest`, a sweep that may meet it down to 25 ms, until the first contact is found: that locates
/// its begin. Three parts do the work and hand values on:
///
///     SweptPath             what the tool sweeps in a segment
///     NearestPieceFinder    the piece that comes nearest there, and the pieces that no plane separates from the mesh
///     SegmentContactFinder  the triangles that these pieces meet
///
/// Invariant: the sweeps of the object are end to end, and each triangle that the tool may meet on the path is reported.
/// Triangles that a piece is meant to touch are left out for it; a link that has touched as intended only counts where the
/// path itself meets the workpiece. What comes no nearer than an earlier sweep, of this body or another one, is not
/// measured (PredictedSweep). Once the plan is out of time, sweeps beyond the reflex interval are neither halved nor
/// handed to the detector: a triangle counts as met if no plane of a volume separates it from the volume.
///
/// Cost: one volume for each sweep of the plan and sub-motion, shared by consecutive workpieces in one place that rests and
/// with the same rounding; one look at the boxes of the mesh for each sweep; more only where the tool comes near. Keeps its
/// buffers. Source: [P, Sec. 3.2].
class PathChecker {
 public:
  /// @param finest          a sweep with contact is halved until it lasts no longer than this, > 0
  /// @param max_deviations  contacts at more standard deviations are ignored
  PathChecker(const SweepOptions& options, Duration finest, double max_deviations = kMaxDeviations);

  /// Forgets the path. Between two calls, the requests of begin() differ only in the workpiece and its frame.
  void forgetPath();
  /// Begins a test in place of the one before.
  /// @param request  what it refers to must outlive the test
  /// @param[out] object  overwritten; must outlive the test; its buffers are used again
  void begin(const PredictedPathRequest& request, PredictedObject& object);
  bool done() const { return test_ == std::nullopt; }
  /// Tests one sweep of the plan, or one half of a sweep. Not if done().
  /// @throws DeviceError if the detector fails; then call giveUp()
  void step(Detector& detector);
  void giveUp() { test_.reset(); }  ///< ends the test

  /// Tests a path from begin to end.
  void check(Detector& detector, const PredictedPathRequest& request, PredictedObject& object);

 private:
  // The test that has begun.
  struct Test {
    WorkpieceOnPath on_path;
    const SweepPlan& plan;
    size_t count;          // sweeps of the plan
    size_t reflex_sweeps;  // number of poses
    Duration reflex_end;   // after the newest pose
    Submesh around;        // what the path may reach
    bool bounded;          // pieces that come no nearer are left out before their volumes are computed
    PredictedObject& object;
    ClosestApproach& closest;
    TriangleSet* triangles;  // of the interval under test
    size_t next = 0;         // sweep of the plan
    bool contact = false;    // found in an earlier segment

    bool inTimeFor(const PathSegment& segment) const {
      return segment.to <= reflex_end || !plan.out_of_time || !plan.out_of_time();
    }
  };
  // A segment to be tested next.
  struct Waiting {
    size_t number;
    Submesh around;
    size_t halvings;
  };

  bool staysOutOfReach(const PredictedPathRequest& request, double margin) const;
  void beginTest(const PredictedPathRequest& request, double margin, PredictedObject& object);
  Submesh submeshInReach(const Submesh& around, const Eigen::AlignedBox3d& reach_M, size_t halvings);
  Waiting nextSegment();
  void testSegment(Detector& detector, const Waiting& waiting);
  void halve(const Waiting& waiting, const Submesh& submesh);
  void report(const PathSegment& segment, const PieceApproach& nearest, const SegmentContacts& contacts);

  SweepOptions options_;
  Duration finest_;
  double max_deviations_;
  SweptPath path_;
  NearestPieceFinder nearest_finder_;
  SegmentContactFinder contact_finder_;
  ClosestApproaches own_closest_;  // where the request has none
  std::optional<Test> test_;
  std::vector<Waiting> halves_;  // the next one last
  // Buffers:
  std::deque<SubmeshFinder> finders_;  // of the whole path, of its sweeps, of their halves, ...
  ClusterBoxes boxes_;                 // of what the path may reach
  std::vector<std::optional<double>> bounds_;
  std::vector<UnseparatedPiece> unseparated_;
  SegmentContacts contacts_;
};

}  // namespace sweep_guard_core
