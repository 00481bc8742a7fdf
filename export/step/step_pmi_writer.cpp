// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <string_view>

#include "trueflank/base/units.h"
#include "trueflank/export/step/step_pmi.h"

namespace trueflank::io {
namespace {

class PmiWriter {
 public:
  PmiWriter(StepEntities& out, const PmiAnchor& anchor) : out_(out), anchor_(anchor) {}

  void write(const StepPmi& pmi) {
    for (const PmiDimension& dimension : pmi.dimensions) write_dimension(dimension);
    const StepId a = pmi.datum.empty() ? 0 : write_datum('A', pmi.datum);
    const StepId b = pmi.datum_b.empty() ? 0 : write_datum('B', pmi.datum_b);
    for (const PmiTolerance& tolerance : pmi.tolerances)
      write_tolerance(tolerance, tolerance.datum == 'A' ? a : tolerance.datum == 'B' ? b : 0);
    for (const PmiProperty& property : pmi.properties) write_property(property);
  }

 private:
  void tie(StepId aspect, int face) {
    out_.begin("GEOMETRIC_ITEM_SPECIFIC_USAGE('','',");
    out_.put(aspect).put(",").put(anchor_.representation).put(",");
    out_.put(anchor_.faces[static_cast<std::size_t>(face)]).end();
  }
  void relate(StepId relating, StepId related) {
    out_.begin("SHAPE_ASPECT_RELATIONSHIP('',$,");
    out_.put(relating).put(",").put(related).end();
  }
  StepId begin_aspect(std::string_view opening, std::string_view rest) {
    const StepId aspect = out_.begin(opening);
    out_.put(anchor_.shape).put(rest).end();
    return aspect;
  }

  StepId single_aspect(int face) {
    const StepId aspect = begin_aspect("SHAPE_ASPECT('',$,", ",.T.");
    tie(aspect, face);
    return aspect;
  }
  /// One face, or a group of single ones.
  StepId aspect_of(const PmiFaces& faces) {
    if (faces.size() == 1) return single_aspect(faces.front());
    const StepId group =
        begin_aspect("COMPOSITE_GROUP_SHAPE_ASPECT('','multiple elements',", ",.T.");
    for (const int face : faces) relate(group, single_aspect(face));
    return group;
  }

  StepId length(double value_mm) {
    const StepId id = out_.begin("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(");
    out_.put(value_mm).put("),").put(anchor_.millimetre).end();
    return id;
  }
  StepId nominal(double value_mm) {
    const StepId id = out_.begin(
        "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()"
        "MEASURE_WITH_UNIT(LENGTH_MEASURE(");
    out_.put(value_mm).put("),").put(anchor_.millimetre);
    out_.put(")REPRESENTATION_ITEM('nominal value')").end();
    return id;
  }

  void write_dimension(const PmiDimension& dimension) {
    const StepId aspect = aspect_of(dimension.faces);
    const bool diameter = dimension.other_faces.empty();
    const StepId other = diameter ? 0 : aspect_of(dimension.other_faces);
    const StepId size =
        out_.begin(diameter ? "DIMENSIONAL_SIZE(" : "DIMENSIONAL_LOCATION('linear distance',$,");
    out_.put(aspect);
    if (diameter)
      out_.put(",'diameter'").end();
    else
      out_.put(",").put(other).end();
    std::vector<StepId> items{nominal(dimension.value_mm)};
    if (!dimension.note.empty()) {
      items.push_back(out_.begin("DESCRIPTIVE_REPRESENTATION_ITEM('dimensional note',"));
      out_.put_quoted(dimension.note).end();
    }
    const StepId shown = out_.begin("SHAPE_DIMENSION_REPRESENTATION('',");
    out_.put(items).put(",").put(anchor_.context).end();
    out_.begin("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(");
    out_.put(size).put(",").put(shown).end();
    if (!std::isnan(dimension.limits.upper_mm)) write_limits(dimension.limits, size);
  }

  void write_limits(const SizeLimits& limits, StepId size) {
    const StepId lower = length(limits.lower_mm), upper = length(limits.upper_mm);
    const StepId value = out_.begin("TOLERANCE_VALUE(");
    out_.put(lower).put(",").put(upper).end();
    out_.begin("PLUS_MINUS_TOLERANCE(");
    out_.put(value).put(",").put(size).end();
  }

  /// A datum and the system of this one datum.
  StepId write_datum(char letter, const PmiFaces& faces) {
    const std::string name(1, letter);
    const StepId feature = begin_aspect("DATUM_FEATURE('" + name + "',$,", ",.T.");
    for (const int face : faces) tie(feature, face);
    const StepId datum = begin_aspect("DATUM('" + name + "',$,", ",.F.,'" + name + "'");
    relate(feature, datum);
    const StepId compartment = out_.begin("DATUM_REFERENCE_COMPARTMENT('',$,");
    out_.put(anchor_.shape).put(",.F.,").put(datum).put(",$").end();
    const StepId system = out_.begin("DATUM_SYSTEM('" + name + "',$,");
    out_.put(anchor_.shape).put(",.F.,(").put(compartment).put(")").end();
    return system;
  }

  void write_tolerance(const PmiTolerance& tolerance, StepId system) {
    const StepId aspect = aspect_of(tolerance.faces);
    const StepId value = length(tolerance.value_mm);
    if (tolerance.kind == ToleranceKind::kPosition) {
      write_position(tolerance, system, aspect, value);
      return;
    }
    out_.begin(entity_of(tolerance.kind));
    out_.put_quoted(tolerance.name).put(",$,").put(value).put(",").put(aspect);
    if (system != 0) out_.put(",(").put(system).put(")");
    out_.end();
  }
  /// Its zone is a cylinder about each axis.
  void write_position(const PmiTolerance& tolerance, StepId system, StepId aspect, StepId value) {
    const StepId position = out_.begin("(GEOMETRIC_TOLERANCE(");
    out_.put_quoted(tolerance.name).put(",$,").put(value).put(",").put(aspect);
    out_.put(")GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((")
        .put(system)
        .put("))POSITION_TOLERANCE()")
        .end();
    const StepId form = out_.add("TOLERANCE_ZONE_FORM(", "'cylindrical or circular'");
    out_.begin("TOLERANCE_ZONE('','',");
    out_.put(anchor_.shape).put(",.F.,(").put(position).put("),").put(form).end();
  }
  static std::string_view entity_of(ToleranceKind kind) {
    switch (kind) {
      case ToleranceKind::kCircularRunout:
        return "CIRCULAR_RUNOUT_TOLERANCE(";
      case ToleranceKind::kTotalRunout:
        return "TOTAL_RUNOUT_TOLERANCE(";
      case ToleranceKind::kFlatness:
        return "FLATNESS_TOLERANCE(";
      case ToleranceKind::kParallelism:
        return "PARALLELISM_TOLERANCE(";
      case ToleranceKind::kCylindricity:
        return "CYLINDRICITY_TOLERANCE(";
      case ToleranceKind::kPosition:
        break;
    }
    return "POSITION_TOLERANCE(";
  }

  void write_property(const PmiProperty& property) {
    const StepId item = value_item(property);
    const StepId general = out_.begin("GENERAL_PROPERTY('',");
    out_.put_quoted(property.name).put(",$").end();
    const StepId definition = out_.begin("PROPERTY_DEFINITION(");
    out_.put_quoted(property.name).put(",$,").put(anchor_.definition).end();
    out_.begin("GENERAL_PROPERTY_ASSOCIATION('','user defined attribute',");
    out_.put(general).put(",").put(definition).end();
    const StepId shown = out_.begin("REPRESENTATION(");
    out_.put_quoted(property.name).put(",(").put(item).put("),").put(anchor_.context).end();
    out_.begin("PROPERTY_DEFINITION_REPRESENTATION(");
    out_.put(definition).put(",").put(shown).end();
  }

  StepId value_item(const PmiProperty& property) {
    using Unit = PmiProperty::Unit;
    const StepId unit = property.unit == Unit::kMillimetre ? anchor_.millimetre
                        : property.unit == Unit::kDegree   ? degree()
                                                           : 0;
    const StepId item =
        out_.begin(unit == 0 ? "VALUE_REPRESENTATION_ITEM(" : "MEASURE_REPRESENTATION_ITEM(");
    out_.put_quoted(property.name);
    const bool whole = std::holds_alternative<int>(property.value);
    out_.put(whole                                ? ",COUNT_MEASURE("
             : property.unit == Unit::kMillimetre ? ",LENGTH_MEASURE("
             : property.unit == Unit::kDegree     ? ",PLANE_ANGLE_MEASURE("
                                                  : ",NUMERIC_MEASURE(");
    std::visit([&](auto value) { out_.put(static_cast<double>(value)); }, property.value);
    out_.put(")");
    if (unit != 0) out_.put(",").put(unit);
    out_.end();
    return item;
  }

  StepId degree() {
    if (degree_ != 0) return degree_;
    const StepId exponents = out_.add("DIMENSIONAL_EXPONENTS(", "0.,0.,0.,0.,0.,0.,0.");
    const StepId one = out_.begin("PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(");
    out_.put(rad_from_deg(1.0)).put("),").put(anchor_.radian).end();
    degree_ = out_.begin("(CONVERSION_BASED_UNIT('DEGREE',");
    out_.put(one).put(")NAMED_UNIT(").put(exponents).put(")PLANE_ANGLE_UNIT()").end();
    return degree_;
  }

  StepEntities& out_;
  const PmiAnchor& anchor_;
  StepId degree_ = 0;
};

}  // namespace

void add_pmi(StepEntities& out, const StepPmi& pmi, const PmiAnchor& anchor) {
  PmiWriter(out, anchor).write(pmi);
}

}  // namespace trueflank::io
