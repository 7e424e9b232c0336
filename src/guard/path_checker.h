#pragma once

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "guard/contact_probability.h"
#include "guard/intended_contact.h"
#include "guard/path_in_mesh.h"
#include "guard/predict_contacts.h"
#include "guard/swept_body.h"
#include "sweep_guard/detection/submesh.h"

namespace sweep_guard_core {

/// How to cut a predicted path into sweeps, and how long they may take.
struct SweepPlan {
  std::vector<size_t> sweep_ends;       ///< pose numbers from findSweepEnds(); empty: every pose ends a sweep
  std::function<bool()> out_of_time{};  ///< true once the time after the reflex interval is used up; empty: never
  std::function<void()> before_sweep = [] {};  ///< called before every sweep and part of one; may throw to give up

  size_t sweepCount(const PredictedPath& path) const { return sweep_ends.empty() ? path.size() : sweep_ends.size(); }
};

struct PredictedPathRequest {
  const Tool& tool;
  const Eigen::Isometry3d& X_WT;  ///< where the path begins
  const PredictedPath& path;      ///< at least one pose
  size_t reflex_sweeps;           ///< number of poses, from the first, within the reflex interval
  const Eigen::Isometry3d& X_WM;  ///< frame of the workpiece; taken to stay where it is, unless there is `frame`
  const std::shared_ptr<const Workpiece>& workpiece;
  const SweepPlan& plan;
  const Intentions& intentions = kNoIntentions;
  const IntendedTouches& touches = kNoTouches;
  const FramePath* frame = nullptr;      ///< along `path`, of a frame that moves on its own
  ClosestApproaches* closest = nullptr;  ///< of the bodies of the tool; null: it is the only one
};

/// Tests the sweeps along a predicted path. Keeps its buffers between calls.
class PathChecker {
 public:
  struct Options {
    SweepOptions sweep;
    Duration finest;                         ///< a sweep with contact is halved until it lasts no longer than this, > 0
    double max_deviations = kMaxDeviations;  ///< contacts at more standard deviations are ignored
    AllowedPairs allowed = {};               ///< left out
  };
  static Options optionsOf(const GuardOptions& options) {
    return {options.sweep, options.horizon.reflex_step / 2, options.max_deviations, options.allowed};
  }

  explicit PathChecker(const Options& options) : options_(options), meter_(options.max_deviations) {}

  /// Tests the path against one workpiece. A sweep whose volume meets the workpiece is halved down to `finest`, a sweep
  /// that may meet it down to 25 ms: short volumes are tight and locate the begin of the contact. After the first
  /// contact, sweeps are no longer halved. Triangles that a piece is meant to touch are left out for it; a link that has
  /// touched as intended only counts where the path itself meets the workpiece. Once the plan is out of time, sweeps beyond the reflex interval are neither
  /// halved nor handed to the detector: a triangle counts as met if no plane of a volume separates it from the volume.
  /// What comes no nearer than an earlier sweep, of this body or another one, is not measured (PredictedSweep).
  /// @param[out] object  overwritten; its buffers are used again
  /// @throws DeviceError if the detector fails
  void check(Detector& detector, const PredictedPathRequest& request, PredictedObject& object);

  /// Tests the predicted motion against every workpiece. A workpiece whose detection fails is reported as a failure.
  /// Consecutive workpieces in one place share the sweeps of the tool.
  /// @param[out] prediction  overwritten; its buffers are used again
  void predict(Detector& detector, const PredictionRequest& request, const SweepPlan& plan, Prediction& prediction);

 private:
  struct Scene;
  struct Progress;

  /// A convex piece of the tool, and how near it comes to the mesh (Clearance).
  struct PieceApproach {
    double deviations = std::numeric_limits<double>::infinity();
    std::optional<size_t> piece = {};  // none if no piece may meet the mesh
  };
  /// A motion of the tool, and the pose at the end of its segment.
  struct UncertainMotion {
    const Motion& motion_M;
    const UncertainPose& end_M;
  };
  /// What a piece of the tool sweeps.
  struct SweptPiece {
    const SweptBody& body;
    const PerHalfSpace& deviations;
    size_t piece;
  };
  struct UncertainBody {
    SweptBody body;
    PerHalfSpace deviations;
  };
  struct Unseparated {
    SweptBody body;
    PieceApproach approach;
  };
  /// What the tool sweeps in a segment of the path, whatever the workpiece.
  struct SweptSegment {
    PathSegment segment;
    Eigen::AlignedBox3d reach_M;
    std::vector<SweptBody> bodies;         // around the whole tool
    std::vector<PerHalfSpace> deviations;  // of these; empty: not computed yet
    UncertainPose end_M;                   // computed with them
    std::array<size_t, 2> halves{};        // indices into segments_; 0: not swept yet
  };

  void checkNext(Detector& detector, const PredictedPathRequest& request, PredictedObject& object);
  void follow(const PredictedPathRequest& request, double margin);
  size_t sweepSegment(const PathSegment& segment, double margin);
  void sweepHalves(size_t number, double margin);
  void measureDeviations(const Scene& scene, SweptSegment& swept);
  UncertainBody sweepPiece(const Scene& scene, const UncertainMotion& motion, const ConvexShape& piece) const;
  void detectContacts(const Scene& scene, const Submesh& submesh, const Progress& progress, bool reflex);
  bool keepNewlyMet(const SweptBody& body, const IsLeftOut& intended, const TriangleMesh& mesh_M,
                    const Progress& progress);
  void addContact(const PieceApproach& approach);
  void assumeContacts(const Scene& scene, const Submesh& submesh);
  bool hasCandidate(const Scene& scene, const Submesh& submesh, SweptSegment& swept);
  bool hasCandidateBelow(const Scene& scene, const Submesh& submesh, const UncertainMotion& motion, size_t node);
  static const PieceApproach& nearer(const PieceApproach& one, const PieceApproach& other);
  PieceApproach noApproach();
  PieceApproach findNearestPiece(const Scene& scene, const Submesh& submesh, SweptSegment& swept, double at_most);
  PieceApproach findNearestPieceBelow(const Scene& scene, const Submesh& submesh, const UncertainMotion& motion,
                                      size_t node, double at_most);
  bool isLeftOut(const Scene& scene, const Submesh& submesh, const UncertainMotion& motion, size_t node,
                 double at_most);
  double limit(double at_most) const;
  PieceApproach measure(const Scene& scene, const Submesh& submesh, const SweptPiece& swept, double at_most);
  void boundPieces(const Scene& scene, const PathSegment& segment);
  double leastDeviations(const Scene& scene, size_t node);
  bool comesNoNearer(const Scene& scene, size_t node, double at_most);
  bool noPieceComesNearer(const Scene& scene, size_t node, double at_most);
  std::array<size_t, 2> nearestFirst(const Scene& scene, const Tool::Node& node);
  static IsLeftOut intendedFor(const Scene& scene, const Submesh& submesh, const SweptBody& body,
                               std::optional<size_t> piece);
  void checkSegment(const Scene& scene, const Submesh& around, size_t number, Progress& progress, size_t halvings);
  bool staysOutOfReach(const PredictedPathRequest& request, double margin) const;
  static void addFreeSweeps(const PredictedPathRequest& request, PredictedObject& object);
  Submesh submeshInReach(const Submesh& around, const Eigen::AlignedBox3d& reach_M, size_t halvings);

  Options options_;
  ClearanceMeter meter_;
  std::deque<SubmeshFinder> finders_;  // of the whole path, of its sweeps, of their halves, ...
  Detection detection_;
  PathInMesh path_M_;
  ClosestApproaches own_closest_;
  ClusterBoxes boxes_;  // of what the path may reach
  // Of path_M_, for the workpieces placed as the last one was:
  std::optional<Eigen::Isometry3d> X_WM_;
  double margin_ = 0.0;
  const ConvexShape* tool_ = nullptr;  // of the whole tool
  Eigen::AlignedBox3d reach_M_;
  std::deque<SweptSegment> segments_;  // the base sweeps first; more than `swept_` are buffers to use again
  size_t swept_ = 0;
  // Of the segment under test:
  std::optional<UncertainStep> step_;  // none: nothing is bounded
  std::vector<std::optional<double>>
      least_;  // bounds on the clearances of the pieces below each node; empty: not computed yet
  std::vector<Motion> motions_M_;
  std::vector<Unseparated> unseparated_;  // pieces of the tool that no plane separates from the mesh
  bool meets_ = false;                    // one of them meets the mesh
  TriangleSet newly_met_;                 // triangles that these pieces meet, but for those reported already
  std::vector<char> assumed_;             // for each triangle of the mesh: newly met
  PieceApproach in_contact_;              // the nearest of the pieces that meet one
  bool hulls_miss_ = false;               // the hulls of all pieces miss what their volumes meet
};

}  // namespace sweep_guard_core
