#include "sweep_guard/guard/guard.h"

#include <algorithm>

namespace sweep_guard {

double SweepReport::margin() const {
  double largest = 0.0;
  for (const SweptObject& object : objects) largest = std::max(largest, object.findings.margin);
  return largest;
}

bool SweepReport::contact() const {
  return std::any_of(objects.begin(), objects.end(),
                     [](const SweptObject& object) { return !object.findings.triangles.empty(); });
}

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const SweepOptions& options)
    : tool_(std::move(tool)), detector_(std::move(detector)), options_(options) {}

SweepReport Guard::sweep(const ToolPose& pose, const Workpieces& workpieces) {
  SweepReport report;
  report.start = pose.stamp;
  report.end = pose.stamp;
  for (const auto& workpiece : workpieces) {
    const auto here = pose.X_MT.find(workpiece->frame);
    if (here == pose.X_MT.end()) {
      report.unswept.push_back(workpiece);
      continue;
    }
    const auto last = last_.find(workpiece->frame);
    const Placed from = last == last_.end() ? Placed{pose.stamp, here->second} : last->second;
    report.start = std::min(report.start, from.stamp);
    report.objects.push_back(
        {workpiece, from.stamp, testSweep(*detector_, tool_, {from.X_MT, here->second}, workpiece->mesh_M, options_)});
  }
  remember(pose, workpieces);
  return report;
}

// A frame without a workpiece is forgotten: what comes to live there later was not there when the tool moved before.
// One whose transform is missing now keeps its pose, so that the next sweep begins there.
void Guard::remember(const ToolPose& pose, const Workpieces& workpieces) {
  std::map<std::string, Placed> inhabited;
  for (const auto& workpiece : workpieces) {
    const auto last = last_.find(workpiece->frame);
    if (last != last_.end()) inhabited.insert(*last);
  }
  for (const auto& [frame, X_MT] : pose.X_MT) inhabited.insert_or_assign(frame, Placed{pose.stamp, X_MT});
  last_ = std::move(inhabited);
}

}  // namespace sweep_guard
