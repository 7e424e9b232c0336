#include <gtest/gtest.h>

#include <algorithm>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "detection/exact_oracle.h"
#include "refusal.h"
#include "soundness/exact_motion.h"
#include "soundness/families.h"
#include "soundness/joint_positives.h"
#include "soundness/oracle.h"
#include "soundness/pairs.h"
#include "soundness/positives.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

void compareOracles(PairCase (*make)(std::uint64_t)) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const PairCase pair = make(seed);
    const TriangleMesh mesh_M = pair.triangles.mesh();
    for (std::uint32_t i = 0; i < pair.triangles.count(); ++i) {
      const bool met = meets(mesh_M, i, pair.swept_M);
      EXPECT_EQ(met, meetsExactly(mesh_M, i, pair.swept_M)) << "seed " << seed << " triangle " << i;
      EXPECT_EQ(met, meetsByLinearProgram(mesh_M, i, pair.swept_M)) << "seed " << seed << " triangle " << i;
    }
  }
}

TEST(OracleTest, ThreeMethodsAgreeOnRandomPairs) { compareOracles(randomPairs); }
TEST(OracleTest, ThreeMethodsAgreeOnGrazingPairs) { compareOracles(grazingPairs); }
TEST(OracleTest, ThreeMethodsAgreeOnAdversarialPairs) { compareOracles(adversarialPairs); }

// Two independent computations; the product's is accurate to double.
TEST(ExactMotionTest, EqualsTheMotionOfTheProduct) {
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    Random random(seed);
    const SweepCase sweep = randomSweep(random);
    const ExactMotion exact(sweep.motion);
    const Eigen::Vector3d p_T = extentOf(sweep.tool) * random.direction();
    const double largest = sweep.motion.X_MT_start.translation().norm() + sweep.motion.X_MT_end.translation().norm();
    for (const double fraction : {0.0, 0.125, 0.5, 0.875, 1.0}) {
      const Vector3r error = exact.at(fraction, p_T.cast<Real>()) - (sweep.motion.at(fraction) * p_T).cast<Real>();
      EXPECT_LT(static_cast<double>(error.norm()), 1e-15 * largest + 1e-14 * p_T.norm()) << "seed " << seed;
    }
  }
}

TEST(JointPositivesTest, WouldBeMissedWithoutTheBoundOfTheirDeviation) {
  std::vector<TestedDetector> detectors = allDetectors();
  size_t missed = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SweepCase sweep = jointPositives(seed);
    sweep.motion.deviation_bound = 0.0;
    missed += sweep.contacts.size() - checkCase(*detectors.front().detector, sweep).not_ruled_out.size();
  }
  EXPECT_GT(missed, 100U);
}

TEST(CaseTest, IsReadAsItWasWritten) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const std::string pair = textOf(adversarialPairs(seed), "adversarial seed 1");
    const bool joints = seed % 2 == 0;
    const std::string sweep = textOf(joints ? jointPositives(seed) : constructedPositives(seed), "positives seed 1");
    std::stringstream stream;
    stream << "something before\n" << pair << "something between\n" << sweep;
    const std::optional<AnyCase> first = readCase(stream);
    ASSERT_TRUE(first && first->pair);
    EXPECT_EQ(textOf(*first->pair, first->about), pair);
    const std::optional<AnyCase> second = readCase(stream);
    ASSERT_TRUE(second && second->sweep);
    EXPECT_EQ(textOf(*second->sweep, second->about), sweep);
    EXPECT_FALSE(readCase(stream));
  }
}

TEST(CaseTest, IsRefusedIfItIsCutOffOrUnknown) {
  std::istringstream cut_off("soundness-pair x\nstreamed\n");
  EXPECT_THROW(readCase(cut_off), InvalidInput);
  std::istringstream unknown("soundness-pair x\nsphere 1\nend\n");
  EXPECT_THROW(readCase(unknown), InvalidInput);
  std::istringstream short_of_numbers("soundness-pair x\ntriangle 0x1p0 2\nend\n");
  EXPECT_THROW(readCase(short_of_numbers), InvalidInput);
}

// Misses the last triangle that is met.
class MissingDetector : public Detector {
  void find(const Submesh& submesh, const SweptVolume& swept_M, Detection& detection) override {
    detection = reference_->detect(submesh, swept_M);
    if (!detection.triangles.empty()) detection.triangles.pop_back();
  }

  std::unique_ptr<Detector> reference_ = makeDetector("reference");
};

// Names every triangle.
class ExcessiveDetector : public Detector {
  void find(const Submesh& submesh, const SweptVolume& /*swept_M*/, Detection& detection) override {
    submesh.forEachTriangle([&](std::uint32_t triangle) { detection.triangles.push_back(triangle); });
    std::sort(detection.triangles.begin(), detection.triangles.end());
  }
};

// Runs a family on one detector, then replays the case that it wrote.
void expectCaught(const std::string& family_name, std::unique_ptr<Detector> detector, const std::string& what) {
  std::vector<TestedDetector> detectors;
  detectors.push_back({"tested", std::move(detector)});
  std::stringstream out;
  Report report(out);
  for (const Family& family : families()) {
    if (family.name == family_name) run(family, {/*cases=*/20}, detectors, report);
  }
  EXPECT_GT(report.failures(), 0U);
  EXPECT_TRUE(has(out.str(), "FAILED: " + what));

  std::ostringstream again;
  Report second(again);
  const std::optional<AnyCase> first = readCase(out);
  ASSERT_TRUE(first);
  replay(*first, detectors, second);
  EXPECT_GT(second.failures(), 0U) << first->about;
}

TEST(SearchTest, CatchesADetectorThatMissesATriangle) {
  expectCaught("grazing", std::make_unique<MissingDetector>(), "missed triangle");
  expectCaught("positives", std::make_unique<MissingDetector>(), "missed triangle");
  expectCaught("metamorphic", std::make_unique<MissingDetector>(), "relation");
}

TEST(SearchTest, CatchesADetectorThatNamesFarTriangles) {
  expectCaught("random", std::make_unique<ExcessiveDetector>(), "farther away than the inflation");
  expectCaught("sweeps", std::make_unique<ExcessiveDetector>(), "farther away than the margin");
}

// Each file is a case that failed before.
TEST(SearchTest, PassesTheCasesThatFailedBefore) {
  size_t cases = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SWEEP_GUARD_SOURCE_DIR "/test/soundness/found")) {
    std::ifstream file(entry.path());
    std::vector<TestedDetector> detectors = allDetectors();
    std::ostringstream out;
    Report report(out);
    for (; const std::optional<AnyCase> any = readCase(file); ++cases) replay(*any, detectors, report);
    EXPECT_EQ(report.failures(), 0U) << entry.path() << '\n' << out.str();
  }
  EXPECT_GT(cases, 0U);
}

TEST(SearchTest, IsDividedWithoutLosingCases) {
  std::vector<TestedDetector> detectors;
  detectors.push_back({"reference", makeDetector("reference")});
  std::ostringstream out;
  Report whole(out);
  Report halves(out);
  const Family& family = families().front();
  run(family, {/*cases=*/4000, /*seed=*/7}, detectors, whole);
  for (const std::uint64_t part : {0U, 1U}) {
    Report half(out);
    run(family, {/*cases=*/4000, /*seed=*/7, part, /*parts=*/2}, detectors, half);
    halves.of("reference", family.name).cases += half.of("reference", family.name).cases;
  }
  EXPECT_GE(halves.of("reference", family.name).cases, 4000U);
  EXPECT_GE(whole.of("reference", family.name).cases, 4000U);
}

}  // namespace
}  // namespace sweep_guard_core::soundness
