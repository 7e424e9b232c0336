#include "geometry/qhull.h"

#include <libqhull_r/libqhull_r.h>

#include <cstdio>
#include <memory>
#include <new>
#include <string>
#include <utility>

#include "sweep_guard/common/error.h"

namespace sweep_guard_core {
namespace {

// Runs Qhull. Not libqhullcpp: on flat points it crashes where another plugin of the process has loaded libqhull_r
// before.
class Qhull {
 public:
  Qhull() : messages_(std::fopen("/dev/null", "w"), &std::fclose) {
    if (!messages_) throw DeviceError("cannot open /dev/null for the messages of Qhull");
    qh_zero(&qh_, messages_.get());
  }
  ~Qhull() {
    int long_blocks = 0;
    int long_bytes = 0;
    qh_freeqhull(&qh_, !qh_ALL);
    qh_memfreeshort(&qh_, &long_blocks, &long_bytes);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;

  // Returns no facets if the points span fewer dimensions or Qhull fails. Of a Delaunay triangulation it returns the
  // facets that look down: those are its cells.
  std::optional<std::vector<Facet>> facets(Eigen::MatrixXd points, std::string command) {
    const int error = qh_new_qhull(&qh_, static_cast<int>(points.rows()), static_cast<int>(points.cols()),
                                   points.data(), False, command.data(), nullptr, messages_.get());
    if (error == qh_ERRmem) throw std::bad_alloc();
    if (error != qh_ERRnone) return std::nullopt;
    std::vector<Facet> facets;
    for (const facetT* facet = qh_.facet_list; facet && facet->next; facet = facet->next) {
      if (facet->upperdelaunay) continue;
      facets.push_back(cornersOf(*facet));
      if (facets.back().size() != static_cast<size_t>(qh_.hull_dim)) return std::nullopt;
    }
    return facets;
  }

 private:
  Facet cornersOf(const facetT& facet) {
    Facet corners;
    vertexT* vertex = nullptr;
    vertexT** vertexp = nullptr;
    FOREACHvertex_(facet.vertices) corners.push_back(static_cast<std::uint32_t>(qh_pointid(&qh_, vertex->point)));
    if (facet.toporient != qh_ORIENTclock) std::swap(corners[0], corners[1]);
    return corners;
  }

  std::unique_ptr<FILE, int (*)(FILE*)> messages_;
  qhT qh_ = {};
};

}  // namespace

std::optional<std::vector<Facet>> hullFacets(const Eigen::MatrixXd& points) {
  return Qhull().facets(points, "qhull Qt");
}

std::vector<std::array<std::uint32_t, 4>> delaunayTetrahedra(const Eigen::Matrix3Xd& points) {
  if (points.cols() < 4) return {};
  const std::optional<std::vector<Facet>> facets = Qhull().facets(points, "qhull d Qbb Qt");
  std::vector<std::array<std::uint32_t, 4>> tetrahedra;
  for (const Facet& facet : facets.value_or(std::vector<Facet>())) {
    tetrahedra.push_back({facet[0], facet[1], facet[2], facet[3]});
  }
  return tetrahedra;
}

}  // namespace sweep_guard_core
