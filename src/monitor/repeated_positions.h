#pragma once

#include <Eigen/Geometry>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace sweep_guard_core {

/// Counts the states of a tool that are where the one before was, bit for bit: those of a tool that is sent more often
/// than it is measured, and all of one that rests without noise. add() in one thread at a time.
class RepeatedPositions {
 public:
  struct Counts {
    std::uint64_t states = 0;    ///< with one before
    std::uint64_t repeated = 0;  ///< of these
  };

  /// @param joints  [rad] or [m], of a tool that has some
  void add(const Eigen::Isometry3d& X_WT, const std::vector<double>& joints);

  Counts counts() const { return {states_, repeated_}; }  ///< any thread

 private:
  std::optional<Eigen::Matrix4d> X_WT_;  // of the state before, as the next one
  std::vector<double> joints_;
  std::atomic<std::uint64_t> states_ = 0;
  std::atomic<std::uint64_t> repeated_ = 0;
};

/// Returns which share [%] of the states between two counts was repeated; empty: there was none.
std::optional<double> repeatedPercent(const RepeatedPositions::Counts& before, const RepeatedPositions::Counts& after);

}  // namespace sweep_guard_core
