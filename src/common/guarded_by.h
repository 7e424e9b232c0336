#pragma once

#include "sweep_guard/common/mutex.h"

// The annotations of mutex.h by their usual names, for files that are not installed: there they might be a user's own.
#define GUARDED_BY(x) SWEEP_GUARD_GUARDED_BY(x)
#define REQUIRES(...) SWEEP_GUARD_REQUIRES(__VA_ARGS__)
