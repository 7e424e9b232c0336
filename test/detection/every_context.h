#pragma once

#include <gtest/gtest.h>

#include <string>

#include "detection/offscreen_context.h"
#include "refusal.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// Why this machine has no such context; empty: it has.
inline std::string whyMissing(const std::string& gl_context) {
  return refusal<DeviceError>([&] { makeOffscreenContext(gl_context); });
}

/// Tests that run on each of offscreenContextNames(). scripts/test installs what they need.
class OnEveryContext : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string why = whyMissing(GetParam()); !why.empty()) FAIL() << why;
  }
};

}  // namespace sweep_guard_core

#define INSTANTIATE_ON_EVERY_CONTEXT(suite)                                             \
  INSTANTIATE_TEST_SUITE_P(Contexts, suite, testing::ValuesIn(offscreenContextNames()), \
                           [](const auto& test) { return test.param; })
