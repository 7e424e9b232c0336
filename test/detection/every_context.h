#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sweep_guard/detection/offscreen_context.h"

namespace sweep_guard {

/// Why this machine has no such context; empty: it has.
inline std::string whyMissing(const std::string& gl_context) {
  try {
    makeOffscreenContext(gl_context);
  } catch (const DeviceError& error) {
    return error.what();
  }
  return {};
}

/// Tests that run on each of offscreenContextNames(), and are skipped where the machine lacks one.
class OnEveryContext : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string why = whyMissing(GetParam()); !why.empty()) GTEST_SKIP() << why;
  }
};

}  // namespace sweep_guard

#define INSTANTIATE_ON_EVERY_CONTEXT(suite)                                             \
  INSTANTIATE_TEST_SUITE_P(Contexts, suite, testing::ValuesIn(offscreenContextNames()), \
                           [](const auto& test) { return test.param; })
