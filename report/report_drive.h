// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/report/report.h"
#include "trueflank/train/axial_thrust.h"

// The drive in report.json: efficiency with every member and mesh, strength, inertia. One JSON object
// each, as text: the JSON library stays in .cpp files.
namespace trueflank::io {

[[nodiscard]] std::string efficiency_json_text(const EfficiencyResult& efficiency);
/// With ISO 6336 and plastics beside it, where the report has them.
[[nodiscard]] std::string strength_json_text(const Report& report);
/// What the tooth is made of that limits the torque; of both gears where their flanks do.
[[nodiscard]] std::string limiting_material(const StrengthResult& strength);
[[nodiscard]] std::string inertia_json_text(const ReportedInertia& inertia);

/// The forces of axial_thrust, and the same at a torque on the sun [N m]; null where that is NaN.
[[nodiscard]] std::string axial_thrust_json_text(const AxialThrust& thrust, double input_torque_nm);

}  // namespace trueflank::io
