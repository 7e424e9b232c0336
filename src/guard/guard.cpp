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

Outlook lookAlong(const Forecast& forecast, const Workpieces& workpieces, PathTest& test, Detector& detector,
                  const Tool& tool, const PathTest::Effort& effort) {
  Outlook outlook;
  outlook.stamp = forecast.from.stamp;
  outlook.path = forecast.path;
  outlook.reflex_sweeps = forecast.reflex_sweeps;
  outlook.sweeps_asked = forecast.path.size();
  outlook.sweeps_made = effort.sweep_ends.empty() ? forecast.path.size() : effort.sweep_ends.size();
  if (forecast.path.empty()) return outlook;
  for (const auto& workpiece : workpieces) {
    const auto X_WM = forecast.from.X_WM.find(workpiece->frame);
    if (X_WM == forecast.from.X_WM.end()) {
      outlook.unplaced.push_back(workpiece);
      continue;
    }
    try {
      outlook.objects.push_back(test(detector, tool, forecast.from.X_WT, forecast.path, forecast.reflex_sweeps,
                                     X_WM->second, workpiece, effort));
    } catch (const std::exception& error) {  // the device, or no memory: the others are tested all the same
      outlook.failures.push_back({workpiece, error.what()});
    }
  }
  return outlook;
}

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : tool_(std::move(tool)),
      detector_(std::move(detector)),
      options_(options),
      predictor_(options.predictor),
      budget_(options.horizon, options.cycle),
      path_test_(options.pathTest()) {}

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
  if (!newest_) return {};
  const SteadyTime begin = options_.clock();
  const Horizon asked = horizon(options_.horizon, age);
  const Forecast forecast{*newest_, predictor_.predict(asked.ends), asked.reflex_sweeps};
  const Outlook outlook = lookAlong(forecast, workpieces, path_test_, *detector_, tool_, effortFor(forecast, begin));
  size_t volumes = 0;
  for (const PredictedObject& object : outlook.objects) volumes = std::max(volumes, object.volumes_tested);
  budget_.spentOnPredicted(options_.clock() - begin, volumes);
  return outlook;
}

PathTest::Effort Guard::effortFor(const Forecast& forecast, SteadyTime begin) const {
  const PredictedPath& path = forecast.path;
  if (path.empty()) return {};
  size_t volumes[] = {0, 0};
  for (size_t i = 0; i < path.size(); ++i) {
    const Motion step{i == 0 ? forecast.from.X_WT : path[i - 1].X_WT, path[i].X_WT};
    volumes[i < forecast.reflex_sweeps ? 0 : 1] += split(step, options_.sweep.max_rotation).size();
  }
  const size_t considered_sweeps = budget_.consideredSweeps(volumes[0], volumes[1]);
  return {sweepEnds(forecast.from.X_WT, path, forecast.reflex_sweeps, considered_sweeps),
          [this, end = begin + budget_.forPrediction()] { return options_.clock() >= end; }};
}

Forecast Guard::forecast(Duration age, Duration end) const {
  if (!newest_) return {};
  const Horizon asked = horizonUpTo(end, options_.horizon, age);
  return {*newest_, predictor_.predict(asked.ends), asked.reflex_sweeps};
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
