#pragma once

#include <optional>
#include <vector>

#include "evaluation/closed_loop.h"
#include "evaluation/random.h"

namespace sweep_guard_evaluation {

/// How a tool is commanded away from a surface.
enum class RetreatKind : std::uint8_t {
  kNormal,     ///< along the normal of the surface
  kReverse,    ///< as it came
  kTranslate,  ///< in a random direction
  kTurn        ///< in a random direction while it turns about a random axis
};
constexpr size_t kRetreatKinds = 4;

struct Retreat {
  RetreatKind kind;
  size_t commands = 0;  ///< how many it lasted
  /// Least share of the commanded velocity that was passed on, of translation and turn the smaller one.
  double speed_kept = 1.0;
  std::optional<double> time_until_free;  ///< until the gap had grown by kFree [s]
  bool contact = false;

  static constexpr double kFree = 0.01;  ///< [m]
};

/// Returns whether a velocity brings no piece of the tool closer to the surface: no nearest point of a piece and no ball
/// that encloses it, each measured from the nearest point of the surface.
bool opensEveryGap(const LoopScene& scene, const Eigen::Isometry3d& X_MT, const sweep_guard_core::Twist& twist_W);

/// Lets the tool retreat from one place along the normal of the surface, as it came, and `random_count` times each in
/// random directions that open every gap, with and without a turn. A retreat begins at the speed 0, speeds up as the
/// robot can and lasts 0.3 s, or, as it came, 0.5 s. It ends before a command that does not open every gap: beside the
/// edge of a surface, its normal does not lead away from it. One that ends before its first command is left out.
/// @param held    where the guard held the tool
/// @param came_W  velocities of the robot at each command before, the newest last
std::vector<Retreat> retreatFrom(const ClosedLoop& held, const std::vector<sweep_guard_core::Twist>& came_W,
                                 const RobotOptions& robot, size_t random_count, Random& random);

}  // namespace sweep_guard_evaluation
