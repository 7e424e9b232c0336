#include "simulation/drilling.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>

#include "common/number_text.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_simulation {

using sweep_guard_core::InvalidInput;
using sweep_guard_core::TriangleMesh;

namespace {

std::optional<double> heightOver(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                 const Eigen::Vector2d& point) {
  Eigen::Matrix2d sides;
  sides << (b - a).head<2>(), (c - a).head<2>();
  if (sides.determinant() == 0.0) return std::nullopt;
  const Eigen::Vector2d weights = sides.inverse() * (point - a.head<2>());
  if (weights.minCoeff() < 0.0 || weights.sum() > 1.0) return std::nullopt;
  return a.z() + weights.x() * (b - a).z() + weights.y() * (c - a).z();
}

double smoothStep(double x) {
  const double s = std::clamp(x, 0.0, 1.0);
  return s * s * s * (10.0 + s * (6.0 * s - 15.0));
}

Eigen::Vector3d sines(double t, const Eigen::Vector3d& frequencies) {
  return (2.0 * M_PI * t * frequencies + Eigen::Vector3d(0.3, 1.1, 2.2)).array().sin();
}

void requireWithin(const char* name, double value, double min, double max) {
  if (value >= min && value <= max) return;
  throw InvalidInput(std::string(name) + " is " + sweep_guard_core::shortText(value) + ", must be in [" +
                     sweep_guard_core::shortText(min) + ", " + sweep_guard_core::shortText(max) + "]");
}

}  // namespace

Eigen::Vector3d highestPoint(const TriangleMesh& mesh_W) {
  Eigen::Vector3d highest_W = mesh_W.vertex(mesh_W.triangles().front().front());
  for (const sweep_guard_core::Triangle& triangle : mesh_W.triangles()) {
    for (const std::uint32_t index : triangle) {
      if (mesh_W.vertex(index).z() > highest_W.z()) highest_W = mesh_W.vertex(index);
    }
  }
  return highest_W;
}

std::optional<double> surfaceHeight(const TriangleMesh& mesh_W, double x, double y) {
  std::optional<double> highest;
  for (const auto& [a, b, c] : mesh_W.triangles()) {
    const std::optional<double> height = heightOver(mesh_W.vertex(a), mesh_W.vertex(b), mesh_W.vertex(c), {x, y});
    if (height) highest = std::max(highest.value_or(*height), *height);
  }
  return highest;
}

Drilling::Drilling(std::vector<Eigen::Vector3d> holes_W, const Options& options)
    : holes_W_(std::move(holes_W)), options_(options) {
  if (holes_W_.empty()) throw InvalidInput("there is no hole to drill");
  requireWithin("clearance", options.clearance, 1e-3, 10.0);
  requireWithin("depth", options.depth, 0.0, 10.0);
  requireWithin("wander", options.wander, 0.0, 10.0);
  requireWithin("tilt", options.tilt, 0.0, 1.0);
  requireWithin("travel_time", options.travel_time, 1e-3, 1e3);
  requireWithin("approach_time", options.approach_time, 1e-3, 1e3);
  requireWithin("dwell_time", options.dwell_time, 0.0, 1e3);
}

double Drilling::holeTime() const { return options_.travel_time + 2.0 * options_.approach_time + options_.dwell_time; }

double Drilling::duration() const { return holeTime() * static_cast<double>(holes_W_.size()); }

double Drilling::heightAt(double t_hole) const {
  const double down = smoothStep((t_hole - options_.travel_time) / options_.approach_time);
  const double up = smoothStep((t_hole - holeTime() + options_.approach_time) / options_.approach_time);
  return options_.clearance - (options_.clearance + options_.depth) * (down - up);
}

Eigen::Isometry3d Drilling::pose(double t) const {
  const double round_time = std::fmod(t, duration());
  const std::size_t hole = std::min(static_cast<std::size_t>(round_time / holeTime()), holes_W_.size() - 1);
  const double t_hole = round_time - static_cast<double>(hole) * holeTime();
  const Eigen::Vector3d& from_W = holes_W_[(hole + holes_W_.size() - 1) % holes_W_.size()];
  const Eigen::Vector3d& to_W = holes_W_[hole];

  const double height = heightAt(t_hole);
  const double freedom = smoothStep(height / options_.clearance);
  const Eigen::Vector3d wander_W = options_.wander * freedom * sines(t, {0.41, 0.53, 0.67});
  const Eigen::Vector3d tilt_T = options_.tilt * freedom * sines(t, {0.37, 0.47, 0.29});

  Eigen::Isometry3d X_WT = Eigen::Isometry3d::Identity();
  X_WT.translation() = from_W + smoothStep(t_hole / options_.travel_time) * (to_W - from_W) + wander_W;
  X_WT.translation().z() += height;
  X_WT.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix() *
                  Eigen::AngleAxisd(tilt_T.norm(), tilt_T.stableNormalized());
  return X_WT;
}

std::vector<Eigen::Vector3d> holesAround(const TriangleMesh& mesh_W, double radius, int count) {
  const Eigen::Vector3d highest_W = highestPoint(mesh_W);
  std::vector<Eigen::Vector3d> holes_W = {highest_W};
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * M_PI * i / count;
    const double x = highest_W.x() + radius * std::cos(angle);
    const double y = highest_W.y() + radius * std::sin(angle);
    const std::optional<double> height = surfaceHeight(mesh_W, x, y);
    if (height && *height > highest_W.z() - radius) holes_W.emplace_back(x, y, *height);
  }
  return holes_W;
}

}  // namespace sweep_guard_simulation
