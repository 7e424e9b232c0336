#pragma once

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

#include "sweep_guard/detection/time_of_impact.h"

namespace sweep_guard_core::soundness {

/// Two edges, or a vertex and a face, whose four points move straight; and whether they meet. A query of the Sample
/// Queries (Wang et al. 2021), the common benchmark of continuous collision detection.
struct CcdQuery {
  enum class Kind { kEdgeEdge, kVertexFace };
  Kind kind;
  std::array<Eigen::Vector3d, 4> start;  ///< both ends of the first edge, then of the second; or vertex, then face
  std::array<Eigen::Vector3d, 4> end;
  bool truth;  ///< as computed exactly by the authors of the data
};

/// Reads a file of queries. Each has eight rows: the four points at the start, then at the end. A row contains x, y and
/// z as numerator and denominator of any length, then the truth.
/// @throws InvalidInput with the line number if a row is malformed or a number is not exactly a double
std::vector<CcdQuery> readCcdQueries(std::istream& stream, CcdQuery::Kind kind);

/// A query relative to one of its points: the tool is a point at rest, the obstacle are moving triangles.
struct RelativeQuery {
  std::vector<MovingTriangle> triangles;  ///< the query is met if one of them meets the origin
  double rounding;                        ///< error bound of the differences [m]
};

/// Makes a query relative. A vertex meets a face if the face minus the vertex contains the origin. Two edges meet if
/// the difference of two of their points is zero: at any time the differences form a parallelogram, whose corners are
/// the differences of the ends. These are two triangles whose corners move straight, so nothing is approximated.
RelativeQuery relative(const CcdQuery& query);

/// Returns whether timeOfImpact() finds an impact.
bool hasImpact(const CcdQuery& query);

/// Returns the least distance found at 4 096 times and around the best of them, in sizes of the triangles.
double leastDistance(const CcdQuery& query);

/// Counts of queries.
struct CcdTally {
  int queries = 0;
  int positives = 0;
  int misses = 0;
  int extras = 0;
  double farthest_extra = 0.0;  ///< largest leastDistance() of an extra

  void add(const CcdTally& more);
};

/// Runs the queries of a file; its path must contain edge-edge or vertex-face.
/// @param out  receives a line for each miss
/// @throws InvalidInput if the file cannot be read or its path does not contain one of these
CcdTally checkCcdQueries(const std::string& file, std::ostream& out);

}  // namespace sweep_guard_core::soundness
