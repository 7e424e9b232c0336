#include "sweep_guard/guard/guard.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr double kMergeTolerance = 1e-3;  // of the tool's bounding radius
constexpr Duration kDeformationLasts = std::chrono::milliseconds(500);

// From fractions of a segment to fractions of the interval, in which the segment lasts from `begin` to `end`.
void rescale(std::vector<TriangleContact>& in_contact, double begin, double end) {
  for (TriangleContact& one : in_contact) one.impact.time_of_impact = begin + (end - begin) * one.impact.time_of_impact;
}

MovingMesh movingMesh(const Workpiece& now, const Workpiece& before, const Displacements& displacements) {
  if (&now == &before) return now.mesh_M;
  const bool skipped = now.updates > before.updates + 1;
  const double off = skipped ? pathDeviation(now.path_length - before.path_length, displacements.least()) : 0.0;
  return {now.mesh_M, before.mesh_M, displacements, off};
}

// Copies the pose, reusing map nodes when the frames are equal.
void assign(PoseWithFrames& to, const PoseWithFrames& from) {
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

// Older normals stay where there is no newer one.
void update(SweepCache& cache, const SweepResult& result) {
  cache.outside = !result.contact();
  for (const TriangleContact& one : result.in_contact) {
    cache.contact_normals.insert_or_assign(one.triangle, one.impact.normal_M);
  }
}

bool sameTriangles(const TriangleMesh& a, const TriangleMesh& b) {
  return &a.triangles() == &b.triangles() || (a.vertexCount() == b.vertexCount() && a.triangles() == b.triangles());
}

}  // namespace

Guard::Guard(Tool tool, std::unique_ptr<Detector> detector, const GuardOptions& options)
    : tool_(std::move(tool)),
      detector_(std::move(detector)),
      options_(options),
      predictor_(options.predictor),
      budget_(options.horizon, options.cycle),
      path_checker_(PathChecker::optionsOf(options)) {}

SweepReport Guard::sweep(const PoseWithFrames& pose, const Workpieces& workpieces) {
  SweepReport report;
  sweep(pose, workpieces, report);
  return report;
}

void Guard::sweep(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report) {
  const SteadyTime begin = options_.clock();
  forgetRemoved(workpieces);
  take(pose);
  sweepAll(pose, workpieces, report);
  report.backlog = pose.stamp - waiting_since_.value_or(pose.stamp);
  waiting_since_.reset();
  swept_to_ = poses_;
  if (!predicted_motion_) predicted_motion_.emplace();
  assign(predicted_motion_->from, pose);
  budget_.spentOnMeasured(options_.clock() - begin);
}

void Guard::pass(const PoseWithFrames& pose) {
  take(pose);
  if (!waiting_since_) waiting_since_ = pose.stamp;
}

void Guard::take(const PoseWithFrames& pose) {
  ++poses_;
  for (const auto& [frame, X_WM] : pose.X_WM) histories_[frame].add({poses_, pose.stamp, pose.X_WT, X_WM});
  predictor_.observe({pose.stamp, pose.X_WT});
}

void Guard::sweepAll(const PoseWithFrames& pose, const Workpieces& workpieces, SweepReport& report) {
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
    } catch (const std::exception& error) {  // of the detector, or no memory: the other workpieces are swept
      report.failures.push_back({workpiece, error.what()});
    }
  }
  report.objects.resize(swept);
  for (auto& [frame, history] : histories_) shorten(frame, history);
}

void Guard::sweepObject(const std::shared_ptr<const Workpiece>& workpiece, SweptObject& object) {
  const PoseHistory& history = histories_.at(workpiece->frame);
  const size_t last = history.size() - 1;
  Swept& swept = sweptBefore(workpiece);
  const size_t begin = history.lastUpTo(swept.pose);
  const auto past = [&](const Workpiece& deformation) { return deformation.stamp <= history[begin].stamp; };
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
  const size_t first = again ? std::min(begin, history.lastUpTo(before.stamp)) : begin;
  object.workpiece = workpiece;
  object.interval_start = history[begin].stamp;
  object.result.clear();
  cache_ = swept.cache;
  history.path_M(first, last, tool_.boundingRadius(), path_M_);
  size_t i = first;
  do {
    const bool is_new = i >= begin;
    const size_t end = first + endOfMotion(i - first, (is_new ? last : begin) - first);
    cache_.already_confirmed.clear();
    if (!is_new) cache_.already_confirmed = object.result.not_ruled_out;
    SweepResult& found = sweep_checker_.check(
        *detector_, {tool_, motions_M(history, first, i - first, end - first), mesh, options_.sweep, cache_});
    if (is_new) cache_.contact_normals.clear();
    update(cache_, found);
    rescale(found.in_contact, history.share(begin, i), history.share(begin, end));
    unite(object.result, found);
    i = end;
  } while (i < last);
  if (deformed) swept.deformations.push_back(workpiece);
  swept.pose = history.newest().number;
  std::swap(swept.cache, cache_);
}

// A workpiece with other triangles, or in another frame, has not been swept since the last pose.
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

// Numbers count points of path_M_.
size_t Guard::endOfMotion(size_t begin, size_t last) const {
  if (begin >= last) return last;
  const MergeLimits limits{kMergeTolerance * tool_.boundingRadius(), options_.sweep.max_rotation};
  return endOfMergedMotion(path_M_, begin, last, tool_.boundingRadius(), limits);
}

// Between two points of path_M_, whose first point is sample `first` of the history.
const std::vector<Motion>& Guard::motions_M(const PoseHistory& history, size_t first, size_t begin, size_t end) {
  if (end > begin + 1) {
    motions_M_.assign(1, mergedMotion(path_M_, begin, end, tool_.boundingRadius()));
    return motions_M_;
  }
  const PoseSample& from = history[first + begin];
  const PoseSample& to = history[first + end];
  split({{from.X_WT, to.X_WT}, {from.X_WM, to.X_WM}}, options_.sweep.max_rotation, tool_.boundingRadius(), motions_M_);
  return motions_M_;
}

Prediction Guard::predict(Duration age, const Workpieces& workpieces) {
  Prediction prediction;
  predict(age, workpieces, prediction);
  return prediction;
}

void Guard::predict(Duration age, const Workpieces& workpieces, Prediction& prediction) {
  if (!predicted_motion_) {
    prediction = {};
    return;
  }
  const SteadyTime begin = options_.clock();
  horizon(options_.horizon, age, horizon_);
  predictor_.predict(horizon_.ends, predicted_motion_->path);
  predicted_motion_->reflex_sweeps = horizon_.reflex_sweeps;
  chooseSweepPlan(begin);
  path_checker_.predict(*detector_, {tool_, *predicted_motion_, workpieces, plan_}, prediction);
  size_t volumes = 0;
  for (const PredictedObject& object : prediction.objects) volumes = std::max(volumes, object.volumes_tested);
  budget_.spentOnPredicted(options_.clock() - begin, volumes);
}

void Guard::chooseSweepPlan(SteadyTime begin) {
  plan_.sweep_ends.clear();
  plan_.out_of_time = [this, end = begin + budget_.forPrediction()] { return options_.clock() >= end; };
  const PredictedPath& path = predicted_motion_->path;
  if (path.empty()) return;
  size_t volumes[] = {0, 0};
  for (size_t i = 0; i < path.size(); ++i) {
    const Motion step{i == 0 ? predicted_motion_->from.X_WT : path[i - 1].X_WT, path[i].X_WT};
    volumes[i < predicted_motion_->reflex_sweeps ? 0 : 1] += subMotionCount(step.angle(), options_.sweep.max_rotation);
  }
  const size_t considered_sweeps = budget_.consideredSweeps(volumes[0], volumes[1]);
  sweepEnds(predicted_motion_->from.X_WT, path, predicted_motion_->reflex_sweeps, considered_sweeps, plan_.sweep_ends);
}

PredictedMotion Guard::predictMotion(Duration age, Duration end) const {
  if (!predicted_motion_) return {};
  const Horizon asked = horizonUpTo(end, options_.horizon, age);
  return {predicted_motion_->from, predictor_.predict(asked.ends), asked.reflex_sweeps};
}

void Guard::reset() {
  histories_.clear();
  swept_.clear();
  waiting_since_.reset();
  predictor_.restart();
  predicted_motion_.reset();
}

void Guard::exchange(GuardChange& change) {
  change.options.clock = options_.clock;
  std::swap(options_, change.options);
  if (change.detector) std::swap(detector_, change.detector);
  if (change.tool) {
    std::swap(tool_, *change.tool);
    for (auto& [id, swept] : swept_) swept.cache = {};
  }
  if (change.predictor) {
    std::swap(predictor_, *change.predictor);
    if (predicted_motion_) predictor_.observe({predicted_motion_->from.stamp, predicted_motion_->from.X_WT});
  }
  budget_ = TimeBudget(options_.horizon, options_.cycle);
  path_checker_ = PathChecker(PathChecker::optionsOf(options_));
}

// A workpiece that appears later in an empty frame was not there when the tool moved.
void Guard::forgetRemoved(const Workpieces& workpieces) {
  const auto dropUnless = [&](auto& known, const auto& fits) {
    for (auto one = known.begin(); one != known.end();) {
      const bool there = std::any_of(workpieces.begin(), workpieces.end(),
                                     [&](const auto& workpiece) { return fits(*workpiece, one->first); });
      one = there ? std::next(one) : known.erase(one);
    }
  };
  dropUnless(histories_, [](const Workpiece& workpiece, const std::string& frame) { return workpiece.frame == frame; });
  dropUnless(swept_, [](const Workpiece& workpiece, const std::string& id) { return workpiece.id == id; });
}

// Keeps what a mesh update may need, and what some workpiece has not been swept along yet.
void Guard::shorten(const std::string& frame, PoseHistory& history) const {
  std::uint64_t unswept = history.newest().number;
  for (const auto& [id, swept] : swept_) {
    if (swept.deformations.back()->frame == frame) unswept = std::min(unswept, swept.pose);
  }
  const Time oldest = history.newest().stamp - kDeformationLasts;
  while (history.size() > 1 && history[1].number <= unswept && history[1].stamp <= oldest) history.forgetFirst();
}

}  // namespace sweep_guard_core
