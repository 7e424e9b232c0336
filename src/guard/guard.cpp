#include "sweep_guard/guard/guard.h"

#include <algorithm>
#include <set>

namespace sweep_guard {
namespace {

constexpr size_t kLongestWay = 4096;  // of a detector that keeps failing: the warning is not clear meanwhile

}  // namespace

double SweepReport::margin() const {
  double largest = 0.0;
  for (const SweptObject& object : objects) largest = std::max(largest, object.findings.margin);
  return largest;
}

bool SweepReport::contact() const {
  return std::any_of(objects.begin(), objects.end(),
                     [](const SweptObject& object) { return !object.findings.triangles.empty(); });
}

bool SweepReport::complete() const { return !objects.empty() && unplaced.empty() && failures.empty(); }

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : tool_(std::move(tool)),
      detector_(std::move(detector)),
      options_(options),
      predictor_(options.predictor),
      budget_(options.horizon, options.cycle),
      test_path_({options.sweep, options.horizon.reflex_step / 2}) {}

SweepReport Guard::sweep(const ToolPose& pose, const Workpieces& workpieces) {
  const SteadyTime begin = options_.clock();
  SweepReport report = sweepAll(pose, workpieces);
  predictor_.observe({pose.stamp, pose.X_WT});
  newest_ = pose;
  budget_.spentOnMeasured(options_.clock() - begin);
  return report;
}

SweepReport Guard::sweepAll(const ToolPose& pose, const Workpieces& workpieces) {
  dropWaysOfEmptyFrames(workpieces);
  for (const auto& [frame, X_WM] : pose.X_WM) {
    Way& way = ways_[frame];
    if (way.size() >= kLongestWay) way.erase(way.begin() + 1);
    way.push_back({pose.stamp, pose.X_WT, X_WM});
  }

  SweepReport report{pose.stamp, pose.stamp, {}, {}, {}};
  std::set<std::string> failed_frames;
  for (const auto& workpiece : workpieces) {
    if (pose.X_WM.count(workpiece->frame) == 0) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    const Way& way = ways_.at(workpiece->frame);
    report.start = std::min(report.start, way.front().stamp);
    try {
      report.objects.push_back({workpiece, way.front().stamp, sweepAlong(way, workpiece->mesh_M)});
    } catch (const std::exception& error) {  // the device, or no memory: the others are swept all the same
      report.failures.push_back({workpiece, error.what()});
      failed_frames.insert(workpiece->frame);
    }
  }
  for (const auto& [frame, X_WM] : pose.X_WM) {
    if (failed_frames.count(frame) == 0) ways_[frame] = {ways_[frame].back()};
  }
  return report;
}

SweepFindings Guard::sweepAlong(const Way& way, const TriangleMesh& mesh_M) {
  SweepFindings findings;
  for (size_t i = 0; i < std::max<size_t>(way.size() - 1, 1); ++i) {
    const Placed& from = way[i];
    const Placed& to = way[std::min(i + 1, way.size() - 1)];
    const RelativeMotion motion{{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}};
    const std::vector<Motion> parts = split(motion, options_.sweep.max_rotation, tool_.extent());
    unite(findings, testSweep(*detector_, tool_, parts, mesh_M, options_.sweep));
  }
  return findings;
}

Outlook Guard::lookAhead(Duration age, const Workpieces& workpieces) {
  Outlook outlook;
  if (!newest_) return outlook;
  const SteadyTime begin = options_.clock();
  const size_t reflex_sweeps = reflexSweeps(options_.horizon, age);
  const Horizon asked = horizon(options_.horizon, age, budget_.consideredSweeps(reflex_sweeps));
  outlook.stamp = newest_->stamp;
  outlook.reflex_sweeps = asked.reflex_sweeps;
  outlook.sweeps_asked = reflex_sweeps + consideredSweeps(options_.horizon);
  outlook.path = predictor_.predict(asked.ends);
  if (!outlook.path.empty()) testPath(outlook, workpieces);
  budget_.spentOnPredicted(options_.clock() - begin, outlook.path.size());
  return outlook;
}

void Guard::testPath(Outlook& outlook, const Workpieces& workpieces) {
  for (const auto& workpiece : workpieces) {
    const auto X_WM = newest_->X_WM.find(workpiece->frame);
    if (X_WM == newest_->X_WM.end()) {
      outlook.unplaced.push_back(workpiece);
      continue;
    }
    try {
      outlook.objects.push_back(
          test_path_(*detector_, tool_, newest_->X_WT, outlook.path, outlook.reflex_sweeps, X_WM->second, workpiece));
    } catch (const std::exception& error) {  // the device, or no memory: the others are tested all the same
      outlook.failures.push_back({workpiece, error.what()});
    }
  }
}

void Guard::forget() {
  ways_.clear();
  predictor_.restart();
  newest_.reset();
}

// What comes to live in an empty frame later was not there when the tool moved before.
void Guard::dropWaysOfEmptyFrames(const Workpieces& workpieces) {
  for (auto way = ways_.begin(); way != ways_.end();) {
    const bool inhabited = std::any_of(workpieces.begin(), workpieces.end(),
                                       [&](const auto& workpiece) { return workpiece->frame == way->first; });
    way = inhabited ? std::next(way) : ways_.erase(way);
  }
}

}  // namespace sweep_guard
