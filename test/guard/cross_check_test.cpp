#include "guard/cross_check.h"

#include <gtest/gtest.h>

#include <sstream>

#include "fake_detector.h"
#include "refusal.h"
#include "scenes.h"
#include "sweep_guard/guard/guard.h"

namespace sweep_guard_core {
namespace {

// A drill that goes through the top of a wavy workpiece, far from the origin of its frame.
class CrossCheckTest : public testing::Test {
 protected:
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
      pose.bodies = {{pose.X_WT}};
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

Eigen::Vector3d vectorIn(std::istream& stream) {
  Eigen::Vector3d p;
  stream >> p.x() >> p.y() >> p.z();
  return p;
}

// The volume that describe() has written.
SweptVolume volumeIn(const std::string& description) {
  const std::string title = "volume in the mesh frame:";
  std::istringstream stream(description.substr(description.find(title) + title.size()));
  SweptVolume volume;
  std::string key;
  stream >> key;
  for (int i = 0; i < 3; ++i) volume.box.X_MB.linear().col(i) = vectorIn(stream);
  stream >> key;
  volume.box.X_MB.translation() = vectorIn(stream);
  stream >> key;
  volume.box.half_extents = vectorIn(stream);
  stream >> key;
  volume.interior_B = vectorIn(stream);
  size_t clips = 0;
  stream >> key >> volume.margin >> key >> clips;
  for (; clips > 0; --clips) {
    const Eigen::Vector3d normal = vectorIn(stream);
    double offset = 0.0;
    stream >> offset;
    volume.clips_B.push_back(HalfSpace(normal, offset));
  }
  EXPECT_FALSE(stream.fail()) << description;
  return volume;
}

TEST_F(CrossCheckTest, ADescribedQueryReproducesTheDisagreement) {
  FakeDetector::Record record;
  record.drop_every = 3;
  drill(std::make_unique<FakeDetector>(record));
  const auto halfspace = makeDetector("halfspace");
  size_t reproduced = 0;
  for (SampledQuery& query : queries_) {
    const Disagreement before = crossCheck(query, *halfspace);
    if (!before.any()) continue;
    query.swept_M = volumeIn(describe(query, before));
    EXPECT_EQ(crossCheck(query, *halfspace).missed, before.missed);
    ++reproduced;
  }
  EXPECT_GT(reproduced, 0U);
}

TEST_F(CrossCheckTest, ADescriptionNamesTrianglesMeshAndPoses) {
  SampledQuery query;
  Workpiece workpiece = *workpieces_[0];
  workpiece.stamp = Time(std::chrono::nanoseconds(12000000034));
  query.workpiece = std::make_shared<const Workpiece>(workpiece);
  query.origin.from.stamp = Time(std::chrono::milliseconds(1500));
  query.origin.to.stamp = Time(std::chrono::milliseconds(1510));
  query.origin.to.X_WT.translation() = Eigen::Vector3d(0.1, -2.0, 300.0);
  Disagreement disagreement{{3, 7}, {}};
  const std::string begin =
      "; mesh 'liver' revision 1 at 12.000000034 in 'world'; tool measured from 0 0 0 0 0 0 1 at 1.500000000 to 0.1 -2 "
      "300 "
      "0 0 0 1 at 1.510000000; volume in the mesh frame: axes 1 0 0 0 1 0 0 0 1 center 0 0 0 half_extents ";
  EXPECT_TRUE(has(describe(query, disagreement), "missed 3 7, invented none" + begin));
  query.origin.measured = false;
  disagreement.invented.resize(22, 5);
  const std::string many = describe(query, disagreement);
  EXPECT_TRUE(has(many, " 5 5 and 2 more; mesh"));
  EXPECT_TRUE(has(many, "tool predicted from"));
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

}  // namespace
}  // namespace sweep_guard_core
