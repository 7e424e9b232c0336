#include "sweep_guard/guard/sweep_report.h"

#include <algorithm>

namespace sweep_guard_core {

double SweepReport::margin() const {
  double largest = 0.0;
  for (const SweptObject& object : objects) largest = std::max(largest, object.result.margin);
  return largest;
}

bool SweepReport::contact() const {
  return std::any_of(objects.begin(), objects.end(), [](const SweptObject& object) { return object.result.contact(); });
}

bool SweepReport::unintendedContact() const {
  return std::any_of(objects.begin(), objects.end(),
                     [](const SweptObject& object) { return object.result.unintendedContact(); });
}

bool SweepReport::complete() const {
  const auto current = [](const SweptObject& object) { return object.behind == Duration::zero(); };
  return !objects.empty() && unplaced.empty() && failures.empty() &&
         std::all_of(objects.begin(), objects.end(), current);
}

}  // namespace sweep_guard_core
