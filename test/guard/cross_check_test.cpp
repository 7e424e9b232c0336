#include "guard/cross_check.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "fake_detector.h"
#include "guard/detector_case.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {
namespace {

namespace filesystem = std::filesystem;

// A drill that goes through the top of a wavy workpiece, far from the origin of its frame.
class CrossCheckTest : public testing::Test {
 protected:
  CrossCheckTest() : folder_(filesystem::temp_directory_path() / ("cross_check_" + std::to_string(getpid()))) {}
  ~CrossCheckTest() override { filesystem::remove_all(folder_); }

  static Workpieces workpieces() {
    const TriangleMesh hull = wavyHull(/*rings=*/30, /*sectors=*/40, /*phase=*/0.0);
    std::vector<Eigen::Vector3d> vertices_M;
    for (size_t i = 0; i < hull.vertexCount(); ++i) vertices_M.emplace_back(hull.vertex(i) + kPlace);
    const TriangleMesh mesh_M(vertices_M, hull.triangles());
    return {std::make_shared<const Workpiece>(Workpiece{"liver", 1, Time(), {}, "world", mesh_M})};
  }

  // Sweeps into the workpiece, and looks ahead.
  SweepReport drill(std::unique_ptr<Detector> detector) {
    sampler_.setWorkpieces(workpieces_);
    Guard guard(Tool(ConvexShape::cylinder(0.005, 0.1)), sampled(std::move(detector), "select", sampler_), {});
    SweepReport report;
    Prediction prediction;
    PoseWithFrames pose;
    pose.X_WM["world"] = Eigen::Isometry3d::Identity();
    for (int step = 0; step < 5; ++step) {
      pose.stamp = Time(std::chrono::milliseconds(10 * step));
      pose.X_WT.translation() = kPlace + Eigen::Vector3d(0.0, 0.0, 0.2 - 0.02 * step);
      guard.sweep(pose, workpieces_, report);
      guard.predict({}, workpieces_, prediction);
      keepAll();
    }
    return report;
  }

  // As another thread does, as long as queries wait.
  void keepAll() {
    SampledQuery query;
    while (sampler_.waiting()) {
      ASSERT_TRUE(sampler_.take(query));
      queries_.push_back(query);
    }
  }

  std::vector<Disagreement> disagreements(const std::string& other) {
    const auto detector = makeDetector(other);
    std::vector<Disagreement> found;
    for (const SampledQuery& query : queries_) {
      if (const Disagreement one = crossCheck(query, *detector); one.any()) found.push_back(one);
    }
    return found;
  }

  std::vector<Disagreement> disagreementsWith(FakeDetector::Record record) {
    drill(std::make_unique<FakeDetector>(record));
    return disagreements("halfspace");
  }

  static inline const Eigen::Vector3d kPlace{300.0, -200.0, 100.0};

  filesystem::path folder_;
  Workpieces workpieces_ = workpieces();
  QuerySampler sampler_{/*every=*/1};
  std::vector<SampledQuery> queries_;
};

TEST_F(CrossCheckTest, DetectorsAgreeAboutMeasuredAndPredictedSweeps) {
  for (const std::string& name : detectorNames()) {
    queries_.clear();
    drill(makeDetector(name));
    EXPECT_GE(queries_.size(), 5U);
    EXPECT_TRUE(disagreements(otherDetector(name, 1)).empty()) << name;
    EXPECT_TRUE(disagreements("reference").empty()) << name;
  }
}

TEST_F(CrossCheckTest, FindsWhatABiasedDetectorLeavesOut) {
  FakeDetector::Record record;
  record.drop_every = 3;
  const std::vector<Disagreement> found = disagreementsWith(record);
  ASSERT_FALSE(found.empty());
  for (const Disagreement& one : found) {
    EXPECT_TRUE(one.invented.empty());
    for (const std::uint32_t triangle : one.missed) EXPECT_EQ(triangle % 3, 0U);
  }
}

TEST_F(CrossCheckTest, FindsWhatABiasedDetectorInvents) {
  FakeDetector::Record record;
  record.grown = 0.01;
  const std::vector<Disagreement> found = disagreementsWith(record);
  ASSERT_FALSE(found.empty());
  for (const Disagreement& one : found) EXPECT_TRUE(one.missed.empty() && !one.invented.empty());
}

TEST_F(CrossCheckTest, TakesEveryNthQueryAndSkipsThemWhileOneWaits) {
  QuerySampler sampler(3);
  sampler.setWorkpieces(workpieces_, {/*measured=*/false, /*epoch=*/7});
  const auto detector = sampled(makeDetector("reference"), "reference", sampler);
  const auto ask = [&](int times) {
    for (; times > 0; --times) detector->detect(workpieces_[0]->mesh_M, {});
  };
  ask(2);
  EXPECT_FALSE(sampler.waiting());
  ask(1);
  EXPECT_TRUE(sampler.waiting());
  ask(10);
  SampledQuery query;
  ASSERT_TRUE(sampler.take(query));
  EXPECT_EQ(query.workpiece, workpieces_[0]);
  EXPECT_EQ(query.detector, "reference");
  EXPECT_FALSE(query.origin.measured);
  EXPECT_EQ(query.origin.epoch, 7U);
  EXPECT_FALSE(sampler.waiting());
  sampler.stop();
  EXPECT_FALSE(sampler.take(query));
}

TEST_F(CrossCheckTest, ASavedCaseIsReadBackAndReproducesTheDisagreement) {
  FakeDetector::Record record;
  record.drop_every = 3;
  drill(std::make_unique<FakeDetector>(record));
  const auto halfspace = makeDetector("halfspace");
  size_t reproduced = 0;
  for (const SampledQuery& query : queries_) {
    const Disagreement before = crossCheck(query, *halfspace);
    if (!before.any()) continue;
    std::stringstream text;
    write(caseOf(query, "halfspace"), text);
    const DetectorCase read = readDetectorCase(text);
    EXPECT_EQ(read.mesh_id, "liver");
    EXPECT_EQ(read.detector, "select");
    EXPECT_EQ(read.other, "halfspace");
    TriangleSet again = crossCheck(queryOf(read), *halfspace).missed;
    for (std::uint32_t& triangle : again) triangle = read.numbers.at(triangle);
    EXPECT_EQ(again, before.missed);
    EXPECT_EQ(read.found.inflation, query.found.inflation);
    EXPECT_EQ(read.swept_M.box.half_extents, query.swept_M.box.half_extents);
    ++reproduced;
  }
  EXPECT_GT(reproduced, 0U);
}

TEST_F(CrossCheckTest, CasesFillTheirFolderUpToALimitAndThenSayWhy) {
  drill(makeDetector("reference"));
  const auto save_up_to = [&](const filesystem::path& folder, std::uintmax_t max_folder) {
    return save(queries_.at(0), "halfspace", folder, max_folder);
  };
  const std::string first = save_up_to(folder_, 1U << 30U);
  EXPECT_EQ(first, "saved as " + (folder_ / "detector_case_1.txt").string());
  const auto size = filesystem::file_size(folder_ / "detector_case_1.txt");
  EXPECT_TRUE(has(save_up_to(folder_, 2 * size), "detector_case_2.txt"));
  EXPECT_TRUE(has(save_up_to(folder_, 3 * size - 1), "not saved: "));
  EXPECT_TRUE(has(save_up_to("/dev/null/cases", 1U << 30U), "not saved: "));
  EXPECT_TRUE(has(save_up_to("/dev/full", 1U << 30U), "not saved: "));
}

TEST_F(CrossCheckTest, EveryTenthQueryIsForADetectorThatSharesNoCode) {
  for (const std::string& name : detectorNames()) {
    int by_reference = 0;
    for (std::uint64_t number = 1; number <= 20; ++number) {
      const std::string other = otherDetector(name, number);
      EXPECT_NE(other, name);
      by_reference += other == "reference" ? 1 : 0;
    }
    EXPECT_EQ(by_reference, name == "reference" ? 0 : 2);
  }
}

TEST_F(CrossCheckTest, ASamplerThatKeepsNoneHoldsNoWorkpiece) {
  QuerySampler sampler(/*every=*/0);
  sampler.setWorkpieces(workpieces_);
  EXPECT_EQ(workpieces_[0].use_count(), 1);
}

TEST(DetectorCaseTest, RefusesOtherTexts) {
  for (const char* const text : {"", "sweep_guard detector case 2", "sweep_guard detector case 1\nworkpiece a\n"}) {
    std::istringstream stream(text);
    EXPECT_THROW(readDetectorCase(stream), InvalidInput) << text;
  }
}

}  // namespace
}  // namespace sweep_guard_core
