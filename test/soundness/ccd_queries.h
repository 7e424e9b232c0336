#pragma once

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

#include "sweep_guard/detection/time_of_impact.h"

namespace sweep_guard_core::soundness {

/// Two edges, or a vertex and a face, whose four points go straight from one place to another; and whether they meet.
/// A query of the Sample Queries of Wang et al. 2021: everybody's test of continuous collision detection.
struct CcdQuery {
  enum class Kind { kEdgeEdge, kVertexFace };
  Kind kind;
  std::array<Eigen::Vector3d, 4> start;  ///< both ends of the first edge, then of the second; or vertex, then face
  std::array<Eigen::Vector3d, 4> end;
  bool truth;  ///< as computed exactly by the authors of the data
};

/// Reads a file of queries: eight rows each, the four points at the start and at the end; x, y, z as a numerator and a
/// denominator of any length each, then the truth.
/// @throws InvalidInput with the line of what is no such row, and if a number is not exactly a double
std::vector<CcdQuery> readCcdQueries(std::istream& stream, CcdQuery::Kind kind);

/// A query seen from one of its points: then a point at rest is left for a tool, and moving triangles.
struct PosedQuery {
  std::vector<MovingTriangle> triangles;  ///< the query is met where one of them meets the origin
  double rounding;                        ///< bound on what taking the differences cost [m]
};

/// A vertex meets a face where the face, less the vertex, holds the origin. Two edges meet where the difference of some
/// points of theirs is zero; all these differences are a parallelogram at any time, its corners the differences of the
/// ends: two triangles, whose corners go straight as well. So nothing is approximated.
PosedQuery posed(const CcdQuery& query);

/// Whether the product's fine phase says that the query is met.
bool named(const CcdQuery& query);

/// How close the query comes to being met, in sizes of its triangles: the least distance found at 4 096 times and
/// around the best of these.
double closest(const CcdQuery& query);

/// What came of some queries.
struct CcdTally {
  int queries = 0;
  int positives = 0;
  int misses = 0;
  int extras = 0;
  double farthest_extra = 0.0;  ///< how close the extra came that stayed farthest away, in its sizes

  void add(const CcdTally& more);
};

/// Runs the queries of a file; edge-edge or vertex-face is told by its name or that of its folder.
/// @param out  gets a line for each miss
/// @throws InvalidInput if the file cannot be read or does not tell its kind
CcdTally checkCcdQueries(const std::string& file, std::ostream& out);

}  // namespace sweep_guard_core::soundness
