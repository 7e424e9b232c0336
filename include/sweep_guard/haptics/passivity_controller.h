#pragma once

// Idea: an observer adds up the energy that the device gives, E = sum of f[k-1] (x[k] - x[k-1]), and a controller limits
// the next effort to what is left of the tolerance [Hannaford and Ryu 2002]; the energy is counted with the delay of
// positions and efforts [Artigas et al. 2011]. Invariant: E at the newest known position, plus the most that the efforts
// sent since may give however the hand moves within its limits, stays below max_effort * max_speed * period. Cost: moved()
// and limit() visit only the efforts that may act after the newest known position, a few at a period of 1 ms and 1024 at
// most; nothing is allocated.

#include <array>
#include <cstddef>
#include <optional>

#include "sweep_guard/common/stamped_pose.h"

namespace sweep_guard_core {

/// Limits the effort along one axis of a device so that the device is passive: the energy that it gives to the hand never
/// exceeds what it took from it by more than a tolerance. Units are those of the device: [N], [m], [m/s], or [N m], [rad],
/// [rad/s].
///
/// After the newest known position the worst case is assumed: the longest motion within the limits, along the effort. A
/// change of the effort takes up to `output_delay` to reach the device, so the worst of all efforts that may act counts.
/// The effort is chosen so small that it can stay the same until the next position, because each change is charged. When
/// no effort is wanted any more, energy that was taken is forgotten at once, and energy that was given one second later:
/// each contact pays for itself.
class PassivityController {
 public:
  /// Limits of the device and of the hand, and the times of the loop.
  struct Options {
    double max_effort = 3.0;                               ///< > 0
    double max_speed = 0.5;                                ///< that the hand does not exceed, > 0
    double max_acceleration = 50.0;                        ///< that the hand does not exceed, > 0
    Duration period = std::chrono::milliseconds(1);        ///< of limit(), > 0
    Duration output_delay = std::chrono::milliseconds(2);  ///< until what is sent acts, at most; >= 0
  };

  explicit PassivityController(const Options& options) : options_(options) {}

  /// Observes how far the device has moved since the last call. The first call only sets the position.
  /// @param until  time of the newest position; one before that of the last call counts as this
  /// @param doubt  bound on the error of the displacement, >= 0
  void moved(double displacement, SteadyTime until, double doubt = 0.0);

  /// Returns the effort to send: the wanted one, or the nearest one that is passive. Zero before the device is known.
  /// @param now  not before that of the last call
  double limit(double wanted, SteadyTime now);

  double energy() const { return energy_; }  ///< upper bound on what the device has given [J]; negative: it took more
  double tolerance() const;                  ///< [J]

 private:
  static constexpr size_t kCapacity = 1024;

  using Sent = StampedValue<double, SteadyTime>;  // an effort
  const Sent& before(size_t newest) const { return ring_[(next_ + kCapacity - 1 - newest) % kCapacity]; }
  template <typename Visit>
  void visitActing(SteadyTime until, const Visit& visit) const;
  double seconds(SteadyTime time) const { return toSeconds(time - *known_); }
  double maxDisplacement(double after) const;
  double unknownEnergy(SteadyTime now) const;
  double maxEffort(SteadyTime now, double duration) const;
  double steadyEffort(SteadyTime now);
  void forget(double wanted, SteadyTime now);
  void remember(double effort, SteadyTime now);

  Options options_;
  std::array<Sent, kCapacity> ring_{};
  size_t next_ = 0;
  size_t count_ = 0;
  std::optional<SteadyTime> known_;  // time of the newest position
  double speed_ = 0.0;               // upper bound on the speed there
  double interval_ = 0.0;            // between the newest two positions [s]
  double cycle_ = 0.0;          // recent maximum, in this contact, of the age of a position when the next one comes [s]
  std::optional<double> held_;  // largest effort until the next position; empty: to be computed
  std::optional<SteadyTime> free_;  // since when no force is wanted
  double energy_ = 0.0;
};

}  // namespace sweep_guard_core
