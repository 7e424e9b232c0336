#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "sweep_guard/common/time.h"

namespace sweep_guard_core {

/// Keeps the energy that one axis of a device gives to its hand at no more than what it took from it, and a tolerance: a
/// passivity observer and controller in the time domain [Hannaford and Ryu 2002], with the energy in delayed as it is
/// known [Artigas et al. 2011]. Units are those of the device: [N], [m], [m/s], or [N m], [rad], [rad/s].
///
/// The observer adds E = sum of f[k-1] (x[k] - x[k-1]), which is positive where the device gives energy. Of what happened
/// after the newest known position, the worst is assumed: all the motion there can be, with the force. Where the force
/// changed within the time that it needs to the device, the worst of those that may have acted counts. The controller
/// makes the next force so small that the sum stays below the tolerance max_effort * max_speed * period, however the hand
/// moves within its limits, and that it need not change before the next position: what changes is charged. Energy that was
/// taken is forgotten when no force is wanted any more, energy that was given a second later: each contact pays for itself.
class PassivityController {
 public:
  struct Options {
    double max_effort = 3.0;                               ///< > 0
    double max_speed = 0.5;                                ///< that the hand does not exceed, > 0
    double max_acceleration = 50.0;                        ///< that the hand does not exceed, > 0
    Duration period = std::chrono::milliseconds(1);        ///< of limit(), > 0
    Duration output_delay = std::chrono::milliseconds(2);  ///< until what is sent acts, at most; >= 0
  };

  explicit PassivityController(const Options& options) : options_(options) {}

  /// Observes that the device has moved, since the last call. The first call only tells where it is.
  /// @param until  time of the newest position; one before that of the last call counts as this
  /// @param doubt  by how much the displacement may be another one, >= 0
  void moved(double displacement, SteadyTime until, double doubt = 0.0);

  /// Returns the effort to send: the wanted one, or the nearest one that is passive. Zero before the device is known.
  /// @param now  not before that of the last call
  double limit(double wanted, SteadyTime now);

  double energy() const { return energy_; }  ///< that the device has given, at most [J]; negative: it took more
  double tolerance() const;                  ///< [J]

 private:
  static constexpr size_t kCapacity = 1024;

  struct Sent {
    double effort;
    SteadyTime at;
  };
  const Sent& before(size_t newest) const { return ring_[(next_ + kCapacity - 1 - newest) % kCapacity]; }
  template <typename Visit>
  void visitActing(SteadyTime until, const Visit& visit) const;
  double seconds(SteadyTime time) const { return toSeconds(time - *known_); }
  double longestWay(double after) const;
  double unknownEnergy(SteadyTime now) const;
  double most(SteadyTime now, double lasts) const;
  double steady(SteadyTime now);
  void forget(double wanted, SteadyTime now);
  void remember(double effort, SteadyTime now);

  Options options_;
  std::array<Sent, kCapacity> ring_{};
  size_t next_ = 0;
  size_t count_ = 0;
  std::optional<SteadyTime> known_;  // time of the newest position
  double speed_ = 0.0;               // the largest it may have had there
  double interval_ = 0.0;            // from the position before [s]
  double cycle_ = 0.0;              // age of a position when the next one comes, the longest lately in this contact [s]
  std::optional<double> held_;      // the most that may be sent until the next position; empty: to be computed
  std::optional<SteadyTime> free_;  // since when no force is wanted
  double energy_ = 0.0;
};

}  // namespace sweep_guard_core
