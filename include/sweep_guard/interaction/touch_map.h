#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "sweep_guard/guard/sweep.h"

namespace sweep_guard_core {

/// How often and how deep the tool touched one triangle.
struct TriangleTouches {
  std::uint32_t triangle;
  /// Number of sweeps in which the tool touched the triangle; stays at the largest number of the type.
  std::uint32_t sweeps;
  float depth;  ///< largest depth at the end of such a sweep (Impact::depth) [m]; NaN: no sweep had a narrow phase
};

/// The touched triangles of one workpiece.
struct ObjectTouches {
  std::string id;
  std::uint32_t revision = 0;
  std::vector<TriangleTouches> triangles;  ///< those touched, in the order of their first touches
  TriangleSet jump_triangles = {};  ///< those touched along a jump, which counts nowhere else: ascending, each once
};

/// Counts in how many sweeps the tool touched each triangle of the workpieces, and keeps the largest depth.
///
/// A sweep touches the triangles for which the narrow phase finds an impact, also where contact is intended or allowed;
/// without narrow phase, all that it does not rule out. It counts once, however many poses it passes and bodies the
/// tool has. A sweep along a jump (`jumps` or `jump` of the report) is not counted: its triangles are kept apart.
/// Depths are those at the swept poses: a contact that begins and ends within one sweep has depth 0.
///
/// Deformations keep the counts. They restart when the triangles or the revision of a workpiece change, and when it
/// returns after it was removed. A triangle of a workpiece that was swept costs 12 bytes. Once a workpiece was swept
/// and the buffers are as large as the largest contact, nothing is allocated.
class TouchMap {
 public:
  /// @param workpieces  all that there are; not only those swept
  void add(const SweepReport& report, const Workpieces& workpieces);
  void clear();  ///< restarts all counts

  std::uint64_t changes() const { return changes_; }  ///< grows with every change of what touches() returns
  Time newest() const { return newest_; }             ///< stamp of the newest pose that touched; 0: none since clear()

  /// Returns the workpieces that were touched, ascending by id.
  /// @param[out] objects  overwritten; its buffers are used again
  void touches(std::vector<ObjectTouches>& objects) const;

 private:
  struct Touched {
    std::shared_ptr<const Workpiece> workpiece;  // as swept last
    std::vector<TriangleTouches> of_triangle;
    std::vector<std::uint32_t> triangles;  // those touched
    TriangleSet jump_triangles;            // those touched along a jump

    bool empty() const { return triangles.empty() && jump_triangles.empty(); }
  };

  void forgetRemoved(const Workpieces& workpieces);
  Touched& touchedOf(const std::shared_ptr<const Workpiece>& workpiece);
  void restart(Touched& touched);
  void findTouched(const SweepResult& result);
  void count(const SweepResult& result, Touched& touched) const;

  std::map<std::string, Touched> touched_;  // by id of the workpiece
  std::uint64_t changes_ = 0;
  Time newest_;
  TriangleSet in_sweep_;  // touched in the sweep that is added
  TriangleSet allowed_;   // the same, as allowed
};

}  // namespace sweep_guard_core
