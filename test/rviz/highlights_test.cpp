#include "rviz/surface_visual.h"

#include <gtest/gtest.h>

namespace sweep_guard_rviz {
namespace {

using Triangles = std::vector<std::uint32_t>;

TEST(HighlightsTest, ShowsATriangleOnceInItsMostUrgentList) {
  sweep_guard::ObjectView view;
  view.touched = {3};
  view.reflex = {3, 4};
  view.considered = {3, 4, 5};
  const SurfaceVisual::Highlights shown = highlightsOf(view, {}, 10);
  EXPECT_EQ(shown[SurfaceVisual::kTouched], Triangles{3});
  EXPECT_EQ(shown[SurfaceVisual::kReflex], Triangles{4});
  EXPECT_EQ(shown[SurfaceVisual::kConsidered], Triangles{5});
}

TEST(HighlightsTest, DropsTrianglesThatTheWorkpieceDoesNotHave) {
  sweep_guard::ObjectView view;
  view.touched = {1, 9, 10, 4000000000U};
  EXPECT_EQ(highlightsOf(view, {}, 10)[SurfaceVisual::kTouched], (Triangles{1, 9}));
}

TEST(HighlightsTest, OrderAndRepetitionDoNotMatter) {
  sweep_guard::ObjectView view;
  view.considered = {7, 2, 7};
  EXPECT_EQ(highlightsOf(view, {}, 10)[SurfaceVisual::kConsidered], (Triangles{2, 7}));
}

TEST(HighlightsTest, WhatIsAllowedIsShownWhereNothingIsMoreUrgentAndBeforeWhatIsIntended) {
  sweep_guard::ObjectView view;
  view.touched = {1};
  view.considered = {3};
  view.allowed = {1, 3, 4, 10};
  const SurfaceVisual::Highlights shown = highlightsOf(view, {4, 5}, 10);
  EXPECT_EQ(shown[SurfaceVisual::kAllowed], Triangles{4});
  EXPECT_EQ(shown[SurfaceVisual::kIntended], Triangles{5});
  EXPECT_EQ(shown[SurfaceVisual::kTouched], Triangles{1});
}

TEST(HighlightsTest, WhatIsIntendedIsShownWhereNothingIsMoreUrgent) {
  sweep_guard::ObjectView view;
  view.touched = {1};
  view.reflex = {2};
  view.considered = {3};
  const SurfaceVisual::Highlights shown = highlightsOf(view, {4, 3, 2, 1, 4, 10}, 10);
  EXPECT_EQ(shown[SurfaceVisual::kIntended], Triangles{4});
  EXPECT_EQ(shown[SurfaceVisual::kTouched], Triangles{1});
}

}  // namespace
}  // namespace sweep_guard_rviz
