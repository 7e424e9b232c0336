#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

namespace sweep_guard_core {

/// Reuses values, with their buffers, once no other owner is left. Values are handed out as shared pointers and must
/// not change while others own them. One thread calls the functions; any thread may own and release values. Weak
/// pointers are not supported.
template <typename Value>
class Pool {
 public:
  /// Returns a value without other owners that fits, in its last state; null if there is none.
  template <typename Fits>
  std::shared_ptr<Value> take(const Fits& fits) {
    for (const std::shared_ptr<Value>& value : all_) {
      if (!isUnowned(value)) continue;
      std::shared_ptr<Value> taken = value;  // increments with acquire: pairs with the release by the last owner
      if (fits(*taken)) return taken;
    }
    return nullptr;
  }

  /// Returns a value without other owners, in its last state, or a new value.
  std::shared_ptr<Value> take() {
    if (auto used = take([](const Value& /*any*/) { return true; })) return used;
    return add(Value{});
  }

  std::shared_ptr<Value> add(Value value) {
    all_.push_back(std::make_shared<Value>(std::move(value)));
    return all_.back();
  }

  /// Forgets values without other owners that none of the last calls needed, so that a burst is not kept for good. One
  /// call after each take().
  /// @param calls  number of them, >= 1
  void forgetUnneeded(size_t calls) {
    unneeded_ = std::min(unneeded_, static_cast<size_t>(std::count_if(all_.begin(), all_.end(), isUnowned)));
    if (++calls_ < calls) return;
    const auto surplus = std::stable_partition(all_.begin(), all_.end(), [this](const std::shared_ptr<Value>& value) {
      if (unneeded_ == 0 || !isUnowned(value)) return true;
      --unneeded_;
      return false;
    });
    all_.erase(surplus, all_.end());
    unneeded_ = std::numeric_limits<size_t>::max();
    calls_ = 0;
  }

  size_t size() const { return all_.size(); }  ///< number of all values, with or without other owners

 private:
  static bool isUnowned(const std::shared_ptr<Value>& value) { return value.use_count() == 1; }

  std::vector<std::shared_ptr<Value>> all_;
  size_t calls_ = 0;                                      // of forgetUnneeded() since it last forgot values
  size_t unneeded_ = std::numeric_limits<size_t>::max();  // smallest number of unowned values at those calls
};

}  // namespace sweep_guard_core
