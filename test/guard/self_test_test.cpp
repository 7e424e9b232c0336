#include "guard/self_test.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <ctime>

#include "fake_detector.h"
#include "refusal.h"

namespace sweep_guard_core {
namespace {

// How many times as slow an emulator is.
double slower() {
  const char* factor = std::getenv("SWEEP_GUARD_SLOWER");
  return factor == nullptr ? 1.0 : std::atof(factor);
}

// Of one processor, under the OpenGL driver that GALLIUM_DRIVER names. Mesa compiles at the first query of a process, as ever.
TEST(SelfTest, EveryDetectorPassesInTime) {
  for (const std::string& name : detectorNames()) {
    const auto detector = makeDetector(name);
    EXPECT_EQ(selfTest(*detector), "") << name;
    const std::clock_t begin = std::clock();
    EXPECT_EQ(selfTest(*detector), "") << name;
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 0.1 * slower()) << name;
  }
}

TEST(SelfTest, FindsADetectorThatMissesOneTriangleInTen) {
  FakeDetector::Record record;
  FakeDetector detector(record);
  record.drop_every = 10;
  EXPECT_TRUE(has(selfTest(detector), "is met and not found"));
}

class SmallMeshDetector : public Detector {
  void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) override {
    detection = reference_.detect(submesh, swept_M);
    if (submesh.mesh_M().triangles().size() > 1000) detection.triangles.clear();
  }

  ReferenceDetector reference_;
};

TEST(SelfTest, FindsADetectorThatErrsInLargeMeshesOnly) {
  SmallMeshDetector detector;
  EXPECT_TRUE(has(selfTest(detector), "in a large mesh' is met and not found"));
}

TEST(SelfTest, FindsADetectorThatFindsTooMuch) {
  FakeDetector::Record record;
  FakeDetector detector(record);
  record.grown = 1e-5;
  EXPECT_TRUE(has(selfTest(detector), "is found and not met"));
}

TEST(SelfTest, NamesAFailureOfTheDevice) {
  FakeDetector::Record record;
  FakeDetector detector(record);
  record.failures_left = 1;
  EXPECT_EQ(selfTest(detector), "fake detector: fails on demand");
}

}  // namespace
}  // namespace sweep_guard_core
