#include "sweep_guard/interaction/touch_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <new>
#include <utility>

#include "allocations.h"
#include "interaction_scenes.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;
using namespace std::chrono_literals;

using Contacts = std::vector<std::pair<std::uint32_t, double>>;  // triangles, ascending, with their depths [m]

std::shared_ptr<const Workpiece> liver(std::uint32_t revision = 1, std::uint32_t cells = 2,
                                       const std::string& id = "liver") {
  return std::make_shared<const Workpiece>(Workpiece{id, revision, Time(100s), {}, "mesh", sheet(0.1, cells)});
}

std::shared_ptr<const Workpiece> deformed(const Workpiece& workpiece) {
  auto next = std::make_shared<Workpiece>(workpiece);
  std::vector<float> positions(3 * next->mesh_M.vertexCount(), 0.01F);
  next->mesh_M.deform(positions);
  return next;
}

std::vector<TriangleContact> inContact(const Contacts& contacts) {
  std::vector<TriangleContact> all;
  for (const auto& [triangle, depth] : contacts)
    all.push_back({triangle, 0, {0.5, Vector3d::Zero(), Vector3d::UnitZ(), depth}});
  return all;
}

SweepReport reportOf(const std::shared_ptr<const Workpiece>& workpiece, const Contacts& contacts,
                     const Contacts& allowed = {}) {
  SweepReport report;
  report.end = Time(101s);
  SweptObject& object = report.objects.emplace_back();
  object.workpiece = workpiece;
  object.result.fine = true;
  object.result.in_contact = inContact(contacts);
  object.result.allowed.in_contact = inContact(allowed);
  return report;
}

SweepReport coarseReport(const std::shared_ptr<const Workpiece>& workpiece, const TriangleSet& triangles) {
  SweepReport report = reportOf(workpiece, {});
  report.objects[0].result.fine = false;
  report.objects[0].result.triangles = report.objects[0].result.not_ruled_out = triangles;
  return report;
}

class TouchMapTest : public testing::Test {
 protected:
  void add(const SweepReport& report) {
    Workpieces workpieces;
    for (const SweptObject& object : report.objects) workpieces.push_back(object.workpiece);
    map_.add(report, workpieces);
  }
  void sweep(const Contacts& contacts, const Contacts& allowed = {}) { add(reportOf(liver_, contacts, allowed)); }

  std::vector<ObjectTouches> touches() const {
    std::vector<ObjectTouches> objects;
    map_.touches(objects);
    return objects;
  }
  std::map<std::uint32_t, TriangleTouches> ofLiver() const {
    std::map<std::uint32_t, TriangleTouches> all;
    const auto objects = touches();
    if (objects.empty()) return all;
    for (const TriangleTouches& touched : objects.at(0).triangles) all.emplace(touched.triangle, touched);
    EXPECT_EQ(all.size(), objects[0].triangles.size());
    return all;
  }

  TouchMap map_;
  std::shared_ptr<const Workpiece> liver_ = liver();
};

TEST_F(TouchMapTest, CountsTheSweepsThatTouchATriangle) {
  sweep({{1, 0.0}, {3, 0.0}});
  sweep({{3, 0.0}});
  sweep({});
  sweep({{3, 0.0}, {7, 0.0}});
  const auto touched = ofLiver();
  ASSERT_EQ(touched.size(), 3U);
  EXPECT_EQ(touched.at(1).sweeps, 1U);
  EXPECT_EQ(touched.at(3).sweeps, 3U);
  EXPECT_EQ(touched.at(7).sweeps, 1U);
}

TEST_F(TouchMapTest, TouchesAlongAJumpAreKeptApart) {
  sweep({{1, 0.002}});
  SweepReport jump = reportOf(liver_, {{1, 0.01}, {3, 0.02}, {5, 0.02}}, {{4, 0.0}});
  jump.jumps = {{"mesh", {12.0, false}}};
  add(jump);
  const auto objects = touches();
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(objects[0].jump_triangles, (TriangleSet{1, 3, 4, 5}));
  EXPECT_EQ(ofLiver().size(), 1U);
  EXPECT_EQ(ofLiver().at(1).sweeps, 1U);
  EXPECT_FLOAT_EQ(ofLiver().at(1).depth, 0.002F);
  jump.jumps = {{"another frame", {12.0, false}}};
  add(jump);
  EXPECT_EQ(ofLiver().size(), 4U) << "the tool did not jump against this workpiece";
  jump.jumps.clear();
  jump.jump = "joint 'elbow' jumped: 130 rad/s";
  add(jump);
  EXPECT_EQ(ofLiver().at(3).sweeps, 1U) << "of a joint that jumped in parts";
  map_.clear();
  EXPECT_TRUE(touches().empty());
}

TEST_F(TouchMapTest, WhatWasTouchedAlongAJumpOnlyIsReportedToo) {
  SweepReport jump = reportOf(liver_, {{3, 0.02}});
  jump.jumps = {{"mesh", {12.0, false}}};
  add(jump);
  const auto changes = map_.changes();
  ASSERT_EQ(touches().size(), 1U);
  EXPECT_TRUE(touches()[0].triangles.empty());
  map_.add({}, {});
  EXPECT_TRUE(touches().empty()) << "it was removed";
  EXPECT_GT(map_.changes(), changes);
}

TEST_F(TouchMapTest, KeepsTheLargestDepth) {
  sweep({{1, 0.002}});
  sweep({{1, 0.005}});
  sweep({{1, 0.001}});
  EXPECT_FLOAT_EQ(ofLiver().at(1).depth, 0.005F);
}

TEST_F(TouchMapTest, WhatAlsoTouchesAsAllowedCountsOnceWithTheLargerDepth) {
  sweep({{1, 0.002}}, {{1, 0.004}, {2, 0.001}});
  const auto touched = ofLiver();
  ASSERT_EQ(touched.size(), 2U);
  EXPECT_EQ(touched.at(1).sweeps, 1U);
  EXPECT_FLOAT_EQ(touched.at(1).depth, 0.004F);
  EXPECT_EQ(touched.at(2).sweeps, 1U);
}

TEST_F(TouchMapTest, WithoutNarrowPhaseADepthIsUnknownUntilASweepHasOne) {
  add(coarseReport(liver_, {1, 2}));
  EXPECT_EQ(ofLiver().at(1).sweeps, 1U);
  EXPECT_TRUE(std::isnan(ofLiver().at(1).depth));
  sweep({{1, 0.003}});
  add(coarseReport(liver_, {1}));
  EXPECT_EQ(ofLiver().at(1).sweeps, 3U);
  EXPECT_FLOAT_EQ(ofLiver().at(1).depth, 0.003F);
  EXPECT_TRUE(std::isnan(ofLiver().at(2).depth));
}

TEST_F(TouchMapTest, ATriangleThatIsOnlyNotRuledOutIsNotTouched) {
  SweepReport report = reportOf(liver_, {{1, 0.0}});
  report.objects[0].result.not_ruled_out = {1, 2};
  add(report);
  EXPECT_EQ(ofLiver().count(2), 0U);
}

TEST_F(TouchMapTest, DeformationsKeepTheCounts) {
  sweep({{1, 0.002}});
  liver_ = deformed(*liver_);
  sweep({{1, 0.001}});
  EXPECT_EQ(ofLiver().at(1).sweeps, 2U);
  EXPECT_FLOAT_EQ(ofLiver().at(1).depth, 0.002F);
}

TEST_F(TouchMapTest, TheSameMeshSentAgainKeepsTheCounts) {
  sweep({{1, 0.002}});
  liver_ = liver();
  sweep({{1, 0.001}});
  EXPECT_EQ(ofLiver().at(1).sweeps, 2U);
}

TEST_F(TouchMapTest, CountsBeginAnewWithOtherTrianglesAndWithAnotherRevision) {
  sweep({{1, 0.002}, {7, 0.0}});
  liver_ = liver(/*revision=*/1, /*cells=*/1);
  sweep({{1, 0.001}});
  EXPECT_EQ(ofLiver().size(), 1U);
  EXPECT_EQ(ofLiver().at(1).sweeps, 1U);
  EXPECT_FLOAT_EQ(ofLiver().at(1).depth, 0.001F);
  liver_ = liver(/*revision=*/2, /*cells=*/1);
  sweep({});
  EXPECT_TRUE(touches().empty());
}

TEST_F(TouchMapTest, AWorkpieceThatWasAwayBeginsAnew) {
  sweep({{1, 0.002}});
  map_.add(SweepReport(), {});
  EXPECT_TRUE(touches().empty());
  sweep({{1, 0.001}});
  EXPECT_EQ(ofLiver().at(1).sweeps, 1U);
}

TEST_F(TouchMapTest, AWorkpieceThatWasNotSweptKeepsItsCounts) {
  sweep({{1, 0.002}});
  map_.add(SweepReport(), {liver_});
  EXPECT_EQ(ofLiver().at(1).sweeps, 1U);
}

TEST_F(TouchMapTest, OnlyTouchedWorkpiecesAreListed) {
  SweepReport report = reportOf(liver(1, 2, "bone"), {});
  report.objects.push_back(reportOf(liver_, {{1, 0.0}}).objects[0]);
  add(report);
  ASSERT_EQ(touches().size(), 1U);
  EXPECT_EQ(touches()[0].id, "liver");
  EXPECT_EQ(touches()[0].revision, 1U);
}

TEST_F(TouchMapTest, ChangesOnlyWhereSomethingIsTouchedOrForgotten) {
  sweep({});
  EXPECT_EQ(map_.changes(), 0U);
  EXPECT_EQ(map_.newest(), Time());
  sweep({{1, 0.0}});
  const auto touched = map_.changes();
  EXPECT_GT(touched, 0U);
  EXPECT_EQ(map_.newest(), Time(101s));
  sweep({});
  EXPECT_EQ(map_.changes(), touched);
  liver_ = liver(/*revision=*/2);
  sweep({});
  EXPECT_GT(map_.changes(), touched);
}

TEST_F(TouchMapTest, ClearedCountsBeginAnew) {
  sweep({{1, 0.002}, {2, 0.002}});
  const auto touched = map_.changes();
  map_.clear();
  EXPECT_TRUE(touches().empty());
  EXPECT_GT(map_.changes(), touched);
  EXPECT_EQ(map_.newest(), Time());
  sweep({{2, 0.001}});
  EXPECT_EQ(ofLiver().size(), 1U);
  EXPECT_EQ(ofLiver().at(2).sweeps, 1U);
  EXPECT_FLOAT_EQ(ofLiver().at(2).depth, 0.001F);
}

TEST_F(TouchMapTest, OnceSweptNothingIsAllocated) {
  const SweepReport one = reportOf(liver_, {{0, 0.001}, {1, 0.001}}, {{1, 0.001}, {2, 0.001}});
  const SweepReport other = reportOf(deformed(*liver_), {{4, 0.002}, {5, 0.001}}, {{6, 0.001}, {7, 0.001}});
  const Workpieces workpieces = {liver_};
  std::vector<ObjectTouches> objects;
  map_.add(one, workpieces);
  map_.touches(objects);
  objects[0].triangles.reserve(8);
  const Allocations allocations;
  map_.add(other, workpieces);
  map_.add(one, workpieces);
  map_.touches(objects);
  map_.clear();
  map_.add(other, workpieces);
  EXPECT_EQ(allocations.count(), 0U) << allocations.stacks();
}

TEST_F(TouchMapTest, WhereMemoryRunsOutTheNextSweepCounts) {
  sweep({{1, 0.0}});
  liver_ = liver(/*revision=*/2, /*cells=*/20);
  const SweepReport report = reportOf(liver_, {{700, 0.0}});
  const Workpieces workpieces = {liver_};
  bool reached = true;
  for (size_t number = 1; reached; ++number) {
    TouchMap map;
    map.add(reportOf(liver(), {{1, 0.0}}), workpieces);
    {
      const FailingAllocation failing(number);
      try {
        map.add(report, workpieces);
      } catch (const std::bad_alloc&) {
      }
      reached = failing.reached();
    }
    map.add(report, workpieces);
    std::vector<ObjectTouches> objects;
    map.touches(objects);
    ASSERT_EQ(objects.size(), 1U);
    ASSERT_EQ(objects[0].triangles.size(), 1U);
    EXPECT_EQ(objects[0].triangles[0].triangle, 700U);
    EXPECT_EQ(objects[0].triangles[0].sweeps, reached ? 1U : 2U);
  }
}

TEST(TouchMapOfAGuardTest, TheDepthIsThatOfTheToolBehindTheTriangle) {
  Guard guard(Tool(ConvexShape::box({0.001, 0.001, 0.02})), makeDetector("halfspace"), GuardOptions());
  const Workpieces workpieces = {liver()};
  TouchMap map;
  SweepReport report;
  for (int i = 0; i <= 4; ++i) {
    const double height = 0.025 - 0.0025 * i;  // of the middle of the box: 5 mm before the surface to 5 mm behind it
    guard.sweep({Time(100s) + i * 10ms, {}, placedAt(0.03, -0.06, height), {{"mesh", Eigen::Isometry3d::Identity()}}},
                workpieces, report);
    map.add(report, workpieces);
  }
  std::vector<ObjectTouches> objects;
  map.touches(objects);
  ASSERT_EQ(objects.size(), 1U);
  ASSERT_EQ(objects[0].triangles.size(), 1U);
  EXPECT_NEAR(objects[0].triangles[0].depth, 0.005, 1e-6);
  EXPECT_GE(objects[0].triangles[0].sweeps, 2U);
  EXPECT_LE(objects[0].triangles[0].sweeps, 3U);  // at the third pose it touches without depth
}

}  // namespace
}  // namespace sweep_guard_core
