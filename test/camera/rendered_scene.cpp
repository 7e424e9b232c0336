#include "camera/rendered_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sweep_guard_core {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr float kEdge = 0.02F;  // difference of depths [m]
constexpr size_t kNoises = size_t{1} << 20U;

double intersection(double begin, double end) { return begin <= end && end >= 0.0 ? std::max(begin, 0.0) : kNever; }

std::pair<double, double> between(double lower, double upper, double origin, double direction) {
  const double one = (lower - origin) / direction;
  const double other = (upper - origin) / direction;
  return {std::min(one, other), std::max(one, other)};
}

// Of a t^2 + 2 b t + c <= 0, a > 0.
std::pair<double, double> roots(double a, double b, double c) {
  const double root = std::sqrt(b * b - a * c);  // NaN: none
  return std::isnan(root) ? std::pair(kNever, -kNever) : std::pair((-b - root) / a, (-b + root) / a);
}

std::vector<Eigen::Vector3d> cornersOf(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& X_WB) {
  std::vector<Eigen::Vector3d> corners_W;
  for (int i = 0; i < 8; ++i) corners_W.push_back(X_WB * box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)));
  return corners_W;
}

}  // namespace

Solid boxOf(const Eigen::Vector3d& lower_W, const Eigen::Vector3d& upper_W) {
  const auto entered = [=](const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W) {
    double begin = -kNever;
    double end = kNever;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto [from, to] = between(lower_W[axis], upper_W[axis], origin_W[axis], direction_W[axis]);
      begin = std::max(begin, from);
      end = std::min(end, to);
    }
    return intersection(begin, end);
  };
  return {entered, cornersOf({lower_W, upper_W}, Eigen::Isometry3d::Identity())};
}

Solid sphereAt(const Eigen::Vector3d& center_W, double radius) {
  const auto entered = [=](const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W) {
    const Eigen::Vector3d from = origin_W - center_W;
    const auto [begin, end] =
        roots(direction_W.squaredNorm(), direction_W.dot(from), from.squaredNorm() - radius * radius);
    return intersection(begin, end);
  };
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(radius);
  return {entered, cornersOf({-half, half}, placedAt(center_W))};
}

Solid cylinderAt(const Eigen::Isometry3d& X_WT, double radius, double length) {
  const auto entered = [=, X_TW = X_WT.inverse()](const Eigen::Vector3d& origin_W, const Eigen::Vector3d& direction_W) {
    const Eigen::Vector3d p = X_TW * origin_W;
    const Eigen::Vector3d d = X_TW.linear() * direction_W;
    const auto [begin, end] =
        roots(d.head<2>().squaredNorm(), p.head<2>().dot(d.head<2>()), p.head<2>().squaredNorm() - radius * radius);
    const auto [from, to] = between(-length, 0.0, p.z(), d.z());
    return intersection(std::max(begin, from), std::min(end, to));
  };
  return {entered, cornersOf({Eigen::Vector3d(-radius, -radius, -length), Eigen::Vector3d(radius, radius, 0.0)}, X_WT)};
}

RenderedScene::RenderedScene(const Eigen::Isometry3d& X_WC, const std::vector<Solid>& at_rest,
                             const DepthFaults& faults, std::uint64_t seed)
    : X_WC_(X_WC), faults_(faults), random_(seed), background_(size_t{kWidth} * kHeight, HUGE_VALF) {
  for (size_t i = 0; i < kNoises; ++i) {
    const double angle = random_.uniform(0.0, 2.0 * M_PI);
    const double normal = std::sqrt(-2.0 * std::log(1.0 - random_.uniform(0.0, 1.0))) * std::cos(angle);
    noise_.push_back(random_.chance(faults.missing) ? std::numeric_limits<float>::quiet_NaN()
                                                    : static_cast<float>(faults.noise * normal));
  }
  for (const Solid& solid : at_rest) draw(solid, {}, background_);
  findEdges(background_, {}, edges_at_rest_);
}

const std::vector<float>& RenderedScene::image(const std::vector<Solid>& moving) {
  image_ = background_;
  edges_ = edges_at_rest_;
  for (const Solid& solid : moving) draw(solid, windowOf(solid), image_);
  for (const Solid& solid : moving) findEdges(image_, windowOf(solid), edges_);
  for (const Edge& edge : edges_) {
    if (image_[edge.pixel] == edge.depth && random_.chance(faults_.flying))
      image_[edge.pixel] += static_cast<float>(random_.uniform(0.0, 1.0)) * (edge.beside - edge.depth);
  }
  const auto steps = static_cast<float>(1.0 / faults_.step);
  for (size_t row = 0; row < kHeight; ++row) {
    const float* const noise = &noise_[static_cast<size_t>(random_.below(kNoises - kWidth))];
    float* const depths = &image_[row * kWidth];
    for (size_t i = 0; i < kWidth; ++i)
      depths[i] = std::nearbyint((depths[i] + noise[i] * depths[i] * depths[i]) * steps) / steps;
  }
  return image_;
}

RenderedScene::Window RenderedScene::windowOf(const Solid& solid) const {
  double left = kWidth, top = kHeight, right = 0.0, bottom = 0.0;
  for (const Eigen::Vector3d& p_W : solid.around_W) {
    const Eigen::Vector3d p_C = X_WC_.inverse() * p_W;
    if (p_C.z() < 1e-3) return {};
    const double u = kCamera.fx * p_C.x() / p_C.z() + kCamera.cx;
    const double v = kCamera.fy * p_C.y() / p_C.z() + kCamera.cy;
    left = std::min(left, u - 2.0);
    right = std::max(right, u + 3.0);
    top = std::min(top, v - 2.0);
    bottom = std::max(bottom, v + 3.0);
  }
  const auto within = [](double x, std::uint32_t most) {
    return static_cast<std::uint32_t>(std::clamp(x, 0.0, static_cast<double>(most)));
  };
  return {within(left, kWidth), within(top, kHeight), within(right, kWidth), within(bottom, kHeight)};
}

void RenderedScene::draw(const Solid& solid, const Window& window, std::vector<float>& depths) const {
  for (std::uint32_t v = window.top; v < window.bottom; ++v) {
    for (std::uint32_t u = window.left; u < window.right; ++u) {
      const Eigen::Vector3d ray_C((u - kCamera.cx) / kCamera.fx, (v - kCamera.cy) / kCamera.fy, 1.0);
      float& depth = depths[size_t{v} * kWidth + u];
      depth = std::min(depth, static_cast<float>(solid.enteredAt(X_WC_.translation(), X_WC_.linear() * ray_C)));
    }
  }
}

void RenderedScene::findEdges(const std::vector<float>& depths, const Window& window, std::vector<Edge>& edges) {
  for (std::uint32_t v = window.top; v + 1 < window.bottom; ++v) {
    for (std::uint32_t u = window.left; u + 1 < window.right; ++u) {
      const size_t pixel = size_t{v} * kWidth + u;
      for (const size_t beside : {pixel + 1, pixel + kWidth}) {
        if (!(std::abs(depths[pixel] - depths[beside]) > kEdge)) continue;
        edges.push_back({pixel, depths[pixel], depths[beside]});
        edges.push_back({beside, depths[beside], depths[pixel]});
      }
    }
  }
}

}  // namespace sweep_guard_core
