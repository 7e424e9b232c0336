#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "scenes.h"
#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_core {

/// Returns an arm of two links of 0.4 m in the plane of x and y, at x from their joints on: `upper` and `fore`.
/// @param at_upper  further pieces of the upper link
inline std::shared_ptr<const Robot> planarArm(const JointVariable& elbow = {"elbow"},
                                              const std::vector<ConvexPiece>& at_upper = {}) {
  std::vector<TreeLink> links(2);
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
  for (size_t i = 0; i < 2; ++i) {
    links[i].name = i == 0 ? "upper" : "fore";
    links[i].type = JointType::kRevolute;
    links[i].variable = i;
    pieces.push_back({i, {{links[i].name, ConvexShape::box({0.2, 0.02, 0.02}).placed(along(0.2))}}});
  }
  links[1].parent = 0;
  links[1].X_PJ.translation().x() = 0.4;
  pieces[0].second.insert(pieces[0].second.end(), at_upper.begin(), at_upper.end());
  return std::make_shared<const Robot>(robotOf({{{"shoulder"}, elbow}, links}, pieces));
}

}  // namespace sweep_guard_core
