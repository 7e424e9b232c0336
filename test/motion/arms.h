#pragma once

// Two arms by the numbers of their descriptions (ur_description: UR5; franka_description: Panda with hand), links as capsules. Of the
// Panda, the capsules are those of its description; all are cut into short pieces, as doc/motion.md advises.

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "motion/capsule_distance.h"
#include "sweep_guard/geometry/tool.h"
#include "sweep_guard/kinematics/kinematic_tree.h"

namespace sweep_guard_core {

/// A robot whose links are capsules. Each link is a body.
struct CapsuleArm {
  std::string name;
  std::shared_ptr<const KinematicTree> tree;
  std::vector<std::vector<Capsule>> capsules;  ///< of each link, in its frame
  std::vector<Tool> bodies;                    ///< of each link
  std::vector<double> home;                    ///< [rad]
  Eigen::Vector3d tip_L;                       ///< in the frame of the last link [m]
};

/// A joint about z, and the capsules of the link that it moves.
struct ArmJoint {
  Eigen::Vector3d xyz;
  Eigen::Vector3d rpy;
  std::vector<Capsule> capsules;
};

/// Returns a capsule as some that lie end to end, no axis of which is longer than 50 mm.
inline std::vector<Capsule> cut(const Capsule& capsule) {
  const double count = std::ceil((capsule.to - capsule.from).norm() / 0.05);
  const Eigen::Vector3d step = (capsule.to - capsule.from) / count;
  std::vector<Capsule> pieces;
  for (double i = 0.0; i < count; i += 1.0)
    pieces.push_back({capsule.from + i * step, capsule.from + (i + 1.0) * step, capsule.radius});
  return pieces;
}

inline CapsuleArm armOf(const std::string& name, const std::vector<ArmJoint>& joints, const std::vector<double>& home,
                        const Eigen::Vector3d& tip_L) {
  CapsuleArm arm{name, nullptr, {}, {}, home, tip_L};
  std::vector<JointVariable> variables;
  std::vector<TreeLink> links;
  for (const ArmJoint& joint : joints) {
    TreeLink link;
    link.variable = links.size();
    link.name = name + "_link" + std::to_string(links.size() + 1);
    link.joint = name + "_joint" + std::to_string(links.size() + 1);
    if (!links.empty()) link.parent = links.size() - 1;
    link.type = JointType::kRevolute;
    link.X_PJ.translation() = joint.xyz;
    link.X_PJ.linear() = (Eigen::AngleAxisd(joint.rpy.z(), Eigen::Vector3d::UnitZ()) *
                          Eigen::AngleAxisd(joint.rpy.y(), Eigen::Vector3d::UnitY()) *
                          Eigen::AngleAxisd(joint.rpy.x(), Eigen::Vector3d::UnitX()))
                             .toRotationMatrix();
    variables.push_back({link.joint});
    links.push_back(link);
    arm.capsules.emplace_back();
    std::vector<ConvexPiece> pieces;
    for (const Capsule& whole : joint.capsules) {
      for (const Capsule& capsule : cut(whole)) {
        arm.capsules.back().push_back(capsule);
        pieces.push_back({link.name, ConvexShape::hull({capsule.from, capsule.to}).padded(capsule.radius)});
      }
    }
    arm.bodies.emplace_back(pieces);
  }
  arm.tree = std::make_shared<const KinematicTree>(KinematicTree(variables, links));
  return arm;
}

inline CapsuleArm ur5() {
  const double right = std::acos(0.0);
  return armOf("ur5",
               {{{0.0, 0.0, 0.089159}, {0.0, 0.0, 0.0}, {{{0.0, 0.0, 0.0}, {0.0, -0.07, 0.0}, 0.06}}},
                {{0.0, 0.0, 0.0}, {right, 0.0, 0.0}, {{{0.0, 0.0, 0.136}, {-0.425, 0.0, 0.136}, 0.055}}},
                {{-0.425, 0.0, 0.0}, {0.0, 0.0, 0.0}, {{{0.0, 0.0, 0.0165}, {-0.392, 0.0, 0.0165}, 0.045}}},
                {{-0.39225, 0.0, 0.10915}, {0.0, 0.0, 0.0}, {{{0.0, 0.0, -0.06}, {0.0, 0.0, 0.0}, 0.04}}},
                {{0.0, -0.09465, 0.0}, {right, 0.0, 0.0}, {{{0.0, 0.0, -0.05}, {0.0, 0.0, 0.0}, 0.04}}},
                {{0.0, 0.0823, 0.0}, {-right, 0.0, 0.0}, {{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.1}, 0.03}}}},
               {0.0, -1.2, 1.6, -1.9, -1.57, 0.0}, {0.0, 0.0, 0.1});
}

inline CapsuleArm panda() {
  const double right = std::acos(0.0);
  const double diagonal = std::sqrt(0.5);
  const auto across = [&](double z, double radius) {  // of the hand, which is turned by -45 degrees about z
    return Capsule{
        {0.05 * diagonal, 0.05 * diagonal, 0.107 + z}, {-0.05 * diagonal, -0.05 * diagonal, 0.107 + z}, radius};
  };
  return armOf("panda",
               {{{0.0, 0.0, 0.333}, {0.0, 0.0, 0.0}, {{{0.0, 0.0, -0.333}, {0.0, 0.0, -0.05}, 0.09}}},
                {{0.0, 0.0, 0.0}, {-right, 0.0, 0.0}, {{{0.0, 0.0, -0.06}, {0.0, 0.0, 0.06}, 0.09}}},
                {{0.0, -0.316, 0.0}, {right, 0.0, 0.0}, {{{0.0, 0.0, -0.22}, {0.0, 0.0, -0.07}, 0.09}}},
                {{0.0825, 0.0, 0.0}, {right, 0.0, 0.0}, {{{0.0, 0.0, -0.06}, {0.0, 0.0, 0.06}, 0.09}}},
                {{-0.0825, 0.384, 0.0},
                 {-right, 0.0, 0.0},
                 {{{0.0, 0.0, -0.31}, {0.0, 0.0, -0.21}, 0.09}, {{0.0, 0.08, -0.2}, {0.0, 0.08, -0.06}, 0.055}}},
                {{0.0, 0.0, 0.0}, {right, 0.0, 0.0}, {{{0.0, 0.0, -0.07}, {0.0, 0.0, 0.01}, 0.08}}},
                {{0.088, 0.0, 0.0},
                 {right, 0.0, 0.0},
                 {{{0.0, 0.0, -0.06}, {0.0, 0.0, 0.08}, 0.07}, across(0.04, 0.07), across(0.1, 0.05)}}},
               {0.0, -0.4, 0.0, -2.0, 0.0, 1.6, 0.8}, {0.0, 0.0, 0.21});
}

}  // namespace sweep_guard_core
