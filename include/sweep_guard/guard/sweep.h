#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sweep_guard/common/time.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/detection/time_of_impact.h"
#include "sweep_guard/geometry/swept_volume.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/contact_policy.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/prediction/jump.h"

namespace sweep_guard_core {

/// Sets how sweeps are tested. The core does not check these options.
struct SweepOptions {
  VolumeKind volume = VolumeKind::kObbPlanes;
  double max_rotation = 0.175;  ///< largest rotation of one sub-motion [rad], in (0, 1.5]
  double margin = 0.0;          ///< the tool is grown by this [m], >= 0
  bool fine = true;             ///< compute timeOfImpact() of the triangles that the swept volumes meet (narrow phase)
};

/// On which side of the surface of a mesh a piece of the tool lies.
enum class PieceSide : std::uint8_t { kUnknown, kOutside, kInside };

/// A triangle that the narrow phase finds in contact with the tool.
struct TriangleContact {
  std::uint32_t triangle;
  /// Index of the convex piece of the tool that touches the triangle first; a Guard counts the pieces of all bodies.
  size_t piece;
  Impact impact;  ///< first impact of the piece on the triangle
  /// No piece meets the triangle other than intended (Intention). If one does, `piece` is the first of these.
  bool intended = false;
};

/// Holds what the pieces of the tool that may touch a mesh (ContactPolicy) meet of it during one motion.
struct AllowedContact {
  TriangleSet triangles = {};                    ///< triangles that a swept volume may meet: ascending, each once
  std::vector<TriangleContact> in_contact = {};  ///< those in contact, as in SweepResult; empty without narrow phase

  void clear();  ///< resets all fields and keeps the buffers
};

/// Holds the triangles of one mesh that the tool meets during one motion.
struct SweepResult {
  TriangleSet triangles;  ///< triangles that a swept volume may meet: ascending, each once
  double margin = 0.0;    ///< largest margin of a tested volume [m]: arcs, rounding, mesh motion and requested margin
  std::vector<SweptVolume>
      volumes_M;                   ///< volumes tested, in order of time: of the tool's pieces, or of boxes around them
  bool fine = false;               ///< the narrow phase has run: timeOfImpact() of `triangles`
  TriangleSet not_ruled_out = {};  ///< subset of `triangles` that the narrow phase does not rule out; without it, all
  /// Those of `not_ruled_out` for which timeOfImpact() finds an impact, the mesh moving at constant speed: ascending,
  /// each once. Empty without narrow phase.
  std::vector<TriangleContact> in_contact = {};
  /// Those of `not_ruled_out` that only pieces meet which are meant to (Intention): ascending, each once. Empty without
  /// narrow phase.
  TriangleSet intended = {};
  /// A piece of the tool lies wholly inside the mesh. Tested only if the sweep's `not_ruled_out` holds nothing but `intended`,
  /// and then not for the links that touch as intended; false otherwise, and where an open mesh leaves it untested.
  bool inside = false;
  std::vector<PieceSide> sides = {};  ///< of each piece of one tool at the end of the motion
  /// What is met by the pieces that may; all other members but `margin` and `volumes_M` are without these pieces.
  AllowedContact allowed = {};

  /// Returns whether the tool met the mesh, or whether it is not ruled out that it did.
  bool contact() const { return inside || !not_ruled_out.empty(); }
  /// Returns whether there is a contact() other than intended.
  bool unintendedContact() const { return inside || not_ruled_out.size() > intended.size(); }
  TriangleSet unintended() const;  ///< `not_ruled_out` without `intended`
  /// Returns the triangles of `allowed` in contact; without narrow phase, all.
  TriangleSet allowedTriangles() const;
  void clear();  ///< resets all fields and keeps the buffers
};

/// Input of checkPath(). What it refers to must outlive it.
struct PathRequest {
  const Tool& tool;
  const std::vector<Eigen::Isometry3d>& path;  ///< finite poses X_MT [m], at least one (asserted); one is a static test
  const TriangleMesh& mesh_M;
  SweepOptions options = {};
  std::function<void()> before_sweep = [] {};  ///< called before every sweep, not empty; may throw to give up
  /// Of each sweep: bound [m], >= 0, on the distance of a tool point from where it would be if the tool moved as a Motion.
  /// Empty: 0
  std::vector<double> deviation_bounds = {};
  const ContactPolicy& contact = kForbidAllContact;  ///< without intentions: what is meant along a path is not known
};

/// Holds what the tool meets along a path of poses; one sweep for each two consecutive poses.
struct PathResult {
  /// All sweeps merged. Of each triangle: time (as a fraction of its sweep), point and piece of the first impact,
  /// normal of the last one, and the depth at the end of the last sweep, 0 if that does not touch it.
  SweepResult all;
  std::optional<size_t> first_contact;   ///< first sweep with contact; sweep i goes from pose i to pose i + 1
  std::optional<double> time_of_impact;  ///< in that sweep, [0, 1]; 0 if inside; empty without contact or narrow phase
  /// Index of the piece that touches first in that sweep; empty without contact or narrow phase, or if inside.
  std::optional<size_t> piece;
};

/// Checks every sweep of a path, also after a contact. From pose to pose the tool moves as a Motion; the mesh rests.
/// @throws DeviceError if the detector fails, and what before_sweep() throws
PathResult checkPath(Detector& detector, const PathRequest& request);

/// One workpiece that was swept, and the result.
struct SweptObject {
  std::shared_ptr<const Workpiece> workpiece;
  /// Stamp of the pose that the sweep began at. Times of impact are fractions of the interval from this stamp to the
  /// stamp of the newest pose. A contact that a mesh update caused before this stamp has time 0.
  Time interval_start;
  /// Time by which the pose that the sweep began at is older than the oldest update of the workpiece still kept: the
  /// sweep leaves out how the workpiece moved in between. Or the time between two images of a camera, if one between them was not
  /// swept, or if that is more than 0.5 s, for which poses are kept. 0: nothing is left out.
  Duration behind{};
  /// Bodies of several that stay out of reach of the workpiece have no volumes, nor a margin.
  SweepResult result;
};

/// Reports one step of the guard: the sweeps up to one pose.
struct SweepReport {
  Time start;  ///< earliest `interval_start` of `objects`; `end` at the first pose and if there are none
  Time end;    ///< stamp of the pose
  /// How long the first pose given to Guard::pass() since the last sweep waited: until the pose of this sweep was received. 0: no
  /// pose waited.
  Duration backlog{};
  std::vector<SweptObject> objects;  ///< every workpiece swept, in the order given to sweep() unless a sweep failed
  Workpieces unplaced;               ///< workpieces that were not swept because their frame is unknown at `end`
  /// Workpieces whose sweep failed, for one body of the tool at least; `objects` has what the others met.
  std::vector<SweepFailure> failures;
  /// Workpieces that have other triangles since they were last swept, with the triangles from before: the tool may have met these
  /// on the way to the pose. As a rule empty.
  std::vector<SweptObject> replaced = {};
  std::string jump = {};  ///< what jumped on the way, in words (PoseWithFrames::jump); empty: nothing
  std::map<std::string, JumpSpeed> jumps = {};  ///< by frame against which the tool, or a body of it, jumped on the way
  /// Frames that come so late that more poses waited for them than are kept: the tool was swept straight past the oldest ones.
  std::set<std::string> passed_over = {};

  double margin() const;           ///< largest margin of all objects [m]; 0 if there are none
  bool contact() const;            ///< the tool met an object, also a replaced one, or it is not ruled out that it did
  bool unintendedContact() const;  ///< the same, but for contacts as intended (Intention)
  bool complete() const;  ///< there is at least one workpiece, and every workpiece was swept with all its updates
};

}  // namespace sweep_guard_core
