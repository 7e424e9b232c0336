#include "ros/service/check_sweep.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <tuple>

#include "ros/bounded.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::CheckSweep;
using sweep_guard_core::InvalidInput;
using sweep_guard_core::printable;

constexpr size_t kMaxPoses = 1024;
constexpr auto kPathTransformWait = std::chrono::milliseconds(100);

struct PathContact {
  size_t segment;
  std::optional<double> time_of_impact;  // in the segment
};

bool refuse(const std::string& reason, CheckSweep::Response& response) {
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  response.message = reason;
  return true;
}

PathContact earlier(const std::optional<PathContact>& a, const PathContact& b) {
  return a && std::tie(a->segment, a->time_of_impact) < std::tie(b.segment, b.time_of_impact) ? *a : b;
}

}  // namespace

CheckSweepService::CheckSweepService(const ros::NodeHandle& private_node, const LiveParameters& live,
                                     const Frames& frames, const sweep_guard_core::WorkpieceStore& workpieces,
                                     const sweep_guard_core::WarningMonitor& monitor)
    : live_(live),
      frames_(frames),
      workpieces_(workpieces),
      monitor_(monitor),
      server_(advertiseBounded<ros::ServiceSpec<CheckSweep::Request, CheckSweep::Response>>(
          calls_.on(private_node), "check_sweep", live.initial().max_message_size,
          [this](auto& request, auto& response) { return onCall(request, response); }, refuse)) {}

// Answers errors by a message: a failed ROS call gives the caller none.
bool CheckSweepService::onCall(CheckSweep::Request& request, CheckSweep::Response& response) {
  if (LimitedCalls::refused()) {
    return refuse("BUSY: " + std::to_string(LimitedCalls::kMaxWaiting) + " calls wait already; ask again", response);
  }
  const auto begin = std::chrono::steady_clock::now();
  response.time_of_impact = std::numeric_limits<double>::quiet_NaN();
  try {
    refreshParameters();
    check(request, response);
    response.success = true;
  } catch (const std::exception& error) {
    response = CheckSweep::Response();
    refuse(error.what(), response);
  }
  response.compute_time = ros::Duration(sweep_guard_core::toSeconds(std::chrono::steady_clock::now() - begin));
  return true;
}

void CheckSweepService::refreshParameters() {
  const auto current = live_.get();
  if (current == parameters_) return;
  if (parameters_ && detectorsDiffer(*parameters_, *current)) detectors_.clear();
  parameters_ = current;
}

void CheckSweepService::check(const CheckSweep::Request& request, CheckSweep::Response& response) {
  if (request.path.empty()) throw InvalidInput("path is empty: send at least one pose");
  if (request.path.size() > kMaxPoses) {
    throw InvalidInput("path has " + std::to_string(request.path.size()) + " poses: send at most 1024");
  }
  if (!(request.margin >= 0.0 && request.margin <= sweep_guard_core::kMaxCoordinate)) {
    throw InvalidInput("margin must be a length >= 0 m");
  }
  sweep_guard_core::SweepOptions options = parameters_->guard.sweep;
  if (!request.volume.empty()) options.volume = sweep_guard_core::volumeKind(request.volume);
  options.margin = request.margin;
  options.fine = request.fine;
  sweep_guard_core::Detector& used = detector(request.detector.empty() ? parameters_->detector : request.detector);

  const auto go_on = untilDeadline();
  // Before the snapshot is taken: what is accepted later does not better it.
  const std::string doubts = monitor_.meshProblems(now(), request.mesh_ids);
  std::optional<PathContact> first;
  for (const auto& workpiece : selected(request.mesh_ids)) {
    const std::vector<Eigen::Isometry3d> path_M = pathIn(workpiece->frame, request.path, go_on);
    const auto before_sweep = [&, sweep = size_t{0}]() mutable {
      go_on("sweep " + std::to_string(sweep++) + " of the path, on '" + workpiece->id + "'");
    };
    auto path =
        sweep_guard_core::checkPath(used, {*parameters_->tool, path_M, workpiece->mesh_M, options, before_sweep});
    response.margin = std::max(response.margin, path.all.margin);
    if (!path.all.triangles.empty() || path.all.inside)
      response.objects.push_back(toMsg(*workpiece, path.all, *parameters_->tool));
    if (path.first_contact) first = earlier(first, {*path.first_contact, path.time_of_impact});
  }
  response.collision = first.has_value();
  // After the test, which waits for late transforms.
  response.message = doubts.empty() ? oldTransforms(request) : doubts;
  response.clear = !response.collision && response.message.empty();
  if (!first) return;
  response.segment = static_cast<std::uint32_t>(first->segment);
  if (first->time_of_impact) response.time_of_impact = *first->time_of_impact;
}

// Returns a function that throws once the call is to end. What has been tested by then is no answer.
std::function<void(const std::string& where)> CheckSweepService::untilDeadline() const {
  const sweep_guard_core::Duration deadline = parameters_->check_sweep_deadline;
  return [this, deadline, end = std::chrono::steady_clock::now() + deadline](const std::string& where) {
    if (stopping_) throw sweep_guard_core::Error("the guard is shutting down");
    if (std::chrono::steady_clock::now() < end) return;
    throw sweep_guard_core::Error("not tested within " + shown(ParameterValue(sweep_guard_core::toSeconds(deadline))) +
                                  " s (check_sweep/deadline): given up before " + where);
  };
}

sweep_guard_core::Workpieces CheckSweepService::selected(const std::vector<std::string>& ids) const {
  sweep_guard_core::Workpieces all = workpieces_.snapshot();
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
                                                         const std::function<void(const std::string&)>& go_on) const {
  std::vector<Eigen::Isometry3d> path_M;
  const std_msgs::Header* looked_up = nullptr;
  Eigen::Isometry3d X_MF;
  for (size_t i = 0; i < path.size(); ++i) {
    const std_msgs::Header& header = path[i].header;
    const bool same = looked_up && looked_up->frame_id == header.frame_id && looked_up->stamp == header.stamp;
    if (!same) go_on("the transform of pose " + std::to_string(i));
    try {
      if (!same) X_MF = frames_.lookup(mesh_frame, header.frame_id, fromMsg(header.stamp), kPathTransformWait);
      looked_up = &header;
      path_M.push_back(X_MF * fromMsg(path[i].pose));
    } catch (const sweep_guard_core::Error& error) {
      throw InvalidInput("pose " + std::to_string(i) + ": " + error.what());
    }
  }
  return path_M;
}

std::string CheckSweepService::oldTransforms(const sweep_guard::CheckSweep::Request& request) const {
  std::set<std::string> frames;
  for (const geometry_msgs::PoseStamped& pose : request.path) frames.insert(pose.header.frame_id);
  for (const auto& workpiece : selected(request.mesh_ids)) {
    for (const std::string& frame : frames) {
      const auto newest = frames_.newest(workpiece->frame, frame);
      if (newest == sweep_guard_core::Time()) continue;
      const sweep_guard_core::Duration age = now().stamp - newest.value_or(sweep_guard_core::Time());
      if (age <= parameters_->limits.pose_timeout) continue;
      return "newest transform from '" + printable(frame) + "' to '" + workpiece->frame + "' is " +
             std::to_string(sweep_guard_core::toSeconds(age)) + " s old";
    }
  }
  return "";
}

sweep_guard_core::Detector& CheckSweepService::detector(const std::string& name) {
  const auto made = detectors_.find(name);
  if (made != detectors_.end()) return *made->second;
  return *detectors_.emplace(name, sweep_guard_core::makeDetector(name, parameters_->detector_options)).first->second;
}

}  // namespace sweep_guard_ros
