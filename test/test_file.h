#pragma once

#include <gtest/gtest.h>

#include <string>

namespace sweep_guard_core {

/// Returns the path of a file for the running test.
/// @param suffix  with its dot
inline std::string testFile(const std::string& suffix) {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return testing::TempDir() + test.test_suite_name() + "_" + test.name() + suffix;
}

}  // namespace sweep_guard_core
