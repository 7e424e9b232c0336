#include "ros/tool/robot_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::JointsBesideTree;
using sweep_guard_core::JointType;
using sweep_guard_core::JointVariable;
using sweep_guard_core::KinematicTree;
using sweep_guard_core::MimicJoint;
using sweep_guard_core::TreeLink;

constexpr size_t kMaxMimicDepth = 16;
constexpr double kMaxAngle = 1e4;  // [rad], of a continuous joint

// From the root of the robot down to the link.
using Joints = std::vector<const urdf::Joint*>;

Joints jointsAbove(const RobotDescription& robot, const urdf::Link& link) {
  Joints joints;
  for (const urdf::Link* at = &link; at->parent_joint; at = robot.link(joints.back()->parent_link_name)) {
    joints.push_back(at->parent_joint.get());
  }
  std::reverse(joints.begin(), joints.end());
  return joints;
}

// Joints above all links move all of them alike.
void forgetShared(std::vector<Joints>& paths) {
  size_t shared = paths.front().size();
  for (const Joints& path : paths) {
    const auto apart = std::mismatch(path.begin(), path.end(), paths.front().begin(), paths.front().end());
    shared = std::min(shared, static_cast<size_t>(apart.first - path.begin()));
  }
  for (Joints& path : paths) path.erase(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(shared));
}

bool hasLimits(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC;
}

std::pair<double, double> limitsOf(const urdf::Joint& joint) {
  if (!hasLimits(joint)) return {-kMaxAngle, kMaxAngle};
  const bool usable = joint.limits && std::isfinite(joint.limits->lower) && std::isfinite(joint.limits->upper) &&
                      joint.limits->lower <= joint.limits->upper;
  if (!usable)
    throw InvalidInput("joint '" + joint.name + "': its limits are missing, or the lower is above the upper");
  return {joint.limits->lower, joint.limits->upper};
}

Eigen::Vector3d axisOf(const urdf::Joint& joint) {
  const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
  const double length = axis.stableNorm();
  if (!(length > 1e-6 && length < 1e6)) throw InvalidInput("joint '" + joint.name + "': its axis must not be 0");
  return axis / length;
}

Eigen::Isometry3d originOf(const urdf::Joint& joint) {
  try {
    return fromUrdf(joint.parent_to_joint_origin_transform);
  } catch (const InvalidInput& error) {
    throw InvalidInput("joint '" + joint.name + "': " + error.what());
  }
}

void requireSupported(const urdf::Joint& joint) {
  if (hasLimits(joint) || joint.type == urdf::Joint::CONTINUOUS) return;
  throw InvalidInput("joint '" + joint.name +
                     "' is within the tool: only fixed, revolute, continuous and prismatic joints are supported there");
}

std::string mimicEachOther(Joints::const_iterator first, Joints::const_iterator end) {
  if (end - first == 1) return "joint '" + (*first)->name + "' mimics itself";
  std::string names = "'" + (*first)->name + "'";
  for (auto each = first + 1; each != end; ++each) names += (each + 1 == end ? " and '" : ", '") + (*each)->name + "'";
  return "joints " + names + " mimic each other: one of them has to lead";
}

// @param chain  each but the first is mimicked by the one before
const urdf::Joint& followedBy(const RobotDescription& robot, const Joints& chain) {
  const urdf::Joint& joint = *chain.back();
  const std::string& name = joint.mimic->joint_name;
  const urdf::Joint* const followed = robot.joint(name);
  const auto refusal = [&](const char* why) {
    return InvalidInput("joint '" + joint.name + "' mimics '" + name + "', which " + why);
  };
  if (followed == nullptr) throw refusal("does not exist");
  const auto first = std::find_if(chain.begin(), chain.end(), [&](const auto* each) { return each->name == name; });
  if (first != chain.end()) throw InvalidInput(mimicEachOther(first, chain.end()));
  if (chain.size() > kMaxMimicDepth) throw refusal("mimics too many others");
  return *followed;
}

std::string shown(double lower, double upper) {
  std::ostringstream text;
  text << lower << " to " << upper;
  return text.str();
}

class TreeBuilder {
 public:
  explicit TreeBuilder(const RobotDescription& robot) : robot_(robot) {}

  // Returns the index of the link at the end of the path.
  size_t add(const Joints& path) {
    size_t parent = TreeLink::kRoot;
    for (const urdf::Joint* joint : path) {
      const auto [place, is_new] = places_.emplace(joint, links_.size());
      if (is_new) links_.push_back(linkBelow(*joint, parent));
      parent = place->second;
    }
    return parent;
  }

  KinematicTree tree() {
    std::map<std::string, MimicJoint> mimics = mimicsOfVariables();
    return {std::move(variables_), std::move(links_), std::move(mimics)};
  }

 private:
  TreeLink linkBelow(const urdf::Joint& joint, size_t parent) {
    TreeLink link;
    link.name = joint.child_link_name;
    link.joint = joint.name;
    link.parent = parent;
    link.X_PJ = originOf(joint);
    if (joint.type == urdf::Joint::FIXED) return link;
    follow(joint, link);
    link.type = joint.type == urdf::Joint::PRISMATIC ? JointType::kPrismatic : JointType::kRevolute;
    link.axis_J = axisOf(joint);
    return link;
  }

  void follow(const urdf::Joint& joint, TreeLink& link) {
    Joints chain{&joint};
    requireSupported(joint);
    while (chain.back()->mimic) {
      chain.push_back(&followedBy(robot_, chain));
      requireSupported(*chain.back());
    }
    if (indexOf(*chain.back()) == variables_.size()) addVariable(*chain.back());
    static_cast<MimicJoint&>(link) = *mimicOf(joint);
  }

  // Empty: the joint mimics no variable. One that mimics nothing is the variable itself.
  std::optional<MimicJoint> mimicOf(const urdf::Joint& joint) const {
    MimicJoint mimic;
    const urdf::Joint* leader = &joint;
    for (size_t depth = 0; leader != nullptr && leader->mimic && depth < kMaxMimicDepth; ++depth) {
      mimic.offset += mimic.multiplier * leader->mimic->offset;
      mimic.multiplier *= leader->mimic->multiplier;
      leader = robot_.joint(leader->mimic->joint_name);
    }
    if (leader == nullptr || leader->mimic) return {};
    mimic.variable = indexOf(*leader);
    return mimic.variable < variables_.size() ? std::optional(mimic) : std::nullopt;
  }

  // Of the whole robot. What is wrong with a joint that moves none of the links does not matter.
  std::map<std::string, MimicJoint> mimicsOfVariables() const {
    std::map<std::string, MimicJoint> mimics;
    for (const urdf::Link* link : RobotDescription::subtree(robot_.root())) {
      const auto& joint = link->parent_joint;
      if (!joint || !joint->mimic || joint->type == urdf::Joint::FIXED) continue;
      const auto mimic = mimicOf(*joint);
      if (mimic && std::isfinite(mimic->multiplier) && std::isfinite(mimic->offset)) mimics[joint->name] = *mimic;
    }
    return mimics;
  }

  // As many as there are: none has its name.
  size_t indexOf(const urdf::Joint& joint) const {
    const auto same = [&](const JointVariable& variable) { return variable.name == joint.name; };
    return static_cast<size_t>(std::find_if(variables_.begin(), variables_.end(), same) - variables_.begin());
  }

  void addVariable(const urdf::Joint& joint) {
    const auto [lower, upper] = limitsOf(joint);
    const double velocity = joint.limits ? joint.limits->velocity : 0.0;
    variables_.push_back({joint.name, lower, upper, joint.type == urdf::Joint::CONTINUOUS, velocity});
  }

  const RobotDescription& robot_;
  std::vector<JointVariable> variables_;
  std::vector<TreeLink> links_;
  std::map<const urdf::Joint*, size_t> places_;
};

void checkGiven(const RobotDescription& robot, const KinematicTree& tree, const std::string& name, double position) {
  const urdf::Joint* const joint = robot.joint(name);
  if (joint == nullptr) throw InvalidInput("tool/joints names '" + name + "', which is not a joint of the robot");
  if (!std::isfinite(position)) throw InvalidInput("the position of joint '" + name + "' is not finite");
  const auto mimic = tree.mimics().find(name);
  if (mimic == tree.mimics().end()) return;
  throw InvalidInput("joint '" + name + "' mimics '" + tree.variables()[mimic->second.variable].name +
                     "': set that joint in tool/joints");
}

void checkLimits(const KinematicTree& tree, const std::vector<double>& positions) {
  for (size_t i = 0; i < positions.size(); ++i) {
    const JointVariable& joint = tree.variables()[i];
    if (positions[i] >= joint.lower && positions[i] <= joint.upper) continue;  // false for NaN
    std::ostringstream text;
    text << "tool/joints/" << joint.name << " is " << positions[i] << ", beyond the joint's limits, "
         << shown(joint.lower, joint.upper);
    throw InvalidInput(text.str());
  }
}

// Adds a joint, and those that it mimics.
void addWithLeaders(const RobotDescription& robot, const urdf::Joint* joint, std::set<std::string>& names) {
  bool is_new = names.insert(joint->name).second;
  while (is_new && joint != nullptr && joint->mimic) {
    is_new = names.insert(joint->mimic->joint_name).second;
    joint = robot.joint(joint->mimic->joint_name);
  }
}

// Of the joints that move the link, and of those that they mimic.
std::set<std::string> namesOfMovers(const RobotDescription& robot, const urdf::Link& link) {
  std::set<std::string> names;
  for (const urdf::Joint* joint : jointsAbove(robot, link)) {
    if (joint->type != urdf::Joint::FIXED) addWithLeaders(robot, joint, names);
  }
  return names;
}

JointsBesideTree jointsBeside(const RobotDescription& robot, const urdf::Link& frame, const KinematicTree& tree) {
  JointsBesideTree beside{namesOfMovers(robot, frame), {}};
  std::set<std::string> known = beside.of_frame;
  for (const JointVariable& variable : tree.variables()) known.insert(variable.name);
  for (const auto& mimic : tree.mimics()) known.insert(mimic.first);
  for (const urdf::Link* link : RobotDescription::subtree(robot.root())) {
    if (link->parent_joint && known.count(link->parent_joint->name) == 0)
      beside.elsewhere.insert(link->parent_joint->name);
  }
  return beside;
}

}  // namespace

RobotTree treeOf(const RobotDescription& robot, const urdf::Link& frame, const std::vector<const urdf::Link*>& links) {
  std::vector<Joints> paths{jointsAbove(robot, frame)};
  for (const urdf::Link* link : links) paths.push_back(jointsAbove(robot, *link));
  forgetShared(paths);
  TreeBuilder builder(robot);
  std::vector<size_t> ends;
  ends.reserve(paths.size());
  for (const Joints& path : paths) ends.push_back(builder.add(path));
  KinematicTree tree = builder.tree();
  JointsBesideTree beside = jointsBeside(robot, frame, tree);
  return {std::move(tree), ends.front(), {ends.begin() + 1, ends.end()}, std::move(beside)};
}

std::vector<double> positionsOf(const RobotDescription& robot, const KinematicTree& tree,
                                const std::map<std::string, double>& given) {
  for (const auto& [name, position] : given) checkGiven(robot, tree, name, position);
  std::vector<double> positions = tree.nearestToZero();
  for (size_t i = 0; i < positions.size(); ++i) {
    const auto found = given.find(tree.variables()[i].name);
    if (found != given.end()) positions[i] = found->second;
  }
  checkLimits(tree, positions);
  return positions;
}

size_t variableNamed(const KinematicTree& tree, const std::string& joint) {
  std::string known;
  for (size_t i = 0; i < tree.variables().size(); ++i) {
    if (tree.variables()[i].name == joint) return i;
    known += (i == 0 ? "" : ", ") + tree.variables()[i].name;
  }
  if (const auto mimic = tree.mimics().find(joint); mimic != tree.mimics().end()) {
    const std::string& leader = tree.variables()[mimic->second.variable].name;
    throw InvalidInput("joint '" + joint + "' mimics '" + leader + "' and need not be published: name '" + leader +
                       "'");
  }
  throw InvalidInput("no joint '" + sweep_guard_core::printable(joint) +
                     "' moves the tool's links: " + (known.empty() ? "none does" : "those that do are " + known));
}

}  // namespace sweep_guard_ros
