#include "ros/allowed_allocations.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sweep_guard_ros {
namespace {

bool matches(const AllowedAllocation& allowed, const std::string& stack) {
  const size_t place = stack.find(allowed.frame);
  return place != std::string::npos && (!allowed.innermost || place < stack.find(" < "));
}

}  // namespace

void expectAllocations(const sweep_guard_core::AllocationsOfAllThreads& made, const std::set<std::string>& threads,
                       const std::vector<AllowedAllocation>& allowed, double cycles, double growth) {
  std::vector<double> of_allowed(allowed.size());
  std::vector<std::string> stacks(allowed.size());
  double of_others = 0.0;
  std::string others;
  for (const auto& [thread, stack, count] : made.places()) {
    if (threads.count(thread) == 0) continue;
    const auto found = std::find_if(allowed.begin(), allowed.end(),
                                    [place = stack](const AllowedAllocation& one) { return matches(one, place); });
    const double per_cycle = static_cast<double>(count) / cycles;
    const std::string line = std::to_string(per_cycle) + " " + stack + "\n";
    if (found != allowed.end()) {
      const auto i = static_cast<size_t>(found - allowed.begin());
      of_allowed[i] += per_cycle;
      stacks[i] += line;
    } else {
      of_others += per_cycle;
      others += thread + " " + line;
    }
  }
  EXPECT_LE(of_others, growth) << others;
  for (size_t i = 0; i < allowed.size(); ++i) {
    EXPECT_GT(of_allowed[i], 0.0) << allowed[i].frame << " need not be listed";
    EXPECT_LE(of_allowed[i], allowed[i].most) << allowed[i].frame << "\n" << stacks[i];
    testing::Test::RecordProperty(allowed[i].frame, std::to_string(of_allowed[i]));
  }
}

}  // namespace sweep_guard_ros
