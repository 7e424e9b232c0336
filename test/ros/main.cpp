// Arguments are names of files, without their ending: their tests are run. Without any, all are.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <filesystem>
#include <iostream>
#include <set>

namespace {

// Returns a filter that chooses the tests of the files.
std::string filterOf(const std::set<std::string>& files) {
  std::string filter;
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
  if (argc > 1) testing::GTEST_FLAG(filter) = filterOf({argv + 1, argv + argc});
  const int failed = RUN_ALL_TESTS();
  const bool nothing = testing::UnitTest::GetInstance()->test_to_run_count() == 0;
  if (nothing) std::cerr << "no test is chosen\n";
  return nothing ? 1 : failed;
}
