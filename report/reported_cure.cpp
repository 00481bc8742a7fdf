// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/reported_cure.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/check/quantity_text.h"

namespace trueflank::io {
namespace {

using Json = nlohmann::ordered_json;

/// One blank at least stands behind it.
std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size() + 1), ' ');
  return text;
}

std::string percent_text(double share) { return std::isnan(share) ? "none" : number_text(100.0 * share, 2) + " %"; }

Json cost_json(const ReportedCure::Cost& cost) { return {{"before", cost.before}, {"after", cost.after}}; }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

}  // namespace

std::string cure_table(const ReportedCure& cure) {
  if (cure.changes.empty()) return {};
  std::string text = "  " + padded("key", 30) + padded("was", 14) + "is\n";
  for (const ReportedCure::Change& change : cure.changes)
    text += "  " + padded(change.key, 30) + padded(change.before.empty() ? "-" : change.before, 14) +
            (change.after.empty() ? "-" : change.after) + "\n";
  text += "what it costs\n";
  for (const ReportedCure::MeshCost& mesh : cure.meshes)
    text += "  contact ratio " + mesh.mesh + " " + number_text(mesh.contact_ratio.before, 3) + " -> " +
            number_text(mesh.contact_ratio.after, 3) + "\n";
  return text + "  efficiency forward " + percent_text(cure.forward.before) + " -> " +
         percent_text(cure.forward.after) + ", backward " + percent_text(cure.backward.before) + " -> " +
         percent_text(cure.backward.after) + "\n";
}

std::string cure_json_text(const ReportedCure& cure) {
  Json json = Json::object();
  json["cured"] = cure.cured;
  json["search_ended"] = cure.search_ended;
  json["changes"] = Json::array();
  for (const ReportedCure::Change& change : cure.changes)
    json["changes"].push_back({{"key", change.key},
                               {"before", text_or_null(change.before)},
                               {"after", text_or_null(change.after)}});
  json["contact_ratio"] = Json::object();
  for (const ReportedCure::MeshCost& mesh : cure.meshes)
    json["contact_ratio"][mesh.mesh] = cost_json(mesh.contact_ratio);
  json["efficiency"] = {{"forward", cost_json(cure.forward)}, {"backward", cost_json(cure.backward)}};
  json["still_failing"] = Json::array();
  for (const Finding& f : cure.still_failing)
    json["still_failing"].push_back({{"id", f.id}, {"where", f.where}, {"message", f.message}});
  json["contradiction"] = text_or_null(cure.contradiction);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trueflank::io
