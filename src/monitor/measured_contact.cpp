#include "monitor/measured_contact.h"

#include <algorithm>

#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

std::optional<size_t> firstPiece(const SweepResult& result) {
  const auto sooner = [](const TriangleContact& a, const TriangleContact& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const auto first = std::min_element(result.in_contact.begin(), result.in_contact.end(), sooner);
  return first == result.in_contact.end() ? std::nullopt : std::optional(first->piece);
}

bool notSwept(const SweepReport& report, const std::string& id) {
  const auto unplaced = [&](const auto& workpiece) { return workpiece->id == id; };
  const auto failed = [&](const SweepFailure& failure) { return failure.workpiece->id == id; };
  return std::any_of(report.unplaced.begin(), report.unplaced.end(), unplaced) ||
         std::any_of(report.failures.begin(), report.failures.end(), failed);
}

}  // namespace

bool updateContact(const SweepReport& report, SteadyTime now, std::optional<WarningInputs::Contact>& contact) {
  if (contact) contact->lasting = contact->lasting && notSwept(report, contact->id);
  const auto meets = [](const SweptObject& object) { return object.result.contact(); };
  const auto met = std::find_if(report.objects.begin(), report.objects.end(), meets);
  if (met == report.objects.end()) return false;
  if (!contact) contact.emplace();
  contact->id = met->workpiece->id;
  contact->triangles = met->result.not_ruled_out;
  contact->found = now;
  contact->lasting = true;
  contact->inside = met->result.inside;
  contact->tool_piece = firstPiece(met->result);
  return true;
}

void addToContact(const Workpiece& workpiece, const std::vector<std::uint32_t>& triangles, SteadyTime now,
                  std::optional<WarningInputs::Contact>& contact) {
  if (!contact || (contact->id != workpiece.id && !contact->lasting)) {
    contact = WarningInputs::Contact{workpiece.id, {}, now};
  }
  contact->found = now;
  if (contact->id == workpiece.id) unite(contact->triangles, triangles);
}

}  // namespace sweep_guard_core
