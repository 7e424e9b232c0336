#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "sweep_guard/motion/braking.h"
#include "sweep_guard/motion/moving_tool.h"
#include "sweep_guard/motion/nearest_point.h"
#include "sweep_guard/motion/plane_set.h"

namespace sweep_guard_core {

/// How planes resist the tool.
struct ContactLaw {
  double stiffness = 500.0;  ///< [N/m], >= 0
  double damping = 0.0;      ///< of a motion into a plane [N s/m], >= 0
  double distance = 0.0;     ///< from a plane at which the force begins [m], >= 0
  double cue_damping = 0.0;  ///< of a motion that meets a plane soon [N s/m], >= 0; 0: there is no such cue
  double cue_time = 0.3;     ///< before a plane is reached at which the cue begins [s], > 0
};

/// Where the pieces of the tool are.
struct PiecePoses {
  const Eigen::Isometry3d& X_WT;
  const MovingTool* moving = nullptr;  ///< whose joints place them; null: they are fixed to the tool frame

  const Eigen::Isometry3d& of(size_t piece) const { return moving ? moving->pieces()[piece].X_WL : X_WT; }
};

/// A force on the tool, and its torque about the origin of the tool frame, along the axes of W.
struct ToolForce {
  Eigen::Vector3d force_W = Eigen::Vector3d::Zero();   ///< [N]
  Eigen::Vector3d torque_W = Eigen::Vector3d::Zero();  ///< [N m]
  double depth = 0.0;  ///< length of the translation that frees the tool [m]; 0: it is free
};

/// Computes the force of separating planes that are carried by a newer pose of the tool. Keeps its buffers between calls:
/// nothing is allocated for as many planes as ProximityFinder finds.
///
/// Let u be the shortest translation that brings each ball of the tool to `distance` before its planes: the
/// displacement to the surface point of a god object [Zilles and Salisbury 1995]. The force is stiffness * u: the
/// gradient of an energy, so planes at rest return the energy that they took, and parallel planes count once. Damping
/// acts along u, in proportion to the speed at which u grows, and never pulls. Where no translation frees the tool,
/// because it pierces a sheet, there is no force.
class ContactForceFinder {
 public:
  ContactForceFinder();

  /// @param tool     that `planes` belong to
  /// @param twist_W  velocity of the tool, for damping and cue; its joints count as at rest
  ToolForce find(const PlaneSet& planes, const ToolBalls& tool, const PiecePoses& poses, const Twist& twist_W,
                 const ContactLaw& law);

 private:
  void collectNearestBalls(const PlaneSet& planes, const ToolBalls& tool, const PiecePoses& poses);
  ToolForce contact(const Twist& twist_W, const ContactLaw& law);
  void addCue(const Twist& twist_W, const ContactLaw& law, ToolForce& force) const;

  std::vector<FacingBall> facing_;   // of one plane
  std::vector<FacingBall> nearest_;  // of each plane: its nearest ball, whose center is moved to its nearest point
  std::vector<size_t> touching_;     // indices into nearest_, of the half-spaces
  std::vector<HalfSpace4> half_spaces_;
};

/// @throws InvalidInput  if a value is NaN or out of range, with what it is
void requireUsable(const ContactLaw& law);

}  // namespace sweep_guard_core
