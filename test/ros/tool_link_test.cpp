// A tool of two links, a drill and a camera beside it: every warning names its link.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "node_fixture.h"

namespace sweep_guard_ros {
namespace {

using sweep_guard::Warning;

struct Link {
  std::string name;
  double x;  // of its center when the tip is at 0 [m]
};
void PrintTo(const Link& link, std::ostream* out) { *out << link.name; }

class ToolLinkTest : public NodeTest, public ::testing::WithParamInterface<Link> {};

// The tool points down and descends to the square, which is under one link only.
TEST_P(ToolLinkTest, IsNamedBeforeAndInContact) {
  probe().place(squareAt("square", {GetParam().x, 0.0, 0.0}, probe().time(), /*half_side=*/0.008));
  placed_.insert("square");
  const size_t before = probe().warnings().size();
  for (int mm = 60; mm >= -5; --mm) {  // every 10 ms
    moveTo({0.0, 0.0, 0.001 * mm});
    probe().awaitPrediction(probe().time());
  }
  probe().awaitWarning([](const Warning& warning) { return warning.contact; });

  std::set<std::uint8_t> levels;
  const std::vector<Warning> warnings = probe().warnings();
  for (size_t i = before; i < warnings.size(); ++i) {
    if (warnings[i].level < Warning::CONSIDERED) continue;
    levels.insert(warnings[i].level);
    EXPECT_EQ(warnings[i].tool_link, GetParam().name) << warnings[i].text;
    if (warnings[i].level != Warning::CONTACT) continue;
    EXPECT_NE(warnings[i].text.find(", by link '" + GetParam().name + "'"), std::string::npos) << warnings[i].text;
  }
  EXPECT_EQ(levels, (std::set<std::uint8_t>{Warning::CONSIDERED, Warning::REFLEX, Warning::CONTACT}));
}

INSTANTIATE_TEST_SUITE_P(Links, ToolLinkTest, ::testing::Values(Link{"drill", 0.0}, Link{"camera", 0.05}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace sweep_guard_ros
