#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace sweep_guard_core {

/// Reuses values, with their buffers, once no other owner is left. Values are handed out as shared pointers and must
/// not change while others own them. One thread calls take() and add(); any thread may own and release values. Weak
/// pointers are not supported.
template <typename Value>
class Pool {
 public:
  /// Returns a value without other owners that fits, in its last state; null if there is none.
  template <typename Fits>
  std::shared_ptr<Value> take(const Fits& fits) {
    for (const std::shared_ptr<Value>& value : all_) {
      if (value.use_count() != 1) continue;
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

  size_t size() const { return all_.size(); }  ///< number of all values, with or without other owners

 private:
  std::vector<std::shared_ptr<Value>> all_;
};

}  // namespace sweep_guard_core
