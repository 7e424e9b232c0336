#pragma once

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

namespace sweep_guard_core {

/// Values that are handed out shared, and do not change while anybody holds them. What nobody else holds any more is
/// used again, buffers and all. One thread takes and adds; any thread may hold and let go. No weak pointers.
template <typename Value>
class Pool {
 public:
  /// One that nobody holds, as it was left; null if there is none that fits.
  template <typename Fits>
  std::shared_ptr<Value> take(const Fits& fits) {
    for (const std::shared_ptr<Value>& one : all_) {
      if (one.use_count() != 1) continue;
      std::atomic_thread_fence(std::memory_order_acquire);  // after what the last holder did with it
      if (fits(*one)) return one;
    }
    return nullptr;
  }

  /// One that nobody holds, as it was left, or a new one.
  std::shared_ptr<Value> take() {
    if (auto used = take([](const Value& /*any*/) { return true; })) return used;
    return add(Value{});
  }

  std::shared_ptr<Value> add(Value value) {
    all_.push_back(std::make_shared<Value>(std::move(value)));
    return all_.back();
  }

  size_t size() const { return all_.size(); }  ///< those held, too

 private:
  std::vector<std::shared_ptr<Value>> all_;
};

}  // namespace sweep_guard_core
