#pragma once

#include <cstddef>

#include "sweep_guard/guard/prediction.h"
#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// Adds the report on one body of a tool to that on others at the same pose. Times of impact count from the earliest start
/// of an interval.
/// @param[in,out] body  becomes meaningless
/// @param first_piece   number of pieces of the bodies before: the body counts its own from 0
void unite(SweepReport& all, SweepReport& body, size_t first_piece);

/// Adds the prediction for one body of a tool to that for others, along paths of the same times. A sweep lasts until one of
/// any body ends; it has contact if that of any body has, and the deviations of the nearest body.
/// @param[in,out] body  becomes meaningless
/// @param first_piece   as above
void unite(Prediction& all, Prediction& body, size_t first_piece);

}  // namespace sweep_guard_core
