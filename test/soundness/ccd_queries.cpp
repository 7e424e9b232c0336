#include "soundness/ccd_queries.h"

#include <CGAL/Gmpq.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <istream>
#include <limits>

#include "soundness/nearest_point.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

using Integer = CGAL::Gmpz;
using Rational = CGAL::Gmpq;

struct Row {
  Eigen::Vector3d p;
  bool truth;
};

[[noreturn]] void refuse(size_t line, const std::string& what) {
  throw InvalidInput("line " + std::to_string(line) + ": " + what);
}

std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',') {
      words.emplace_back();
    } else if (c != '\r' && c != ' ') {
      words.back() += c;
    }
  }
  return words;
}

Integer integer(const std::string& word, size_t line) {
  const size_t sign = word.rfind('-', 0) == 0 ? 1 : 0;
  const bool digits = word.size() > sign && std::all_of(word.begin() + static_cast<std::ptrdiff_t>(sign), word.end(),
                                                        [](char c) { return c >= '0' && c <= '9'; });
  if (!digits) refuse(line, "'" + word + "' is not an integer");
  return Integer(word, 10);
}

double quotient(const std::string& numerator, const std::string& denominator, size_t line) {
  const Integer below = integer(denominator, line);
  if (below == 0) refuse(line, "a denominator is 0");
  const Rational exact(integer(numerator, line), below);
  const double value = CGAL::to_double(exact);
  if (!std::isfinite(value) || Rational(value) != exact) {
    refuse(line, numerator + '/' + denominator + " is not exactly a double");
  }
  return value;
}

Row row(const std::string& text, size_t line) {
  const std::vector<std::string> words = columns(text);
  if (words.size() != 7) refuse(line, "has " + std::to_string(words.size()) + " columns instead of 7");
  if (words[6] != "0" && words[6] != "1") refuse(line, "the truth is '" + words[6] + "' instead of 0 or 1");
  return {{quotient(words[0], words[1], line), quotient(words[2], words[3], line), quotient(words[4], words[5], line)},
          words[6] == "1"};
}

// Computes differences and the bound of their rounding errors (Knuth's exact sum of two).
class Subtraction {
 public:
  Eigen::Vector3d subtract(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Vector3d error;
    Eigen::Vector3d difference = a - b;
    for (int i = 0; i < 3; ++i) {
      const double of_b = a[i] - difference[i];
      error[i] = (a[i] - (difference[i] + of_b)) + (of_b - b[i]);
    }
    rounding_ = std::max(rounding_, 1.01 * error.norm());
    return difference;
  }
  double rounding() const { return rounding_; }

 private:
  double rounding_ = 0.0;
};

std::array<Eigen::Vector3d, 4> relativeCorners(CcdQuery::Kind kind, const std::array<Eigen::Vector3d, 4>& p,
                                               Subtraction& subtraction) {
  if (kind == CcdQuery::Kind::kVertexFace) {
    return {subtraction.subtract(p[1], p[0]), subtraction.subtract(p[2], p[0]), subtraction.subtract(p[3], p[0]),
            Eigen::Vector3d::Zero()};
  }
  return {subtraction.subtract(p[2], p[0]), subtraction.subtract(p[3], p[0]), subtraction.subtract(p[3], p[1]),
          subtraction.subtract(p[2], p[1])};
}

}  // namespace

std::vector<CcdQuery> readCcdQueries(std::istream& stream, CcdQuery::Kind kind) {
  std::vector<CcdQuery> queries;
  std::vector<Row> rows;
  size_t line = 0;
  for (std::string text; std::getline(stream, text);) {
    ++line;
    rows.push_back(row(text, line));
    if (rows.back().truth != rows.front().truth) refuse(line, "the truth changes within a query");
    if (rows.size() < 8) continue;
    CcdQuery query{kind, {}, {}, rows.front().truth};
    for (size_t i = 0; i < 4; ++i) {
      query.start[i] = rows[i].p;
      query.end[i] = rows[i + 4].p;
    }
    queries.push_back(query);
    rows.clear();
  }
  if (!rows.empty()) refuse(line, "the last query has less than eight rows");
  return queries;
}

RelativeQuery relative(const CcdQuery& query) {
  Subtraction subtraction;
  const std::array<Eigen::Vector3d, 4> start = relativeCorners(query.kind, query.start, subtraction);
  const std::array<Eigen::Vector3d, 4> end = relativeCorners(query.kind, query.end, subtraction);
  RelativeQuery result{{{{start[0], start[1], start[2]}, {end[0], end[1], end[2]}}}, subtraction.rounding()};
  if (query.kind == CcdQuery::Kind::kEdgeEdge) {
    result.triangles.push_back({{start[0], start[2], start[3]}, {end[0], end[2], end[3]}});
  }
  return result;
}

bool hasImpact(const CcdQuery& query) {
  const ConvexShape point = ConvexShape::hull({Eigen::Vector3d::Zero()});
  const RelativeQuery seen = relative(query);
  return std::any_of(seen.triangles.begin(), seen.triangles.end(), [&](const MovingTriangle& triangle) {
    return timeOfImpact(point, {Motion{}}, triangle, seen.rounding).has_value();
  });
}

double leastDistance(const CcdQuery& query) {
  Real least = std::numeric_limits<Real>::infinity();
  Real size = 0;
  for (const MovingTriangle& triangle : relative(query).triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = (i + 1) % 3;
      size = std::max({size, static_cast<Real>((triangle.start_M[i] - triangle.start_M[next]).norm()),
                       static_cast<Real>((triangle.end_M[i] - triangle.end_M[next]).norm())});
    }
    const auto distance = [&](Real time) {
      std::array<Vector3r, 3> corners;
      for (size_t i = 0; i < 3; ++i) {
        corners[i] = (1 - time) * triangle.start_M[i].cast<Real>() + time * triangle.end_M[i].cast<Real>();
      }
      return nearestOfTriangle(corners, Vector3r::Zero()).norm();
    };
    Real best = 0;
    Real step = 0x1p-12L;
    for (Real time = 0; time <= 1; time += step) {
      if (distance(time) < distance(best)) best = time;
    }
    for (; step > 0x1p-60L; step /= 2) {
      for (const Real time : {std::max(best - step / 2, Real{0}), std::min(best + step / 2, Real{1})}) {
        if (distance(time) < distance(best)) best = time;
      }
    }
    least = std::min(least, distance(best));
  }
  return static_cast<double>(least / size);
}

void CcdTally::add(const CcdTally& more) {
  queries += more.queries;
  positives += more.positives;
  misses += more.misses;
  extras += more.extras;
  farthest_extra = std::max(farthest_extra, more.farthest_extra);
}

CcdTally checkCcdQueries(const std::string& file, std::ostream& out) {
  const bool edges = file.find("edge-edge") != std::string::npos;
  if (edges == (file.find("vertex-face") != std::string::npos)) {
    throw InvalidInput(file + ": the path contains neither edge-edge nor vertex-face, or both");
  }
  std::ifstream stream(file);
  if (!stream) throw InvalidInput(file + ": cannot read");
  std::vector<CcdQuery> queries;
  try {
    queries = readCcdQueries(stream, edges ? CcdQuery::Kind::kEdgeEdge : CcdQuery::Kind::kVertexFace);
  } catch (const InvalidInput& error) {
    throw InvalidInput(file + ": " + error.what());
  }
  CcdTally tally;
  for (const CcdQuery& query : queries) {
    const bool found = hasImpact(query);
    ++tally.queries;
    if (query.truth) ++tally.positives;
    if (found && !query.truth) {
      ++tally.extras;
      tally.farthest_extra = std::max(tally.farthest_extra, leastDistance(query));
    }
    if (found || !query.truth) continue;
    ++tally.misses;
    out << "missed: " << file << " line " << 8 * (tally.queries - 1) + 1 << '\n';
  }
  return tally;
}

}  // namespace sweep_guard_core::soundness
