// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/export/step/step_entities.h"
#include "trueflank/solid/brep/brep.h"

// Product and manufacturing information of a part that a program can read: sizes with limits, the
// datums, tolerances, each tied to the faces it is about, and the data of the gears (ISO
// 10303-242).
namespace trueflank::io {

/// Indices into Brep::faces.
using PmiFaces = std::vector<int>;

/// A diameter of one set of faces, or the distance between two sets.
struct PmiDimension {
  PmiFaces faces;
  PmiFaces other_faces;  ///< empty: a diameter
  double value_mm = 0.0;
  SizeLimits limits;
  std::string note;  ///< "H7, flat 4.5"; may be empty
};

/// Of the faces it is about.
struct PmiTolerance {
  std::string name;
  PmiFaces faces;
  ToleranceKind kind = ToleranceKind::kCircularRunout;
  double value_mm = 0.0;
  char datum = 0;  ///< 'A', 'B' or none
};

/// A number or text of a gear, by the names of report.json.
struct PmiProperty {
  enum class Unit { kNone, kMillimetre, kDegree };
  std::string name;  ///< "planet1.normal_module_mm"
  std::variant<int, double> value;
  Unit unit = Unit::kNone;
};

struct StepPmi {
  PmiFaces datum;    ///< whose axis is datum A; empty: there is none, and no tolerance
  PmiFaces datum_b;  ///< the upper face, where something refers to it
  std::vector<PmiDimension> dimensions;
  std::vector<PmiTolerance> tolerances;
  std::vector<PmiProperty> properties;
};

/// What part_dimensions asks of a part, on the faces of its solid. What has no face of its own is
/// left out: the tip circle of pointed teeth, and of teeth that a correction has displaced.
[[nodiscard]] StepPmi step_pmi(const GearTrain& train, const PartShape& part, const Brep& solid);

/// What the information is tied to: entities of the part.
struct PmiAnchor {
  StepId shape = 0;           ///< PRODUCT_DEFINITION_SHAPE
  StepId definition = 0;      ///< PRODUCT_DEFINITION
  StepId representation = 0;  ///< ADVANCED_BREP_SHAPE_REPRESENTATION
  StepId context = 0;
  StepId millimetre = 0, radian = 0;
  std::vector<StepId> faces;  ///< one a face of the solid
};

/// Writes them, as the recommended practices of the CAx Interoperability Forum have it.
void add_pmi(StepEntities& out, const StepPmi& pmi, const PmiAnchor& anchor);

}  // namespace trueflank::io
