#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>

#include "guard_probe.h"

namespace sweep_guard_ros {

/// Returns the probe of the test program, which is the clock of the guard.
inline GuardProbe& probe() {
  static GuardProbe probe(/*drives_clock=*/true);
  return probe;
}

inline bool isClear(const sweep_guard::Warning& warning) { return warning.level == sweep_guard::Warning::CLEAR; }

/// Returns whether a warning is unknown for this reason, among others.
inline std::function<bool(const sweep_guard::Warning&)> hasReason(std::uint32_t reason) {
  return [reason](const sweep_guard::Warning& warning) {
    return warning.level == sweep_guard::Warning::UNKNOWN && !warning.clear && (warning.reasons & reason) != 0;
  };
}

/// Tests a running guard, which is not restarted between tests.
class NodeTest : public ::testing::Test {
 protected:
  // Each test begins with a fresh pose high above, no workpiece, and no contact.
  void SetUp() override {
    probe().advance(1.0);
    sweep_guard::Warning warning;
    do {
      probe().tick(0.001);
      probe().publish(poseAt({0.0, 0.0, 5.0}, probe().time()));
      probe().skipWarnings();
      warning = probe().awaitWarning([](const sweep_guard::Warning&) { return true; });
    } while (warning.reasons != sweep_guard::Warning::NO_MESH || warning.level != sweep_guard::Warning::UNKNOWN);
  }
  void TearDown() override {
    for (const std::string& id : placed_) probe().remove(id);
  }

  void placeSquare(const std::string& id, const Eigen::Vector3d& center, const std::string& frame = "world",
                   double half_side = 0.1) {
    auto square = squareAt(id, center, probe().time(), half_side);
    square.header.frame_id = frame;
    placed_.insert(id);
    probe().place(square);
  }

  // Advances the clock by 10 ms and moves the tool.
  sweep_guard::Contacts moveTo(const Eigen::Vector3d& tip) {
    probe().tick(0.01);
    return probe().move(poseAt(tip, probe().time()));
  }

  // @returns the warning of the contact
  sweep_guard::Warning touchASquare() {
    placeSquare("square", {0.0, 0.0, 0.0});
    moveTo({0.0, 0.0, 0.05});
    moveTo({0.0, 0.0, -0.01});
    return probe().awaitWarning([](const sweep_guard::Warning& warning) { return warning.contact; });
  }

  // Moves the tool now, and returns how many workpieces it touched on its way.
  static size_t touchedOnTheWayTo(const Eigen::Vector3d& tip) {
    return probe().move(poseAt(tip, probe().time())).objects.size();
  }

  // The motion is known from two poses. On a busy machine they may be stale before the guard is clear.
  void restAt(const Eigen::Vector3d& tip) {
    moveTo(tip);
    sweep_guard::Warning warning;
    do {
      probe().skipWarnings();
      moveTo(tip);
      warning = probe().awaitWarning([](const sweep_guard::Warning& next) {
        return next.clear || (next.reasons & sweep_guard::Warning::POSE_STALE) != 0;
      });
    } while (!warning.clear);
  }

  // Keeps both inputs fresh until a warning fits: contacts are held for their hold time.
  sweep_guard::Warning moveUntil(const std::string& id, const Eigen::Vector3d& square, const Eigen::Vector3d& tip,
                                 const std::function<bool(const sweep_guard::Warning&)>& fits) {
    for (int i = 0; i < 1000; ++i) {
      moveTo(tip);
      probe().place(squareMovedTo(id, square, probe().time()));
      const auto warnings = probe().warnings();
      if (fits(warnings.back())) return warnings.back();
    }
    ADD_FAILURE() << "no such warning; the last: " << probe().warnings().back().text;
    return {};
  }

  std::set<std::string> placed_;
};

}  // namespace sweep_guard_ros
