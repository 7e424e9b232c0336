#pragma once

#include <cstdint>

#include "sweep_guard/haptics/force_renderer.h"

namespace sweep_guard_core {

/// What is between the hand and the computation of the force in an episode.
enum class Place {
  kAtTheDevice,  ///< the hand is known at once, and what is sent acts at once; tool and planes are late
  kByTheTool,    ///< the hand is known by the pose of the tool; what is sent acts at once
  kFarAway       ///< everything is late and lost at times
};

struct EpisodeOptions {
  std::uint64_t seed = 0;
  Place place = Place::kAtTheDevice;
  bool controlled = true;  ///< by PassiveDevice
  bool bounded = true;     ///< stiffness by the measured delay
  bool turns = false;      ///< the hand turns, too, and feels torques
};

/// Of the axes of translation, or of those of rotation.
struct EpisodeEnergy {
  double given = 0.0;      ///< the largest that an axis gave until any time, counted at the device [J]
  double tolerance = 0.0;  ///< [J]
  double impulse = 0.0;    ///< of the force at the device [N s], or of the torque [N m s]
};

struct EpisodeResult {
  EpisodeEnergy translation;
  EpisodeEnergy rotation;
};

/// Lets a hand, a mass with a damper that a random force moves, press a device into one to three planes for a second. A
/// hand that turns has an inertia with a damper and a random torque as well, which presses the end of a shaft into the planes.
/// Everything random is equal for equal seeds. Delays are 0 to 50 ms, up to 30 % of messages are lost, at most five in a
/// row; a message does not overtake another.
EpisodeResult runEpisode(const EpisodeOptions& options);

}  // namespace sweep_guard_core
