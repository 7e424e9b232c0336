#include <sweep_guard/Warning.h>

#include <utility>

#include "await.h"
#include "display_fixture.h"
#include "pictures.h"

namespace sweep_guard_rviz {
namespace {

using sweep_guard::View;

const char* const kParts[] = {"Workpiece", "Touched", "Reflex", "Considered", "Measured sweep", "Predicted sweeps",
                              "Tool",      "Ghosts",  "Path",   "Contacts",   "Normals",        "Depths"};

sweep_guard::TestedVolume boxAt(double x) {
  sweep_guard::TestedVolume box;
  box.pose.position.x = x;
  box.pose.orientation.w = 1.0;
  box.half_extents.x = box.half_extents.y = box.half_extents.z = 0.05;
  return box;
}

/// Everything that can be drawn, near the origin.
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

class PartTest : public SweepDisplayTest {
 protected:
  void SetUp() override {
    SweepDisplayTest::SetUp();
    Rviz::only().setDistance(1.0F);
    display_->subProp("Contacts")->subProp("Point Size")->setValue(0.03F);
    display_->subProp("Normals")->subProp("Length")->setValue(0.1F);
    place(sheet(0.0));
  }

  /// One part alone, opaque and magenta.
  void showOnly(const char* name) {
    for (const char* const part : kParts) display_->subProp(part)->setValue(QString(part) == name);
    display_->subProp(name)->subProp("Color")->setValue(QColor(255, 0, 255));
    display_->subProp(name)->subProp("Alpha")->setValue(1.0F);
  }
  double magenta() { return shareOf(Rviz::only().picture(), isMagenta); }
};

class EveryPartTest : public PartTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(EveryPartTest, IsDrawnInItsColourAndGoesWithItsAlphaAndItsSwitch) {
  showOnly(GetParam());
  show(everything());
  await("its colour", [this] { return magenta() > 1e-4; });
  rviz::Property* const part = display_->subProp(GetParam());
  part->subProp("Alpha")->setValue(0.0F);
  await("that it is transparent", [this] { return magenta() == 0.0; });
  part->subProp("Alpha")->setValue(1.0F);
  await("that it is opaque", [this] { return magenta() > 1e-4; });
  part->setValue(false);
  await("that it goes", [this] { return magenta() == 0.0; });
}

INSTANTIATE_TEST_SUITE_P(Parts, EveryPartTest, ::testing::ValuesIn(kParts),
                         [](const auto& part) { return QString(part.param).remove(' ').toStdString(); });

TEST_F(PartTest, BoxesOfEarlierSweepsStayWhileTheyAreAskedFor) {
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

TEST_F(PartTest, OfAWorkpieceThatTheGuardIsSilentAboutNoBoxStays) {
  showOnly("Measured sweep");
  display_->subProp("Measured sweep")->subProp("History")->setValue(10);
  View view = everything();
  show(view);
  await("a box", [this] { return magenta() > 1e-3; });
  view.objects.clear();
  show(view);
  await("that it goes", [this] { return magenta() == 0.0; });
}

class SizeTest : public PartTest, public ::testing::WithParamInterface<std::pair<const char*, const char*>> {};

TEST_P(SizeTest, IsThatWhichIsSet) {
  const auto& [part, size] = GetParam();
  showOnly(part);
  show(everything());
  await("it", [this] { return magenta() > 1e-4; });
  const double share = magenta();
  display_->subProp(part)->subProp(size)->setValue(0.2F);
  await("more of it", [&] { return magenta() > 1.5 * share; });
}

INSTANTIATE_TEST_SUITE_P(Contacts, SizeTest,
                         ::testing::Values(std::pair("Contacts", "Point Size"), std::pair("Normals", "Length")));

TEST_F(PartTest, EdgesAreDrawnOfSurfacesThatAreSmallEnough) {
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
