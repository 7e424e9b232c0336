#include "monitor/faults.h"

#include <algorithm>
#include <cstring>

namespace sweep_guard_core {
namespace {

constexpr auto kFailureShown = std::chrono::milliseconds(100);

constexpr size_t kMaxKept = 1024;  // bounds the memory that invalid ids can take
constexpr char kTooMany[] = " (and more than 1024 other workpieces: start the guard again)";

}  // namespace

void Faults::add(Reason reason, const std::string& message) {
  inputs_.faults[reason] = message;
  numbers_[reason] = ++count_;
}

void Faults::addFailure(Reason reason, const char* message, SteadyTime now, bool lasting) noexcept {
  auto& failure = inputs_.failure;
  lasting = lasting || (failure && failure->lasting);
  failure = WarningInputs::Failure{reason, {}, now, lasting};
  std::strncpy(failure->message.data(), message, failure->message.size() - 1);
  failure_number_ = ++count_;
}

void Faults::endBefore(std::uint64_t count, SteadyTime now) {
  for (auto fault = numbers_.begin(); fault != numbers_.end();) {
    const auto& [reason, number] = *fault;
    const bool over = number <= count;
    if (over) inputs_.faults.erase(reason);
    fault = over ? numbers_.erase(fault) : std::next(fault);
  }
  if (failure_number_ <= count) endFailure(now);
}

void Faults::endFailure(SteadyTime now) {
  const auto& failure = inputs_.failure;
  if (failure && !failure->lasting && now - failure->found >= kFailureShown) inputs_.failure.reset();
}

void Faults::restart() {
  numbers_.clear();
  inputs_.faults = lasting_;
  if (inputs_.failure && !inputs_.failure->lasting) inputs_.failure.reset();
}

void Faults::set(Reason reason, const std::string& message) {
  lasting_.erase(reason);
  inputs_.faults.erase(reason);
  if (message.empty()) return;
  lasting_[reason] = message;
  inputs_.faults[reason] = message;
}

std::string Faults::get(Reason reason) const {
  const auto found = lasting_.find(reason);
  return found == lasting_.end() ? std::string() : found->second;
}

void Refusals::add(const std::string& id, const WarningInputs::Event& refusal) {
  const bool room = refused_.size() < kMaxKept || refused_.count(id) != 0;
  if (room) refused_[id] = refusal;
  if (!room) of_others_ = refusal.message + kTooMany;
}

bool Refusals::accept(const std::string& id, SteadyTime received) {
  const auto refused = refused_.find(id);
  const bool ends = refused != refused_.end() && refused->second.found <= received;
  if (ends) refused_.erase(refused);
  return ends;
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
