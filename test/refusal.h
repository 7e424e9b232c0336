#pragma once

#include <gtest/gtest.h>

#include <string>

#include "sweep_guard/common/error.h"

inline testing::AssertionResult has(const std::string& text, const std::string& part) {
  return (text.find(part) != std::string::npos ? testing::AssertionSuccess() : testing::AssertionFailure())
         << "'" << part << "' in: " << text;
}

/// Returns the message of the exception that `work` throws; empty if it throws none.
template <typename Refused = sweep_guard_core::InvalidInput, typename Work>
std::string refusal(Work work) {
  try {
    work();
  } catch (const Refused& error) {
    return error.what();
  }
  return "";
}
