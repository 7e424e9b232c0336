#include "evaluation/obstacle_placement.h"

#include <gtest/gtest.h>

#include "evaluation/first_contact.h"
#include "evaluation/motions.h"

namespace sweep_guard_evaluation {
namespace {

using sweep_guard_core::ConvexShape;

class ObstaclePlacementTest : public testing::Test {
 protected:
  RecordedMotion motion_{winding()};
  ConvexShape tool_ = ConvexShape::cylinder(0.005, 0.1);
};

TEST_F(ObstaclePlacementTest, GivesAsManyAsAskedForHalfOfThemWithContact) {
  const std::vector<ObstaclePlacement> placements = placeObstacles(motion_, tool_, 50, 1);
  ASSERT_EQ(placements.size(), 50U);
  EXPECT_EQ(std::count_if(placements.begin(), placements.end(), [](const auto& p) { return p.contact.has_value(); }),
            25);
}

TEST_F(ObstaclePlacementTest, LeavesTwoSecondsBeforeAContactAndNoneInANearMiss) {
  for (const ObstaclePlacement& placement : placeObstacles(motion_, tool_, 50, 1)) {
    const auto contact =
        firstContact(motion_, tool_, placement.obstacle, placement.begin, placement.begin + seconds(10));
    EXPECT_EQ(contact, placement.contact);
    if (contact) {
      EXPECT_EQ(placement.end, *contact);
      EXPECT_GE(*contact - placement.begin, seconds(2));
    }
    EXPECT_TRUE(motion_.isContinuous(placement.begin - seconds(1), placement.end));
  }
}

TEST_F(ObstaclePlacementTest, PutsNearMissesWithinTenCentimeters) {
  for (const ObstaclePlacement& placement : placeObstacles(motion_, tool_, 50, 1)) {
    if (placement.contact) continue;
    EXPECT_TRUE(intersects(tool_, motion_.at(placement.begin + seconds(4)), placement.obstacle, 0.1));
  }
}

TEST_F(ObstaclePlacementTest, AreTheSameForTheSameSeedOnly) {
  const std::vector<ObstaclePlacement> first = placeObstacles(motion_, tool_, 20, 1);
  const std::vector<ObstaclePlacement> again = placeObstacles(motion_, tool_, 20, 1);
  const std::vector<ObstaclePlacement> other = placeObstacles(motion_, tool_, 20, 2);
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].begin, again[i].begin);
    EXPECT_EQ(first[i].obstacle.X_WS.matrix(), again[i].obstacle.X_WS.matrix());
    EXPECT_NE(first[i].begin, other[i].begin);
  }
}

TEST_F(ObstaclePlacementTest, AreOrderedByTheirBegin) {
  const std::vector<ObstaclePlacement> placements = placeObstacles(motion_, tool_, 50, 1);
  EXPECT_TRUE(std::is_sorted(placements.begin(), placements.end(),
                             [](const ObstaclePlacement& a, const ObstaclePlacement& b) { return a.begin < b.begin; }));
}

TEST_F(ObstaclePlacementTest, AreNoneWhereTheToolRestsOrThereIsNoTime) {
  const RecordedMotion at_rest(straightMotion(0.0, milliseconds(20), seconds(60)));
  EXPECT_TRUE(placeObstacles(at_rest, tool_, 20, 1).empty());
  const RecordedMotion of_a_moment(straightMotion(0.1, milliseconds(20), seconds(4)));
  EXPECT_TRUE(placeObstacles(of_a_moment, tool_, 20, 1).empty());
}

}  // namespace
}  // namespace sweep_guard_evaluation
