#include "simulation/warning_leads.h"

#include <gtest/gtest.h>

namespace sweep_guard_simulation {
namespace {

using namespace std::chrono_literals;
using sweep_guard_core::Duration;
using sweep_guard_core::Time;
using sweep_guard_core::WarningLevel;

std::vector<WarningLeads::Contact> contactsOf(std::initializer_list<std::pair<Time, WarningLevel>> levels) {
  WarningLeads leads;
  for (const auto& [at, level] : levels) leads.add(at, level);
  return leads.contacts();
}

void expectLeads(const WarningLeads::Contact& contact, Duration considered, Duration reflex) {
  EXPECT_EQ(contact.considered, considered);
  EXPECT_EQ(contact.reflex, reflex);
}

TEST(WarningLeadsTest, CountFromWhenTheWarningRose) {
  const auto contacts = contactsOf({{Time(1s), WarningLevel::kClear},
                                    {Time(2s), WarningLevel::kConsidered},
                                    {Time(2100ms), WarningLevel::kConsidered},
                                    {Time(2900ms), WarningLevel::kReflex},
                                    {Time(3s), WarningLevel::kContact},
                                    {Time(3100ms), WarningLevel::kContact}});
  ASSERT_EQ(contacts.size(), 1U);
  expectLeads(contacts[0], 1s, 100ms);
}

TEST(WarningLeadsTest, AreZeroWhereNothingWarned) {
  const auto contacts = contactsOf(
      {{Time(1s), WarningLevel::kConsidered}, {Time(2s), WarningLevel::kUnknown}, {Time(3s), WarningLevel::kContact}});
  expectLeads(contacts.at(0), 0s, 0s);
}

TEST(WarningLeadsTest, AWarningThatWasWithdrawnDoesNotCount) {
  const auto contacts = contactsOf(
      {{Time(1s), WarningLevel::kReflex}, {Time(2s), WarningLevel::kConsidered}, {Time(3s), WarningLevel::kContact}});
  expectLeads(contacts.at(0), 2s, 0s);
}

TEST(WarningLeadsTest, EachContactHasItsOwn) {
  const auto contacts = contactsOf(
      {{Time(1s), WarningLevel::kContact}, {Time(2s), WarningLevel::kReflex}, {Time(3s), WarningLevel::kContact}});
  ASSERT_EQ(contacts.size(), 2U);
  expectLeads(contacts[1], 1s, 1s);
}

}  // namespace
}  // namespace sweep_guard_simulation
