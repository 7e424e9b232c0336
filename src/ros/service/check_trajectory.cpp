#include "ros/service/check_trajectory.h"

#include <algorithm>
#include <optional>
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
  const bool renamed =
      found != parameters.joint_names.end() && !hasJoint(parameters.robot->robot.tree, parameters.robot->beside, joint);
  return renamed ? found->second : joint;
}

JointPlan planOf(const trajectory_msgs::JointTrajectory& trajectory, const Parameters& parameters) {
  JointPlan plan;
  for (const std::string& joint : trajectory.joint_names) plan.joints.push_back(nameInModel(joint, parameters));
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
std::vector<RobotState> statesOf(const PlannedPositions& plan, const RobotModel& model) {
  std::vector<RobotState> states;
  for (const std::vector<double>& positions : plan.positions) states.push_back({model.X_TR, positions});
  return states;
}

std::vector<Eigen::Isometry3d> moved(const Eigen::Isometry3d& X_MT, const std::vector<Eigen::Isometry3d>& X_TB) {
  std::vector<Eigen::Isometry3d> X_MB;
  for (const Eigen::Isometry3d& X : X_TB) X_MB.push_back(X_MT * X);
  return X_MB;
}

// Where a body first collides.
struct Collision {
  size_t segment;
  double fraction;
  size_t path;  // of the question
  std::optional<size_t> piece;
};

Collision collisionOf(const PathResult& result, size_t path, const RobotPath& robot_path) {
  if (robot_path.places.empty()) return {0, 0.0, path, result.piece};
  const auto& [segment, from, to] = robot_path.places[*result.first_contact];
  return {segment, from + result.time_of_impact.value_or(0.0) * (to - from), path, result.piece};
}

bool isEarlier(const Collision& a, const Collision& b) {
  return std::tie(a.segment, a.fraction) < std::tie(b.segment, b.fraction);
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

void fill(CheckTrajectory::Response& response, const PathQuestion& question, const RobotPath& robot_path,
          const std::vector<PathResult>& results) {
  std::optional<Collision> first;
  for (size_t i = 0; i < results.size(); ++i) {
    const auto& [workpiece, tool, path_M, deviation_bounds] = question.paths[i];
    const sweep_guard_core::SweepResult& all = results[i].all;
    response.margin = std::max(response.margin, all.margin);
    if (!all.triangles.empty() || all.inside) add(toMsg(*workpiece, all, *tool), response.objects);
    if (!all.allowed.triangles.empty()) add(allowedMsg(*workpiece, all, *tool), response.allowed);
    if (!results[i].first_contact) continue;
    const Collision collision = collisionOf(results[i], i, robot_path);
    if (!first || isEarlier(collision, *first)) first = collision;
  }
  response.sweeps = static_cast<std::uint32_t>(std::max<size_t>(robot_path.places.size(), 1));
  response.deviation = robot_path.deviationBound();
  response.collision = first.has_value();
  if (!first) return;
  response.segment = static_cast<std::uint32_t>(first->segment);
  response.time_of_impact = first->fraction;
  const PathQuestion::Path& path = question.paths[first->path];
  response.mesh_id = path.workpiece->id;
  if (first->piece) response.tool_link = path.tool->pieces()[*first->piece].link;
}

}  // namespace

CheckTrajectoryService::CheckTrajectoryService(const ros::NodeHandle& private_node, ServiceThreads& threads,
                                               PathTests& tests)
    : tests_(tests),
      calls_(threads.lasting, threads.refusals),
      server_(calls_.advertise<ros::ServiceSpec<CheckTrajectory::Request, CheckTrajectory::Response>>(
          private_node, "check_trajectory", tests.parameters().initial().max_message_size,
          [this](auto& request, auto& response) { return answerPath(response, [&] { check(request, response); }); },
          refusePath<CheckTrajectory::Response>)) {}

void CheckTrajectoryService::check(const CheckTrajectory::Request& request, CheckTrajectory::Response& response) {
  const auto question =
      tests_.question({request.volume, request.detector, request.margin, request.fine != 0}, calls_.arrival());
  const RobotModel& model = robotOf(*question->parameters);
  const PlannedPositions plan = plannedBy(request.trajectory, *question->parameters);
  const std::vector<RobotState> states = statesOf(plan, model);
  // Before the snapshot is taken: what is accepted later does not better it.
  const std::string doubts_before = tests_.meshProblems(request.mesh_ids);
  const sweep_guard_core::Workpieces workpieces = tests_.selected(*question, request.mesh_ids);
  question->go_on("the poses of the links");
  const RobotPath path = robotPath(model.robot, states, kMaxDeviation);
  for (const auto& workpiece : workpieces) {
    question->go_on("the transform of tool_pose");
    const Eigen::Isometry3d X_MT = toolPoseIn(workpiece->frame, request.tool_pose);
    for (size_t i = 0; i < path.bodies.size(); ++i) {
      const std::shared_ptr<const sweep_guard_core::Tool> tool(question->parameters->robot, &model.robot.tools[i]);
      question->paths.push_back({workpiece, tool, moved(X_MT, path.bodies[i].X_WB), path.bodies[i].deviation_bounds});
    }
  }
  fill(response, *question, path, tests_.test(question));
  response.message = doubts_before.empty()
                         ? tests_.doubts(*question, request.mesh_ids, {request.tool_pose.header.frame_id})
                         : doubts_before;
  response.clear = !response.collision && response.message.empty();
  addRemarks(*question, response.message);
  if (plan.remarks.empty()) return;
  response.message += (response.message.empty() ? "" : "; ") + plan.remarks;
}

Eigen::Isometry3d CheckTrajectoryService::toolPoseIn(const std::string& mesh_frame,
                                                     const geometry_msgs::PoseStamped& pose) const {
  try {
    return tests_.transform(mesh_frame, pose.header) * fromMsg(pose.pose);
  } catch (const sweep_guard_core::Error& error) {
    throw InvalidInput(std::string("tool_pose: ") + error.what());
  }
}

}  // namespace sweep_guard_ros
