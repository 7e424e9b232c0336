// A library to be loaded before others: replaces operator new by one that fails, waits or spins on demand of a test.
#include "faults.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <thread>

namespace sweep_guard_ros {
namespace {

/// Name of the shared memory of this process.
struct Name {
  Name() { std::snprintf(text, sizeof text, kFaultsName, getpid()); }
  char text[64];
};

Faults* sharedFaults() {
  const Name name;
  shm_unlink(name.text);  // an earlier process with the same id may have left it, with a fault
  const int file = shm_open(name.text, O_CREAT | O_EXCL | O_RDWR, 0600);
  if (file < 0 || ftruncate(file, sizeof(Faults)) != 0) std::abort();
  void* const memory = mmap(nullptr, sizeof(Faults), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (memory == MAP_FAILED) std::abort();
  return static_cast<Faults*>(memory);
}

Faults* faults = nullptr;

__attribute__((constructor)) void share() { faults = sharedFaults(); }

__attribute__((destructor)) void unlinkShared() { shm_unlink(Name().text); }

bool strikesThisThread() {
  char name[16] = {};
  prctl(PR_GET_NAME, name);
  return std::strcmp(name, faults->thread) == 0;
}

void noteTime() {
  std::int64_t none = 0;
  faults->struck.compare_exchange_strong(none, std::chrono::steady_clock::now().time_since_epoch().count());
}

void strike(Fault fault) {
  noteTime();
  if (fault == Fault::kOneFails && !faults->fault.compare_exchange_strong(fault, Fault::kNone)) return;
  if (fault == Fault::kOneFails || fault == Fault::kAllFail) throw std::bad_alloc();
  while (faults->fault == fault) {
    if (fault == Fault::kBlocks) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

}  // namespace
}  // namespace sweep_guard_ros

void* operator new(size_t size) {
  using namespace sweep_guard_ros;
  const Fault fault = faults == nullptr ? Fault::kNone : faults->fault.load();
  if (fault != Fault::kNone && strikesThisThread()) strike(fault);
  void* const memory = std::malloc(size == 0 ? 1 : size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, size_t /*size*/) noexcept { std::free(memory); }
