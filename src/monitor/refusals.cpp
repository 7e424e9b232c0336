#include "monitor/refusals.h"

#include <algorithm>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxKept = 1024;  // bounds the memory that invalid ids can take
constexpr char kTooMany[] = " (and more than 1024 other workpieces: start the guard again)";

}  // namespace

void Refusals::add(const std::string& id, const WarningInputs::Event& refusal) {
  const bool room = refused_.size() < kMaxKept || refused_.count(id) != 0;
  if (room) refused_[id] = refusal;
  if (!room) of_others_ = refusal.message + kTooMany;
}

void Refusals::accept(const std::string& id, SteadyTime received) {
  const auto refused = refused_.find(id);
  if (refused != refused_.end() && refused->second.found <= received) refused_.erase(refused);
}

std::string Refusals::message(const std::vector<std::string>& ids) const {
  if (!of_others_.empty()) return of_others_;
  const auto asked = [&](const auto& refused) {
    return ids.empty() || std::find(ids.begin(), ids.end(), refused.first) != ids.end();
  };
  const auto last = std::find_if(refused_.rbegin(), refused_.rend(), asked);
  return last == refused_.rend() ? std::string() : last->second.message;
}

}  // namespace sweep_guard_core
