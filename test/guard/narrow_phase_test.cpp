#include "guard/narrow_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "guard/swept_body.h"
#include "scenes.h"

namespace sweep_guard_core {
namespace {

using Eigen::Vector3d;

constexpr double kMaxRotation = 0.175;
constexpr std::uint32_t kCells = 24;  // along each side of a sheet of 2 m

TriangleMesh sheet(Random& random, double height) {
  return gridSurface(kCells, 2.0, [&](double /*x*/, double /*y*/) { return random.uniform(0.0, height); });
}

TriangleMesh moved(Random& random, const TriangleMesh& mesh, double distance) {
  std::vector<float> positions = streamedPositions(mesh);
  for (float& coordinate : positions) coordinate += static_cast<float>(random.uniform(-distance, distance));
  return deformed(mesh, positions);
}

ConvexShape randomPresser(Random& random) {
  std::vector<Vector3d> cloud;
  switch (random.below(5)) {
    case 0:
      return ConvexShape::sphere(random.uniform(0.2, 0.5));
    case 1:
      return ConvexShape::box({random.uniform(0.1, 0.5), random.uniform(0.1, 0.5), random.uniform(0.1, 0.5)});
    case 2:
      for (int i = 0; i < 25; ++i) cloud.emplace_back(random.uniform(0.3, 0.5) * random.direction());
      return ConvexShape::hull(cloud);
    case 3:
      return ConvexShape::hull({{-0.3, 0, 0}, {0.3, 0, 0}}).padded(random.uniform(0.05, 0.3));
    default:
      return ConvexShape::cylinder(random.uniform(0.1, 0.4), random.uniform(0.2, 1.0));
  }
}

struct Patch {
  explicit Patch(Random& random)
      : before_M(sheet(random, 0.05)),
        mesh_M(random.chance(0.5) ? before_M : moved(random, before_M, 0.02)),
        displacements(before_M, mesh_M),
        mesh(mesh_M, before_M, displacements, 0.0) {
    Motion motion;
    motion.X_MT_start = random.pose(random.inBox({0.3, 0.3, 0.6}));
    motion.X_MT_end.linear() = random.turn(random.uniform(0.0, 0.3)) * motion.X_MT_start.linear();
    motion.X_MT_end.translation() = motion.X_MT_start.translation() + random.uniform(0.0, 0.3) * random.direction();
    sub_motions_M = split(motion, kMaxRotation);
    margin = random.chance(0.5) ? 0.0 : 0.01;
  }

  TriangleMesh before_M;
  TriangleMesh mesh_M;
  Displacements displacements;
  MovingMesh mesh;
  std::vector<Motion> sub_motions_M;
  double margin;
};

TriangleSet allOf(const TriangleMesh& mesh) {
  TriangleSet all;
  for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) all.push_back(i);
  return all;
}

bool hullsMeet(const ConvexShape& shape_T, const Patch& patch, std::uint32_t triangle, double margin) {
  const auto& motions_M = patch.sub_motions_M;
  return std::any_of(motions_M.begin(), motions_M.end(), [&](const Motion& motion_M) {
    const double all = margin + deviationBound(shape_T, motion_M);
    return !missedByHull(shape_T, motion_M, patch.mesh.triangle(triangle), all);
  });
}

// Of 100 depths, so many are as small as alone. On aarch64, libccd fuses multiplications and additions: measured 98.7.
#ifdef __aarch64__
constexpr int kLeastDepths = 98;
#else
constexpr int kLeastDepths = 99;
#endif

// The narrow phase keeps its directions from patch to patch: even such from elsewhere must not change what is found.
TEST(NarrowPhasePatchTest, FindsOfEachTriangleWhatIsFoundOfItAlone) {
  Random random(/*seed=*/1);
  NarrowPhase narrow_phase;
  NarrowPhaseResult result;
  int contacts = 0;
  int on_the_way = 0;
  int ruled_out = 0;
  int least_depth = 0;
  int overlapping = 0;
  for (int i = 0; i < 60; ++i) {
    const Patch patch(random);
    const Tool tool(randomPresser(random));
    const ConvexShape& shape_T = tool.pieces()[0].shape_T;
    const TriangleSet all = allOf(patch.mesh_M);
    narrow_phase.run({tool, patch.sub_motions_M, patch.mesh, {all}, patch.margin, {}}, result);
    const double margin = patch.margin + patch.mesh.uncertainty();
    auto found = result.in_contact.begin();
    for (const std::uint32_t triangle : all) {
      SCOPED_TRACE("patch " + std::to_string(i) + ", triangle " + std::to_string(triangle));
      const auto alone = timeOfImpact(shape_T, patch.sub_motions_M, patch.mesh.triangle(triangle), margin);
      const bool left = std::binary_search(result.not_ruled_out.begin(), result.not_ruled_out.end(), triangle);
      EXPECT_EQ(left, alone || (patch.mesh.moved() && hullsMeet(shape_T, patch, triangle, margin)));
      ruled_out += left ? 0 : 1;
      const bool contact = found != result.in_contact.end() && found->triangle == triangle;
      ASSERT_EQ(contact, alone.has_value());
      if (!contact) continue;
      ++contacts;
      const Impact& impact = (found++)->impact;
      EXPECT_NEAR(impact.time_of_impact, alone->time_of_impact, 1e-5);
      if (alone->time_of_impact > 0.0) {
        ++on_the_way;
        EXPECT_LT((impact.normal_M - alone->normal_M).norm(), 1e-3);
        EXPECT_NEAR(impact.depth, alone->depth, 1e-4);
      } else {
        ++overlapping;
        least_depth += impact.depth <= alone->depth + 1e-6 ? 1 : 0;
      }
    }
    EXPECT_EQ(found, result.in_contact.end());
  }
  EXPECT_GT(contacts, 2000);
  EXPECT_GT(on_the_way, 500);
  EXPECT_GT(ruled_out, 10000);
  EXPECT_GE(least_depth, overlapping * kLeastDepths / 100) << least_depth << " of " << overlapping;
}

TEST(NarrowPhasePatchTest, KeepsTheFirstImpactOfSeveralPiecesAndTheOrderOfTriangles) {
  Random random(/*seed=*/2);
  NarrowPhase narrow_phase;
  NarrowPhaseResult both;
  std::array<NarrowPhaseResult, 2> each;
  int of_both = 0;
  for (int i = 0; i < 20; ++i) {
    const Patch patch(random);
    const std::vector<ConvexPiece> pieces = {{"", randomPresser(random)}, {"", randomPresser(random)}};
    const TriangleSet all = allOf(patch.mesh_M);
    narrow_phase.run({Tool(pieces), patch.sub_motions_M, patch.mesh, {all, all}, patch.margin, {}}, both);
    for (size_t piece = 0; piece < 2; ++piece) {
      const Tool one({pieces[piece]});
      narrow_phase.run({one, patch.sub_motions_M, patch.mesh, {all}, patch.margin, {}}, each[piece]);
    }
    std::map<std::uint32_t, double> first;
    for (const NarrowPhaseResult& one : each) {
      for (const TriangleContact& contact : one.in_contact) {
        const auto [entry, is_new] = first.emplace(contact.triangle, contact.impact.time_of_impact);
        entry->second = std::min(entry->second, contact.impact.time_of_impact);
        of_both += is_new ? 0 : 1;
      }
    }
    ASSERT_EQ(both.in_contact.size(), first.size());
    auto expected = first.begin();
    for (const TriangleContact& contact : both.in_contact) {
      EXPECT_EQ(contact.triangle, expected->first);
      EXPECT_NEAR(contact.impact.time_of_impact, (expected++)->second, 1e-5);
    }
  }
  EXPECT_GT(of_both, 100);
}

TEST(NarrowPhasePatchTest, KeepsTheNormalsOfContactsThatBeganEarlier) {
  Random random(/*seed=*/3);
  NarrowPhase narrow_phase;
  NarrowPhaseResult result;
  int kept = 0;
  for (int i = 0; i < 20; ++i) {
    const Patch patch(random);
    const Tool tool(randomPresser(random));
    const TriangleSet all = allOf(patch.mesh_M);
    ContactNormals normals;
    for (const std::uint32_t triangle : all) {
      if (random.chance(0.5)) normals.emplace(triangle, random.direction());
    }
    narrow_phase.run({tool, patch.sub_motions_M, patch.mesh, {all}, patch.margin, normals}, result);
    for (const TriangleContact& contact : result.in_contact) {
      const auto normal = normals.find(contact.triangle);
      const std::optional<Vector3d> given = normal == normals.end() ? std::nullopt : std::optional(normal->second);
      const auto alone =
          timeOfImpact(tool.pieces()[0].shape_T, patch.sub_motions_M, patch.mesh.triangle(contact.triangle),
                       patch.margin + patch.mesh.uncertainty(), given);
      ASSERT_TRUE(alone);
      if (!given) continue;
      EXPECT_LT((contact.impact.normal_M - alone->normal_M).norm(), 1e-3);
      kept += contact.impact.normal_M == *given ? 1 : 0;
    }
  }
  EXPECT_GT(kept, 300);
}

}  // namespace
}  // namespace sweep_guard_core
