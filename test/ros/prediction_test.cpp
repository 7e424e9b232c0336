// Predictions of a running guard, by topic and by ~predict. The test is the clock.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "node_fixture.h"
#include "refusal.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Prediction;
using sweep_guard::Warning;

constexpr double kApproach = 0.25;  // [m/s]
constexpr double kStep = 0.01;      // [s]

class PredictionTest : public NodeTest {
 protected:
  void SetUp() override {
    NodeTest::SetUp();
    placeSquare("square", {0.0, 0.0, 0.0});
  }

  // One step of the tip along z; both inputs stay fresh.
  Prediction glideTo(double z) {
    moveTo({0.0, 0.0, z});
    const ros::Time pose = probe().time();
    if (++steps_ % 20 == 0) probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, pose));
    return probe().awaitPrediction(pose);
  }

  // Comes down at constant speed; ends at the height.
  void descend(double from, double to) {
    for (int i = 0; from - i * kApproach * kStep > to; ++i) glideTo(from - i * kApproach * kStep);
    glideTo(to);
  }

  // Comes down from rest, and returns the number of warnings before. On a busy machine poses may be old before they are
  // swept: then REFLEX rises earlier than 0.3 s before the contact, and the approach is repeated.
  size_t approach(double from, double to) {
    for (int tries_left = 5;; --tries_left) {
      restAt({0.0, 0.0, from});
      probe().awaitPrediction(probe().time());  // else one from before the rest may warn later
      probe().forgetPredictions();
      const size_t begin = probe().warnings().size();
      const ros::Time contact = probe().time() + ros::Duration(kStep + from / kApproach);
      descend(from, to);
      probe().awaitWarning([](const Warning& warning) { return warning.header.stamp == probe().time(); });
      const auto early = [&](const Warning& warning) {
        return warning.level == Warning::REFLEX && contact - warning.header.stamp > ros::Duration(0.3);
      };
      const auto warnings = probe().warnings();
      const auto since = warnings.begin() + static_cast<std::ptrdiff_t>(begin);
      if (tries_left == 1 || std::none_of(since, warnings.end(), early)) return begin;
    }
  }

 private:
  int steps_ = 0;
};

ros::Time firstOf(const std::vector<Warning>& warnings, size_t since, std::uint8_t level) {
  for (size_t i = since; i < warnings.size(); ++i) {
    if (warnings[i].level == level) return warnings[i].header.stamp;
  }
  ADD_FAILURE() << "level " << static_cast<int>(level) << " was never entered";
  return {};
}

TEST_F(PredictionTest, ALonePoseIsNoMotion) {
  probe().setClock(probe().time() - ros::Duration(100.0));
  probe().place(squareMovedTo("square", {0.0, 0.0, 0.0}, probe().time()));
  const Prediction nothing = glideTo(0.5);
  EXPECT_FALSE(nothing.valid);
  EXPECT_TRUE(nothing.poses.empty());
  EXPECT_FALSE(nothing.collision);
  EXPECT_EQ(nothing.interval, Prediction::NONE);
  EXPECT_EQ(nothing.time_to_collision, ros::Duration(-1.0));
  EXPECT_TRUE(std::isnan(nothing.probability));
  EXPECT_TRUE(std::isnan(probe().timesToCollision().back()));
  const auto not_covered = [](const Warning& warning) { return warning.reasons == Warning::NOT_COVERED; };
  EXPECT_EQ(probe().awaitWarning(not_covered).level, Warning::UNKNOWN);
  EXPECT_TRUE(glideTo(0.5).valid);
  probe().awaitWarning(isClear);
}

TEST_F(PredictionTest, PredictsThePosesOfTheTool) {
  descend(0.9, 0.8);
  const Prediction prediction = glideTo(0.8 - kApproach * kStep);
  EXPECT_EQ(prediction.header.stamp, probe().time());
  EXPECT_EQ(prediction.header.frame_id, "world");
  EXPECT_EQ(prediction.tool, "tool");
  EXPECT_EQ(prediction.predictor, "direct");
  ASSERT_TRUE(prediction.valid);
  EXPECT_FALSE(prediction.collision);
  EXPECT_EQ(prediction.interval, Prediction::NONE);
  EXPECT_EQ(probe().timesToCollision().back(), INFINITY);
  ros::Duration before(0);
  for (const auto& pose : prediction.poses) {
    EXPECT_GT(pose.from_now, before);
    before = pose.from_now;
    EXPECT_LT(pose.pose.position.z, 0.8);
    for (size_t i = 0; i < 6; ++i) {
      EXPECT_GE(pose.covariance[7 * i], 0.0);
      for (size_t j = 0; j < i; ++j) EXPECT_EQ(pose.covariance[6 * i + j], pose.covariance[6 * j + i]);
    }
  }
  EXPECT_GE(prediction.poses.size(), 11U);
  EXPECT_GE(prediction.sweeps_asked, prediction.poses.size());
  EXPECT_GT(prediction.sweeps_made, 0U);
  EXPECT_LE(prediction.sweeps_made, prediction.sweeps_asked);
  EXPECT_NEAR(before.toSec(), 2.0, 0.001);  // the considered interval, and as long as a pose counts
}

TEST_F(PredictionTest, AnApproachIsConsideredThenReflexThenContact) {
  const size_t begin = approach(0.9, -0.005);
  probe().awaitWarning([](const Warning& warning) { return warning.contact; });
  const auto warnings = probe().warnings();
  const ros::Time contact = firstOf(warnings, begin, Warning::CONTACT);
  EXPECT_GE((contact - firstOf(warnings, begin, Warning::REFLEX)).toSec(), 0.1);
  EXPECT_GE((contact - firstOf(warnings, begin, Warning::CONSIDERED)).toSec(), 1.0);
  EXPECT_LT(firstOf(warnings, begin, Warning::CONSIDERED), firstOf(warnings, begin, Warning::REFLEX));

  const auto predictions = probe().predictions();
  const auto times = probe().timesToCollision();
  EXPECT_EQ(times[2], INFINITY);
  EXPECT_EQ(times.back(), 0.0);
  std::array<double, 10>
      longest{};  // reported time, for each tenth of a second before the contact: load only shortens it
  for (size_t i = 0; i < predictions.size(); ++i) {
    const double left = (contact - predictions[i].header.stamp).toSec();
    if (left < 0.005 || left > 0.995) continue;
    EXPECT_LE(times[i], left + 0.01);  // a learned path is nearly straight
    double& reported = longest.at(static_cast<size_t>(10.0 * left));
    reported = std::max(reported, times[i]);
  }
  for (size_t i = 1; i < longest.size(); ++i) EXPECT_LT(longest[i - 1], longest[i]);
}

TEST_F(PredictionTest, AWarningNamesThePredictedContact) {
  const size_t begin = approach(0.6, 0.1 - kApproach * kStep);
  const Prediction prediction = probe().awaitPrediction(probe().time());  // 0.39 s before the contact
  EXPECT_TRUE(prediction.collision);
  EXPECT_EQ(prediction.interval, Prediction::CONSIDERED);
  EXPECT_GT(prediction.probability, 0.5);
  ASSERT_EQ(prediction.objects.size(), 1U);
  EXPECT_EQ(prediction.objects[0].mesh_id, "square");
  EXPECT_EQ(prediction.objects[0].triangles, (std::vector<std::uint32_t>{0, 1}));

  const auto warnings = probe().warnings();
  const Warning warning =
      *std::find_if(warnings.begin() + static_cast<std::ptrdiff_t>(begin), warnings.end(),
                    [&](const Warning& next) { return next.header.stamp == prediction.header.stamp; });
  EXPECT_EQ(warning.level, Warning::CONSIDERED) << warning.text;
  EXPECT_TRUE(warning.considered);
  EXPECT_FALSE(warning.reflex || warning.clear || warning.contact);
  EXPECT_EQ(warning.mesh_id, "square");
  EXPECT_EQ(warning.triangles, prediction.objects[0].triangles);
  EXPECT_NEAR(warning.time_to_collision.toSec(), prediction.time_to_collision.toSec(), 0.1);
  EXPECT_GE(warning.covered_until, warning.header.stamp + ros::Duration(1.0));
}

TEST_F(PredictionTest, ARetreatDoesNotWarn) {
  restAt({0.0, 0.0, 0.3});
  descend(0.3, 0.02);
  probe().awaitWarning([](const Warning& warning) { return warning.level == Warning::REFLEX; });
  double z = 0.02;
  const auto retreat = [&] { glideTo(z += kApproach * kStep); };
  while (!isClear(probe().warnings().back()) && z < 50.0) retreat();
  const size_t clear_since = probe().warnings().size();
  for (int i = 0; i < 50; ++i) retreat();
  probe().awaitWarning([](const Warning& warning) { return warning.header.stamp == probe().time(); });
  const auto warnings = probe().warnings();
  for (size_t i = clear_since; i < warnings.size(); ++i) EXPECT_TRUE(warnings[i].clear) << warnings[i].text;
}

TEST_F(PredictionTest, PosesThatStopAreUnknown) {
  restAt({0.0, 0.0, 0.6});
  descend(0.6, 0.5);
  probe().advance(1.01);
  const Warning warning = probe().awaitWarning(hasReason(Warning::POSE_STALE));
  EXPECT_TRUE(warning.reflex && warning.considered);
  EXPECT_EQ(warning.time_to_collision, ros::Duration(-1.0));
}

// Markers come when they are due: it takes some, drawn from a fresh pose, that show a collision not yet near.
TEST_F(PredictionTest, MarkersShowWhatIsPredicted) {
  using visualization_msgs::Marker;
  using visualization_msgs::MarkerArray;
  const auto markers_of = [](const MarkerArray& drawn, const std::string& ns) {
    std::vector<Marker> found;
    for (const Marker& marker : drawn.markers) {
      if (marker.ns == ns && marker.action == Marker::ADD) found.push_back(marker);
    }
    return found;
  };
  const auto amber = [](const Marker& marker) { return marker.color.r > 0.9F && marker.color.b < 0.2F; };
  const auto drawn_now = [&](const MarkerArray& drawn) {
    const auto tool = markers_of(drawn, "tool");
    return !tool.empty() && tool[0].header.stamp == probe().time();
  };
  restAt({0.0, 0.0, 0.3});
  MarkerArray shown;
  for (double z = 0.2; z > 0.03; z -= kApproach * kStep) {
    glideTo(z);
    shown = probe().awaitMarkers(drawn_now);
    const auto triangles = markers_of(shown, "predicted_triangles");
    if (triangles.size() == 2 && amber(triangles[0])) break;
  }
  const auto triangles = markers_of(shown, "predicted_triangles");
  ASSERT_EQ(triangles.size(), 2U);  // faces and edges of the considered interval
  EXPECT_TRUE(amber(triangles[0]));
  EXPECT_EQ(triangles[0].points.size(), 12U);  // two triangles from both sides
  const auto ghosts = markers_of(shown, "predicted_tool");
  ASSERT_GE(ghosts.size(), 3U);
  EXPECT_LE(ghosts.size(), 10U);
  for (size_t i = 1; i < ghosts.size(); ++i) {
    EXPECT_GT(ghosts[i].id, ghosts[i - 1].id);
    EXPECT_LT(ghosts[i].color.a, ghosts[i - 1].color.a);
    EXPECT_LT(ghosts[i].pose.position.z, ghosts[i - 1].pose.position.z);
  }
  EXPECT_EQ(markers_of(shown, "predicted_volume").size(), 2U);
  EXPECT_EQ(markers_of(shown, "trajectory").size(), 2U);
  for (const Marker& marker : shown.markers) {
    EXPECT_EQ(marker.lifetime, ros::Duration(0.5));
    EXPECT_LT(marker.color.a, 1.0F);
  }

  probe().advance(3.0);  // what was expected is over, and the pose is stale
  const auto grey = [&](const MarkerArray& drawn) {
    const auto stale = markers_of(drawn, "predicted_triangles");
    return !stale.empty() && stale[0].color.r == stale[0].color.b;
  };
  probe().awaitMarkers(grey);
  while (!isClear(probe().warnings().back())) glideTo(0.9);
  probe().awaitMarkers([&](const MarkerArray& drawn) {
    return std::any_of(drawn.markers.begin(), drawn.markers.end(), [](const Marker& marker) {
      return marker.ns == "predicted_triangles" && marker.action == Marker::DELETE;
    });
  });
}

TEST_F(PredictionTest, PredictAnswersForAnyHorizon) {
  restAt({0.0, 0.0, 0.9});
  descend(0.9, 0.8);
  for (const double horizon : {0.004, 0.1, 0.55, 1.0, 2.0, 5.0}) {
    const auto response = probe().predict(horizon);
    ASSERT_TRUE(response.success) << response.message;
    ASSERT_TRUE(response.prediction.valid);
    EXPECT_EQ(response.prediction.poses.back().from_now, ros::Duration(horizon));
    EXPECT_EQ(response.prediction.header.stamp, probe().time());
  }
  const auto configured = probe().predict(0.0);
  ASSERT_TRUE(configured.success) << configured.message;
  EXPECT_EQ(configured.prediction.poses.back().from_now, ros::Duration(1.0));
}

TEST_F(PredictionTest, PredictFindsWhatLiesBeyondTheConfiguredHorizon) {
  restAt({0.0, 0.0, 1.2});
  descend(1.2, 0.6);  // 2.4 s before the contact
  EXPECT_FALSE(probe().predict(1.0).prediction.collision);
  const auto far = probe().predict(4.0).prediction;
  EXPECT_TRUE(far.collision);
  EXPECT_EQ(far.interval, Prediction::NONE);
  EXPECT_GT(far.time_to_collision.toSec(), 1.1);
  EXPECT_LT(far.time_to_collision.toSec(), 4.0);
  ASSERT_EQ(far.objects.size(), 1U);
  EXPECT_EQ(far.objects[0].mesh_id, "square");
}

TEST_F(PredictionTest, PredictRefusesWhatItCannotAnswer) {
  const auto refused = [](double horizon, const std::string& expected) {
    const auto response = probe().predict(horizon);
    EXPECT_FALSE(response.success || response.prediction.valid);
    EXPECT_TRUE(response.prediction.poses.empty());
    EXPECT_EQ(response.prediction.time_to_collision, ros::Duration(-1.0));
    EXPECT_TRUE(has(response.message, expected));
  };
  restAt({0.0, 0.0, 0.9});
  refused(-0.1, "from 0 (as configured) to 5 s");
  refused(5.001, "from 0 (as configured) to 5 s");
  probe().advance(1.1);
  refused(1.0, "stale");
  probe().setClock(probe().time() - ros::Duration(100.0));
  refused(1.0, "no tool pose");
  moveTo({0.0, 0.0, 0.9});
  refused(1.0, "two tool poses");
}

}  // namespace
}  // namespace sweep_guard_ros
