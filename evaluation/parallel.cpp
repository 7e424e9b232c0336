#include "evaluation/parallel.h"

#include <algorithm>
#include <atomic>
#include <future>
#include <thread>
#include <vector>

namespace sweep_guard_evaluation {

size_t coreCount() { return std::max(1U, std::thread::hardware_concurrency()); }

void inParallel(size_t count, const std::function<void(size_t)>& task) {
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < count; i = next++) task(i);
  };
  std::vector<std::future<void>> workers;
  for (size_t core = 0; core < coreCount(); ++core) {
    workers.push_back(std::async(std::launch::async, work));
  }
  for (const std::future<void>& worker : workers) worker.wait();
  for (std::future<void>& worker : workers) worker.get();
}

}  // namespace sweep_guard_evaluation
