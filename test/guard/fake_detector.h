#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "detection/reference_detector.h"
#include "sweep_guard/common/error.h"
#include "sweep_guard/detection/detector.h"

namespace sweep_guard_core {

/// The reference detector, with a record of what it was asked, and failing on demand.
class FakeDetector : public Detector {
 public:
  struct Record {
    std::vector<SweptVolume> volumes;
    int failures_left = 0;
    double inflation = 0.0;               ///< claimed on top of the reference's
    double grown = 0.0;                   ///< the volume is tested as if it were larger [m]
    std::uint32_t drop_every = 0;         ///< leaves out the triangles whose number this divides; 0: none
    std::function<void()> asked = [] {};  ///< called in each query
  };

  explicit FakeDetector(Record& record) : record_(record) {}

 private:
  void find(const Submesh& part, const SweptVolume& swept_M, Detection& detection) override {
    if (record_.failures_left > 0) {
      --record_.failures_left;
      throw DeviceError("fake detector: fails on demand");
    }
    record_.asked();
    record_.volumes.push_back(swept_M);
    detection = reference_.detect(part, swept_M.grown(record_.grown));
    if (record_.drop_every != 0) {
      auto& found = detection.triangles;
      const auto dropped = [&](std::uint32_t triangle) { return triangle % record_.drop_every == 0; };
      found.erase(std::remove_if(found.begin(), found.end(), dropped), found.end());
    }
    detection.inflation += record_.inflation;
  }

  Record& record_;
  ReferenceDetector reference_;
};

}  // namespace sweep_guard_core
