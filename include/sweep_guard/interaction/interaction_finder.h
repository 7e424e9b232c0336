#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/interaction/interaction_force.h"

namespace sweep_guard_core {

struct InteractionOptions {
  ForceLaw law;
  std::map<std::string, double> stiffness_of;  ///< by id of the workpiece, in place of law.stiffness [N/m^3]
};

/// What a tool and a workpiece have in common at one pose, and the force of the workpiece on the tool: the sums over
/// the convex pieces of the tool. Where pieces overlap, their volume and force count as often.
struct ObjectInteraction {
  std::shared_ptr<const Workpiece> workpiece;
  bool enclosed = false;                                 ///< as of Interpenetration
  double volume = 0.0;                                   ///< [m^3]
  Eigen::Vector3d centroid_T = Eigen::Vector3d::Zero();  ///< of the volume [m]
  Eigen::Vector3d area_T = Eigen::Vector3d::Zero();      ///< as of Interpenetration [m^2]
  double depth = 0.0;                                    ///< the largest of a piece, as Interpenetration::depth() [m]
  Wrench wrench;
};

struct Interaction {
  std::vector<ObjectInteraction> objects;  ///< with a volume or an area, in the order of the workpieces
  Wrench total;
  Workpieces unplaced;  ///< left out because their frame is unknown at the pose
};

struct InteractionRequest {
  const PoseWithFrames& pose;
  const Workpieces& workpieces;
  const InteractionOptions& options;
};

/// The convex pieces of a tool, ready for InteractionFinder. Takes some milliseconds for each piece.
std::vector<InterpenetrationFinder> interpenetrationFinders(const Tool& tool);

/// Computes the forces of the workpieces on a tool. The velocity for the damping is that between the poses of the two
/// latest calls, relative to the frame of the workpiece; 0 at the first one, and after 0.1 s without a call. The speed
/// of a deformation is left out. Keeps its buffers between calls.
class InteractionFinder {
 public:
  explicit InteractionFinder(const Tool& tool) : pieces_(interpenetrationFinders(tool)) {}

  /// Exchanges the pieces of the tool; the caller gets those before.
  void exchange(std::vector<InterpenetrationFinder>& pieces) { pieces_.swap(pieces); }

  /// @param[out] interaction  overwritten; its buffers are used again
  void find(const InteractionRequest& request, Interaction& interaction);

  void reset() { earlier_.clear(); }  ///< forgets the poses

 private:
  struct PlacedTool {
    Eigen::Isometry3d X_MT;
    std::string frame;  // name of M
    Time stamp;
  };
  class ToolMotion;

  ToolMotion motionOf(const Workpiece& workpiece, const PlacedTool& now);
  void forgetRemoved(const Workpieces& workpieces);
  ObjectInteraction interact(const std::shared_ptr<const Workpiece>& workpiece, const ToolMotion& motion,
                             const InteractionOptions& options);

  std::vector<InterpenetrationFinder> pieces_;
  std::map<std::string, PlacedTool> earlier_;  // by id of the workpiece
};

}  // namespace sweep_guard_core
