#pragma once

#include <QDir>
#include <QImage>
#include <cstdlib>
#include <string>

namespace sweep_guard_rviz {

/// Saves a picture in the folder SWEEP_GUARD_PICTURES, if that is set.
inline void keepPicture(const QImage& image, const std::string& name) {
  const QString folder = qEnvironmentVariable("SWEEP_GUARD_PICTURES");
  if (folder.isEmpty() || !QDir().mkpath(folder)) return;
  image.save(QDir(folder).filePath(QString::fromStdString(name + ".png")));
}

/// Returns the share [-] of pixels whose color fits.
template <typename Fits>
double shareOf(const QImage& image, Fits&& fits) {
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) count += fits(image.pixelColor(x, y)) ? 1 : 0;
  }
  return static_cast<double>(count) / (image.width() * image.height());
}

inline bool isGreen(const QColor& c) { return c.green() > c.red() + 40 && c.green() > c.blue() + 40; }
inline bool isRed(const QColor& c) { return c.red() > 150 && c.green() < 90 && c.blue() < 90; }
inline bool isAmber(const QColor& c) { return c.red() > 200 && c.green() > 120 && c.green() < 210 && c.blue() < 90; }

inline bool isGray(const QColor& c) {
  return c.red() > 120 && c.red() < 160 && std::abs(c.red() - c.green()) < 6 && std::abs(c.red() - c.blue()) < 6;
}
inline bool isMagenta(const QColor& c) { return c.red() > c.green() + 50 && c.blue() > c.green() + 50; }

}  // namespace sweep_guard_rviz
