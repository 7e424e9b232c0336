// Arguments are names of files, without their ending: their tests are run, but for those that GTEST_FILTER excludes. Without any
// argument, all are.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>

namespace {

const std::string kNone = ":";  // chooses no test; before exclusions, an empty text would choose all

// Returns what a filter excludes, as it is written there: -A:B.
std::string excludedBy(const std::string& filter) { return filter.substr(std::min(filter.find('-'), filter.size())); }

// Returns a filter that chooses the tests of the files.
std::string filterOf(const std::set<std::string>& files) {
  std::string filter = kNone;
  const testing::UnitTest& program = *testing::UnitTest::GetInstance();
  for (int i = 0; i < program.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *program.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      const bool chosen = files.count(std::filesystem::path(test.file()).stem()) != 0;
      if (chosen) filter += std::string(suite.name()) + "." + test.name() + ":";
    }
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "sweep_guard_test");
  const ros::NodeHandle alive;
  testing::InitGoogleTest(&argc, argv);
  const std::string given = testing::GTEST_FLAG(filter);
  const std::string excluded = excludedBy(given);
  const std::string chosen = argc > 1 ? filterOf({argv + 1, argv + argc}) : given;
  if (argc > 1) testing::GTEST_FLAG(filter) = chosen + excluded;
  const int failed = RUN_ALL_TESTS();
  const bool nothing =
      chosen == kNone || (testing::UnitTest::GetInstance()->test_to_run_count() == 0 && excluded.empty());
  if (nothing) std::cerr << "no test is chosen\n";
  return nothing ? 1 : failed;
}
