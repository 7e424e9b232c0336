#include "ros/service/check_sweep.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::PathResult;
using sweep_guard_core::printable;

constexpr size_t kMaxPoses = 1024;
constexpr auto kPathTransformWait = std::chrono::milliseconds(100);
constexpr auto kGrace = std::chrono::milliseconds(50);  // for the sweeps, which know where they were given up

struct PathContact {
  size_t segment;
  std::optional<double> time_of_impact;  // in the segment
};

bool refuse(const std::string& reason, CheckSweep::Response& response) {
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  response.message = reason;
  return true;
}

sweep_guard_core::Error givenUp(sweep_guard_core::Duration deadline, const std::string& when) {
  return sweep_guard_core::Error("not tested within " + shown(ParameterValue(sweep_guard_core::toSeconds(deadline))) +
                                 " s (check_sweep/deadline): given up " + when);
}

sweep_guard_core::SweepOptions optionsOf(const CheckSweep::Request& request, sweep_guard_core::SweepOptions options) {
  if (request.path.empty()) throw InvalidInput("path is empty: send at least one pose");
  if (request.path.size() > kMaxPoses) {
    throw InvalidInput("path has " + std::to_string(request.path.size()) + " poses: send at most 1024");
  }
  if (!(request.margin >= 0.0 && request.margin <= sweep_guard_core::kMaxCoordinate)) {
    throw InvalidInput("margin must be a length >= 0 m");
  }
  if (!request.volume.empty()) options.volume = sweep_guard_core::volumeKind(request.volume);
  options.margin = request.margin;
  options.fine = request.fine;
  return options;
}

PathContact earlier(const std::optional<PathContact>& a, const PathContact& b) {
  return a && std::tie(a->segment, a->time_of_impact) < std::tie(b.segment, b.time_of_impact) ? *a : b;
}

void fill(CheckSweep::Response& response, const PathQuestion& question, const std::vector<PathResult>& results) {
  std::optional<PathContact> first;
  for (size_t i = 0; i < results.size(); ++i) {
    const auto& [all, first_contact, time_of_impact] = results[i];
    response.margin = std::max(response.margin, all.margin);
    if (!all.triangles.empty() || all.inside)
      response.objects.push_back(toMsg(*question.paths[i].workpiece, all, *question.parameters->tool));
    if (first_contact) first = earlier(first, {*first_contact, time_of_impact});
  }
  response.collision = first.has_value();
  if (!first) return;
  response.segment = static_cast<std::uint32_t>(first->segment);
  if (first->time_of_impact) response.time_of_impact = *first->time_of_impact;
}

}  // namespace

CheckSweepService::CheckSweepService(const ros::NodeHandle& private_node, const CheckSweepDependencies& dependencies)
    : dependencies_(dependencies),
      tester_(dependencies.make_detector),
      server_(calls_.advertise<ros::ServiceSpec<CheckSweep::Request, CheckSweep::Response>>(
          private_node, "check_sweep", dependencies.parameters.initial().max_message_size,
          [this](auto& request, auto& response) { return onCall(request, response); }, refuse)) {}

void CheckSweepService::start(Supervisor& supervisor) {
  sweeps_.start(supervisor, {"paths", sweep_guard_core::Stage::kOther, /*watched=*/false});
  calls_.start(supervisor);
}

// Answers errors by a message: a failed ROS call gives the caller none.
bool CheckSweepService::onCall(CheckSweep::Request& request, CheckSweep::Response& response) {
  const auto begin = std::chrono::steady_clock::now();
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  try {
    check(request, response);
    response.success = true;
  } catch (const std::exception& error) {
    response = CheckSweep::Response();
    refuse(error.what(), response);
  }
  response.compute_time = ros::Duration(sweep_guard_core::toSeconds(std::chrono::steady_clock::now() - begin));
  return true;
}

void CheckSweepService::check(const CheckSweep::Request& request, CheckSweep::Response& response) {
  const auto question = std::make_shared<PathQuestion>();
  question->parameters = dependencies_.parameters.get();
  question->detector = request.detector.empty() ? question->parameters->detector.name : request.detector;
  question->options = optionsOf(request, question->parameters->guard.sweep);
  question->go_on = untilDeadline(question->parameters->check_sweep_deadline);
  // Before the snapshot is taken: what is accepted later does not better it.
  const std::string doubts_before = dependencies_.monitor.meshProblems(now(), request.mesh_ids);
  for (const auto& workpiece : selected(request.mesh_ids)) {
    question->paths.push_back({workpiece, pathIn(workpiece->frame, request.path, question->go_on)});
  }
  fill(response, *question, test(question));
  response.message = doubts_before.empty() ? doubts(*question, request) : doubts_before;
  response.clear = !response.collision && response.message.empty();
}

// A busy processor may keep the thread of the sweeps waiting for long. It gives up by itself, before its next sweep.
std::vector<PathResult> CheckSweepService::test(const std::shared_ptr<const PathQuestion>& question) {
  auto results = sweeps_.submit<std::vector<PathResult>>([this, question] { return tester_.test(*question); });
  const sweep_guard_core::Duration deadline = question->parameters->check_sweep_deadline;
  if (results.wait_until(LimitedCalls::arrival() + deadline + kGrace) == std::future_status::ready)
    return results.get();
  throw givenUp(deadline, "during a sweep");
}

// After the test, which waits for late transforms, and during which a mesh may be refused.
std::string CheckSweepService::doubts(const PathQuestion& question, const CheckSweep::Request& request) const {
  const std::string problems = dependencies_.monitor.meshProblems(now(), request.mesh_ids);
  return problems.empty() ? oldTransforms(question, request) : problems;
}

GoOn CheckSweepService::untilDeadline(sweep_guard_core::Duration deadline) const {
  return [this, deadline, end = LimitedCalls::arrival() + deadline](const std::string& where) {
    if (stopping_) throw sweep_guard_core::Error("the guard is shutting down");
    if (std::chrono::steady_clock::now() < end) return;
    throw givenUp(deadline, "before " + where);
  };
}

sweep_guard_core::Workpieces CheckSweepService::selected(const std::vector<std::string>& ids) const {
  sweep_guard_core::Workpieces all = dependencies_.workpieces.snapshot();
  if (all.empty()) throw InvalidInput("no workpiece yet");
  if (ids.empty()) return all;
  sweep_guard_core::Workpieces selected;
  for (const std::string& id : std::set<std::string>(ids.begin(), ids.end())) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& workpiece) { return workpiece->id == id; });
    if (found == all.end()) throw InvalidInput("no workpiece '" + printable(id) + "'");
    selected.push_back(*found);
  }
  return selected;
}

std::vector<Eigen::Isometry3d> CheckSweepService::pathIn(const std::string& mesh_frame,
                                                         const std::vector<geometry_msgs::PoseStamped>& path,
                                                         const GoOn& go_on) const {
  std::vector<Eigen::Isometry3d> path_M;
  const std_msgs::Header* looked_up = nullptr;
  Eigen::Isometry3d X_MF;
  for (size_t i = 0; i < path.size(); ++i) {
    const std_msgs::Header& header = path[i].header;
    const bool same = looked_up && looked_up->frame_id == header.frame_id && looked_up->stamp == header.stamp;
    if (!same) go_on("the transform of pose " + std::to_string(i));
    try {
      if (!same)
        X_MF = dependencies_.frames.lookup(mesh_frame, header.frame_id, fromMsg(header.stamp), kPathTransformWait);
      looked_up = &header;
      path_M.push_back(X_MF * fromMsg(path[i].pose));
    } catch (const sweep_guard_core::Error& error) {
      throw InvalidInput("pose " + std::to_string(i) + ": " + error.what());
    }
  }
  return path_M;
}

std::string CheckSweepService::oldTransforms(const PathQuestion& question, const CheckSweep::Request& request) const {
  std::set<std::string> frames;
  for (const geometry_msgs::PoseStamped& pose : request.path) frames.insert(pose.header.frame_id);
  for (const auto& [workpiece, path_M] : question.paths) {
    for (const std::string& frame : frames) {
      const auto newest = dependencies_.frames.newest(workpiece->frame, frame);
      if (newest == sweep_guard_core::Time()) continue;
      const sweep_guard_core::Duration age = now().stamp - newest.value_or(sweep_guard_core::Time());
      if (age <= question.parameters->limits.pose_timeout) continue;
      return "newest transform from '" + printable(frame) + "' to '" + workpiece->frame + "' is " +
             std::to_string(sweep_guard_core::toSeconds(age)) + " s old";
    }
  }
  return "";
}

}  // namespace sweep_guard_ros
