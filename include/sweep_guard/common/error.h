#pragma once

#include <stdexcept>

namespace sweep_guard_core {

/// The base of all errors that the core throws by itself; std::bad_alloc passes through, except where a SweepFailure
/// reports it. The message says what is wrong and, where the caller can help, what to do.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reports an input that is refused: a mesh without triangles, a negative radius, a file that does not parse.
struct InvalidInput : Error {
  using Error::Error;
};

/// Reports a failure of the machine: no off-screen context, an answer of OpenGL that cannot be trusted, a detector
/// that fails its self-test, or a file, program or limit of the system that cannot be opened, run or set.
struct DeviceError : Error {
  using Error::Error;
};

}  // namespace sweep_guard_core
