#include "sweep_guard/guard/guard.h"

#include <algorithm>

namespace sweep_guard {
namespace {

constexpr double kChordBulge = 1e-3;                                    // of the tool's extent
constexpr Duration kDeformationLasts = std::chrono::milliseconds(500);  // older workpieces are stale by default

// To the share of a longer motion that lasts from `begin` to `end`.
void rescale(std::vector<TouchedTriangle>& touched, double begin, double end) {
  for (TouchedTriangle& one : touched) one.impact.time_of_impact = begin + (end - begin) * one.impact.time_of_impact;
}

MovingMesh movingMesh(const Workpiece& now, const Workpiece& before, const Displacements& displacements) {
  if (&now == &before) return now.mesh_M;
  const bool skipped = now.updates > before.updates + 1;
  const double off = skipped ? strayed(now.way - before.way, displacements.least()) : 0.0;
  return {now.mesh_M, before.mesh_M, displacements, off};
}

// As it does by itself, but that names of frames stay where they are.
void assign(ToolPose& to, const ToolPose& from) {
  const auto same = [](const auto& a, const auto& b) { return a.first == b.first; };
  if (!std::equal(to.X_WM.begin(), to.X_WM.end(), from.X_WM.begin(), from.X_WM.end(), same)) {
    to = from;
    return;
  }
  to.stamp = from.stamp;
  to.received = from.received;
  to.X_WT = from.X_WT;
  auto next = from.X_WM.begin();
  for (auto& [frame, X_WM] : to.X_WM) X_WM = next++->second;
}

// The ways in known before stay where there is no newer one.
void learn(SweptBefore& known, const SweepFindings& found) {
  known.outside = !found.contact();
  for (const TouchedTriangle& one : found.touched) {
    known.ways_in.insert_or_assign(one.triangle, one.impact.normal_M);
  }
}

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b) {
  return &a.triangles() == &b.triangles() || (a.vertexCount() == b.vertexCount() && a.triangles() == b.triangles());
}

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

void lookAlong(const Forecast& forecast, const Workpieces& workpieces, PathTest& test, Detector& detector,
               const Tool& tool, const PathTest::Effort& effort, Outlook& outlook) {
  outlook.stamp = forecast.from.stamp;
  outlook.path = forecast.path;
  outlook.reflex_sweeps = forecast.reflex_sweeps;
  outlook.sweeps_asked = forecast.path.size();
  outlook.sweeps_made = effort.sweepsAlong(forecast.path);
  outlook.unplaced.clear();
  outlook.failures.clear();
  size_t tested = 0;
  for (const auto& workpiece : workpieces) {
    if (forecast.path.empty()) break;
    const auto X_WM = forecast.from.X_WM.find(workpiece->frame);
    if (X_WM == forecast.from.X_WM.end()) {
      outlook.unplaced.push_back(workpiece);
      continue;
    }
    try {
      if (tested == outlook.objects.size()) outlook.objects.emplace_back();
      test(detector, tool, forecast.from.X_WT, forecast.path, forecast.reflex_sweeps, X_WM->second, workpiece, effort,
           outlook.objects[tested]);
      ++tested;
    } catch (const std::exception& error) {  // the device, or no memory: the others are tested all the same
      outlook.failures.push_back({workpiece, error.what()});
    }
  }
  outlook.objects.resize(tested);
}

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : tool_(std::move(tool)),
      detector_(std::move(detector)),
      options_(options),
      predictor_(options.predictor),
      budget_(options.horizon, options.cycle),
      path_test_(options.pathTest()) {}

SweepReport Guard::sweep(const ToolPose& pose, const Workpieces& workpieces) {
  SweepReport report;
  sweep(pose, workpieces, report);
  return report;
}

void Guard::sweep(const ToolPose& pose, const Workpieces& workpieces, SweepReport& report) {
  const SteadyTime begin = options_.clock();
  forgetWhatIsGone(workpieces);
  take(pose);
  sweepAll(pose, workpieces, report);
  report.backlog = pose.stamp - waiting_since_.value_or(pose.stamp);
  waiting_since_.reset();
  swept_to_ = poses_;
  if (!forecast_) forecast_.emplace();
  assign(forecast_->from, pose);
  budget_.spentOnMeasured(options_.clock() - begin);
}

void Guard::pass(const ToolPose& pose) {
  take(pose);
  if (!waiting_since_) waiting_since_ = pose.stamp;
}

void Guard::take(const ToolPose& pose) {
  ++poses_;
  for (const auto& [frame, X_WM] : pose.X_WM) ways_[frame].add({poses_, pose.stamp, pose.X_WT, X_WM});
  predictor_.observe({pose.stamp, pose.X_WT});
}

void Guard::sweepAll(const ToolPose& pose, const Workpieces& workpieces, SweepReport& report) {
  report.start = report.end = pose.stamp;
  report.unplaced.clear();
  report.failures.clear();
  size_t swept = 0;
  for (const auto& workpiece : workpieces) {
    if (pose.X_WM.count(workpiece->frame) == 0) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    try {
      if (swept == report.objects.size()) report.objects.emplace_back();
      SweptObject& object = report.objects[swept];
      sweepObject(workpiece, object);
      report.start = std::min(report.start, object.interval_start);
      ++swept;
    } catch (const std::exception& error) {  // the device, or no memory: the others are swept all the same
      report.failures.push_back({workpiece, error.what()});
    }
  }
  report.objects.resize(swept);
  for (auto& [frame, way] : ways_) shorten(frame, way);
}

void Guard::sweepObject(const std::shared_ptr<const Workpiece>& workpiece, SweptObject& object) {
  const Way& way = ways_.at(workpiece->frame);
  const size_t last = way.size() - 1;
  Swept& swept = sweptBefore(workpiece);
  const size_t begin = way.lastUpTo(swept.pose);
  const auto past = [&](const Workpiece& deformation) { return deformation.stamp <= way[begin].stamp; };
  while (swept.deformations.size() > 1 && past(*swept.deformations[1])) {
    swept.deformations.erase(swept.deformations.begin());
  }
  const auto& from = swept.deformations.front();
  const Workpiece& before = *swept.deformations.back();
  const bool deformed = workpiece.get() != &before;
  if (deformed || swept.displaced_from != from) {
    swept.displaced_from = from;
    swept.displacements = workpiece == from ? Displacements() : Displacements(from->mesh_M, workpiece->mesh_M);
  }

  const MovingMesh mesh = movingMesh(*workpiece, *from, swept.displacements);
  const bool again = deformed && mesh.moved();
  const size_t first = again ? std::min(begin, way.lastUpTo(before.stamp)) : begin;
  object.workpiece = workpiece;
  object.interval_start = way[begin].stamp;
  object.findings.clear();
  known_ = swept.known;
  way.waypoints_M(first, last, tool_.extent(), waypoints_M_);
  size_t i = first;
  do {
    const bool is_new = i >= begin;
    const size_t end = first + endOfMotion(i - first, (is_new ? last : begin) - first);
    known_.settled.clear();
    if (!is_new) known_.settled = object.findings.met;  // once more tells nothing new
    SweepFindings& found =
        sweep_test_(*detector_, tool_, motions_M(way, first, i - first, end - first), mesh, options_.sweep, known_);
    if (is_new) known_.ways_in.clear();
    learn(known_, found);
    rescale(found.touched, way.share(begin, i), way.share(begin, end));
    unite(object.findings, found);
    i = end;
  } while (i < last);
  if (deformed) swept.deformations.push_back(workpiece);
  swept.pose = way.newest().number;
  std::swap(swept.known, known_);
}

// Whatever its triangles were: from there on it has not been swept.
Guard::Swept& Guard::sweptBefore(const std::shared_ptr<const Workpiece>& workpiece) {
  const auto one = swept_.find(workpiece->id);
  if (one == swept_.end()) return swept_.emplace(workpiece->id, Swept{{workpiece}, swept_to_}).first->second;
  Swept& known = one->second;
  const Workpiece& before = *known.deformations.back();
  if (before.frame != workpiece->frame) {
    known = {{workpiece}, swept_to_};
  } else if (!sameTriangles(before.mesh_M, workpiece->mesh_M)) {
    known = {{workpiece}, known.pose};
  }
  return known;
}

// Numbers count the waypoints of the stretch.
size_t Guard::endOfMotion(size_t begin, size_t last) const {
  if (begin >= last) return last;
  const ChordLimits limits{kChordBulge * tool_.extent(), options_.sweep.max_rotation};
  return lastOfChord(waypoints_M_, begin, last, tool_.extent(), limits);
}

// From one waypoint of the stretch that begins at place `first` of the way to another.
const std::vector<Motion>& Guard::motions_M(const Way& way, size_t first, size_t begin, size_t end) {
  if (end > begin + 1) {
    motions_M_.assign(1, chord(waypoints_M_, begin, end, tool_.extent()));
    return motions_M_;
  }
  const Placed& from = way[first + begin];
  const Placed& to = way[first + end];
  split({{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}}, options_.sweep.max_rotation, tool_.extent(), motions_M_);
  return motions_M_;
}

Outlook Guard::lookAhead(Duration age, const Workpieces& workpieces) {
  Outlook outlook;
  lookAhead(age, workpieces, outlook);
  return outlook;
}

void Guard::lookAhead(Duration age, const Workpieces& workpieces, Outlook& outlook) {
  if (!forecast_) {
    outlook = {};
    return;
  }
  const SteadyTime begin = options_.clock();
  horizon(options_.horizon, age, horizon_);
  predictor_.predict(horizon_.ends, forecast_->path);
  forecast_->reflex_sweeps = horizon_.reflex_sweeps;
  chooseEffort(begin);
  lookAlong(*forecast_, workpieces, path_test_, *detector_, tool_, effort_, outlook);
  size_t volumes = 0;
  for (const PredictedObject& object : outlook.objects) volumes = std::max(volumes, object.volumes_tested);
  budget_.spentOnPredicted(options_.clock() - begin, volumes);
}

void Guard::chooseEffort(SteadyTime begin) {
  effort_.sweep_ends.clear();
  effort_.spent = [this, end = begin + budget_.forPrediction()] { return options_.clock() >= end; };
  const PredictedPath& path = forecast_->path;
  if (path.empty()) return;
  size_t volumes[] = {0, 0};
  for (size_t i = 0; i < path.size(); ++i) {
    const Motion step{i == 0 ? forecast_->from.X_WT : path[i - 1].X_WT, path[i].X_WT};
    volumes[i < forecast_->reflex_sweeps ? 0 : 1] += countOfParts(step.angle(), options_.sweep.max_rotation);
  }
  const size_t considered_sweeps = budget_.consideredSweeps(volumes[0], volumes[1]);
  sweepEnds(forecast_->from.X_WT, path, forecast_->reflex_sweeps, considered_sweeps, effort_.sweep_ends);
}

Forecast Guard::forecast(Duration age, Duration end) const {
  if (!forecast_) return {};
  const Horizon asked = horizonUpTo(end, options_.horizon, age);
  return {forecast_->from, predictor_.predict(asked.ends), asked.reflex_sweeps};
}

void Guard::forget() {
  ways_.clear();
  swept_.clear();
  waiting_since_.reset();
  predictor_.restart();
  forecast_.reset();
}

void Guard::adopt(GuardChange& change) {
  change.options.clock = options_.clock;
  std::swap(options_, change.options);
  if (change.detector) std::swap(detector_, change.detector);
  if (change.tool) {
    std::swap(tool_, *change.tool);
    for (auto& [id, swept] : swept_) swept.known = {};
  }
  if (change.predictor) {
    std::swap(predictor_, *change.predictor);
    if (forecast_) predictor_.observe({forecast_->from.stamp, forecast_->from.X_WT});
  }
  budget_ = Budget(options_.horizon, options_.cycle);
  path_test_ = PathTest(options_.pathTest());
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
  std::uint64_t unswept = way.newest().number;
  for (const auto& [id, swept] : swept_) {
    if (swept.deformations.back()->frame == frame) unswept = std::min(unswept, swept.pose);
  }
  const Time oldest = way.newest().stamp - kDeformationLasts;
  while (way.size() > 1 && way[1].number <= unswept && way[1].stamp <= oldest) way.forgetFirst();
}

}  // namespace sweep_guard
