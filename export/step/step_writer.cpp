// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/step/step_writer.h"

#include "trueflank/base/contract.h"
#include <cmath>
#include "trueflank/base/units.h"
#include "trueflank/export/step/step_entities.h"

namespace trueflank::io {
namespace {

/// What the placement of a part refers to.
struct ProductIds {
  StepId definition = 0, representation = 0, origin = 0, shape = 0;
};

/// What a schema calls itself.
struct SchemaWords {
  std::string_view context;   ///< APPLICATION_CONTEXT
  std::string_view protocol;  ///< name and year
  std::string_view schema;    ///< FILE_SCHEMA
};
const SchemaWords& words_of(StepSchema schema) {
  static const SchemaWords kAp214 = {"'core data for automotive mechanical design processes'",
                                     "'automotive_design',2000",
                                     "'AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'"};
  static const SchemaWords kAp242 = {
      "'managed model based 3d engineering'", "'ap242_managed_model_based_3d_engineering',2014",
      "'AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }'"};
  return schema == StepSchema::kAp214 ? kAp214 : kAp242;
}

class StepFile {
 public:
  StepFile(std::size_t bytes, StepSchema schema, const std::string& name) : schema_(schema) {
    out_.reserve(bytes);
    add_header(name);
    application_ = out_.add("APPLICATION_CONTEXT(", words_of(schema).context);
    out_.begin("APPLICATION_PROTOCOL_DEFINITION('international standard',");
    out_.put(words_of(schema).protocol).put(",").put(application_).end();
    millimetre_ = out_.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.)", "");
    radian_ = out_.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.)", "");
    steradian_ = out_.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT()", "");
    uncertainty_ = out_.begin("UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-06),");
    out_.put(millimetre_).put(",'distance_accuracy_value','confusion accuracy'").end();
  }

  ProductIds add_part(const StepPart& part) {
    ProductIds ids;
    ids.definition = add_product(part.name);
    ids.origin = add_placement(out_, {});
    SolidIds solid = add_solid(out_, part.solid, part.name);
    const StepId context = add_context();
    add_representation("ADVANCED_BREP_SHAPE_REPRESENTATION(", part.name, {ids.origin, solid.solid},
                       context, ids);
    add_colour(solid.solid, part.colour, context);
    if (schema_ == StepSchema::kAp242)
      add_pmi(out_, part.pmi,
              {.shape = ids.shape,
               .definition = ids.definition,
               .representation = ids.representation,
               .context = context,
               .millimetre = millimetre_,
               .radian = radian_,
               .faces = std::move(solid.faces)});
    return ids;
  }

  void add_assembly(const std::vector<ProductIds>& parts, const std::vector<Placement>& placements,
                    const std::string& name) {
    ProductIds assembly;
    assembly.definition = add_product(name);
    assembly.origin = add_placement(out_, {});
    std::vector<StepId> items{assembly.origin};
    for (const Placement& p : placements)
      items.push_back(add_placement(
          out_, {Point3(p.translation_mm[0], p.translation_mm[1], p.translation_mm[2]),
                 Point3::UnitZ(),
                 Point3(std::cos(p.rotation_rad), std::sin(p.rotation_rad), 0.0)}));
    add_representation("SHAPE_REPRESENTATION(", name, items, add_context(), assembly);
    for (std::size_t i = 0; i < placements.size(); ++i) {
      TRUEFLANK_EXPECTS(placements[i].part >= 0 &&
                        static_cast<std::size_t>(placements[i].part) < parts.size());
      add_usage(parts[static_cast<std::size_t>(placements[i].part)], assembly, items[i + 1],
                placements[i].name, static_cast<int>(i) + 1);
    }
  }

  std::string finish() {
    out_.put("ENDSEC;\nEND-ISO-10303-21;\n");
    return out_.take();
  }

 private:
  void add_header(const std::string& name) {
    out_.put("ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((").put_quoted("Trueflank " + name);
    // no clock: the same design gives the same bytes
    out_.put("),'2;1');\nFILE_NAME(").put_quoted(name + ".step");
    out_.put(",'1970-01-01T00:00:00',(''),(''),'Trueflank','Trueflank','');\n"
             "FILE_SCHEMA((");
    out_.put(words_of(schema_).schema).put("));\nENDSEC;\nDATA;\n");
  }

  /// A product with its definition; returns the PRODUCT_DEFINITION.
  StepId add_product(const std::string& name) {
    const StepId product_context = out_.begin("PRODUCT_CONTEXT('',");
    out_.put(application_).put(",'mechanical'").end();
    const StepId product = out_.begin("PRODUCT(");
    out_.put_quoted(name).put(",").put_quoted(name).put(",'',(").put(product_context).put(")").end();
    out_.begin("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(");
    out_.put(product).put(")").end();
    const StepId formation = out_.begin("PRODUCT_DEFINITION_FORMATION('','',");
    out_.put(product).end();
    const StepId context = out_.begin("PRODUCT_DEFINITION_CONTEXT('part definition',");
    out_.put(application_).put(",'design'").end();
    const StepId definition = out_.begin("PRODUCT_DEFINITION('design','',");
    out_.put(formation).put(",").put(context).end();
    return definition;
  }

  /// Every representation has a space of its own, or placing one in another would say nothing.
  StepId add_context() {
    const StepId id = out_.begin("(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
                                 "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((");
    out_.put(uncertainty_).put("))GLOBAL_UNIT_ASSIGNED_CONTEXT(");
    out_.put(std::vector<StepId>{millimetre_, radian_, steradian_});
    out_.put(")REPRESENTATION_CONTEXT('','3D')").end();
    return id;
  }

  /// Completes the ids of a product that has its definition.
  void add_representation(std::string_view kind, const std::string& name,
                          const std::vector<StepId>& items, StepId context, ProductIds& ids) {
    ids.representation = out_.begin(kind);
    out_.put_quoted(name).put(",").put(items).put(",").put(context).end();
    ids.shape = out_.begin("PRODUCT_DEFINITION_SHAPE('','',");
    out_.put(ids.definition).end();
    out_.begin("SHAPE_DEFINITION_REPRESENTATION(");
    out_.put(ids.shape).put(",").put(ids.representation).end();
  }

  void add_colour(StepId solid, const std::array<double, 3>& colour, StepId context) {
    const StepId rgb = out_.begin("COLOUR_RGB('',");
    out_.put(colour[0]).put(",").put(colour[1]).put(",").put(colour[2]).end();
    StepId style = rgb;
    for (const std::string_view wrapping :
         {"FILL_AREA_STYLE_COLOUR('',", "FILL_AREA_STYLE('',(", "SURFACE_STYLE_FILL_AREA(",
          "SURFACE_SIDE_STYLE('',(", "SURFACE_STYLE_USAGE(.BOTH.,",
          "PRESENTATION_STYLE_ASSIGNMENT(("}) {
      const StepId inner = style;
      style = out_.begin(wrapping);
      out_.put(inner).put(wrapping.ends_with("((") || wrapping.ends_with(",(") ? ")" : "").end();
    }
    const StepId styled = out_.begin("STYLED_ITEM('colour',(");
    out_.put(style).put("),").put(solid).end();
    out_.begin("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(");
    out_.put(styled).put("),").put(context).end();
  }

  void add_usage(const ProductIds& part, const ProductIds& assembly, StepId place,
                 const std::string& name, int number) {
    const StepId usage = out_.begin("NEXT_ASSEMBLY_USAGE_OCCURRENCE(");
    out_.put_quoted(std::to_string(number)).put(",").put_quoted(name).put(",'',");
    out_.put(assembly.definition).put(",").put(part.definition).put(",$").end();
    const StepId shape = out_.begin("PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',");
    out_.put(usage).end();
    const StepId move = out_.begin("ITEM_DEFINED_TRANSFORMATION('','',");
    out_.put(part.origin).put(",").put(place).end();
    const StepId relation = out_.begin("(REPRESENTATION_RELATIONSHIP('','',");
    out_.put(part.representation).put(",").put(assembly.representation);
    out_.put(")REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(").put(move);
    out_.put(")SHAPE_REPRESENTATION_RELATIONSHIP()").end();
    out_.begin("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(");
    out_.put(relation).put(",").put(shape).end();
  }

  StepEntities out_;
  StepSchema schema_;
  StepId application_ = 0, millimetre_ = 0, radian_ = 0, steradian_ = 0, uncertainty_ = 0;
};

/// About what a solid's text takes, so that it is not moved while it grows.
std::size_t expected_bytes(const StepPart& part) {
  return 4096 + 320 * part.solid.edges.size() + 700 * part.solid.faces.size();
}

}  // namespace

std::string step_text(const StepPart& part, StepSchema schema) {
  StepFile file(expected_bytes(part), schema, part.name);
  file.add_part(part);
  return file.finish();
}

std::string step_text(const std::vector<StepPart>& parts, const std::vector<Placement>& placements,
                      const std::string& name, StepSchema schema) {
  std::size_t bytes = 1000 * placements.size();
  for (const StepPart& part : parts) bytes += expected_bytes(part);
  StepFile file(bytes, schema, name);
  std::vector<ProductIds> ids;
  for (const StepPart& part : parts) ids.push_back(file.add_part(part));
  file.add_assembly(ids, placements, name);
  return file.finish();
}

}  // namespace trueflank::io
