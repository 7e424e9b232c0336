#include "ros/input/articulated_tool.h"

#include <utility>

#include "common/number_text.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/kinematics/robot_motion.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::printable;
using sweep_guard_core::Time;

constexpr double kMaxDeviation = 5e-4;  // [m], of a body from a Motion
constexpr size_t kMostParts = 100;      // of a jump
constexpr size_t kMostMissing = 12;     // joints that a text lists

}  // namespace

ArticulatedTool::ArticulatedTool(const LiveParameters& live) : ArticulatedTool(live, live.initial()) {}

ArticulatedTool::ArticulatedTool(const LiveParameters& live, const Parameters& parameters)
    : live_(live),
      model_(parameters.robot),
      root_moves_(parameters.tool_source != ToolSource::kJointStates),
      root_timeout_(parameters.joint_timeout),
      fixed_(fixedPositions(model_->robot.tree, parameters.fixed_joints)),
      names_(model_->robot.tree, fixed_, parameters.joint_names),
      timeline_(model_->robot.tree, fixed_, root_moves_) {
  for (const auto& variable : model_->robot.tree.variables()) {
    const auto given = parameters.joint_timeouts.find(variable.name);
    timeouts_.push_back(given == parameters.joint_timeouts.end() ? parameters.joint_timeout : given->second);
  }
}

void ArticulatedTool::add(const std::string& publisher, const sensor_msgs::JointState& positions,
                          sweep_guard_core::SteadyTime received) try {
  names_.find(positions, named_);
  timeline_.add(publisher, fromMsg(positions.header.stamp), named_);
  noteForeign(positions);
} catch (const sweep_guard_core::SeveralPublishers& error) {
  conflict_.note(error.what(), received);
  throw;
}

void ArticulatedTool::add(Time stamp, const Eigen::Isometry3d& X_WT) { timeline_.addRoot(stamp, X_WT * model_->X_TR); }

bool ArticulatedTool::next(const std::function<std::optional<Eigen::Isometry3d>(Time)>& X_WT,
                           std::vector<sweep_guard_core::PoseWithFrames>& poses) {
  poses.clear();
  const auto stamp = next_stamp_ ? std::exchange(next_stamp_, {}) : timeline_.next(next_);
  if (!stamp) return false;
  if (!root_moves_) {
    const auto placed = X_WT(*stamp);
    if (!placed) next_stamp_ = stamp;
    if (!placed) return false;
    next_.X_WR = *placed * model_->X_TR;
  }
  if (!stamp_) {
    place(*stamp, next_, poses);
  } else {
    const auto newest = live_.get();  // with the sizes of what is attached
    const sweep_guard_core::RobotMotion motion(model_->robot.tree, newest->robot->robot.bodies, state_, next_);
    const size_t parts = motion.partsFor(kMaxDeviation, kMostParts);
    for (size_t part = 1; part <= parts; ++part) {
      const auto share = static_cast<double>(part) / static_cast<double>(parts);
      const auto passed = (*stamp - *stamp_) * static_cast<int>(part) / static_cast<int>(parts);
      place(*stamp_ + passed, part == parts ? next_ : motion.at(share), poses);
      for (size_t body = 0; body < X_WB_.size(); ++body)
        poses.back().bodies[body].deviation_bound = motion.deviationBound(body, parts);
    }
  }
  stamp_ = stamp;
  std::swap(state_, next_);
  return true;
}

void ArticulatedTool::place(Time stamp, const sweep_guard_core::RobotState& state,
                            std::vector<sweep_guard_core::PoseWithFrames>& poses) {
  bodyPoses(model_->robot.tree, model_->robot.bodies, state, X_WB_);
  sweep_guard_core::PoseWithFrames& pose = poses.emplace_back();
  pose.stamp = stamp;
  pose.X_WT = state.X_WR * model_->X_TR.inverse();
  pose.bodies.clear();
  for (const Eigen::Isometry3d& X_WB : X_WB_) pose.bodies.push_back({X_WB});
  pose.state = state;
}

void ArticulatedTool::noteForeign(const sensor_msgs::JointState& message) {
  bool is_complete = true;
  for (size_t i = 0; i < timeouts_.size(); ++i) is_complete = is_complete && !isMissing(i);
  is_complete ? foreign_.clear() : foreign_.note(names_, message.name);
}

bool ArticulatedTool::isMissing(size_t variable) const {
  return timeline_.expects(variable) && !timeline_.newestOf(variable);
}

std::string ArticulatedTool::shownJoint(size_t variable) const {
  const std::string& name = model_->robot.tree.variables()[variable].name;
  const std::string& in_messages = names_.inMessages(variable);
  const std::string renamed = in_messages == name ? "" : " ('" + printable(in_messages) + "' in messages)";
  return "'" + printable(name) + "'" + renamed;
}

std::string ArticulatedTool::missingPose() const {
  return root_moves_ && !timeline_.newestOfRoot() ? "the tool pose has not been published yet" : "";
}

std::string ArticulatedTool::missingJoints() const {
  std::vector<std::string> missing;
  std::string shown;
  for (size_t i = 0; i < timeouts_.size(); ++i) {
    if (!isMissing(i)) continue;
    if (missing.size() < kMostMissing) shown += (missing.empty() ? " " : ", ") + shownJoint(i);
    missing.push_back(model_->robot.tree.variables()[i].name);
  }
  if (missing.empty()) return "";
  if (missing.size() > kMostMissing) shown += ", ...";
  const std::string others = foreign_.text(missing);
  return (missing.size() == 1 ? "joint" + shown + " has" : "joints" + shown + " have") + " not been published yet" +
         (others.empty() ? "" : ", but joint_states has " + others + ": if they are the same, set tool/joint_names");
}

std::string ArticulatedTool::silence(Time now) const {
  const std::string pose = missingPose();
  const std::string joints = missingJoints();
  if (!pose.empty() || !joints.empty()) return pose + (pose.empty() || joints.empty() ? "" : "; ") + joints;
  const auto tell = [now](const std::string& what, Time newest) {
    return what + " has been silent for " + sweep_guard_core::inSeconds(now - newest);
  };
  const auto root = timeline_.newestOfRoot();
  if (root && now - *root > root_timeout_) return tell("the tool pose", *root);
  for (size_t i = 0; i < timeouts_.size(); ++i) {
    const auto newest = timeline_.newestOf(i);
    if (newest && now - *newest > timeouts_[i]) return tell("joint " + shownJoint(i), *newest);
  }
  return "";
}

void ArticulatedTool::placeAnew(const PoseOfFrame& X_WF, const std::function<void()>& place) {
  std::vector<Time> stamps = timeline_.rootStamps();
  if (stamp_) stamps.push_back(*stamp_);
  std::vector<std::optional<Eigen::Isometry3d>> before;
  before.reserve(stamps.size());
  for (const Time stamp : stamps) before.push_back(X_WF(stamp));
  place();
  std::vector<Eigen::Isometry3d> motions_W(stamps.size(), Eigen::Isometry3d::Identity());
  for (size_t i = 0; i < stamps.size(); ++i) {
    const auto now = X_WF(stamps[i]);
    if (before[i] && now) motions_W[i] = *now * before[i]->inverse();
  }
  if (stamp_) state_.X_WR = motions_W.back() * state_.X_WR;
  motions_W.resize(timeline_.rootStamps().size());
  timeline_.moveRoot(motions_W);
}

void ArticulatedTool::reset() {
  foreign_.clear();
  timeline_.reset();
  next_stamp_.reset();
  stamp_.reset();
}

}  // namespace sweep_guard_ros
