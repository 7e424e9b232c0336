#include "ros/service/path_tests.h"

#include <algorithm>

#include "common/number_text.h"
#include "ros/guard/detector_test.h"
#include "ros/parameters/parameter_changes.h"
#include "ros/service/left_out.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/common/printable.h"
#include "sweep_guard/ros/conversions.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::PathResult;
using sweep_guard_core::printable;

constexpr auto kGrace = std::chrono::milliseconds(50);  // for the sweeps, which know where they were given up

sweep_guard_core::Error givenUp(sweep_guard_core::Duration deadline, const std::string& when) {
  return sweep_guard_core::Error("not tested within " + shown(ParameterValue(sweep_guard_core::toSeconds(deadline))) +
                                 " s (check_sweep/deadline): given up " + when);
}

}  // namespace

void addRemarks(const PathQuestion& question, std::string& message) {
  sweep_guard_core::Workpieces tested;
  for (const PathQuestion::Path& path : question.paths) {
    if (tested.empty() || tested.back() != path.workpiece) tested.push_back(path.workpiece);
  }
  for (const auto& workpiece : tested) {
    const size_t edges = workpiece->mesh_M.openEdges();
    if (edges > 0) sweep_guard_core::appendOpenSurface(workpiece->id, edges, message);
  }
  const std::string left_out = describeLeftOut(question.parameters->guard.allowed, tested);
  message += (message.empty() || left_out.empty() ? "" : "; ") + left_out;
}

void PathTests::start(Supervisor& supervisor) {
  sweeps_.start(supervisor, {"paths", sweep_guard_core::Stage::kOther, /*watched=*/false});
}

std::shared_ptr<PathQuestion> PathTests::question(const std::string& volume, const std::string& detector, double margin,
                                                  bool fine, sweep_guard_core::SteadyTime arrival) const {
  if (!(margin >= 0.0 && margin <= sweep_guard_core::kMaxCoordinate)) {
    throw InvalidInput("margin must be a length >= 0 m");
  }
  auto question = std::make_shared<PathQuestion>();
  question->parameters = dependencies_.parameters.get();
  question->detector = detector.empty() ? question->parameters->detector.name : detector;
  question->options = question->parameters->guard.sweep;
  if (!volume.empty()) question->options.volume = sweep_guard_core::volumeKind(volume);
  question->options.margin = margin;
  question->options.fine = fine;
  question->arrival = arrival;
  question->go_on = untilDeadline(question->parameters->check_sweep_deadline, arrival);
  return question;
}

// A busy processor may keep the thread of the sweeps waiting for long. It gives up by itself, before its next sweep.
std::vector<PathResult> PathTests::test(const std::shared_ptr<const PathQuestion>& question) {
  auto results = sweeps_.submit<std::vector<PathResult>>([this, question] { return sweep(*question); });
  const sweep_guard_core::Duration deadline = question->parameters->check_sweep_deadline;
  if (results.wait_until(question->arrival + deadline + kGrace) == std::future_status::ready) return results.get();
  throw givenUp(deadline, "during a sweep");
}

std::vector<PathResult> PathTests::sweep(const PathQuestion& question) {
  setParameters(question.parameters);
  sweep_guard_core::Detector& used = detector(question.detector);
  std::vector<PathResult> results;
  for (const auto& [workpiece, tool, path_M, deviation_bounds] : question.paths) {
    const auto before_sweep = [&, id = workpiece->id, sweep = size_t{0}]() mutable {
      question.go_on("sweep " + std::to_string(sweep++) + " of the path, on '" + id + "'");
    };
    const sweep_guard_core::ContactPolicy contact(*tool, *workpiece, &question.parameters->guard.allowed);
    results.push_back(sweep_guard_core::checkPath(
        used, {*tool, path_M, workpiece->mesh_M, question.options, before_sweep, deviation_bounds, contact}));
  }
  return results;
}

void PathTests::setParameters(const std::shared_ptr<const Parameters>& current) {
  if (current == parameters_) return;
  if (parameters_ && detectorsDiffer(*parameters_, *current)) detectors_.clear();
  parameters_ = current;
}

sweep_guard_core::Detector& PathTests::detector(const std::string& name) {
  const auto made = detectors_.find(name);
  if (made != detectors_.end()) return *made->second;
  auto detector = make_detector_(name, parameters_->detector.options);
  const std::string failure = testFailure(*parameters_, name, *detector);
  if (!failure.empty()) throw sweep_guard_core::DeviceError(failure);
  return *detectors_.emplace(name, std::move(detector)).first->second;
}

std::string PathTests::meshProblems(const std::vector<std::string>& ids) const {
  return dependencies_.monitor.meshProblems(now(), ids);
}

GoOn PathTests::untilDeadline(sweep_guard_core::Duration deadline, sweep_guard_core::SteadyTime arrival) const {
  return [this, deadline, end = arrival + deadline](const std::string& where) {
    if (stopping_) throw sweep_guard_core::Error("the guard is shutting down");
    if (std::chrono::steady_clock::now() < end) return;
    throw givenUp(deadline, "before " + where);
  };
}

sweep_guard_core::Workpieces PathTests::selected(const PathQuestion& question,
                                                 const std::vector<std::string>& ids) const {
  sweep_guard_core::Workpieces all = dependencies_.workpieces.snapshotBeside(question.parameters->attached);
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

Eigen::Isometry3d PathTests::transform(const std::string& mesh_frame, const std_msgs::Header& header) const {
  const auto lookup = [&](const std::string& target) {
    return dependencies_.frames.lookup(target, header.frame_id, fromMsg(header.stamp), kTransformWait);
  };
  if (!isOfOtherTool(mesh_frame)) return lookup(mesh_frame);
  const auto X_WM = frame_motions_->newest(mesh_frame);
  if (!X_WM) throw sweep_guard_core::Error("it is not known where the other tool is");
  return X_WM->inverse() * lookup(dependencies_.parameters.initial().fixed_frame);
}

bool PathTests::isOfOtherTool(const std::string& frame) const {
  return frame_motions_ != nullptr && frame_motions_->expects(frame);
}

std::string PathTests::doubts(const PathQuestion& question, const std::vector<std::string>& ids,
                              const std::set<std::string>& frames) const {
  const std::string problems = meshProblems(ids);
  return problems.empty() ? oldTransforms(question, frames) : problems;
}

std::string PathTests::oldTransforms(const PathQuestion& question, const std::set<std::string>& frames) const {
  for (const PathQuestion::Path& path : question.paths) {
    const std::string& mesh_frame =
        isOfOtherTool(path.workpiece->frame) ? question.parameters->fixed_frame : path.workpiece->frame;
    for (const std::string& frame : frames) {
      const auto newest = dependencies_.frames.newest(mesh_frame, frame);
      if (newest == sweep_guard_core::Time()) continue;
      const sweep_guard_core::Duration age = now().stamp - newest.value_or(sweep_guard_core::Time());
      if (age <= question.parameters->limits.pose_timeout) continue;
      return "newest transform from '" + printable(frame) + "' to '" + mesh_frame + "' is " +
             sweep_guard_core::inSeconds(age) + " old";
    }
  }
  return "";
}

}  // namespace sweep_guard_ros
