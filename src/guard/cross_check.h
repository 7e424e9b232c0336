#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// What a detector was asked about one volume, and its answer.
struct SampledQuery {
  std::string detector;  ///< its name
  std::shared_ptr<const Workpiece> workpiece;
  bool whole = true;              ///< all triangles were tested
  std::vector<Cluster> clusters;  ///< if not: those tested
  SweptVolume swept_M;
  Detection found;
};

/// Keeps every Nth query of a guard's detector for another thread. Holds one: the next ones are skipped until it is
/// taken. The guard's thread waits for nothing, and allocates only until the buffers have grown.
class QuerySampler {
 public:
  explicit QuerySampler(int every) : every_(every) {}  ///< 0: keeps none

  /// Sets the workpieces that the next queries are about. The guard's thread.
  void setWorkpieces(const Workpieces& workpieces) { workpieces_ = workpieces; }
  /// Counts a query, and keeps it if it is the Nth. The guard's thread.
  /// @param detector  its name
  void offer(const std::string& detector, const Submesh& submesh, const SweptVolume& swept_M, const Detection& found);

  /// Waits for a query. Another thread.
  /// @param[in,out] taken  exchanged: its buffers are used again
  /// @returns false after stop()
  bool take(SampledQuery& taken);
  bool waiting();  ///< whether take() returns at once
  void stop();     ///< ends every wait

 private:
  const int every_;
  int count_ = 0;
  Workpieces workpieces_;
  std::mutex mutex_;
  std::condition_variable changed_;
  SampledQuery kept_;  // has a workpiece while it waits
  bool stopping_ = false;
};

/// Returns a detector that asks another one, by this name, and offers each answer to a sampler, which must outlive it.
std::unique_ptr<Detector> sampled(std::unique_ptr<Detector> detector, const std::string& name, QuerySampler& sampler);

/// Triangles that detectors disagree about by more than their inflations: ascending.
struct Disagreement {
  TriangleSet missed;    ///< met, and found by the other detector only
  TriangleSet invented;  ///< not met, and found by the sampled detector only

  bool any() const { return !missed.empty() || !invented.empty(); }
};

/// Asks another detector the same. ReferenceDetector judges where they differ.
/// @throws DeviceError if the other detector fails
Disagreement crossCheck(const SampledQuery& query, Detector& other);

/// Returns the triangles that the detector was asked about: ascending.
TriangleSet testedTriangles(const SampledQuery& query);

/// Returns the name of the detector that the named one is compared with: `halfspace`, and for that `select`.
std::string otherDetector(const std::string& name);

}  // namespace sweep_guard_core
