#include "sweep_guard/interaction/touch_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "guard/rigid_shape.h"
#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

void assignTriangles(const std::vector<TriangleContact>& contacts, TriangleSet& triangles) {
  triangles.clear();
  for (const TriangleContact& contact : contacts) triangles.push_back(contact.triangle);
}

// A joint may have jumped in parts, the first of which are no jump of a body.
bool jumps(const SweepReport& report, const std::string& frame) {
  return report.jumps.empty() ? !report.jump.empty() : report.jumps.count(frame) != 0;
}

bool isOfTheSameTriangles(const Workpiece& a, const Workpiece& b) {
  return a.revision == b.revision && sameTriangles(a.mesh_M, b.mesh_M);
}

}  // namespace

void TouchMap::add(const SweepReport& report, const Workpieces& workpieces) {
  forgetRemoved(workpieces);
  for (const SweptObject& object : report.objects) {
    if (object.workpiece->of_camera) continue;
    Touched& touched = touchedOf(object.workpiece);
    findTouched(object.result);
    if (in_sweep_.empty()) continue;
    if (jumps(report, object.workpiece->frame)) {
      unite(touched.jump_triangles, in_sweep_);
    } else {
      count(object.result, touched);
    }
    newest_ = report.end;
    ++changes_;
  }
}

void TouchMap::clear() {
  for (auto& [id, touched] : touched_) restart(touched);
  newest_ = Time();
  ++changes_;
}

void TouchMap::touches(std::vector<ObjectTouches>& objects) const {
  size_t count = 0;
  for (const auto& [id, touched] : touched_) {
    if (touched.empty()) continue;
    if (count == objects.size()) objects.emplace_back();
    ObjectTouches& object = objects[count++];
    object.id = id;
    object.revision = touched.workpiece->revision;
    object.triangles.clear();
    object.jump_triangles = touched.jump_triangles;
    for (const std::uint32_t triangle : touched.triangles) object.triangles.push_back(touched.of_triangle[triangle]);
  }
  objects.resize(count);
}

void TouchMap::forgetRemoved(const Workpieces& workpieces) {
  for (auto touched = touched_.begin(); touched != touched_.end();) {
    const auto same = [&](const auto& workpiece) { return workpiece->id == touched->first; };
    const bool there = std::any_of(workpieces.begin(), workpieces.end(), same);
    if (!there && !touched->second.empty()) ++changes_;
    touched = there ? std::next(touched) : touched_.erase(touched);
  }
}

TouchMap::Touched& TouchMap::touchedOf(const std::shared_ptr<const Workpiece>& workpiece) {
  Touched& touched = touched_[workpiece->id];
  if (!touched.workpiece || !isOfTheSameTriangles(*touched.workpiece, *workpiece)) {
    restart(touched);
    touched.workpiece.reset();
    touched.of_triangle.resize(workpiece->mesh_M.triangles().size());
    touched.triangles.reserve(touched.of_triangle.size());
  }
  touched.workpiece = workpiece;
  return touched;
}

void TouchMap::restart(Touched& touched) {
  if (touched.empty()) return;
  for (const std::uint32_t triangle : touched.triangles) touched.of_triangle[triangle] = {};
  touched.triangles.clear();
  touched.jump_triangles.clear();
  ++changes_;
}

void TouchMap::findTouched(const SweepResult& result) {
  if (result.fine) {
    assignTriangles(result.in_contact, in_sweep_);
    assignTriangles(result.allowed.in_contact, allowed_);
  } else {
    in_sweep_ = result.not_ruled_out;
    allowed_ = result.allowed.triangles;
  }
  unite(in_sweep_, allowed_);
}

void TouchMap::count(const SweepResult& result, Touched& touched) const {
  for (const std::uint32_t triangle : in_sweep_) {
    TriangleTouches& touch = touched.of_triangle[triangle];
    if (touch.sweeps == 0) {
      touch = {triangle, 0, kUnknown};
      touched.triangles.push_back(triangle);
    }
    if (touch.sweeps < std::numeric_limits<std::uint32_t>::max()) ++touch.sweeps;
  }
  for (const auto* const contacts : {&result.in_contact, &result.allowed.in_contact}) {
    for (const TriangleContact& contact : *contacts) {
      float& depth = touched.of_triangle[contact.triangle].depth;
      depth = std::fmax(depth, static_cast<float>(contact.impact.depth));
    }
  }
}

}  // namespace sweep_guard_core
