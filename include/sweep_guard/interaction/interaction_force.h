#pragma once

#include <Eigen/Core>

#include "sweep_guard/interaction/interpenetration.h"

namespace sweep_guard_core {

/// How a workpiece answers to a piece of the tool inside of it.
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

}  // namespace sweep_guard_core
