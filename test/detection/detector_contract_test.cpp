#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "detection/every_context.h"
#include "detection/exact_oracle.h"
#include "detection/halfspace_detector.h"
#include "detection/reference_detector.h"
#include "detection/select_detector.h"
#include "scenes.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {
namespace {

using SceneOf = Scene (*)(std::uint64_t seed);

struct Variant {
  std::string name;
  std::string gl_context;  // that it needs; empty: none
  std::function<std::unique_ptr<Detector>()> make;
};

std::ostream& operator<<(std::ostream& stream, const Variant& variant) { return stream << variant.name; }

Variant selectVariant(const std::string& gl_context, const std::string& name, const DetectorOptions& options,
                      size_t hit_records = 256) {
  const auto contexts = [gl_context] { return makeOffscreenContext(gl_context); };
  return {"select_" + name + gl_context, gl_context,
          [=] { return std::make_unique<SelectDetector>(options, contexts, hit_records); }};
}

// Every detector by name, and on every context the ways of `select` that no name gives.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const std::string& name : detectorNames()) {
    if (name != "select") all.push_back({name, "", [name] { return makeDetector(name); }});
  }
  for (const simd::Kernels& kernels : simd::availableKernels()) {
    const auto make = [&kernels]() -> std::unique_ptr<Detector> {
      return std::make_unique<HalfspaceDetector>(kernels);
    };
    all.push_back({std::string("halfspace_") + kernels.name, "", make});
  }
  for (const std::string& gl_context : offscreenContextNames()) {
    all.push_back(selectVariant(gl_context, "on_", {}));
    all.push_back(selectVariant(gl_context, "without_cull_on_", {/*cull=*/false}));
    all.push_back(selectVariant(gl_context, "one_by_one_on_", {/*cull=*/true, gl_context, /*triangles_per_name=*/1}));
    all.push_back(selectVariant(gl_context, "in_sevens_with_room_for_two_hits_on_",
                                {/*cull=*/true, gl_context, /*triangles_per_name=*/7}, /*hit_records=*/2));
  }
  return all;
}

SweptVolume grown(SweptVolume volume, double distance) {
  volume.box.half_extents.array() += distance;
  for (HalfSpace& clip_B : volume.clips_B) clip_B = clip_B.grown(distance);
  return volume;
}

std::vector<std::uint32_t> difference(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
  std::vector<std::uint32_t> only_in_a;
  std::set_difference(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(only_in_a));
  return only_in_a;
}

class DetectorContractTest : public testing::TestWithParam<Variant> {
 protected:
  void SetUp() override {
    const std::string& gl_context = GetParam().gl_context;
    const std::string why = gl_context.empty() ? "" : whyMissing(gl_context);
    if (!why.empty()) FAIL() << why;
    detector_ = GetParam().make();
  }

  // Of each of so many scenes: what the reference finds is found, and what else is found is within the inflation.
  void compareWithReference(SceneOf scene_of, int count) {
    for (int seed = 0; seed < count && !HasFailure(); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Scene scene = scene_of(static_cast<std::uint64_t>(seed));
      const Detection found = detector_->detect(scene.mesh_M, scene.swept_M);
      const Detection expected = reference_.detect(scene.mesh_M, scene.swept_M);
      const Detection allowed = reference_.detect(scene.mesh_M, grown(scene.swept_M, found.inflation));
      for (const std::uint32_t missed : difference(expected.triangles, found.triangles)) {
        ADD_FAILURE() << "missed " << describe(scene, missed);
      }
      for (const std::uint32_t extra : difference(found.triangles, allowed.triangles)) {
        ADD_FAILURE() << "farther than " << found.inflation << " m: " << describe(scene, extra);
      }
    }
  }

  // The same against exact arithmetic, which judges the reference too.
  void compareWithExact(SceneOf scene_of, int count) {
    for (int seed = 0; seed < count && !HasFailure(); ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed));
      const Scene scene = scene_of(static_cast<std::uint64_t>(seed));
      const Detection found = detector_->detect(scene.mesh_M, scene.swept_M);
      for (std::uint32_t i = 0; i < scene.mesh_M.triangles().size(); ++i) {
        if (std::binary_search(found.triangles.begin(), found.triangles.end(), i)) {
          EXPECT_TRUE(meetsExactly(scene.mesh_M, i, scene.swept_M, found.inflation))
              << "farther than " << found.inflation << " m: " << describe(scene, i);
        } else {
          EXPECT_FALSE(meetsExactly(scene.mesh_M, i, scene.swept_M)) << "missed " << describe(scene, i);
        }
      }
    }
  }

  std::unique_ptr<Detector> detector_;
  ReferenceDetector reference_;
};

TEST_P(DetectorContractTest, FindsWhatTheReferenceFindsInRandomScenes) {
  compareWithReference(randomScene, sceneCount(/*full_size=*/100'000, /*default_percent=*/2.0));
}

TEST_P(DetectorContractTest, FindsWhatTheReferenceFindsInGrazingScenes) {
  compareWithReference(grazingScene, sceneCount(/*full_size=*/10'000, /*default_percent=*/20.0));
}

TEST_P(DetectorContractTest, FindsWhatExactArithmeticFindsInRandomScenes) {
  compareWithExact(randomScene, sceneCount(/*full_size=*/2'000, /*default_percent=*/5.0));
}

TEST_P(DetectorContractTest, FindsWhatExactArithmeticFindsInGrazingScenes) {
  compareWithExact(grazingScene, sceneCount(/*full_size=*/2'000, /*default_percent=*/10.0));
}

INSTANTIATE_TEST_SUITE_P(AllDetectors, DetectorContractTest, testing::ValuesIn(variants()),
                         [](const auto& test) { return test.param.name; });

TEST(HalfspaceDetectorTest, NamesTheSameWithEachInstructionSet) {
  size_t named = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    const Scene scene = seed % 2 == 0 ? grazingScene(seed) : randomScene(seed);
    HalfspaceDetector best;
    const Detection expected = best.detect(scene.mesh_M, scene.swept_M);
    named += expected.triangles.size();
    for (const simd::Kernels& kernels : simd::availableKernels()) {
      HalfspaceDetector detector(kernels);
      const Detection& found = detector.detect(scene.mesh_M, scene.swept_M);
      EXPECT_EQ(found.triangles, expected.triangles) << kernels.name << ", seed " << seed;
      EXPECT_EQ(found.inflation, expected.inflation);
    }
  }
  EXPECT_GT(named, 1000U);
}

struct Shares {
  double with_hit = 0.0;           // of scenes, with some triangle met
  double without_hit = 0.0;        // of scenes, with none
  double met = 0.0;                // of triangles
  double decided_by_little = 0.0;  // of triangles, those that meet the volume only if it grows by 1e-6 of its size
};

Shares sharesOf(SceneOf scene_of, int count) {
  ReferenceDetector reference;
  Shares shares;
  double triangles = 0.0;
  double met = 0.0;
  double close = 0.0;
  for (int seed = 0; seed < count; ++seed) {
    const Scene scene = scene_of(static_cast<std::uint64_t>(seed));
    const double little = 1e-6 * scene.swept_M.box.half_extents.norm();
    const size_t found = reference.detect(scene.mesh_M, scene.swept_M).triangles.size();
    (found > 0 ? shares.with_hit : shares.without_hit) += 1.0 / count;
    triangles += static_cast<double>(scene.mesh_M.triangles().size());
    met += static_cast<double>(found);
    close += static_cast<double>(reference.detect(scene.mesh_M, grown(scene.swept_M, little)).triangles.size() - found);
  }
  shares.met = met / triangles;
  shares.decided_by_little = close / triangles;
  return shares;
}

// Scenes that all hit, or all miss, would prove nothing about a detector that always answers alike.
void expectHitsAndMisses(const Shares& shares, double min_without_hit, double min_met) {
  EXPECT_GT(shares.with_hit, 0.3);
  EXPECT_GT(shares.without_hit, min_without_hit);
  EXPECT_GT(shares.met, min_met);
  EXPECT_LT(shares.met, 0.8);
}

TEST(ScenesTest, RandomScenesHitAndMiss) {
  expectHitsAndMisses(sharesOf(randomScene, 1000), /*min_without_hit=*/0.05, /*min_met=*/0.05);
}

TEST(ScenesTest, GrazingScenesHitAndMissByLittle) {
  const Shares shares = sharesOf(grazingScene, 1000);
  expectHitsAndMisses(shares, /*min_without_hit=*/0.1, /*min_met=*/0.2);
  EXPECT_GT(shares.decided_by_little, 0.1);
}

}  // namespace
}  // namespace sweep_guard_core
