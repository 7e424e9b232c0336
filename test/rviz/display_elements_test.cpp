#include <sweep_guard/Warning.h>

#include <utility>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::View;

const char* const kElements[] = {"Workpiece", "Touched", "Reflex", "Considered", "Measured sweep", "Predicted sweeps",
                                 "Tool",      "Ghosts",  "Path",   "Contacts",   "Normals",        "Depths"};

sweep_guard::TestedVolume boxAt(double x) {
  sweep_guard::TestedVolume box;
  box.pose.position.x = x;
  box.pose.orientation.w = 1.0;
  box.half_extents.x = box.half_extents.y = box.half_extents.z = 0.05;
  return box;
}

/// Returns a view with every element, near the origin.
View everything() {
  View view = viewOf(sweep_guard::Warning::CONTACT);
  view.pose.position.z = 0.0;
  for (int i = 1; i <= 4; ++i) {
    view.path.push_back(view.pose);
    view.path.back().position.x = -0.1 * i;
  }
  sweep_guard::ObjectView& object = view.objects[0];
  object.measured = {boxAt(0.0)};
  object.predicted = {boxAt(0.1)};
  sweep_guard::TriangleContact& contact = object.impacts.emplace_back();
  contact.normal.z = 1.0;
  contact.depth = 0.1;
  return view;
}

class ElementTest : public SweepDisplayTest {
 protected:
  void SetUp() override {
    SweepDisplayTest::SetUp();
    Rviz::only().setDistance(1.0F);
    display_->subProp("Contacts")->subProp("Point Size")->setValue(0.03F);
    display_->subProp("Normals")->subProp("Length")->setValue(0.1F);
    place(square(0.0));
  }

  /// Shows one element alone, opaque and magenta.
  void showOnly(const char* name) {
    for (const char* const element : kElements) display_->subProp(element)->setValue(QString(element) == name);
    display_->subProp(name)->subProp("Color")->setValue(QColor(255, 0, 255));
    display_->subProp(name)->subProp("Alpha")->setValue(1.0F);
  }
  double magenta() { return shareOf(Rviz::only().picture(), isMagenta); }
};

class EveryElementTest : public ElementTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(EveryElementTest, HasAColorAnAlphaAndASwitch) {
  showOnly(GetParam());
  show(everything());
  await("its color", [this] { return magenta() > 1e-4; });
  rviz::Property* const element = display_->subProp(GetParam());
  element->subProp("Alpha")->setValue(0.0F);
  await("that it is transparent", [this] { return magenta() == 0.0; });
  element->subProp("Alpha")->setValue(1.0F);
  await("that it is opaque", [this] { return magenta() > 1e-4; });
  element->setValue(false);
  await("that it goes", [this] { return magenta() == 0.0; });
}

INSTANTIATE_TEST_SUITE_P(Elements, EveryElementTest, ::testing::ValuesIn(kElements),
                         [](const auto& element) { return QString(element.param).remove(' ').toStdString(); });

TEST_F(ElementTest, KeepsBoxesOfEarlierSweepsWhileHistoryIsOn) {
  showOnly("Measured sweep");
  rviz::Property* const history = display_->subProp("Measured sweep")->subProp("History");
  history->setValue(10);
  View view = everything();
  const auto showAt = [&](double x) {
    view.objects[0].measured = {boxAt(x)};
    show(view);
  };
  showAt(-0.2);
  await("one", [this] { return magenta() > 1e-3; });
  const double one = magenta();
  showAt(0.2);
  await("two", [&] { return magenta() > 1.5 * one; });
  history->setValue(0);
  await("the newest alone", [&] { return magenta() < 1.5 * one; });
  view.objects.clear();
  show(view);
  await("none", [this] { return magenta() == 0.0; });
}

TEST_F(ElementTest, DropsBoxesOfAWorkpieceThatTheViewOmits) {
  showOnly("Measured sweep");
  display_->subProp("Measured sweep")->subProp("History")->setValue(10);
  View view = everything();
  show(view);
  await("a box", [this] { return magenta() > 1e-3; });
  view.objects.clear();
  show(view);
  await("that it goes", [this] { return magenta() == 0.0; });
}

class SizeTest : public ElementTest, public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(SizeTest, FollowsItsProperty) {
  const auto& [element, size] = GetParam();
  showOnly(element);
  show(everything());
  await("it", [this] { return magenta() > 1e-4; });
  const double share = magenta();
  display_->subProp(element)->subProp(size)->setValue(0.2F);
  await("more of it", [&] { return magenta() > 1.5 * share; });
}

INSTANTIATE_TEST_SUITE_P(Contacts, SizeTest,
                         ::testing::Values(std::pair("Contacts", "Point Size"), std::pair("Normals", "Length")));

TEST_F(ElementTest, DrawsEdgesOfSmallSurfacesOnly) {
  const auto dim = [](const QColor& c) { return isMagenta(c) && c.red() < 225; };
  showOnly("Workpiece");
  rviz::Property* const most = display_->subProp("Workpiece")->subProp("Edges Up To");
  most->setValue(static_cast<int>(kTriangles));
  await("edges", [&] { return shareOf(Rviz::only().picture(), dim) > 1e-3; });
  most->setValue(static_cast<int>(kTriangles) - 1);
  await("none", [&] { return shareOf(Rviz::only().picture(), dim) < 1e-4; });
}

}  // namespace
}  // namespace sweep_guard_rviz
