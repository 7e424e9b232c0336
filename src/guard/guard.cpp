#include "sweep_guard/guard/guard.h"

#include <algorithm>
#include <set>

namespace sweep_guard {
namespace {

constexpr size_t kLongestWay = 4096;  // of a detector that keeps failing: the warning is not clear meanwhile
constexpr Duration kDeformationLasts = std::chrono::milliseconds(500);  // older workpieces are stale by default

// To the share of a longer motion that begins at `done` and lasts `share`.
void rescale(std::vector<TouchedTriangle>& touched, double done, double share) {
  for (TouchedTriangle& one : touched) one.impact.time_of_impact = done + share * one.impact.time_of_impact;
}

MovingMesh movingMesh(const Workpiece& now, const Workpiece& before) {
  if (&now == &before) return now.mesh_M;
  const bool skipped = now.updates > before.updates + 1;
  const double off = skipped ? strayed(now.way - before.way, leastWay(before.mesh_M, now.mesh_M)) : 0.0;
  return {now.mesh_M, before.mesh_M, off};
}

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b) { return &a.triangles() == &b.triangles(); }

}  // namespace

double SweepReport::margin() const {
  double largest = 0.0;
  for (const SweptObject& object : objects) largest = std::max(largest, object.findings.margin);
  return largest;
}

bool SweepReport::contact() const {
  return std::any_of(objects.begin(), objects.end(),
                     [](const SweptObject& object) { return object.findings.contact(); });
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
  forgetWhatIsGone(workpieces);
  ++poses_;
  for (const auto& [frame, X_WM] : pose.X_WM) {
    Way& way = ways_[frame];
    if (way.size() >= kLongestWay) way.erase(way.begin() + 1);
    way.push_back({poses_, pose.stamp, pose.X_WT, X_WM});
  }

  SweepReport report{pose.stamp, pose.stamp, {}, {}, {}};
  for (const auto& workpiece : workpieces) {
    if (pose.X_WM.count(workpiece->frame) == 0) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    try {
      report.objects.push_back(sweepObject(workpiece));
      report.start = std::min(report.start, report.objects.back().interval_start);
    } catch (const std::exception& error) {  // the device, or no memory: the others are swept all the same
      report.failures.push_back({workpiece, error.what()});
    }
  }
  for (auto& [frame, way] : ways_) shorten(frame, way);
  return report;
}

// Places in a way: legs from `first` on are swept; those before `begin` only because the mesh has moved since.
struct Guard::Span {
  size_t first;
  size_t begin;
};

SweptObject Guard::sweepObject(const std::shared_ptr<const Workpiece>& workpiece) {
  const Way& way = ways_.at(workpiece->frame);
  const Swept* before = sweptBefore(*workpiece);
  const MovingMesh mesh = before != nullptr ? movingMesh(*workpiece, *before->workpiece) : workpiece->mesh_M;
  const auto [first, begin] = spanOf(way, before, mesh);
  WaysIn ways_in = before != nullptr ? before->ways_in : WaysIn();
  if (before == nullptr) swept_[workpiece->id] = {workpiece, way[begin].number, {}};  // should the sweep fail
  SweptObject object{workpiece, way[begin].stamp, {}};
  const double legs = std::max(1.0, static_cast<double>(way.size() - 1 - begin));
  for (size_t i = first; i < std::max(way.size() - 1, first + 1); ++i) {
    SweepFindings found = sweepLeg(way[i], way[std::min(i + 1, way.size() - 1)], mesh, ways_in);
    ways_in = waysIn(found.touched);
    const double done = i < begin ? 0.0 : static_cast<double>(i - begin) / legs;
    rescale(found.touched, done, i < begin ? 0.0 : 1.0 / legs);
    unite(object.findings, std::move(found));
  }
  swept_[workpiece->id] = {workpiece, way.back().number, std::move(ways_in)};
  return object;
}

const Guard::Swept* Guard::sweptBefore(const Workpiece& workpiece) const {
  const auto found = swept_.find(workpiece.id);
  if (found == swept_.end()) return nullptr;
  const Workpiece& before = *found->second.workpiece;
  return before.frame == workpiece.frame && sameTriangles(before.mesh_M, workpiece.mesh_M) ? &found->second : nullptr;
}

Guard::Span Guard::spanOf(const Way& way, const Swept* before, const MovingMesh& mesh) const {
  const size_t last = way.size() - 1;
  if (before == nullptr) return {last == 0 ? 0 : last - 1, last == 0 ? 0 : last - 1};
  const auto first_after = [&](const auto& is_after) {
    return static_cast<size_t>(std::find_if(way.begin(), way.end(), is_after) - way.begin());
  };
  const size_t after_swept = first_after([&](const Placed& placed) { return placed.number > before->pose; });
  const size_t begin = std::min(last, std::max<size_t>(after_swept, 1) - 1);
  if (!mesh.moved()) return {begin, begin};
  const size_t after_mesh = first_after([&](const Placed& placed) { return placed.stamp > before->workpiece->stamp; });
  return {std::min(begin, std::max<size_t>(after_mesh, 1) - 1), begin};
}

SweepFindings Guard::sweepLeg(const Placed& from, const Placed& to, const MovingMesh& mesh, const WaysIn& ways_in) {
  const RelativeMotion motion{{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}};
  const std::vector<Motion> parts = split(motion, options_.sweep.max_rotation, tool_.extent());
  return testSweep(*detector_, tool_, parts, mesh, options_.sweep, ways_in);
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
  swept_.clear();
  predictor_.restart();
  newest_.reset();
}

// What comes to live in an empty frame later was not there when the tool moved before.
void Guard::forgetWhatIsGone(const Workpieces& workpieces) {
  const auto dropUnless = [&](auto& known, const auto& fits) {
    for (auto one = known.begin(); one != known.end();) {
      const bool there = std::any_of(workpieces.begin(), workpieces.end(),
                                     [&](const auto& workpiece) { return fits(*workpiece, one->first); });
      one = there ? std::next(one) : known.erase(one);
    }
  };
  dropUnless(ways_, [](const Workpiece& workpiece, const std::string& frame) { return workpiece.frame == frame; });
  dropUnless(swept_, [](const Workpiece& workpiece, const std::string& id) { return workpiece.id == id; });
}

// To what an update of a mesh may ask for, and to what a workpiece has not been swept along yet.
void Guard::shorten(const std::string& frame, Way& way) const {
  std::uint64_t unswept = way.back().number;
  for (const auto& [id, swept] : swept_) {
    if (swept.workpiece->frame == frame) unswept = std::min(unswept, swept.pose);
  }
  const Time oldest = way.back().stamp - kDeformationLasts;
  while (way.size() > 1 && way[1].number <= unswept && way[1].stamp <= oldest) way.pop_front();
}

}  // namespace sweep_guard
