#include <exception>
#include <iostream>
#include <limits>
#include <string>

#include "soundness/camera_sessions.h"
#include "sweep_guard/common/error.h"

namespace sweep_guard_core::soundness {
namespace {

constexpr double kRate = 30.0;  // [Hz]

struct Frame {
  DepthImages camera;
  DepthImages::Image image;
};

// As depth_images.py writes it: numbers in text, then the pixels.
bool readFrame(std::istream& in, Frame& frame) {
  DepthImages& camera = frame.camera;
  double unit = 0.0;
  if (!(in >> camera.width >> camera.height >> unit)) return false;
  in >> camera.camera.fx >> camera.camera.fy >> camera.camera.cx >> camera.camera.cy;
  for (Eigen::Index i = 0; i < 12; ++i) in >> frame.image.X_FC.matrix()(i / 4, i % 4);
  in.get();
  std::vector<std::uint16_t> pixels(size_t{camera.width} * camera.height);
  in.read(reinterpret_cast<char*>(pixels.data()), static_cast<std::streamsize>(2 * pixels.size()));
  if (!in) throw InvalidInput("a frame is cut off");
  frame.image.depths.clear();
  for (const std::uint16_t pixel : pixels)
    frame.image.depths.push_back(pixel == 0 ? std::numeric_limits<float>::quiet_NaN()
                                            : static_cast<float>(unit * pixel));
  return true;
}

void check(Random& random, Frame& before, const Frame& now, int tools, const std::string& about, Report& report) {
  DepthImages images = now.camera;
  before.image.stamp = Time(std::chrono::seconds(100));
  images.images = {before.image, now.image};
  images.images[1].stamp = before.image.stamp + fromSeconds(1.0 / kRate);
  const SeenSurfaces surfaces(images);
  for (int i = 0; i < tools; ++i)
    add(checkCameraSession(random, surfaces, /*looseness=*/true), "depth_images", about, report);
}

int checkAll(int tools) {
  Report report(std::cout);
  Frame before;
  Frame now;
  bool has_before = false;
  for (std::uint64_t number = 0; readFrame(std::cin, now); ++number) {
    Random random(number);
    const bool same =
        has_before && now.camera.width == before.camera.width && now.camera.height == before.camera.height;
    if (same) check(random, before, now, tools, "frame " + std::to_string(number), report);
    std::swap(before, now);
    has_before = true;
  }
  report.summarize();
  return report.failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace sweep_guard_core::soundness

int main(int argc, char** argv) {
  if (argc != 2 || std::atoi(argv[1]) < 1) {
    std::cerr << "usage: depth_images.py FOLDER | check_depth_images TOOLS\n"
                 "Shows each two consecutive images of a folder to guards with so many random tools, as if they came "
                 "at 30 Hz.\n"
                 "Exit status: 0, 1 if a touch was missed, 2 wrong usage.\n";
    return 2;
  }
  try {
    return sweep_guard_core::soundness::checkAll(std::atoi(argv[1]));
  } catch (const std::exception& error) {
    std::cerr << "check_depth_images: " << error.what() << '\n';
    return 2;
  }
}
