#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "scenes.h"
#include "sweep_guard/kinematics/robot_path.h"

namespace sweep_guard_core {

/// Two links with a piece each, alike but for their names. Each has a joint at the root.
struct TwoLinks {
  TwoLinks(const std::string& first, const std::string& second, JointType joint, const ConvexShape& piece_L) {
    for (const std::string& name : {first, second}) {
      const size_t index = links.size();
      TreeLink& link = links.emplace_back();
      link.name = name;
      link.type = joint;
      link.variable = index;
      pieces.push_back({index, {{name, piece_L}}});
    }
  }

  std::shared_ptr<const Robot> robot() const {
    return std::make_shared<const Robot>(robotOf({variables, links}, pieces));
  }

  std::vector<JointVariable> variables = {{"one"}, {"two"}};
  std::vector<TreeLink> links;
  std::vector<std::pair<size_t, std::vector<ConvexPiece>>> pieces;
};

/// Returns two links of 0.4 m in the plane of x and y, at x from their joints on: `upper`, which `shoulder` moves, and `fore`.
inline TwoLinks planarArm(const JointVariable& elbow = {"elbow"}) {
  TwoLinks arm("upper", "fore", JointType::kRevolute, ConvexShape::box({0.2, 0.02, 0.02}).placed(along(0.2)));
  arm.variables = {{"shoulder"}, elbow};
  arm.links[1].parent = 0;
  arm.links[1].X_PJ = along(0.4);
  return arm;
}

}  // namespace sweep_guard_core
