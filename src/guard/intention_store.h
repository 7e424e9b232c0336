#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/guard/intention.h"

namespace sweep_guard_core {

/// Asks that links of the tool may touch a region of a workpiece.
struct IntentionRequest {
  std::string mesh_id;
  std::vector<std::uint32_t> triangles = {};  ///< in any order
  /// Radius of a ball, whose triangles are added: those that lie wholly inside [m], > 0. Empty: there is no ball.
  std::optional<double> radius = {};
  Eigen::Vector3d center_M = Eigen::Vector3d::Zero();  ///< of the ball [m]
  double depth = 0.0;                                  ///< as Intention::depth
  std::vector<std::string> tool_links = {};            ///< empty: all
  Duration duration{};                                 ///< 0: until taken back

  bool takesBack() const { return triangles.empty() && !radius; }  ///< what is intended with this mesh ends
};

/// Keeps where contact is meant. Any thread.
class IntentionStore {
 public:
  /// Adds what is asked for, in this order; all or nothing. A region is added to an intention that is equal but for its
  /// triangles, unless they end by themselves.
  /// @throws InvalidInput with what is wrong about the first request that is refused: unknown workpiece or triangle, no
  ///     triangle in the ball, a depth, radius or duration out of range, or too many
  void set(const std::vector<IntentionRequest>& requests, SteadyTime now);

  /// Takes the newest snapshots of all workpieces, ascending by id. What is intended with a workpiece ends when it is
  /// removed, and when it has other triangles.
  void follow(const Workpieces& newest);

  void clear();  ///< nothing is intended any more

  /// Returns what is intended now; not null. The same object until that changes, or set() is called.
  std::shared_ptr<const Intentions> at(SteadyTime now);

 private:
  Workpieces newest() const;
  void apply(Intention region, Intentions& all) const REQUIRES(mutex_);
  void replace(Intentions all) REQUIRES(mutex_);
  void endBefore(SteadyTime now) REQUIRES(mutex_);

  mutable Mutex mutex_;
  Workpieces newest_ GUARDED_BY(mutex_);
  std::shared_ptr<const Intentions> intentions_ GUARDED_BY(mutex_) = std::make_shared<const Intentions>();
};

}  // namespace sweep_guard_core
