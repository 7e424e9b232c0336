#pragma once

namespace sweep_guard_core {

/// A device that is sampled and driven with a period, and the damper that is simulated with it.
struct SampledDevice {
  double damping = 2.0;          ///< of the device and the hand that holds it [N s/m], >= 0
  double virtual_damping = 0.0;  ///< that is simulated [N s/m], >= 0
  double period = 0.001;         ///< [s], > 0
};

/// Returns the largest stiffness [N/m] of a simulated wall that such a device can be coupled to without gaining energy from
/// it in a linear model: K < (b - B) / (T/2 + delay), 0 if B >= b. Without delay this is the condition of Colgate and
/// Schenkel (1997), b > K T / 2 + B. With a delay of m periods the term of the spring grows by the maximum 2 m + 1 of
/// Dirichlet's kernel, b > K (T/2 + m T) + B; doc/haptics.md derives it. The denominator is that of Gil et al. (2009).
/// @param delay  from a position of the device to the force that answers to it, without the hold of a period [s], >= 0
double maxStiffness(const SampledDevice& device, double delay);

/// Returns the damping [N s/m] against the motion of a point that a force acts on with a lever about the device, where each
/// force F comes with a torque F * lever: with the dampings b and c of translation and rotation, a spring K and a damper B at that
/// point gain no energy if (K (T/2 + delay) + B) (1/b + lever^2/c) < 1, so 1 / (1/b + lever^2/c) stands for b. For one contact.
/// @param damping       of translation [N s/m], > 0
/// @param turn_damping  of rotation [N m s/rad], > 0
/// @param lever         [m]
double dampingWithLever(double damping, double turn_damping, double lever);

}  // namespace sweep_guard_core
