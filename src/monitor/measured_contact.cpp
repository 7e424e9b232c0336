#include "monitor/measured_contact.h"

#include <algorithm>

#include "guard/triangle_set.h"

namespace sweep_guard_core {
namespace {

std::optional<size_t> firstPiece(const SweepResult& result) {
  const auto sooner = [](const TriangleContact& a, const TriangleContact& b) {
    return a.impact.time_of_impact < b.impact.time_of_impact;
  };
  const TriangleContact* first = nullptr;
  for (const TriangleContact& contact : result.in_contact) {
    if (!contact.intended && (first == nullptr || sooner(contact, *first))) first = &contact;
  }
  return first == nullptr ? std::nullopt : std::optional(first->piece);
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
  const auto meets = [](const SweptObject& object) { return object.result.unintendedContact(); };
  const auto met = std::find_if(report.objects.begin(), report.objects.end(), meets);
  if (met == report.objects.end()) return false;
  if (!contact) contact = WarningInputs::Contact{};
  contact->id = met->workpiece->id;
  contact->triangles = met->result.not_ruled_out;
  remove(contact->triangles, met->result.intended);
  contact->found = now;
  contact->lasting = true;
  contact->inside = met->result.inside;
  contact->tool_piece = firstPiece(met->result);
  return true;
}

void updateIntended(const SweepReport& report, std::vector<std::string>& ids) {
  ids.clear();
  for (const SweptObject& object : report.objects) {
    if (!object.result.intended.empty()) ids.push_back(object.workpiece->id);
  }
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
