#include "guard/united_bodies.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "guard/sweep_checker.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

template <typename Object>
Object* objectOf(const std::shared_ptr<const Workpiece>& workpiece, std::vector<Object>& objects) {
  const auto same = [&](const Object& object) { return object.workpiece == workpiece; };
  const auto found = std::find_if(objects.begin(), objects.end(), same);
  return found == objects.end() ? nullptr : &*found;
}

// One failure tells enough of a workpiece.
void unite(std::vector<SweepFailure>& all, const std::vector<SweepFailure>& body) {
  for (const SweepFailure& failure : body) {
    const auto same = [&](const SweepFailure& known) { return known.workpiece == failure.workpiece; };
    if (std::none_of(all.begin(), all.end(), same)) all.push_back(failure);
  }
}

// Makes the interval begin at an earlier stamp.
void beginAt(Time start, Time end, SweptObject& object) {
  const double length = toSeconds(end - start);
  const double left_out = length > 0.0 ? toSeconds(object.interval_start - start) / length : 0.0;
  object.interval_start = start;
  if (left_out == 0.0) return;
  const auto delay = [&](std::vector<TriangleContact>& in_contact) {
    for (TriangleContact& contact : in_contact) {
      double& time = contact.impact.time_of_impact;
      time = left_out + (1.0 - left_out) * time;
    }
  };
  delay(object.result.in_contact);
  delay(object.result.allowed.in_contact);
}

void unite(SweptObject& all, SweptObject& body, Time end) {
  const Time start = std::min(all.interval_start, body.interval_start);
  beginAt(start, end, all);
  beginAt(start, end, body);
  all.behind = std::max(all.behind, body.behind);
  uniteBodies(all.result, body.result);
}

void countPiecesFrom(size_t first_piece, SweptObject& object) {
  for (TriangleContact& contact : object.result.in_contact) contact.piece += first_piece;
  for (TriangleContact& contact : object.result.allowed.in_contact) contact.piece += first_piece;
}

void countPiecesFrom(size_t first_piece, PredictedObject& object) {
  for (PredictedSweep& sweep : object.sweeps) {
    if (sweep.tool_piece) *sweep.tool_piece += first_piece;
  }
}

// Most bodies are far from most workpieces.
bool areFree(const std::vector<PredictedSweep>& sweeps) {
  return std::all_of(sweeps.begin(), sweeps.end(), [](const PredictedSweep& sweep) {
    return !sweep.contact && sweep.deviations == std::numeric_limits<double>::infinity();
  });
}

// Of two sweeps that overlap.
void unite(PredictedSweep& all, const PredictedSweep& body) {
  const bool nearer = body.deviations < all.deviations;
  if (body.contact != all.contact ? body.contact : nearer) all.tool_piece = body.tool_piece;
  all.contact = all.contact || body.contact;
  all.deviations = std::min(all.deviations, body.deviations);
}

// Cuts both where either ends.
std::vector<PredictedSweep> united(const std::vector<PredictedSweep>& all, const std::vector<PredictedSweep>& body) {
  std::vector<PredictedSweep> united;
  for (size_t i = 0, j = 0; i < all.size() && j < body.size();) {
    united.push_back(all[i]);
    unite(united.back(), body[j]);
    united.back().from = std::max(all[i].from, body[j].from);
    const bool last_i = i + 1 == all.size();
    const bool last_j = j + 1 == body.size();
    if (last_i && last_j) break;
    const bool step_i = !last_i && (last_j || all[i + 1].from <= body[j + 1].from);
    const bool step_j = !last_j && (last_i || body[j + 1].from <= all[i + 1].from);
    i += step_i ? 1 : 0;
    j += step_j ? 1 : 0;
  }
  return united;
}

void unite(PredictedObject& all, PredictedObject& body) {
  if (areFree(all.sweeps)) std::swap(all.sweeps, body.sweeps);
  if (!areFree(body.sweeps)) all.sweeps = united(all.sweeps, body.sweeps);
  sweep_guard_core::unite(all.reflex, body.reflex);
  sweep_guard_core::unite(all.considered, body.considered);
  remove(all.considered, all.reflex);
  all.volumes_M.insert(all.volumes_M.end(), body.volumes_M.begin(), body.volumes_M.end());
  all.volumes_tested += body.volumes_tested;
}

template <typename Object, typename Unite>
void uniteEach(std::vector<Object>& all, std::vector<Object>& body, size_t first_piece, const Unite& unite) {
  for (Object& object : body) {
    countPiecesFrom(first_piece, object);
    if (Object* const known = objectOf(object.workpiece, all)) {
      unite(*known, object);
    } else {
      all.push_back(std::move(object));
    }
  }
}

}  // namespace

void unite(SweepReport& all, SweepReport& body, size_t first_piece) {
  all.start = std::min(all.start, body.start);
  all.backlog = std::max(all.backlog, body.backlog);
  unite(all.failures, body.failures);
  all.passed_over.insert(body.passed_over.begin(), body.passed_over.end());
  all.jumps.insert(body.jumps.begin(), body.jumps.end());
  for (const auto objects : {&SweepReport::objects, &SweepReport::replaced})
    uniteEach(all.*objects, body.*objects, first_piece,
              [&](SweptObject& known, SweptObject& object) { unite(known, object, all.end); });
}

void unite(Prediction& all, Prediction& body, size_t first_piece) {
  all.sweeps_made = std::min(all.sweeps_made, body.sweeps_made);
  unite(all.failures, body.failures);
  uniteEach(all.objects, body.objects, first_piece,
            [](PredictedObject& known, PredictedObject& object) { unite(known, object); });
}

}  // namespace sweep_guard_core
