#include "sweep_guard/kinematics/joint_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <sstream>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"

namespace sweep_guard_core {
namespace {

constexpr double kShareOfRange = 1e-3;    // of a joint, which sensors may be wrong by
constexpr double kMaxFrameMotion = 1e-6;  // [rad or m]
constexpr double kWorthSaying = 1e-9;     // [rad or m]
constexpr double kTurn = 2.0 * M_PI;
constexpr size_t kMaxListed = 20;

std::string number(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

std::string listed(const std::vector<std::string>& texts, const std::string& separator) {
  std::string list;
  for (size_t i = 0; i < std::min(texts.size(), kMaxListed); ++i) list += (i == 0 ? "" : separator) + texts[i];
  if (texts.size() > kMaxListed) list += separator + "and " + std::to_string(texts.size() - kMaxListed) + " more";
  return list;
}

std::string quoted(const std::string& joint) { return "'" + printable(joint) + "'"; }

std::optional<size_t> variableOf(const KinematicTree& tree, const std::string& joint) {
  const auto& variables = tree.variables();
  const auto same = [&](const JointVariable& variable) { return variable.name == joint; };
  const auto found = std::find_if(variables.begin(), variables.end(), same);
  return found == variables.end() ? std::nullopt : std::optional(static_cast<size_t>(found - variables.begin()));
}

double tolerance(const JointVariable& variable) {
  const double range = variable.continuous ? kTurn : variable.upper - variable.lower;
  return std::isfinite(range) ? kShareOfRange * range : 0.0;
}

std::string limitsOf(const JointVariable& variable) { return number(variable.lower) + " to " + number(variable.upper); }

// A position of a joint at a point, and how far it is from where it has to be; infinite for NaN.
struct Worst {
  double excess = -1.0;
  double position = 0.0;
  size_t point = 0;
};

class PlanReader {
 public:
  PlanReader(const KinematicTree& tree, const JointsBesideTree& beside, const std::vector<double>& unnamed,
             const JointPlan& plan)
      : tree_(tree), beside_(beside), plan_(plan), positions_(plan.points.size(), unnamed) {
    assert(unnamed.size() == tree.variables().size());
  }

  PlannedPositions read() {
    readNames();
    readPoints();
    for (size_t joint = 0; joint < plan_.joints.size(); ++joint) takeVariable(joint);
    for (size_t joint = 0; joint < plan_.joints.size(); ++joint) checkRest(joint);
    if (!objections_.empty()) throw InvalidInput(listed(objections_, "; "));
    if (!passed_over_.empty())
      remarks_.push_back("passed over, for they do not move the tool: " + listed(passed_over_, ", "));
    return {std::move(positions_), listed(remarks_, "; ")};
  }

 private:
  void readNames() {
    std::vector<std::string> unknown;
    std::set<std::string> named;
    bool any_counts = plan_.joints.empty() || tree_.variables().empty();
    for (const std::string& joint : plan_.joints) {
      if (!named.insert(joint).second) objections_.push_back("joint_names has " + quoted(joint) + " twice");
      if (!hasJoint(tree_, beside_, joint)) unknown.push_back(quoted(joint));
      any_counts = any_counts || beside_.elsewhere.count(joint) == 0;
    }
    std::vector<std::string> variables;
    for (const JointVariable& variable : tree_.variables()) variables.push_back(variable.name);
    const std::string movers =
        "the tool's links are moved by " + (variables.empty() ? "none" : listed(variables, ", "));
    if (!unknown.empty()) {
      objections_.push_back("the robot description has no joint " + listed(unknown, ", ") +
                            ": leave it out, or correct its name; " + movers);
    } else if (!any_counts) {
      objections_.push_back("joint_names has no joint of the tool, which would be tested at rest: " + movers);
    }
  }

  void readPoints() {
    std::vector<size_t> wrong;
    for (size_t point = 0; point < plan_.points.size(); ++point) {
      if (plan_.points[point].size() != plan_.joints.size()) wrong.push_back(point);
    }
    if (wrong.empty()) return;
    const size_t count = plan_.points[wrong.front()].size();
    objections_.push_back("point " + std::to_string(wrong.front()) + " has " + std::to_string(count) + " positions" +
                          (count == 0 ? " (velocities alone cannot be swept)" : "") + ", but joint_names has " +
                          std::to_string(plan_.joints.size()) + " joints" +
                          (wrong.size() == 1 ? "" : "; so do " + std::to_string(wrong.size() - 1) + " other points"));
  }

  // Excess: by how much a position is out of place, >= 0, or NaN.
  template <typename Excess>
  Worst worst(size_t joint, const Excess& excess) const {
    Worst worst;
    for (size_t point = 0; point < plan_.points.size(); ++point) {
      if (plan_.points[point].size() != plan_.joints.size()) continue;
      const double position = plan_.points[point][joint];
      const double here = std::isfinite(position) ? excess(point, position) : HUGE_VAL;
      if (here > worst.excess) worst = {here, position, point};
    }
    return worst;
  }

  std::string at(size_t joint, const Worst& worst) const {
    return "joint " + quoted(plan_.joints[joint]) + " is at " + number(worst.position) + " in point " +
           std::to_string(worst.point);
  }

  void takeVariable(size_t joint) {
    const auto index = variableOf(tree_, plan_.joints[joint]);
    if (!index) return;
    const JointVariable& variable = tree_.variables()[*index];
    const Worst beyond = worst(joint, [&](size_t point, double position) {
      positions_[point][*index] = position;
      return std::max({0.0, position - variable.upper, variable.lower - position});
    });
    const std::string limits = at(joint, beyond) + ", but its limits are " + limitsOf(variable);
    if (beyond.excess > tolerance(variable)) {
      objections_.push_back(limits);
    } else if (beyond.excess > 0.0) {
      remarks_.push_back(limits + ": swept as it is");
    }
  }

  // After all variables were taken.
  void checkRest(size_t joint) {
    const std::string& name = plan_.joints[joint];
    const auto mimic = tree_.mimics().find(name);
    if (beside_.of_frame.count(name) != 0) requireStill(joint);
    if (mimic != tree_.mimics().end()) requireFollowing(joint, mimic->second);
    if (beside_.elsewhere.count(name) != 0) passed_over_.push_back(printable(name));
  }

  void requireStill(size_t joint) {
    std::optional<double> first;
    const Worst moved = worst(joint, [&](size_t, double position) {
      if (!first) first = position;
      return std::abs(position - *first);
    });
    if (moved.excess > kMaxFrameMotion) {
      objections_.push_back(
          at(joint, moved) + (first ? ", and at " + number(*first) + " before" : "") +
          ", but it moves tool_frame, which stays at tool_pose: test the parts of the plan in which it "
          "stays, each with its tool_pose");
    } else if (!variableOf(tree_, plan_.joints[joint])) {
      passed_over_.push_back(printable(plan_.joints[joint]) + " (it moves tool_frame, and stays)");
    }
  }

  void requireFollowing(size_t joint, const MimicJoint& follower) {
    const JointVariable& leader = tree_.variables()[follower.variable];
    const Worst off = worst(
        joint, [&](size_t point, double position) { return std::abs(position - follower.at(positions_[point])); });
    if (off.excess < 0.0) return;
    const std::string put = at(joint, off) + ", but '" + leader.name + "', which it mimics" +
                            (isNamed(leader.name) ? "" : " and is not named") + ", puts it at " +
                            number(follower.at(positions_[off.point]));
    if (off.excess > std::abs(follower.multiplier) * tolerance(leader)) {
      objections_.push_back(put);
    } else if (off.excess > kWorthSaying) {
      remarks_.push_back(put + ": swept there");
    }
  }

  bool isNamed(const std::string& joint) const {
    return std::count(plan_.joints.begin(), plan_.joints.end(), joint) != 0;
  }

  const KinematicTree& tree_;
  const JointsBesideTree& beside_;
  const JointPlan& plan_;
  std::vector<std::vector<double>> positions_;
  std::vector<std::string> objections_;
  std::vector<std::string> remarks_;
  std::vector<std::string> passed_over_;
};

}  // namespace

bool hasJoint(const KinematicTree& tree, const JointsBesideTree& beside, const std::string& joint) {
  return variableOf(tree, joint) || tree.mimics().count(joint) != 0 || beside.of_frame.count(joint) != 0 ||
         beside.elsewhere.count(joint) != 0;
}

PlannedPositions planned(const KinematicTree& tree, const JointsBesideTree& beside, const std::vector<double>& unnamed,
                         const JointPlan& plan) {
  return PlanReader(tree, beside, unnamed, plan).read();
}

}  // namespace sweep_guard_core
