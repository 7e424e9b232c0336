#include "ros/service/check_trajectory.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "sweep_guard/common/error.h"
#include "sweep_guard/kinematics/joint_plan.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckTrajectory;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::JointPlan;
using sweep_guard_core::PathResult;
using sweep_guard_core::PlannedPositions;
using sweep_guard_core::RobotPath;
using sweep_guard_core::RobotState;

constexpr size_t kMaxPoints = 1024;
constexpr double kMaxDeviation = 5e-4;  // [m], of a link within a sweep

const RobotModel& robotOf(const Parameters& parameters) {
  if (parameters.robot) return *parameters.robot;
  throw InvalidInput("no joints: " + parameters.why_no_robot);
}

// Returns the name in the robot description of a joint that may be named as on `joint_states`.
std::string nameInModel(const std::string& joint, const Parameters& parameters) {
  const auto found = parameters.joint_names.find(joint);
  if (found == parameters.joint_names.end() || found->second == joint) return joint;
  if (!hasJoint(parameters.robot->robot.tree, parameters.robot->beside, joint)) return found->second;
  throw InvalidInput("'" + joint + "' is a joint of the robot description, and tool/joint_names says that it is '" +
                     found->second + "': a plan with this name could mean either");
}

JointPlan planOf(const trajectory_msgs::JointTrajectory& trajectory, const Parameters& parameters) {
  JointPlan plan{namesInModel(trajectory.joint_names, parameters), {}};
  for (const auto& point : trajectory.points) plan.points.push_back(point.positions);
  return plan;
}

PlannedPositions plannedBy(const trajectory_msgs::JointTrajectory& trajectory, const Parameters& parameters) {
  if (trajectory.points.empty()) throw InvalidInput("trajectory has no points: send at least one");
  if (trajectory.points.size() > kMaxPoints) {
    throw InvalidInput("trajectory has " + std::to_string(trajectory.points.size()) + " points: send at most 1024");
  }
  const RobotModel& model = robotOf(parameters);
  return planned(model.robot.tree, model.beside, model.positions, planOf(trajectory, parameters));
}

// In the frame of the tool.
std::vector<RobotState> statesOf(const std::vector<std::vector<double>>& all, const RobotModel& model) {
  std::vector<RobotState> states;
  states.reserve(all.size());
  for (const std::vector<double>& positions : all) states.push_back({model.X_TR, positions});
  return states;
}

std::vector<Eigen::Isometry3d> moved(const Eigen::Isometry3d& X_MT, const std::vector<Eigen::Isometry3d>& X_TB) {
  std::vector<Eigen::Isometry3d> X_MB;
  X_MB.reserve(X_TB.size());
  for (const Eigen::Isometry3d& X : X_TB) X_MB.push_back(X_MT * X);
  return X_MB;
}

// Adds what one body meets of a workpiece to what other bodies meet.
void add(sweep_guard::ObjectContacts&& body, std::vector<sweep_guard::ObjectContacts>& objects) {
  const auto same = [&](const auto& object) { return object.mesh_id == body.mesh_id; };
  const auto known = std::find_if(objects.begin(), objects.end(), same);
  if (known == objects.end()) {
    objects.push_back(std::move(body));
    return;
  }
  std::vector<std::uint32_t> triangles;
  std::set_union(known->triangles.begin(), known->triangles.end(), body.triangles.begin(), body.triangles.end(),
                 std::back_inserter(triangles));
  known->triangles = std::move(triangles);
  known->impacts.insert(known->impacts.end(), body.impacts.begin(), body.impacts.end());
  const auto ascending = [](const auto& a, const auto& b) { return a.triangle < b.triangle; };
  std::stable_sort(known->impacts.begin(), known->impacts.end(), ascending);
  known->inside = known->triangles.empty() && (known->inside || body.inside);
}

// Keeps the first collision of all bodies.
void addCollision(const PathResult& result, const PathQuestion::Path& path, const RobotPath& robot_path,
                  CheckTrajectory::Response& response) {
  size_t segment = 0;
  double fraction = 0.0;
  if (!robot_path.places.empty()) {
    const RobotPath::Place& place = robot_path.places[*result.first_contact];
    segment = place.segment;
    fraction = place.from + result.time_of_impact.value_or(0.0) * (place.to - place.from);
  }
  if (response.collision && std::tie(response.segment, response.time_of_impact) <= std::tie(segment, fraction)) return;
  response.collision = true;
  response.segment = static_cast<std::uint32_t>(segment);
  response.time_of_impact = fraction;
  response.mesh_id = path.workpiece->id;
  response.tool_link = result.piece ? path.tool->pieces()[*result.piece].link : "";
}

void fill(CheckTrajectory::Response& response, const PathQuestion& question, const RobotPath& robot_path,
          const std::vector<PathResult>& results) {
  for (size_t i = 0; i < results.size(); ++i) {
    const auto& [workpiece, tool, path_M, deviation_bounds] = question.paths[i];
    const sweep_guard_core::SweepResult& all = results[i].all;
    response.margin = std::max(response.margin, all.margin);
    if (!all.triangles.empty() || all.inside) add(toMsg(*workpiece, all, *tool), response.objects);
    if (!all.allowed.triangles.empty()) add(allowedMsg(*workpiece, all, *tool), response.allowed);
    if (results[i].first_contact) addCollision(results[i], question.paths[i], robot_path, response);
  }
  response.sweeps = static_cast<std::uint32_t>(std::max<size_t>(robot_path.places.size(), 1));
  response.deviation = robot_path.deviationBound();
}

Eigen::Isometry3d toolPoseIn(const PathTests& tests, const std::string& mesh_frame,
                             const geometry_msgs::PoseStamped& pose) {
  try {
    return tests.transform(mesh_frame, pose.header) * fromMsg(pose.pose);
  } catch (const sweep_guard_core::Error& error) {
    throw InvalidInput(std::string("tool_pose: ") + error.what());
  }
}

}  // namespace

std::vector<std::string> namesInModel(const std::vector<std::string>& joints, const Parameters& parameters) {
  std::vector<std::string> names;
  names.reserve(joints.size());
  for (const std::string& joint : joints) names.push_back(nameInModel(joint, parameters));
  return names;
}

void checkPositions(PathTests& tests, const std::shared_ptr<PathQuestion>& question, const PositionsRequest& request,
                    CheckTrajectory::Response& response) {
  const RobotModel& model = robotOf(*question->parameters);
  // Before the snapshot is taken: what is accepted later does not better it.
  const std::string doubts_before = tests.meshProblems(request.mesh_ids);
  const sweep_guard_core::Workpieces workpieces = tests.selected(*question, request.mesh_ids);
  question->go_on("the poses of the links");
  const RobotPath path = robotPath(model.robot, statesOf(request.positions, model), request.max_deviation);
  for (const auto& workpiece : workpieces) {
    question->go_on("the transform of tool_pose");
    const Eigen::Isometry3d X_MT = toolPoseIn(tests, workpiece->frame, request.tool_pose);
    for (size_t i = 0; i < path.bodies.size(); ++i) {
      const std::shared_ptr<const sweep_guard_core::Tool> tool(question->parameters->robot, &model.robot.tools[i]);
      question->paths.push_back({workpiece, tool, moved(X_MT, path.bodies[i].X_WB), path.bodies[i].deviation_bounds});
    }
  }
  fill(response, *question, path, tests.test(question));
  response.message = doubts_before.empty()
                         ? tests.doubts(*question, request.mesh_ids, {request.tool_pose.header.frame_id})
                         : doubts_before;
  response.clear = !response.collision && response.message.empty();
  addRemarks(*question, response.message);
}

void checkTrajectory(PathTests& tests, sweep_guard_core::SteadyTime arrival, const CheckTrajectory::Request& request,
                     CheckTrajectory::Response& response) {
  const auto question = tests.question(request.volume, request.detector, request.margin, request.fine != 0, arrival);
  const PlannedPositions plan = plannedBy(request.trajectory, *question->parameters);
  checkPositions(tests, question, {plan.positions, request.tool_pose, request.mesh_ids, kMaxDeviation}, response);
  if (plan.remarks.empty()) return;
  response.message += (response.message.empty() ? "" : "; ") + plan.remarks;
}

}  // namespace sweep_guard_ros
