#include "detection/select_detector.h"

#include <GL/gl.h>
#include <gtest/gtest.h>

#include <thread>

#include "detection/every_context.h"
#include "detection/faulty_context.h"
#include "detection/reference_detector.h"
#include "scenes.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

using Replacements = FaultyContext::Replacements;

// What a context whose selection fails is made of.
Replacements broken() { return {{"glGetError", reinterpret_cast<OffscreenContext::Function>(reportAnError)}}; }

// Makes contexts, of which the first so many are broken.
class Factory {
 public:
  Factory(std::string gl_context, int broken_ones) : gl_context_(std::move(gl_context)), broken_left_(broken_ones) {}

  SelectDetector::ContextFactory get() {
    return [this]() -> std::unique_ptr<OffscreenContext> {
      ++made;
      return std::make_unique<FaultyContext>(makeOffscreenContext(gl_context_),
                                             broken_left_-- > 0 ? broken() : Replacements{});
    };
  }

  int made = 0;

 private:
  std::string gl_context_;
  int broken_left_;
};

// A drill that moves 0.2 m to the side, over the surface of the wavy hull.
SweptVolume sweptDrill() {
  Motion motion;
  motion.X_MT_start.translation() = Eigen::Vector3d(-0.1, 0.01, 0.1);
  motion.X_MT_end.translation() = Eigen::Vector3d(0.1, 0.01, 0.1);
  return sweptVolume(ConvexShape::cylinder(0.005, 0.05), motion, VolumeKind::kObbPlanes);
}

const TriangleMesh& hull() {
  static const TriangleMesh mesh = wavyHull(/*rings=*/21, /*sectors=*/40, /*phase=*/0.0);
  return mesh;
}

std::vector<std::uint32_t> expected(const TriangleMesh& mesh = hull()) {
  return ReferenceDetector().detect(mesh, sweptDrill()).triangles;
}

class SelectDetectorTest : public OnEveryContext {
 protected:
  static SelectDetector::ContextFactory contexts() {
    return [] { return makeOffscreenContext(GetParam()); };
  }
};

TEST_P(SelectDetectorTest, FindsTheTrianglesThatTheDrillMeets) {
  SelectDetector detector({}, contexts());
  ASSERT_GT(expected().size(), 20U);
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
}

// Two records hold 8 words: the canary and one hit.
TEST_P(SelectDetectorTest, FindsAllInABufferThatHoldsTwo) {
  SelectDetector detector({}, contexts(), /*hit_records=*/2);
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
}

TEST_P(SelectDetectorTest, TakesANewContextWhereOneFails) {
  Factory factory(GetParam(), /*broken_ones=*/1);
  SelectDetector detector({}, factory.get());
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
  EXPECT_EQ(factory.made, 2);
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
  EXPECT_EQ(factory.made, 2);  // and keeps it
}

TEST_P(SelectDetectorTest, GivesUpWhereTheSecondContextFailsAndComesBackWithTheThird) {
  Factory factory(GetParam(), /*broken_ones=*/2);
  SelectDetector detector({}, factory.get());
  EXPECT_THROW(detector.detect(hull(), sweptDrill()), DeviceError);
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
  EXPECT_EQ(factory.made, 3);
}

TEST_P(SelectDetectorTest, ComesBackAfterATimeWithoutAnyContext) {
  Factory factory(GetParam(), /*broken_ones=*/1);
  bool refuse = false;
  SelectDetector detector({}, [&]() -> std::unique_ptr<OffscreenContext> {
    if (refuse) throw DeviceError("no context today");
    return factory.get()();
  });
  refuse = true;
  EXPECT_THROW(detector.detect(hull(), sweptDrill()), DeviceError);
  EXPECT_THROW(detector.detect(hull(), sweptDrill()), DeviceError);
  refuse = false;
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
}

TEST_P(SelectDetectorTest, RefusesToStartWithoutAContext) {
  const auto none = []() -> std::unique_ptr<OffscreenContext> { throw DeviceError("no context"); };
  EXPECT_THROW(SelectDetector({}, none), DeviceError);
  const auto incomplete = []() -> std::unique_ptr<OffscreenContext> {
    return std::make_unique<FaultyContext>(makeOffscreenContext(GetParam()), Replacements{{"glClipPlane", nullptr}});
  };
  EXPECT_THROW(SelectDetector({}, incomplete), DeviceError);
}

// A context is current in one thread at a time; a nodelet's timer comes from any.
TEST_P(SelectDetectorTest, AnswersInOneThreadAfterTheOther) {
  SelectDetector detector({}, contexts());
  for (int i = 0; i < 5; ++i) {
    std::vector<std::uint32_t> found;
    std::thread([&] { found = detector.detect(hull(), sweptDrill()).triangles; }).join();
    EXPECT_EQ(found, expected()) << "thread " << i;
  }
  EXPECT_EQ(detector.detect(hull(), sweptDrill()).triangles, expected());
}

TEST_P(SelectDetectorTest, DetectorsInParallelThreadsDoNotDisturbEachOther) {
  constexpr std::uint64_t kRandomScenes = 200;
  std::vector<std::vector<std::uint32_t>> alone;
  SelectDetector detector_alone({}, contexts());
  for (std::uint64_t seed = 0; seed < kRandomScenes; ++seed) {
    const Scene scene = randomScene(seed);
    alone.push_back(detector_alone.detect(scene.mesh_M, scene.swept_M).triangles);
  }
  std::vector<int> wrong(4, 0);
  std::vector<std::thread> threads;
  threads.reserve(wrong.size());
  for (int& wrong_here : wrong) {
    threads.emplace_back([&] {
      SelectDetector detector({}, contexts());
      for (std::uint64_t seed = 0; seed < kRandomScenes; ++seed) {
        const Scene scene = randomScene(seed);
        if (detector.detect(scene.mesh_M, scene.swept_M).triangles != alone[seed]) ++wrong_here;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST_P(SelectDetectorTest, FollowsADeformation) {
  SelectDetector detector({}, contexts());
  TriangleMesh mesh = hull();
  for (int step = 0; step < 20; ++step) {
    mesh = deformed(mesh, streamedPositions(wavyHull(21, 40, /*phase=*/0.3 * step)));
    EXPECT_EQ(detector.detect(mesh, sweptDrill()).triangles, expected(mesh)) << "step " << step;
  }
}

TEST_P(SelectDetectorTest, FollowsAChangeOfTopology) {
  SelectDetector detector({}, contexts());
  for (const int rings : {21, 5, 40, 3, 2}) {
    const TriangleMesh mesh = wavyHull(rings, 40, 0.0);
    EXPECT_EQ(detector.detect(mesh, sweptDrill()).triangles, expected(mesh)) << rings << " rings";
  }
}

// Small numbers of triangles, on both sides of the size of a block.
TEST_P(SelectDetectorTest, FindsEachTriangleWhereverItIsInABlock) {
  for (const int block : {1, 2, 3, 64}) {
    SelectDetector detector({/*cull=*/false, GetParam(), block}, contexts());
    for (const std::uint32_t count : {1U, 2U, 3U, 4U, 63U, 64U, 65U, 128U, 129U}) {
      for (const std::uint32_t met : {0U, count / 2, count - 1}) {
        std::vector<Eigen::Vector3d> vertices(count, Eigen::Vector3d(5, 5, 5));
        vertices[met] = Eigen::Vector3d(0, 0.01, 0.1);
        std::vector<Triangle> triangles;
        for (std::uint32_t i = 0; i < count; ++i) triangles.push_back({i, i, i});
        const TriangleMesh mesh(vertices, triangles);
        EXPECT_EQ(detector.detect(mesh, sweptDrill()).triangles, std::vector<std::uint32_t>{met})
            << "blocks of " << block << ", " << count << " triangles";
      }
    }
  }
}

// Where the cull decides everything, OpenGL's rounding plays no part.
TEST(SelectDetectorTest, WhatWasDrawnBeforeLeavesNoInflation) {
  const TriangleMesh mesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const SweptVolume across_M = sweptVolume(ConvexShape::cylinder(0.01, 0.1), Motion{}, VolumeKind::kObbPlanes);
  SweptVolume far_M = across_M;
  far_M.box.X_MB.translation().z() += 1.0;
  SelectDetector detector({}, makeOsMesaContext);
  const Detection drawn = detector.detect(mesh, across_M);
  EXPECT_EQ(drawn.triangles.size(), 1U);
  EXPECT_GT(drawn.inflation, 0.0);
  const Detection far = detector.detect(mesh, far_M);
  EXPECT_TRUE(far.triangles.empty());
  EXPECT_EQ(far.inflation, 0.0);
}

TEST(MakeDetectorTest, KnowsItsNamesAndNoOther) {
  for (const std::string& name : detectorNames()) {
    EXPECT_EQ(makeDetector(name)->detect(hull(), sweptDrill()).triangles, expected()) << name;
  }
  EXPECT_EQ(makeDetector("select", {/*cull=*/false})->detect(hull(), sweptDrill()).triangles, expected());
  for (const char* name : {"", "Select", "plane"}) EXPECT_THROW(makeDetector(name), InvalidInput) << name;
  EXPECT_THROW(makeDetector("select", {/*cull=*/true, "glx"}), InvalidInput);
}

// A context that stays current in the thread that made it would be used there after its end.
TEST_P(SelectDetectorTest, MayEndInAnotherThreadThanItBegan) {
  const TriangleMesh mesh({{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const SweptVolume swept_M = sweptVolume(ConvexShape::cylinder(0.01, 0.1), Motion{}, VolumeKind::kObbPlanes);
  const DetectorOptions options{/*cull=*/true, GetParam()};
  for (int i = 0; i < 5; ++i) {
    std::unique_ptr<Detector> detector = makeDetector("select", options);
    std::thread([&] { detector.reset(); }).join();
    EXPECT_EQ(makeDetector("select", options)->detect(mesh, swept_M).triangles.size(), 1U);
  }
}

INSTANTIATE_ON_EVERY_CONTEXT(SelectDetectorTest);

}  // namespace
}  // namespace sweep_guard_core
