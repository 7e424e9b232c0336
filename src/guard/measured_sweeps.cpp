#include "guard/measured_sweeps.h"

#include <algorithm>
#include <utility>

#include "guard/late_deformations.h"
#include "guard/out_of_reach.h"
#include "guard/rigid_shape.h"

namespace sweep_guard_core {
namespace {

constexpr double kMergeTolerance = 1e-3;  // of the tool's bounding radius

// Converts fractions of a segment to fractions of the interval, in which the segment lasts from `begin` to `end`.
void rescale(std::vector<TriangleContact>& in_contact, double begin, double end) {
  for (TriangleContact& contact : in_contact) {
    contact.impact.time_of_impact = begin + (end - begin) * contact.impact.time_of_impact;
  }
}

// Returns whether no volume of a segment comes to the mesh.
bool staysOutOfReach(const SweepSetup& setup, const PoseHistory& history, size_t first, size_t last,
                     const MovingMesh& mesh) {
  const Tool& tool = setup.tool;
  const Eigen::Vector3d center_T = tool.bounds_T().center();
  const PoseBounds poses = history.bounds_M(first, last, center_T, tool.boundingRadius() + center_T.norm());
  const double merged = kMergeTolerance * tool.boundingRadius();
  return staysOutOfReach(tool, poses, mesh, setup.options.margin + merged);
}

// Keeps the older normal of a triangle that has no newer one.
void update(SweepCache& cache, const SweepResult& result) {
  cache.sides = result.sides;
  auto place = cache.contact_normals.begin();
  for (const TriangleContact& contact : result.in_contact) {
    place = std::next(cache.contact_normals.insert_or_assign(place, contact.triangle, contact.impact.normal_M));
  }
}

// Leaves what a sweep leaves that meets nothing. The tool was outside at its start, too, which holds even if the sweep fails.
void leaveOut(const SweepSetup& setup, bool has_new_poses, SweepCache& cache, SweepResult& result) {
  setup.before_sweep();
  result.fine = setup.options.fine;
  result.sides.assign(setup.tool.pieces().size(), PieceSide::kOutside);
  if (has_new_poses) cache.contact_normals.clear();
  update(cache, result);
}

}  // namespace

void MeasuredSweeps::pass(const PoseWithFrames& pose, const BodyPose& body, const FrameMotions& frames) {
  poses_.add(pose, body, frames);
  if (!waiting_since_ && !pose.anew) waiting_since_ = pose.received;
}

// A workpiece that is not swept now is swept from the same pose on next time.
void MeasuredSweeps::sweep(const SweepSetup& setup, const PoseWithFrames& pose, const std::optional<BodyPose>& arrived,
                           const Workpieces& workpieces, SweepReport& report) {
  begin(setup, pose, arrived, workpieces, report);
  size_t tested = 0;
  for (const auto& workpiece : workpieces) {
    if (!poses_.isPlaced(workpiece->frame, pose, setup.frames)) {
      report.unplaced.push_back(workpiece);
      continue;
    }
    try {
      if (tested == report.objects.size()) report.objects.emplace_back();
      sweepObject(setup, workpiece, lastSwept(workpiece), report, report.objects[tested]);
      ++tested;
    } catch (const std::exception& error) {  // of the detector, or no memory: the other workpieces are swept
      report.failures.push_back({workpiece, error.what()});
    }
  }
  report.objects.resize(tested);
  for (const auto& workpiece : report.unplaced) {
    Swept& swept = lastSwept(workpiece);
    swept.before = swept.pose;
  }
  sweepReplaced(setup, pose, report);
  end(pose, report);
}

void MeasuredSweeps::begin(const SweepSetup& setup, const PoseWithFrames& pose, const std::optional<BodyPose>& arrived,
                           const Workpieces& workpieces, SweepReport& report) {
  forgetRemoved(workpieces);
  for (auto& [id, swept] : swept_) {
    swept.before = swept.pose;
    swept.grown = false;
  }
  for (auto replaced = replaced_.begin(); replaced != replaced_.end();)
    replaced = replaced->second.reported ? replaced_.erase(replaced) : std::next(replaced);
  if (arrived) poses_.add(pose, *arrived, setup.frames);
  poses_.join(setup.frames);
  poses_.findJumps(swept_to_, setup.limits, report.jumps);
  report.start = report.end = pose.stamp;
  report.unplaced.clear();
  report.failures.clear();
}

void MeasuredSweeps::end(const PoseWithFrames& pose, SweepReport& report) {
  poses_.forgetBefore(kMaxUpdateInterval,
                      [this](const std::string& frame, std::uint64_t newest) { return firstUnswept(frame, newest); });
  report.backlog = pose.received - waiting_since_.value_or(pose.received);
  waiting_since_.reset();
  report.passed_over = poses_.takePassedOver();
  swept_to_ = poses_.newest();
}

// What fails is swept to the next pose.
void MeasuredSweeps::sweepReplaced(const SweepSetup& setup, const PoseWithFrames& pose, SweepReport& report) {
  report.replaced.clear();
  for (auto& [id, replaced] : replaced_) {
    const auto workpiece = replaced.deformations.back();
    if (!poses_.isPlaced(workpiece->frame, pose, setup.frames)) continue;
    SweptObject& object = report.replaced.emplace_back();
    try {
      sweepObject(setup, workpiece, replaced, report, object);
      replaced.reported = true;
    } catch (const std::exception& error) {  // of the detector, or no memory
      report.replaced.pop_back();
      report.failures.push_back({workpiece, error.what()});
    }
  }
}

void MeasuredSweeps::sweepObject(const SweepSetup& setup, const std::shared_ptr<const Workpiece>& workpiece,
                                 Swept& swept, SweepReport& report, SweptObject& object) {
  Passage passage = passageTo(setup, workpiece, swept, object);
  const bool left_out = setup.several && std::all_of(meshes_.begin(), meshes_.end(), [&](const MovingMesh& mesh) {
                          return staysOutOfReach(setup, passage.history, passage.next, passage.last, mesh);
                        });
  if (left_out) {
    leaveOut(setup, /*has_new_poses=*/passage.next == passage.begin || passage.begin < passage.last, swept.cache,
             object.result);
  } else {
    cache_ = swept.cache;
    Detector& detector = setup.detectors.of(*workpiece);
    const ContactPolicy contact(setup.tool, *workpiece, &setup.allowed, &setup.intentions);
    while (nextMotion(setup, object.result, passage)) {
      // Along old poses only the newest mesh is new: the others were swept there when they came.
      for (size_t i = passage.isNew() ? 0 : meshes_.size() - 1; i < meshes_.size(); ++i) {
        SweepResult& result =
            sweep_checker_.check(detector, {setup.tool, sub_motions_M_, meshes_[i], setup.options, cache_, contact});
        keep(passage, report.end, result, object);
      }
    }
  }
  endPassage(passage, workpiece, swept);
  if (!left_out) std::swap(swept.cache, cache_);
  report.start = std::min(report.start, object.interval_start);
}

// Of a mesh that has moved, the path since it was where it was before is swept again.
MeasuredSweeps::Passage MeasuredSweeps::passageTo(const SweepSetup& setup,
                                                  const std::shared_ptr<const Workpiece>& workpiece, Swept& swept,
                                                  SweptObject& object) {
  const PoseHistory& history = poses_.of(workpiece->frame);
  swept.before = swept.pose;
  const size_t begin = history.lastUpTo(swept.pose);
  const Time stamp = history[begin].stamp;
  addMeshes(setup, stamp, workpiece, swept, object);
  const auto& before = swept.deformations.back();
  const bool again = workpiece != before && meshes_.back().moved();
  object.workpiece = workpiece;
  object.interval_start = stamp;
  object.result.clear();
  return {history, begin, history.size() - 1, again ? std::min(begin, history.lastUpTo(before->stamp)) : begin};
}

// A mesh moves from the deformation at the time of the pose to the newest. What a camera saw may have gone at any time since that
// image, and have come at any time before the next one: until then it rests.
void MeasuredSweeps::addMeshes(const SweepSetup& setup, Time pose, const std::shared_ptr<const Workpiece>& workpiece,
                               Swept& swept, SweptObject& object) {
  const auto& from = deformationAt(pose, *workpiece, swept);
  object.behind = swept.incomplete ? from->stamp - pose : Duration::zero();
  meshes_.clear();
  if (!workpiece->of_camera) {
    meshes_.push_back(movingMesh(*workpiece, *from, setup.displacements.between(from, workpiece)));
    return;
  }
  meshes_.emplace_back(from->mesh_M);
  for (size_t i = 1; i < swept.deformations.size(); ++i)
    meshes_.push_back(MovingMesh::grid(swept.deformations[i]->mesh_M));
  const Workpiece& before = *swept.deformations.back();
  if (workpiece.get() == &before) return;
  meshes_.push_back(MovingMesh::grid(workpiece->mesh_M));
  const Duration interval = workpiece->stamp - before.stamp;
  const bool is_whole = workpiece->updates <= before.updates + 1 && interval <= kMaxUpdateInterval;
  if (!is_whole) object.behind = std::max(object.behind, interval);
}

void MeasuredSweeps::endPassage(const Passage& passage, const std::shared_ptr<const Workpiece>& workpiece,
                                Swept& swept) {
  const bool deformed = workpiece != swept.deformations.back();
  if (deformed) swept.deformations.push_back(workpiece);
  swept.grown = deformed;
  swept.pose = passage.history.newest().number;
}

// Finds the sub-motions of the next sweep. Returns false after the last one.
// @param found  by those before
bool MeasuredSweeps::nextMotion(const SweepSetup& setup, const SweepResult& found, Passage& passage) {
  passage.from = passage.to;
  if (passage.from == passage.end && !nextSegment(setup, passage)) return false;
  passage.to = cutMotion(setup, passage);
  confirm(passage, found);
  return true;
}

bool MeasuredSweeps::nextSegment(const SweepSetup& setup, Passage& passage) {
  if (passage.next > passage.last) return false;
  passage.start = passage.from = passage.next;
  passage.end = passage.history.endOfMotion(passage.start, passage.last);
  passage.next = passage.end + 1;
  passage.history.path_M(passage.start, passage.end, setup.tool.boundingRadius(), path_M_);
  return true;
}

// Returns the last pose of the motion, which has new poses only, or none.
size_t MeasuredSweeps::cutMotion(const SweepSetup& setup, const Passage& passage) {
  setup.before_sweep();
  const double radius = setup.tool.boundingRadius();
  const double max_rotation = setup.options.max_rotation;
  const size_t first = passage.from - passage.start;  // in path_M_, as the following
  size_t last = (passage.isNew() ? passage.end : passage.beginOfNew()) - passage.start;
  if (first < last) last = endOfMergedMotion(path_M_, first, last, radius, kMergeTolerance * radius, max_rotation);
  const size_t to_pose = passage.start + last;
  if (last > first + 1) {
    sub_motions_M_.assign(1, mergedMotion(path_M_, first, last, radius));
  } else {
    const PoseSample& from = passage.history[passage.from];
    const PoseSample& to = passage.history[to_pose];
    sub_motions_M_ = split({{from.X_WT, to.X_WT, to.deviation_bound}, {from.X_WM, to.X_WM}}, max_rotation, radius,
                           std::move(sub_motions_M_));
  }
  return to_pose;
}

// Of poses that were swept before, what was found counts.
void MeasuredSweeps::confirm(const Passage& passage, const SweepResult& found) {
  cache_.already_confirmed.clear();
  if (passage.isNew()) return;
  cache_.already_confirmed = found.not_ruled_out;
  remove(cache_.already_confirmed, found.intended);
}

// Adds what a sweep met, in fractions of the interval. What was found before a change of place says nothing of where things are now.
void MeasuredSweeps::keep(const Passage& passage, Time end, SweepResult& result, SweptObject& object) {
  if (passage.isNew()) cache_.contact_normals.clear();
  update(cache_, result);
  const double from = passage.history.share(passage.begin, passage.from, end);
  const double to = passage.history.share(passage.begin, passage.to, end);
  for (std::vector<TriangleContact>* const in_contact : {&result.in_contact, &result.allowed.in_contact})
    rescale(*in_contact, from, to);
  unite(object.result, result);
  if (passage.to == passage.end && passage.end < passage.last) cache_ = {};
}

// Returns the deformation that was there at the time of a pose, and forgets those before it.
const std::shared_ptr<const Workpiece>& MeasuredSweeps::deformationAt(Time pose, const Workpiece& newest,
                                                                      Swept& swept) {
  while (swept.deformations.size() > 1 && swept.deformations[1]->stamp <= pose) {
    swept.deformations.erase(swept.deformations.begin());
  }
  swept.incomplete = forgetLateDeformations(newest, swept.deformations) || swept.incomplete;
  const auto& from = swept.deformations.front();
  swept.incomplete = swept.incomplete && from->stamp > pose;
  return from;
}

// Of those that came meanwhile, only the newest is swept besides the one that was swept last.
void MeasuredSweeps::replace(Swept& swept, const std::shared_ptr<const Workpiece>& workpiece) {
  Swept next = firstOf(workpiece, swept.pose);
  const auto [place, is_first] = replaced_.try_emplace(workpiece->id);
  std::swap(swept, next);
  if (is_first) place->second = std::move(next);
}

// Returns the state of a workpiece that was not swept before. An image counts from its stamp on, any other workpiece from the last
// swept pose on.
MeasuredSweeps::Swept MeasuredSweeps::firstOf(const std::shared_ptr<const Workpiece>& workpiece,
                                              std::uint64_t swept_to) const {
  const PoseHistory* const history = poses_.find(workpiece->frame);
  if (!workpiece->of_camera || history == nullptr) return {{workpiece}, swept_to};
  return {{workpiece}, std::min(swept_to, (*history)[history->lastUpTo(workpiece->stamp)].number)};
}

// A workpiece with other triangles, or in another frame, has not been swept since the last pose.
MeasuredSweeps::Swept& MeasuredSweeps::lastSwept(const std::shared_ptr<const Workpiece>& workpiece) {
  const auto entry = swept_.find(workpiece->id);
  if (entry == swept_.end()) return swept_.emplace(workpiece->id, firstOf(workpiece, swept_to_)).first->second;
  Swept& swept = entry->second;
  const Workpiece& before = *swept.deformations.back();
  if (before.frame != workpiece->frame) {
    swept = firstOf(workpiece, swept_to_);
    replaced_.erase(workpiece->id);
  } else if (!sameTriangles(before.mesh_M, workpiece->mesh_M)) {
    replace(swept, workpiece);
  }
  return swept;
}

void MeasuredSweeps::takeBack() noexcept {
  for (auto& [id, swept] : swept_) {
    swept.pose = swept.before;
    if (swept.grown) swept.deformations.pop_back();
    swept.grown = false;
  }
  for (auto& [id, replaced] : replaced_) {
    replaced.pose = replaced.before;
    replaced.reported = false;
  }
}

void MeasuredSweeps::reset() {
  poses_.reset();
  swept_.clear();
  replaced_.clear();
  waiting_since_.reset();
}

void MeasuredSweeps::forgetContacts() {
  for (auto& [id, swept] : swept_) swept.cache = {};
  for (auto& [id, replaced] : replaced_) replaced.cache = {};
}

// A workpiece that appears later in an empty frame was not there when the tool moved.
void MeasuredSweeps::forgetRemoved(const Workpieces& workpieces) {
  poses_.forgetOtherFrames(workpieces);
  keepOnlyNamed(workpieces, &Workpiece::id, swept_);
  keepOnlyNamed(workpieces, &Workpiece::id, replaced_);
}

std::uint64_t MeasuredSweeps::firstUnswept(const std::string& frame, std::uint64_t newest) const {
  std::uint64_t unswept = newest;
  for (const auto* const all : {&swept_, &replaced_}) {
    for (const auto& [id, swept] : *all) {
      if (swept.deformations.back()->frame == frame) unswept = std::min(unswept, swept.before);
    }
  }
  return unswept;
}

}  // namespace sweep_guard_core
