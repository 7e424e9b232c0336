#include "soundness/checks.h"

#include <algorithm>
#include <iostream>

#include "guard/sweep_checker.h"
#include "soundness/oracle.h"
#include "soundness/sampled_sweep.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/time_of_impact.h"

namespace sweep_guard_core::soundness {
namespace {

std::string about(const Context& context, const std::string& detector) {
  return context.family + ' ' + context.about + " detector " + detector;
}

}  // namespace

bool contains(const std::vector<std::uint32_t>& triangles, std::uint32_t triangle) {
  return std::binary_search(triangles.begin(), triangles.end(), triangle);
}

std::vector<TestedDetector> allDetectors() {
  std::vector<TestedDetector> detectors;
  for (const std::string& name : detectorNames()) {
    if (name != "select") detectors.push_back({name, makeDetector(name)});
  }
  for (const std::string& gl_context : offscreenContextNames()) {
    const std::string name = gl_context == "osmesa" ? "select" : "select_" + gl_context;
    try {
      detectors.push_back({name, makeDetector("select", {/*cull=*/true, gl_context})});
    } catch (const DeviceError& error) {
      std::cout << name << " is skipped: " << error.what() << std::endl;
    }
  }
  return detectors;
}

void checkPair(const Context& context, const PairCase& pair) {
  const TriangleMesh mesh_M = pair.triangles.mesh();
  const SweptVolume& swept_M = pair.swept_M;
  const auto count = static_cast<std::uint32_t>(mesh_M.triangles().size());
  std::vector<bool> met;
  for (std::uint32_t i = 0; i < count; ++i) met.push_back(meets(mesh_M, i, swept_M));
  for (std::uint32_t i = 0; i < count; i += 100) {
    if (meetsByLinearProgram(mesh_M, i, swept_M) != met[i]) {
      context.report.fail("the oracles disagree about triangle " + std::to_string(i),
                          [&] { return textOf(pair, about(context, "oracle")); });
    }
  }

  for (TestedDetector& tested : context.detectors) {
    Tally& tally = context.report.of(tested.name, context.family);
    const auto fail = [&](const std::string& what, std::uint32_t triangle) {
      context.report.fail(what + " triangle " + std::to_string(triangle),
                          [&] { return textOf(pair, about(context, tested.name)); });
    };
    const Detection found = tested.detector->detect(mesh_M, swept_M);
    for (std::uint32_t i = 0; i < count; ++i) {
      ++tally.cases;
      if (met[i]) {
        ++tally.positives;
        if (contains(found.triangles, i)) continue;
        ++tally.misses;
        fail("missed", i);
      } else if (contains(found.triangles, i)) {
        ++tally.extras;
        if (meets(mesh_M, i, swept_M, found.inflation)) continue;
        ++tally.unexplained;
        fail("farther away than the inflation:", i);
      }
    }
  }
}

void checkPositives(const Context& context, const SweepCase& sweep) {
  for (TestedDetector& tested : context.detectors) {
    for (const VolumeKind kind : volumeKinds()) {
      SweepCase of_kind = sweep;
      of_kind.options.volume = kind;
      Tally& tally = context.report.of(tested.name + '/' + nameOf(kind), context.family);
      const SweepResult result = checkCase(*tested.detector, of_kind);
      for (const Contact& contact : sweep.contacts) {
        ++tally.cases;
        ++tally.positives;
        const bool named = contains(result.triangles, contact.triangle);
        if (named && contains(result.not_ruled_out, contact.triangle)) continue;
        ++tally.misses;
        context.report.fail(
            (named ? "not confirmed: triangle " : "missed triangle ") + std::to_string(contact.triangle),
            [&] { return textOf(of_kind, about(context, tested.name)); });
      }
    }
  }
}

void checkImpacts(const Context& context, const SweepCase& sweep) {
  const TriangleMesh mesh_M = sweep.triangles.mesh();
  const TriangleMesh before_M = sweep.triangles.meshBefore();
  const MovingMesh mesh(mesh_M, before_M, {before_M, mesh_M}, /*path_deviation=*/0.0);
  const Tool tool = toolOf(sweep.tool);
  const std::vector<Motion> sub_motions = sweep.subMotions();
  Tally& tally = context.report.of("fine", context.family);
  for (const Contact& contact : sweep.contacts) {
    if (mesh.moved() && contact.mesh_fraction != contact.fraction) continue;  // not at constant speed
    std::optional<double> first;
    for (const ConvexPiece& piece : tool.pieces()) {
      const auto impact = timeOfImpact(piece.shape_T, sub_motions, mesh.triangle(contact.triangle),
                                       sweep.options.margin + mesh.uncertainty());
      if (impact && (!first || impact->time_of_impact < *first)) first = impact->time_of_impact;
    }
    ++tally.cases;
    ++tally.positives;
    constexpr double kRounding = 1e-12;  // of the motion
    if (first && *first <= contact.fraction + kRounding) continue;
    ++tally.misses;
    context.report.fail((first ? "late for triangle " : "missed triangle ") + std::to_string(contact.triangle),
                        [&] { return textOf(sweep, about(context, "fine")); });
  }
}

void checkWholeSweep(const Context& context, const SweepCase& sweep) {
  const TriangleMesh mesh_M = sweep.triangles.mesh();
  const SampledSweep sampled(sweep);
  std::vector<std::optional<Real>> distances;  // empty: met
  for (size_t i = 0; i < sweep.triangles.count(); ++i) {
    const Eigen::Vector3d* corners = &sweep.triangles.corners_M[3 * i];
    distances.push_back(sampled.distance({corners[0], corners[1], corners[2]}));
  }
  const bool any_contact =
      std::any_of(distances.begin(), distances.end(), [](const auto& distance) { return !distance; });
  const bool is_inside = !any_contact && sampled.endsInside(sweep.triangles);
  const Tool tool = toolOf(sweep.tool);
  const std::vector<Motion> sub_motions = sweep.subMotions();
  for (TestedDetector& tested : context.detectors) {
    const SweepResult result = checkSweep(*tested.detector, {tool, sub_motions, mesh_M, sweep.options});
    Tally& tally = context.report.of(tested.name + '/' + nameOf(sweep.options.volume), context.family);
    const auto fail = [&](const std::string& what, std::uint32_t triangle) {
      context.report.fail(what + " triangle " + std::to_string(triangle),
                          [&] { return textOf(sweep, about(context, tested.name)); });
    };
    ++tally.cases;
    for (std::uint32_t i = 0; i < distances.size(); ++i) {
      if (!distances[i]) {
        ++tally.positives;
        if (contains(result.triangles, i) && contains(result.not_ruled_out, i)) continue;
        ++tally.misses;
        fail("missed", i);
      } else if (contains(result.not_ruled_out, i)) {
        ++tally.extras;
        if (*distances[i] <= 0) continue;
        ++tally.unexplained;
        fail("reported as met, but free:", i);
      }
    }
    for (const std::uint32_t triangle : unexplained(mesh_M, result)) {
      ++tally.unexplained;
      fail("farther away than the margin:", triangle);
    }
    if (any_contact || !result.not_ruled_out.empty()) continue;
    if (is_inside) ++tally.positives;
    if (is_inside == result.inside) continue;
    ++(is_inside ? tally.misses : tally.unexplained);
    fail(is_inside ? "not reported inside a mesh with" : "reported inside a mesh with", 0);
  }
}

std::vector<std::uint32_t> unexplained(const TriangleMesh& mesh_M, const SweepResult& result) {
  std::vector<std::uint32_t> farther;
  for (const std::uint32_t triangle : result.triangles) {
    const auto near = [&](const SweptVolume& volume_M) {
      return meets(mesh_M, triangle, volume_M, result.margin - volume_M.margin);
    };
    if (std::none_of(result.volumes_M.begin(), result.volumes_M.end(), near)) farther.push_back(triangle);
  }
  return farther;
}

}  // namespace sweep_guard_core::soundness
