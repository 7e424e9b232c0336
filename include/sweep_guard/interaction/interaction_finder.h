#pragma once

#include <Eigen/Geometry>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/guard/pose_with_frames.h"
#include "sweep_guard/guard/workpiece.h"
#include "sweep_guard/interaction/interpenetration.h"

namespace sweep_guard_core {

/// How a workpiece resists a piece of the tool inside it.
struct ForceLaw {
  double stiffness = 1e6;    ///< force per volume [N/m^3], >= 0: the foundation modulus of an elastic layer
  double damping = 0.0;      ///< [s/m], >= 0: by which share the force grows per closing speed [Hunt and Crossley 1975]
  double least_area = 1e-6;  ///< [m^2], > 0: where the surface inside has a smaller area, the force is smaller
};

/// A force, and its torque about the origin of T, along the axes of T.
struct Wrench {
  Eigen::Vector3d force_T = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque_T = Eigen::Vector3d::Zero();  ///< [N m]

  Wrench& operator+=(const Wrench& other);
};

/// Computes the force of the workpiece on the piece, at the centroid of the volume:
///   F = k V A / max(|A|, A_min) max(0, 1 + c s)   with   s = -v . A / max(|A|, A_min).
/// It is continuous in the pose as V and A are, never pulls, and without damping is that of the pose alone. It is not
/// the gradient of an energy.
/// @param velocity_T  of the piece at the centroid, relative to the workpiece [m/s]
Wrench interactionForce(const Interpenetration& found, const Eigen::Vector3d& velocity_T, const ForceLaw& law);

/// Options of InteractionFinder.
struct InteractionOptions {
  ForceLaw law;
  std::map<std::string, double> stiffness_of;   ///< by id of the workpiece, in place of law.stiffness [N/m^3]
  ForceLaw lawOf(const std::string& id) const;  ///< for a workpiece
};

/// What a tool and a workpiece have in common at one pose, and the force of the workpiece on the tool: the sums over
/// the convex pieces of the tool. Where pieces overlap, their volume and force count as often.
struct ObjectInteraction {
  std::shared_ptr<const Workpiece> workpiece;
  bool enclosed = false;                                 ///< as of Interpenetration
  bool counted_twice = false;                            ///< volume may be: closed parts of the surface overlap
  double volume = 0.0;                                   ///< [m^3]
  Eigen::Vector3d centroid_T = Eigen::Vector3d::Zero();  ///< of the volume [m]
  Eigen::Vector3d area_T = Eigen::Vector3d::Zero();      ///< as of Interpenetration [m^2]
  double depth = 0.0;                                    ///< the largest of a piece, as Interpenetration::depth() [m]
  Wrench wrench;
};

/// What a tool has in common with all workpieces at one pose.
struct Interaction {
  std::vector<ObjectInteraction> objects;  ///< with a volume or an area, in the order of the workpieces
  Wrench total;
  Workpieces unplaced;  ///< left out because their frame is unknown at the pose
};

/// The convex pieces of a tool, by body, ready for InteractionFinder.
using InterpenetrationFinders = std::vector<std::vector<InterpenetrationFinder>>;

/// Returns those of a tool. Takes some milliseconds for each piece.
InterpenetrationFinders interpenetrationFinders(const std::vector<Tool>& bodies);

/// Computes the forces of the workpieces on a tool. The velocity for the damping is that of each body between the poses of
/// the two latest calls, relative to the frame of the workpiece; 0 at the first one, and after 0.1 s without a call. The
/// speed of a deformation is left out. Keeps its buffers between calls.
class InteractionFinder {
 public:
  /// @param bodies  of the tool, each in its own frame; as many as the poses have, or one in T for poses without bodies
  explicit InteractionFinder(const std::vector<Tool>& bodies) : bodies_(interpenetrationFinders(bodies)) {}

  /// Exchanges the pieces of the tool, and forgets the poses; the caller gets those before.
  void exchange(InterpenetrationFinders& bodies) {
    bodies_.swap(bodies);
    reset();
  }

  /// @param[out] interaction  overwritten; its buffers are used again
  void find(const PoseWithFrames& pose, const Workpieces& workpieces, const InteractionOptions& options,
            Interaction& interaction);

  void reset() { motions_.clear(); }  ///< forgets the poses

 private:
  /// The bodies at the two latest poses, relative to a workpiece.
  class ToolMotion {
   public:
    void moveTo(const PoseWithFrames& pose, const std::string& frame, const Eigen::Isometry3d& X_WM, size_t bodies);

    const Eigen::Isometry3d& X_MB(size_t body) const { return now_.X_MB[body]; }
    Eigen::Vector3d velocity_B(size_t body, const Eigen::Vector3d& p_B) const;  // [m/s]; 0: unknown

   private:
    struct BodyPoses {
      std::vector<Eigen::Isometry3d> X_MB;
      std::string frame;  // name of M
      Time stamp;
    };

    BodyPoses before_;
    BodyPoses now_;
    bool known_ = false;
  };

  ObjectInteraction interact(const std::shared_ptr<const Workpiece>& workpiece, const PoseWithFrames& pose,
                             const ToolMotion& motion, const InteractionOptions& options);

  InterpenetrationFinders bodies_;
  std::map<std::string, ToolMotion> motions_;  // by id of the workpiece
};

}  // namespace sweep_guard_core
