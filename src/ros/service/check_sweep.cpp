#include "ros/service/check_sweep.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "sweep_guard/common/error.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::PathResult;

constexpr size_t kMaxPoses = 1024;

void checkPathOf(const CheckSweep::Request& request) {
  if (request.path.empty()) throw InvalidInput("path is empty: send at least one pose");
  if (request.path.size() > kMaxPoses) {
    throw InvalidInput("path has " + std::to_string(request.path.size()) + " poses: send at most 1024");
  }
}

std::set<std::string> framesOf(const CheckSweep::Request& request) {
  std::set<std::string> frames;
  for (const geometry_msgs::PoseStamped& pose : request.path) frames.insert(pose.header.frame_id);
  return frames;
}

bool meetsEarlier(const PathResult& a, const PathResult& b) {
  return std::tie(a.first_contact, a.time_of_impact) < std::tie(b.first_contact, b.time_of_impact);
}

void fill(CheckSweep::Response& response, const PathQuestion& question, const std::vector<PathResult>& results) {
  const PathResult* first = nullptr;
  for (size_t i = 0; i < results.size(); ++i) {
    const PathResult& result = results[i];
    response.margin = std::max(response.margin, result.all.margin);
    if (!result.all.triangles.empty() || result.all.inside)
      response.objects.push_back(toMsg(*question.paths[i].workpiece, result.all, *question.parameters->tool));
    if (!result.all.allowed.triangles.empty())
      response.allowed.push_back(allowedMsg(*question.paths[i].workpiece, result.all, *question.parameters->tool));
    if (result.first_contact && (first == nullptr || meetsEarlier(result, *first))) first = &result;
  }
  response.collision = first != nullptr;
  if (!response.collision) return;
  response.segment = static_cast<std::uint32_t>(*first->first_contact);
  if (first->time_of_impact) response.time_of_impact = *first->time_of_impact;
}

std::vector<Eigen::Isometry3d> pathIn(const PathTests& tests, const std::string& mesh_frame,
                                      const std::vector<geometry_msgs::PoseStamped>& path, const GoOn& go_on) {
  std::vector<Eigen::Isometry3d> path_M;
  const std_msgs::Header* looked_up = nullptr;
  Eigen::Isometry3d X_MF;
  for (size_t i = 0; i < path.size(); ++i) {
    const std_msgs::Header& header = path[i].header;
    const bool same = looked_up && looked_up->frame_id == header.frame_id && looked_up->stamp == header.stamp;
    if (!same) go_on("the transform of pose " + std::to_string(i));
    try {
      if (!same) X_MF = tests.transform(mesh_frame, header);
      looked_up = &header;
      path_M.push_back(X_MF * fromMsg(path[i].pose));
    } catch (const sweep_guard_core::Error& error) {
      throw InvalidInput("pose " + std::to_string(i) + ": " + error.what());
    }
  }
  return path_M;
}

}  // namespace

void checkSweep(PathTests& tests, sweep_guard_core::SteadyTime arrival, const CheckSweep::Request& request,
                CheckSweep::Response& response) {
  checkPathOf(request);
  const auto question = tests.question(request.volume, request.detector, request.margin, request.fine != 0, arrival);
  // Before the snapshot is taken: what is accepted later does not better it.
  const std::string doubts_before = tests.meshProblems(request.mesh_ids);
  for (const auto& workpiece : tests.selected(*question, request.mesh_ids)) {
    question->paths.push_back(
        {workpiece, question->parameters->tool, pathIn(tests, workpiece->frame, request.path, question->go_on), {}});
  }
  fill(response, *question, tests.test(question));
  response.message =
      doubts_before.empty() ? tests.doubts(*question, request.mesh_ids, framesOf(request)) : doubts_before;
  response.clear = !response.collision && response.message.empty();
  addRemarks(*question, response.message);
}

}  // namespace sweep_guard_ros
