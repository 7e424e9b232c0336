#include "allocations.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <pthread.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <map>
#include <mutex>
#include <new>
#include <utility>
#include <vector>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxStacks = 1000;
constexpr int kMaxDepth = 24;

struct Stack {
  std::array<void*, kMaxDepth> frames;
  int depth;
  const void* caller;  // of operator new
};

thread_local bool counting = false;
thread_local size_t left_until_failure = 0;  // 0: none fails
size_t counted = 0;
size_t largest_size = 0;
std::array<Stack, kMaxStacks> recorded;

// Of all threads, if there is one:
std::atomic<std::map<std::pair<std::string, std::vector<void*>>, size_t>*> by_thread = nullptr;
std::mutex by_thread_mutex;
thread_local bool recording = false;

std::string nameOfThread() {
  std::array<char, 16> name{};
  pthread_getname_np(pthread_self(), name.data(), name.size());
  return name.data();
}

// Returns the frames from the caller of operator new on. How many are above it depends on what the compiler inlines.
template <typename Frames>
std::vector<void*> fromCaller(const Frames& frames, int depth, const void* caller) {
  const auto end = frames.begin() + depth;
  return {std::find(frames.begin(), end, caller), end};
}

void recordByThread(const void* caller) {
  if (recording) return;
  recording = true;
  const std::lock_guard lock(by_thread_mutex);
  std::array<void*, kMaxDepth> frames{};
  const int depth = backtrace(frames.data(), kMaxDepth);
  if (by_thread != nullptr) ++(*by_thread)[{nameOfThread(), fromCaller(frames, depth, caller)}];
  recording = false;
}

void record(size_t size, const void* caller) {
  if (by_thread != nullptr) recordByThread(caller);
  if (!counting) return;
  largest_size = std::max(largest_size, size);
  counting = false;  // backtrace() may allocate
  if (counted < kMaxStacks) {
    Stack& stack = recorded[counted];
    stack.depth = backtrace(stack.frames.data(), kMaxDepth);
    stack.caller = caller;
  }
  ++counted;
  counting = true;
}

void* allocate(size_t size, size_t alignment, const void* caller) {
  record(size, caller);
  if (left_until_failure > 0 && --left_until_failure == 0) throw std::bad_alloc();
  const size_t whole = (size + alignment - 1) / alignment * alignment;
  void* memory =
      alignment <= alignof(std::max_align_t) ? std::malloc(size == 0 ? 1 : size) : std::aligned_alloc(alignment, whole);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

std::string nameOf(void* address) {
  Dl_info info;
  if (dladdr(address, &info) == 0 || info.dli_sname == nullptr) return "?";
  int status = 0;
  char* readable = abi::__cxa_demangle(info.dli_sname, nullptr, nullptr, &status);
  const std::string name = status == 0 ? readable : info.dli_sname;
  std::free(readable);
  return name.substr(0, name.find('('));
}

template <typename Frames>
std::string textOf(const Frames& frames) {
  std::string text;
  for (void* const frame : frames) {
    const std::string name = nameOf(frame);
    if (name.find("testing::") != std::string::npos) break;
    if (name != "?" && name.find("std::") != 0) text += (text.empty() ? "" : " < ") + name;
  }
  return text;
}

}  // namespace

Allocations::Allocations() {
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads the library of backtrace()
  counted = 0;
  largest_size = 0;
  counting = true;
}

Allocations::~Allocations() { counting = false; }

FailingAllocation::FailingAllocation(size_t number) { left_until_failure = number; }

FailingAllocation::~FailingAllocation() { left_until_failure = 0; }

bool FailingAllocation::reached() const { return left_until_failure == 0; }

size_t Allocations::count() const { return counted; }

size_t Allocations::largest() const { return largest_size; }

std::string Allocations::stacks() const {
  counting = false;
  std::map<std::string, size_t> times;
  for (size_t i = 0; i < std::min(counted, kMaxStacks); ++i) {
    const auto& [frames, depth, caller] = recorded[i];
    ++times[textOf(fromCaller(frames, depth, caller))];
  }
  std::string text;
  for (const auto& [stack, count] : times) text += std::to_string(count) + "  " + stack + "\n";
  return text;
}

AllocationsOfAllThreads::AllocationsOfAllThreads() {
  void* frame = nullptr;
  backtrace(&frame, 1);  // loads the library of backtrace()
  by_thread = new std::map<std::pair<std::string, std::vector<void*>>, size_t>;
}

AllocationsOfAllThreads::~AllocationsOfAllThreads() {
  const std::lock_guard lock(by_thread_mutex);
  delete by_thread.exchange(nullptr);
}

std::vector<AllocationsOfAllThreads::Place> AllocationsOfAllThreads::places() const {
  recording = true;  // not what this function allocates
  std::map<std::pair<std::string, std::string>, size_t> counts;
  {
    const std::lock_guard lock(by_thread_mutex);
    for (const auto& [place, count] : *by_thread) {
      const auto& [thread, frames] = place;
      counts[{thread, textOf(frames)}] += count;
    }
  }
  std::vector<Place> places;
  places.reserve(counts.size());
  for (const auto& [place, count] : counts) places.push_back({place.first, place.second, count});
  std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) { return a.count > b.count; });
  recording = false;
  return places;
}

}  // namespace sweep_guard_core

#if __GNUC__ >= 11
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // inlined, new and delete are aligned_alloc and free
#endif

void* operator new(size_t size) {
  return sweep_guard_core::allocate(size, alignof(std::max_align_t), __builtin_return_address(0));
}
void* operator new(size_t size, std::align_val_t alignment) {
  return sweep_guard_core::allocate(size, static_cast<size_t>(alignment), __builtin_return_address(0));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*size*/, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
