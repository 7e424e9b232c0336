#pragma once

#include <exception>
#include <iostream>

namespace sweep_guard_core {

/// Runs a program, and prints what an exception says.
/// @param run     returns the exit status
/// @param failed  exit status after an exception
template <typename Run>
int runProgram(const char* name, const Run& run, int failed = 2) {
  try {
    return run();
  } catch (const std::exception& error) {
    std::cerr << name << ": " << error.what() << std::endl;
    return failed;
  }
}

}  // namespace sweep_guard_core
