#pragma once

#include <rviz/panel.h>

#include <QTimer>
#include <optional>
#include <string>

#include "rviz/level_history.h"
#include "rviz/service_call.h"
#include "rviz/warning_feed.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace sweep_guard_rviz {

class StripChart;
class TrafficLight;

/// Shows the warnings of one guard to its operator, and switches it off and on. Saved with rviz's configuration: the
/// topic, from which the names of the services follow.
class WarningPanel : public rviz::Panel {
 public:
  /// How often it looks at the clock: with kSilence, what a dead guard takes to turn it grey.
  static constexpr auto kPeriod = std::chrono::milliseconds(25);

  explicit WarningPanel(QWidget* parent = nullptr);
  ~WarningPanel() override;

  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

  /// Shows what there is to show at a time. Its timer calls this every kPeriod.
  void look(const Moment& now);

  const PanelState& state() const { return state_; }  ///< what is shown
  const LevelHistory& history() const { return history_; }

 private:
  void layOut();
  void setTopic(const std::string& topic);
  void remember(const std::vector<ReceivedWarning>& warnings, SteadyTime now);
  void showState(SteadyTime now);
  std::string announced(const std::string& service);
  void tell(const std::string& outcome);

  std::string topic_;
  std::string guard_;  // namespace of its services; empty: none that could be called
  WarningFeed feed_;
  ServiceCall call_;
  std::optional<ReceivedWarning> newest_;
  LevelHistory history_;
  PanelState state_;
  unsigned looks_ = 0;

  TrafficLight* light_;
  QLabel* target_;
  QLabel* whys_;
  StripChart* chart_;
  QPushButton* enable_;
  QPushButton* reset_;
  QLabel* outcome_;
  QLineEdit* topic_edit_;
  QTimer timer_;
};

}  // namespace sweep_guard_rviz
