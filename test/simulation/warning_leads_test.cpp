#include "simulation/warning_leads.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using namespace std::chrono_literals;
using sweep_guard::Level;
using sweep_guard::Time;

TEST(WarningLeadsTest, CountFromWhenTheWarningRose) {
  WarningLeads leads;
  leads.add(Time(1s), Level::kClear);
  leads.add(Time(2s), Level::kConsidered);
  leads.add(Time(2100ms), Level::kConsidered);
  leads.add(Time(2900ms), Level::kReflex);
  EXPECT_TRUE(leads.contacts().empty());
  leads.add(Time(3s), Level::kContact);
  leads.add(Time(3100ms), Level::kContact);
  ASSERT_EQ(leads.contacts().size(), 1U);
  EXPECT_EQ(leads.contacts()[0].considered, 1s);
  EXPECT_EQ(leads.contacts()[0].reflex, 100ms);
}

TEST(WarningLeadsTest, AreZeroWhereNothingWarned) {
  WarningLeads leads;
  leads.add(Time(1s), Level::kConsidered);
  leads.add(Time(2s), Level::kUnknown);
  leads.add(Time(3s), Level::kContact);
  ASSERT_EQ(leads.contacts().size(), 1U);
  EXPECT_EQ(leads.contacts()[0].considered, 0s);
  EXPECT_EQ(leads.contacts()[0].reflex, 0s);
}

TEST(WarningLeadsTest, AWarningThatWasWithdrawnDoesNotCount) {
  WarningLeads leads;
  leads.add(Time(1s), Level::kReflex);
  leads.add(Time(2s), Level::kConsidered);
  leads.add(Time(3s), Level::kContact);
  EXPECT_EQ(leads.contacts().at(0).considered, 2s);
  EXPECT_EQ(leads.contacts().at(0).reflex, 0s);
}

TEST(WarningLeadsTest, EachContactHasItsOwn) {
  WarningLeads leads;
  leads.add(Time(1s), Level::kContact);
  leads.add(Time(2s), Level::kReflex);
  leads.add(Time(3s), Level::kContact);
  ASSERT_EQ(leads.contacts().size(), 2U);
  EXPECT_EQ(leads.contacts()[1].considered, 1s);
  EXPECT_EQ(leads.contacts()[1].reflex, 1s);
}

}  // namespace
}  // namespace sweep_guard_simulation
