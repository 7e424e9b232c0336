#pragma once

#include <QCoreApplication>
#include <chrono>
#include <stdexcept>
#include <string>

namespace sweep_guard_rviz {

/// Processes Qt events until a condition holds. @throws std::runtime_error after 20 s
template <typename Condition>
void await(const std::string& what, Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("waited too long for " + what);
    QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents);
  }
}

}  // namespace sweep_guard_rviz
