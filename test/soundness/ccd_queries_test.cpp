#include "soundness/ccd_queries.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "data_path.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

using Kind = CcdQuery::Kind;

std::vector<CcdQuery> read(const std::string& text, Kind kind) {
  std::istringstream stream(text);
  return readCcdQueries(stream, kind);
}

// Eight rows of integers.
std::string rows(const std::array<std::array<int, 3>, 8>& points, int truth) {
  std::string text;
  for (const auto& p : points) {
    for (const int coordinate : p) text += std::to_string(coordinate) + ",1,";
    text += std::to_string(truth) + '\n';
  }
  return text;
}

TEST(ReadCcdQueriesTest, TakesIntegersOfAnyLength) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    text += "-1267650600228229401496703205376,1267650600228229401496703205376,0,1,3,4,1\n";  // 2^100
  }
  const std::vector<CcdQuery> queries = read(text, Kind::kVertexFace);
  ASSERT_EQ(queries.size(), 1U);
  EXPECT_EQ(queries[0].start[2], Eigen::Vector3d(-1.0, 0.0, 0.75));
  EXPECT_TRUE(queries[0].truth);
}

TEST(ReadCcdQueriesTest, RefusesMalformedRows) {
  const std::string good = rows({}, 1);
  EXPECT_EQ(read(good, Kind::kEdgeEdge).size(), 1U);
  EXPECT_TRUE(read("", Kind::kEdgeEdge).empty());
  for (const std::string bad : {"0,1,0,1,0,1\n", "0,1,0,1,0,1,2\n", "0,1,0,1,0,0,1\n", "0,1,0,1,x,1,1\n",
                                "0,1,0,1,-,1,1\n", "1,3,0,1,0,1,1\n", "0,1,0,1,0,1,0\n", "0,1,0,1,0,1,1\n"}) {
    EXPECT_THROW(read(good + bad + (bad.back() == '0' ? good : ""), Kind::kEdgeEdge), InvalidInput) << bad;
  }
  EXPECT_THROW(read("0,1,0,1,0,1,1\n" + rows({}, 0), Kind::kEdgeEdge), InvalidInput);
}

TEST(CcdQueryTest, AVertexHitsAFaceThatItPassesThrough) {
  const auto query = [](int x) {
    return read(rows({{{x, 1, 1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {x, 1, -1}, {0, 0, 0}, {4, 0, 0}, {0, 4, 0}}}, 1),
                Kind::kVertexFace)[0];
  };
  EXPECT_TRUE(hasImpact(query(1)));
  EXPECT_TRUE(hasImpact(query(3)));  // on the edge
  EXPECT_FALSE(hasImpact(query(4)));
}

// The second edge grows and turns while it passes, as no rigid tool does.
TEST(CcdQueryTest, EdgesHitIfTheyCross) {
  const auto query = [](int reach) {
    return read(
        rows({{{0, 0, 0}, {8, 0, 0}, {1, -1, 1}, {2, 1, 3}, {0, 0, 0}, {8, 0, 0}, {reach, -4, -1}, {5, 4, -5}}}, 1),
        Kind::kEdgeEdge)[0];
  };
  EXPECT_TRUE(hasImpact(query(4)));
  EXPECT_FALSE(hasImpact(query(-90)));
}

TEST(CcdDataTest, MissesNoneOfTheSampleQueries) {
  const std::filesystem::path data = dataPath("ccd");
  if (!std::filesystem::exists(data)) GTEST_SKIP() << missing(data);
  CcdTally all;
  std::ostringstream misses;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
    if (entry.path().extension() != ".csv") continue;
    all.add(checkCcdQueries(entry.path(), misses));
  }
  EXPECT_GT(all.positives, 100);
  EXPECT_EQ(all.misses, 0) << misses.str();
  EXPECT_LT(all.farthest_extra, 1e-6);  // where the narrow phase ran out of steps; else 2e-9
}

}  // namespace
}  // namespace sweep_guard_core::soundness
