// ~enable, ~reset and ~acknowledge of a running guard. Part of node_test.
#include <map>

#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Contacts;
using sweep_guard::Warning;

class ControlsTest : public NodeTest {
 protected:
  void TearDown() override {
    probe().enable(true);
    NodeTest::TearDown();
  }
};

TEST_F(ControlsTest, DisabledIsUnknownForThatReasonAloneAndNotClear) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  const auto response = probe().enable(false);
  EXPECT_TRUE(response.success) << response.message;
  const Warning warning = probe().awaitWarning(hasReason(Warning::DISABLED));
  EXPECT_EQ(warning.reasons, Warning::DISABLED);
  EXPECT_TRUE(warning.reflex && warning.considered);
  EXPECT_TRUE(has(warning.text, "disabled by " + ros::this_node::getName()));
}

// A pose received while disabled is never swept, not even as a part of a later motion.
TEST_F(ControlsTest, NothingIsSweptWhileDisabledAndCoverageRestarts) {
  placeSquare("square", {0.0, 0.0, 0.0});
  restAt({0.0, 0.0, 0.5});
  ASSERT_TRUE(probe().enable(false).success);
  probe().forgetContacts();
  probe().forgetPredictions();
  probe().tick(0.01);
  probe().publish(poseAt({0.0, 0.0, 0.1}, probe().time()));
  EXPECT_FALSE(probe().predict(1.0).success);
  probe().skipWarnings();
  ASSERT_TRUE(probe().enable(true).success);
  const Warning first = probe().awaitWarning([](const Warning& next) { return next.reasons != Warning::DISABLED; });
  EXPECT_EQ(first.level, Warning::UNKNOWN);
  EXPECT_NE(first.reasons & Warning::NO_POSE, 0U) << first.text;
  EXPECT_EQ(first.covered_until, ros::Time());

  probe().tick(0.01);
  probe().publish(poseAt({0.0, 0.0, -0.5}, probe().time()));  // beyond the square, clear of it
  const std::vector<Contacts> contacts = probe().awaitContactsUpTo(probe().time());
  ASSERT_EQ(contacts.size(), 1U);
  EXPECT_EQ(contacts[0].interval_start, probe().time());
  EXPECT_TRUE(contacts[0].objects.empty());
  restAt({0.0, 0.0, -0.5});
}

TEST_F(ControlsTest, EnablingTwiceChangesNothing) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  const size_t clear_since = probe().warnings().size();
  EXPECT_TRUE(probe().enable(true).success);
  moveTo({0.0, 0.0, 0.5});
  const auto warnings = probe().warnings();
  for (size_t i = clear_since; i < warnings.size(); ++i) EXPECT_TRUE(warnings[i].clear) << warnings[i].text;
}

TEST_F(ControlsTest, ContactIsNotHiddenByDisabling) {
  touchASquare();
  const auto response = probe().enable(false);
  EXPECT_FALSE(response.success);
  EXPECT_TRUE(has(response.message, "CONTACT: tool meets 'square'"));
  moveTo({0.0, 0.0, -0.01});
  EXPECT_TRUE(probe().warnings().back().contact);
}

// Also while the clock of the stamps stands still. A refused input changes nothing.
TEST_F(ControlsTest, DisabledOutlastsResetAndJumpsOfTime) {
  ASSERT_TRUE(probe().enable(false).success);
  const auto response = probe().reset();
  EXPECT_TRUE(response.success);
  EXPECT_TRUE(has(response.message, "stays disabled"));
  probe().skipWarnings();
  probe().setClock(probe().time() - ros::Duration(10.0));
  probe().publish(poseAt({0.0, 0.0, 0.5}, ros::Time()));
  EXPECT_EQ(probe().awaitWarning([](const Warning&) { return true; }).reasons, Warning::DISABLED);
}

// Comes down at 0.025 m/s, warned of from a second before the square on.
class AcknowledgeTest : public ControlsTest {
 protected:
  void SetUp() override {
    ControlsTest::SetUp();
    placeSquare("square", {0.0, 0.0, 0.0});
    restAt({0.0, 0.0, height_});
    probe().skipWarnings();
  }
  void TearDown() override {
    probe().reset();  // other tests predict what they have taught
    ControlsTest::TearDown();
  }

  void stepTo(double height) {
    moveTo({0.0, 0.0, height});
    probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, probe().time()));
  }
  // On a busy machine the pose may be stale before the answer: tries again, up to 1 cm over the square.
  sweep_guard::Acknowledge::Response acknowledgeOnTheWay(const std::string& mesh_id) {
    sweep_guard::Acknowledge::Response response;
    while (!response.success && height_ > 0.01) {
      stepTo(height_ -= kSpeed * 0.01);
      if (height_ < kSpeed) response = probe().acknowledge(mesh_id);
    }
    return response;
  }
  static bool isAcknowledged(const Warning& warning) { return warning.acknowledged; }

  static constexpr double kSpeed = 0.025;  // [m/s]
  double height_ = 0.04;
};

TEST_F(AcknowledgeTest, IsNoPermission) {
  const auto response = acknowledgeOnTheWay("square");
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.mesh_id, "square");
  EXPECT_GT(response.until, probe().time());
  const Warning warning = probe().awaitWarning(isAcknowledged);
  EXPECT_EQ(warning.level, Warning::CONSIDERED) << warning.text;
  EXPECT_TRUE(warning.considered && !warning.clear);
  EXPECT_EQ(warning.mesh_id, "square");
  EXPECT_TRUE(has(warning.text, "acknowledged"));
  const size_t since = probe().warnings().size();
  for (int i = 0; i < 20; ++i) stepTo(height_ -= kSpeed * 0.01);
  const std::vector<Warning> warnings = probe().warnings();
  for (size_t i = since; i < warnings.size(); ++i) {
    EXPECT_FALSE(warnings[i].clear) << warnings[i].text;
    EXPECT_EQ(warnings[i].considered, warnings[i].level != Warning::CLEAR) << warnings[i].text;
  }
}

TEST_F(AcknowledgeTest, IsOfTheWorkpieceWarnedOfIfNoneIsNamed) {
  const auto response = acknowledgeOnTheWay("");
  ASSERT_TRUE(response.success) << response.message;
  EXPECT_EQ(response.mesh_id, "square");
}

TEST_F(AcknowledgeTest, EndsWhenTheToolLeaves) {
  ASSERT_TRUE(acknowledgeOnTheWay("square").success);
  probe().awaitWarning(isAcknowledged);
  for (double height = height_; height < 0.05; height += 0.001) stepTo(height);
  EXPECT_FALSE(probe().acknowledge("square").success);
  probe().skipWarnings();
  const auto isWarned = [](const Warning& next) { return next.level == Warning::CONSIDERED && !next.held; };
  // On a busy machine the warning may come late.
  for (double height = 0.05; height > 0.005 && !isWarned(probe().warnings().back()); height -= kSpeed * 0.01)
    stepTo(height);
  EXPECT_FALSE(probe().awaitWarning(isWarned).acknowledged);
}

TEST_F(AcknowledgeTest, EndsAtContactAndContactIsNotAcknowledged) {
  ASSERT_TRUE(acknowledgeOnTheWay("square").success);
  moveTo({0.0, 0.0, -0.01});
  const Warning warning = probe().awaitWarning([](const Warning& next) { return next.contact; });
  EXPECT_FALSE(warning.acknowledged);
  const auto response = probe().acknowledge("square");
  EXPECT_FALSE(response.success);
  EXPECT_TRUE(has(response.message, "only CONSIDERED can be acknowledged, not CONTACT")) << response.message;
}

TEST_F(AcknowledgeTest, NeedsAWarning) {
  const std::map<std::string, std::string> reasons = {{"square", "only CONSIDERED can be acknowledged"},
                                                      {"", "there is no warning"},
                                                      {"spleen", "only CONSIDERED can be acknowledged"},
                                                      {"\n", "mesh_id is no name"}};
  for (const auto& [id, reason] : reasons) {
    const auto response = probe().acknowledge(id);
    EXPECT_FALSE(response.success) << id;
    EXPECT_TRUE(has(response.message, reason)) << id;
    EXPECT_EQ(response.until, ros::Time()) << id;
  }
}

TEST_F(ControlsTest, AContactThatIsOverIsHeldAndSaysSinceWhen) {
  const Warning touching = touchASquare();
  EXPECT_FALSE(touching.held);
  EXPECT_EQ(touching.held_since, ros::Time());
  moveTo({0.0, 0.0, 0.5});  // the way out still touches
  moveTo({0.0, 0.0, 0.5});
  const Warning held = probe().awaitWarning([](const Warning& warning) { return warning.held; });
  EXPECT_TRUE(held.contact);
  EXPECT_GT(held.held_since, ros::Time());
  EXPECT_LE(held.held_since, probe().time());
  EXPECT_TRUE(has(held.text, "CONTACT: tool touched 'square'"));
}

TEST_F(ControlsTest, ResetEndsAHeldContactAndKeepsTheWorkpieces) {
  const Warning contact = touchASquare();
  moveTo({0.0, 0.0, 0.5});
  probe().skipWarnings();
  const auto response = probe().reset();
  EXPECT_TRUE(response.success) << response.message;
  EXPECT_TRUE(has(response.message, "Kept: workpieces (1)"));
  const Warning restarted = probe().awaitWarning([](const Warning& warning) { return !warning.contact; });
  EXPECT_EQ(restarted.level, Warning::UNKNOWN);
  EXPECT_EQ(restarted.reasons, Warning::NO_POSE) << restarted.text;
  EXPECT_GT(restarted.sequence, contact.sequence);
  restAt({0.0, 0.0, 0.5});
}

TEST_F(ControlsTest, ResetDoesNotHideAContactThatIsStillThere) {
  placeSquare("square", {0.0, 0.0, 0.0});
  moveTo({0.0, 0.0, -0.05});
  ASSERT_TRUE(probe().reset().success);
  probe().skipWarnings();
  EXPECT_EQ(moveTo({0.0, 0.0, -0.05}).objects.size(), 1U);
  probe().awaitWarning([](const Warning& warning) { return warning.contact; });
}

// Two poses make a motion, and poses before the reset do not count.
TEST_F(ControlsTest, ResetForgetsTheMotion) {
  placeSquare("square", {0.0, 0.0, -1.0});
  restAt({0.0, 0.0, 0.5});
  EXPECT_TRUE(probe().predict(1.0).success);
  ASSERT_TRUE(probe().reset().success);
  EXPECT_FALSE(probe().predict(1.0).success);
  moveTo({0.0, 0.0, 0.5});
  EXPECT_FALSE(probe().predict(1.0).success);
  moveTo({0.0, 0.0, 0.5});
  probe().awaitPrediction(probe().time());
  EXPECT_TRUE(probe().predict(1.0).success);
}

TEST_F(ControlsTest, ResetKeepsTheRefusalOfAWorkpiece) {
  auto bad = squareAt("bad", {0.0, 0.0, -1.0}, probe().time());
  bad.mesh.triangles.clear();
  probe().publish(bad);
  placed_.insert("bad");
  probe().awaitWarning(hasReason(Warning::MESH_INVALID));
  ASSERT_TRUE(probe().reset().success);
  probe().skipWarnings();
  const Warning warning = probe().awaitWarning([](const Warning&) { return true; });
  EXPECT_NE(warning.reasons & Warning::MESH_INVALID, 0U) << warning.text;
}

}  // namespace
}  // namespace sweep_guard_ros
