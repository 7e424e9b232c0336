#include "rviz/traffic_light.h"

#include <QFontMetricsF>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "rviz/palette.h"

namespace sweep_guard_rviz {
namespace {

constexpr double kHeight = 170.0;  // everything is drawn for this height and then scaled
constexpr double kNarrowest = 300.0;

bool isDark(const PanelState& state) { return state.level == WarningLevel::kClear || state.acknowledged; }

// In contact, ground and ink are swapped twice a second.
QColor groundOf(const PanelState& state) {
  if (isDark(state)) return backdrop();
  return state.bright ? colorOf(state.level) : inkOn(state.level);
}

QColor inkOf(const PanelState& state) {
  if (isDark(state)) return {225, 228, 232};
  return state.bright ? inkOn(state.level) : colorOf(state.level);
}

QPainterPath polygon(const QPointF& center, double radius, int corners, double first_angle) {
  QPolygonF points;
  for (int i = 0; i < corners; ++i) {
    const double angle = first_angle + 2.0 * M_PI * i / corners;
    points << center + radius * QPointF(std::cos(angle), std::sin(angle));
  }
  QPainterPath path;
  path.addPolygon(points);
  path.closeSubpath();
  return path;
}

QPainterPath disc(const QPointF& center, double radius) {
  QPainterPath path;
  path.addEllipse(center, radius, radius);
  return path;
}

QPainterPath lampShape(WarningLevel level, const QPointF& c) {
  switch (level) {
    case WarningLevel::kClear:
      return disc(c, 15.0);
    case WarningLevel::kConsidered:
      return polygon(c + QPointF(0.0, 5.0), 27.0, 3, -M_PI / 2);
    case WarningLevel::kReflex:
      return polygon(c, 25.0, 8, M_PI / 8);
    case WarningLevel::kContact:
      return polygon(c, 30.0, 4, M_PI / 4);
    case WarningLevel::kUnknown:
      break;
  }
  return {};
}

QPainterPath lampMark(WarningLevel level, const QPointF& c) {
  QPainterPath path;
  const auto line = [&](double x1, double y1, double x2, double y2) {
    path.moveTo(c + QPointF(x1, y1));
    path.lineTo(c + QPointF(x2, y2));
  };
  if (level == WarningLevel::kClear) {
    line(-6.0, 0.5, -1.5, 5.5);
    path.lineTo(c + QPointF(7.0, -5.0));
  } else if (level == WarningLevel::kConsidered) {
    line(0.0, -7.0, 0.0, 6.0);
    line(0.0, 13.0, 0.0, 13.2);
  } else if (level == WarningLevel::kReflex) {
    line(-12.0, 0.0, 12.0, 0.0);
  } else if (level == WarningLevel::kContact) {
    line(-10.0, -10.0, 10.0, 10.0);
    line(-10.0, 10.0, 10.0, -10.0);
  }
  return path;
}

QPointF lampPlace(WarningLevel level) {
  const double row = level == WarningLevel::kClear ? 2.0 : level == WarningLevel::kConsidered ? 1.0 : 0.0;
  return {44.0, 33.0 + 52.0 * row};
}

// Writes as large as fits, up to `size`.
void write(QPainter& painter, const QRectF& place, const QString& text, double size, bool bold) {
  QFont font = painter.font();
  font.setBold(bold);
  const auto fits = [&](double pixels) {
    font.setPixelSize(std::max(1, static_cast<int>(pixels)));
    return QFontMetricsF(font).horizontalAdvance(text) <= place.width();
  };
  while (size > 9.0 && !fits(size)) size -= 1.0;
  fits(size);
  painter.setFont(font);
  painter.drawText(place, Qt::AlignLeft | Qt::AlignVCenter, text);
}

void drawHousing(QPainter& painter, const PanelState& state) {
  painter.setPen(Qt::NoPen);
  painter.setBrush(backdrop());
  painter.drawRoundedRect(QRectF(9.0, 4.0, 70.0, 162.0), 16.0, 16.0);
  if (state.level == WarningLevel::kUnknown) {
    painter.setPen(colorOf(state.level));
    write(painter, QRectF(16.0, 20.0, 60.0, 130.0), "?", 96.0, /*bold=*/true);
    return;
  }
  painter.setBrush(unlit());
  for (const WarningLevel level : {WarningLevel::kReflex, WarningLevel::kConsidered, WarningLevel::kClear}) {
    if (level != state.level) painter.drawPath(disc(lampPlace(level), level == WarningLevel::kClear ? 15.0 : 22.0));
  }
  const QPointF place = lampPlace(state.level);
  painter.fillPath(lampShape(state.level, place), colorOf(state.level));
  painter.strokePath(
      lampMark(state.level, place),
      QPen(inkOn(state.level), state.level == WarningLevel::kClear ? 3.5 : 6.0, Qt::SolidLine, Qt::RoundCap));
}

}  // namespace

TrafficLight::TrafficLight(QWidget* parent) : QWidget(parent) {
  setAttribute(Qt::WA_OpaquePaintEvent);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

void TrafficLight::show(const PanelState& state) {
  if (state == state_) return;
  state_ = state;
  update();
}

void TrafficLight::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.fillRect(rect(), groundOf(state_));
  painter.setRenderHint(QPainter::Antialiasing);
  const double scale = std::min(height() / kHeight, width() / kNarrowest);
  painter.translate(0.0, 0.5 * (height() - scale * kHeight));
  painter.scale(scale, scale);
  drawHousing(painter, state_);

  const double width_left = width() / scale - 94.0 - 8.0;
  painter.setPen(inkOf(state_));
  write(painter, {94.0, 8.0, width_left, 40.0}, QString::fromStdString(state_.title), 34.0, /*bold=*/true);
  write(painter, {94.0, 50.0, width_left, 80.0}, QString::fromStdString(state_.time), 72.0, /*bold=*/true);
  write(painter, {94.0, 134.0, width_left, 26.0}, QString::fromStdString(state_.meaning), 17.0, /*bold=*/false);
}

}  // namespace sweep_guard_rviz
