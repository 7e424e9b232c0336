#include "allocations.h"

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <new>

namespace sweep_guard_core {
namespace {

constexpr size_t kMaxStacks = 1000;
constexpr int kMaxDepth = 24;

struct Stack {
  std::array<void*, kMaxDepth> frames;
  int depth;
};

thread_local bool counting = false;
thread_local size_t left_until_failure = 0;  // 0: none fails
size_t counted = 0;
size_t largest_size = 0;
std::array<Stack, kMaxStacks> recorded;

void record(size_t size) {
  if (!counting) return;
  largest_size = std::max(largest_size, size);
  counting = false;  // backtrace() may allocate
  if (counted < kMaxStacks) recorded[counted].depth = backtrace(recorded[counted].frames.data(), kMaxDepth);
  ++counted;
  counting = true;
}

void* allocate(size_t size, size_t alignment) {
  record(size);
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

std::string textOf(const Stack& stack) {
  std::string text;
  for (int i = 3; i < stack.depth; ++i) {
    const std::string name = nameOf(stack.frames[static_cast<size_t>(i)]);
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
  for (size_t i = 0; i < std::min(counted, kMaxStacks); ++i) ++times[textOf(recorded[i])];
  std::string text;
  for (const auto& [stack, count] : times) text += std::to_string(count) + "  " + stack + "\n";
  return text;
}

}  // namespace sweep_guard_core

#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // inlined, new and delete are aligned_alloc and free

void* operator new(size_t size) { return sweep_guard_core::allocate(size, alignof(std::max_align_t)); }
void* operator new(size_t size, std::align_val_t alignment) {
  return sweep_guard_core::allocate(size, static_cast<size_t>(alignment));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*size*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*size*/, std::align_val_t /*alignment*/) noexcept { std::free(memory); }
