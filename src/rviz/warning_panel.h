#pragma once

#include <rviz/panel.h>

#include <QTimer>
#include <optional>
#include <string>

#include "rviz/feeds.h"
#include "rviz/service_call.h"
#include "rviz/strip_chart.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace sweep_guard_rviz {

class StripChart;
class TrafficLight;

/// Shows the warnings of one guard to its operator, in contact with the force on the tool, and acknowledges them; disables, enables
/// and resets the guard. Shows why a motion guard holds the robot back. Saves both topics in rviz's configuration; the names of the
/// services follow from that of the warnings.
class WarningPanel : public rviz::Panel {
 public:
  /// Period of refresh(). Together with kSilence it is the delay until a dead guard turns the panel gray.
  static constexpr auto kPeriod = std::chrono::milliseconds(25);

  explicit WarningPanel(QWidget* parent = nullptr);
  ~WarningPanel() override;

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

  /// Shows the state at a moment. The panel's timer calls this every kPeriod.
  void refresh(const Instant& now);

  const PanelState& state() const { return state_; }  ///< the state shown
  const LevelHistory& history() const { return history_; }

 private:
  void layOut();
  void setTopic(const std::string& topic);
  void setMotionTopic(const std::string& topic);
  void remember(const std::vector<ReceivedWarning>& warnings, SteadyTime now);
  void showState(SteadyTime now);
  void showForce();
  void showMotion();
  bool canAcknowledge() const;
  std::string announceCall(const std::string& service);
  void showOutcome(const std::string& outcome);

  std::string topic_;
  std::string heard_topic_;  // resolved
  std::string guard_;        // namespace of its services; empty: no guard
  WarningFeed feed_;
  NewestFeed<sweep_guard::Interaction> force_feed_;
  NewestFeed<sweep_guard::MotionStatus> motion_feed_;
  ServiceCall call_;
  std::optional<ReceivedWarning> newest_;
  LevelHistory history_;
  PanelState state_;
  unsigned refreshes_ = 0;

  TrafficLight* light_;
  QLabel* held_;
  QLabel* target_;
  QLabel* force_;
  QLabel* reasons_;
  StripChart* chart_;
  QPushButton* acknowledge_;
  QPushButton* enable_;
  QPushButton* reset_;
  QLabel* outcome_;
  QLineEdit* topic_edit_;
  QLineEdit* motion_edit_;
  QTimer timer_;
};

}  // namespace sweep_guard_rviz
