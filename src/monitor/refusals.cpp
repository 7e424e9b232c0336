#include "monitor/refusals.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxKept = 64;  // bounds the memory that invalid ids can take

}  // namespace

void Refusals::add(const std::string& id, const WarningInputs::Event& refusal) {
  const bool room = refused_.size() < kMaxKept || refused_.count(id) != 0;
  refused_[room ? id : refused_.rbegin()->first] = refusal;
}

void Refusals::accept(const std::string& id, SteadyTime received) {
  const auto refused = refused_.find(id);
  if (refused != refused_.end() && refused->second.found <= received) refused_.erase(refused);
}

std::string Refusals::message(const std::vector<std::string>& ids) const {
  const bool may_hide_others = refused_.size() >= kMaxKept;
  std::string message;
  for (const auto& [id, refusal] : refused_) {
    const bool asked = ids.empty() || std::find(ids.begin(), ids.end(), id) != ids.end();
    if (asked || may_hide_others) message = refusal.message;
  }
  return message;
}

}  // namespace sweep_guard_core
