#pragma once

#include <semaphore.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "common/guarded_by.h"
#include "sweep_guard/common/stamped_pose.h"
#include "sweep_guard/detection/detector.h"
#include "sweep_guard/guard/workpiece.h"

namespace sweep_guard_core {

/// What the queries of a sweep or of a prediction belong to.
struct QueryOrigin {
  bool measured = true;     ///< the tool has moved so; false: it is expected to
  std::uint64_t epoch = 0;  ///< of the monitor, when the pose was received
  StampedPose from =
      {};  ///< the last tool pose swept before, maybe before time jumped; if there is none, and of a prediction: `to`
  StampedPose to = {};  ///< the newest tool pose
};

/// What a detector was asked about one volume, and its answer.
struct SampledQuery {
  std::string detector;  ///< its name
  QueryOrigin origin;
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
  explicit QuerySampler(int every) : every_(every) { sem_init(&signal_, /*pshared=*/0, 0); }  ///< 0: keeps none
  ~QuerySampler() { sem_destroy(&signal_); }
  QuerySampler(const QuerySampler&) = delete;
  QuerySampler& operator=(const QuerySampler&) = delete;

  /// Sets the workpieces that the next queries are about. The guard's thread.
  void setWorkpieces(const Workpieces& workpieces, const QueryOrigin& origin = {});
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
  bool takeNow(SampledQuery& taken);
  void wake() REQUIRES(mutex_);

  const int every_;
  int count_ = 0;
  Workpieces workpieces_;
  QueryOrigin origin_;
  Mutex mutex_;
  sem_t signal_;  // for the waiting thread: notifying a condition variable may wait for that thread
  bool thread_waits_ GUARDED_BY(mutex_) = false;
  SampledQuery kept_ GUARDED_BY(mutex_);  // has a workpiece while it waits
  bool stopping_ GUARDED_BY(mutex_) = false;
};

/// Returns the detector, which offers each of its answers to a sampler from now on, under this name. The sampler must outlive it.
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

/// Names a query and up to 20 triangles of each kind in one line: tool poses, mesh, and the volume in M with all digits. With
/// the mesh out of a recording, detectors can be asked the same again.
std::string describe(const SampledQuery& query, const Disagreement& disagreement);

/// Returns the triangles that the detector was asked about: ascending.
TriangleSet testedTriangles(const SampledQuery& query);

/// Returns the name of the detector that answers a query again: `halfspace`, and for that `select`. They share code, so
/// every tenth query is for `reference`, which shares none.
/// @param number  of the query: 1, 2, ...
std::string otherDetector(const std::string& name, std::uint64_t number);

}  // namespace sweep_guard_core
