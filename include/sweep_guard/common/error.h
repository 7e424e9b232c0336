#pragma once

#include <stdexcept>

namespace sweep_guard_core {

/// Root of everything the core throws. Its message says what is wrong and what to do.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The input can never work: a mesh without triangles, a negative radius, a file that does not parse.
struct InvalidInput : Error {
  using Error::Error;
};

/// The machine failed: no off-screen context, a canary that did not answer.
struct DeviceError : Error {
  using Error::Error;
};

}  // namespace sweep_guard_core
