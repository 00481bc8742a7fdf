// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/scad/scad_writer.h"

#include <algorithm>

#include "trueflank/base/contract.h"
#include "trueflank/base/units.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/file_formats.h"
#include "trueflank/export/scad/scad_flanks.h"
#include "trueflank/export/scad/scad_template_texts.h"
#include "trueflank/export/scad/scad_text.h"
#include "trueflank/solid/shape/outline_loop.h"

namespace trueflank::io {
namespace {

// A curve as the library knows it: kind, interval, then the numbers of its struct in their order.
std::string curve_list(const CircularArc& c, const Curve& curve) {
  return list(std::string("\"arc\""), degrees(curve.begin), degrees(curve.end), number(c.centre.x()),
              number(c.centre.y()), number(c.radius_mm));
}
std::string curve_list(const StraightLine& c, const Curve& curve) {
  return list(std::string("\"line\""), number(curve.begin), number(curve.end), number(c.start.x()),
              number(c.start.y()), number(c.direction.x()), number(c.direction.y()));
}
std::string curve_list(const Involute& c, const Curve& curve) {
  return list(std::string("\"involute\""), degrees(curve.begin), degrees(curve.end),
              number(c.base_radius_mm), degrees(c.base_half_angle_rad), std::to_string(c.sense));
}
std::string curve_list(const RackTrochoid& c, const Curve& curve) {
  return list(std::string("\"rack\""), degrees(curve.begin), degrees(curve.end),
              number(c.pitch_radius_mm), number(c.corner_depth_mm), number(c.corner_offset_mm),
              number(c.corner_radius_mm), number(c.stretch), degrees(c.gap_angle_rad));
}
std::string curve_list(const CutterTrochoid& c, const Curve& curve) {
  return list(std::string("\"cutter\""), degrees(curve.begin), degrees(curve.end),
              number(c.centre_distance_mm), number(c.cutter_pitch_radius_mm),
              number(c.corner_centre_radius_mm), degrees(c.corner_centre_angle_rad),
              number(c.corner_radius_mm), number(c.ratio), degrees(c.gap_angle_rad),
              std::string(c.contact == CutterContact::kTrimming ? "true" : "false"));
}
/// Parts come as designed, without a section's own curves.
std::string curve_list(const PointCurve&, const Curve&) {
  TRUEFLANK_EXPECTS(false && "a section of a modified toothing is no part");
  return {};
}

/// Gathers parameters, data and the solid's text slab by slab.
class PartText {
 public:
  PartText(const PartShape& part, double tolerance_mm) : part_(part), tolerance_mm_(tolerance_mm) {}

  std::string build(const std::string& design_name) {
    for (const Slab& slab : part_.slabs) add_slab(slab);
    const bool stacked = (slabs_.size() > 1 || is_twisted(part_.slabs.front().outer)) && is_nested();
    std::string text = "// " + part_.name + " of " + one_line(design_name) +
                       ", written by Trueflank. Millimetres and degrees.\n"
                       "// The part's axis is z, its lowest face at z = 0, tooth 1 on +x. Elsewhere:\n"
                       "//   use <" + part_.name + ".scad>\n//   " + part_.name + "();  or  " +
                       part_.name + "_section();\n\n";
    text += "/* [Size] */\n" + sizes_;
    text += "\n/* [Fit] */\n// taken off every tooth on top of the design, on the reference circle\n"
            "extra_thinning_um = 0; // [0:5:300]\n";
    text += "\n/* [Accuracy] */\n// largest distance between facets and the true surface\n"
            "tolerance_um = " + short_number(um_from_mm(tolerance_mm_)) + ";\n";
    text += "\n/* [Hidden] */\ntolerance = tolerance_um/1000;\n" + data_ + "\n";
    text += part_.name + "();\n\n";
    text += "module " + part_.name + "_section() section(" + slabs_.front().outer + ", " +
            slabs_.front().holes + ");\n";
    text += "module " + part_.name + "()";
    text += stacked             ? stack_text()
            : is_twisted_ring() ? ring_text()
            : slabs_.size() == 1 ? prism_text(0, "0")
                                 : union_text();
    text += "\n";
    text += scad_template::kLibrary;
    return text;
  }

 private:
  struct SlabText {
    std::string height, outer, points_per_tooth, holes;
    std::string rows;  ///< of the twisted teeth; empty: straight
    std::vector<std::string> hole_names, hole_points;
  };

  /// Whether an outline changes from row to row.
  static bool is_twisted(const Outline& outline) {
    const auto* toothed = std::get_if<ToothedOutline>(&outline);
    return toothed != nullptr && !toothed->toothing().prismatic();
  }

  /// Rows of a slab's twisted teeth: turn at its lower face, rate, and the share of the height above
  /// which a herringbone turns back.
  std::string rows_text(const Outline& outline, const Slab& slab, const std::string& height,
                        const std::string& name) {
    if (!is_twisted(outline)) return {};
    const auto& toothed = std::get<ToothedOutline>(outline);
    const FaceTwist& twist = toothed.twist;
    const double lower = slab.z_lower_mm - toothed.z_lower_mm, width = slab.z_upper_mm - slab.z_lower_mm;
    const double apex = !twist.herringbone ? 1.0 : (0.5 * twist.face_width_mm - lower) / width;
    const std::string twisted = "rows(" + height + ", " + degrees(section_turn_rad(twist, lower)) + ", " +
                                degrees(twist.turn_rad_per_mm) + ", " +
                                number(std::clamp(apex, 0.0, 1.0)) + ", largest_radius(" + name +
                                "), tolerance";
    if (!is_modified(toothed)) return twisted + ")";
    const std::string face = fresh(name + "_face");
    data_ += face + " = " + scad_face(toothed, lower, lower + width) + ";\n";
    return "modified_" + twisted + ",\n  " + name + "_curves, " + name + "_flanks, " + face + ", " + name +
           "_chords, " + std::to_string(toothed.profile->gear().teeth) + ", " +
           degrees(toothed.rotation_rad) + ", " + slack_text(toothed) + ")";
  }
  static std::string slack_text(const ToothedOutline& teeth) {
    return "extra_thinning_um/2000/" + number(reference_radius_mm(teeth.profile->gear())) + "*180/PI";
  }


  void add_size(const std::string& name, double value_mm, const char* comment) {
    sizes_ += std::string("// ") + comment + "\n" + name + " = " + short_number(value_mm) + ";\n";
  }
  /// A name not used before: "bore", "bore_2", ...
  std::string fresh(const std::string& name) {
    names_.push_back(name);
    const auto uses = std::count(names_.begin(), names_.end(), name);
    return uses == 1 ? name : name + "_" + std::to_string(uses);
  }

  void add_slab(const Slab& slab) {
    SlabText text;
    const bool toothed =
        std::holds_alternative<ToothedOutline>(slab.outer) ||
        std::any_of(slab.holes.begin(), slab.holes.end(),
                    [](const Outline& o) { return std::holds_alternative<ToothedOutline>(o); });
    text.height = fresh(toothed ? "face_width" : "neck_height");
    add_size(text.height, slab.z_upper_mm - slab.z_lower_mm,
             toothed ? "height of the toothed section" : "height of the neck between the teeth");
    text.outer = outline_name(slab.outer);
    text.points_per_tooth = points_per_tooth(slab.outer, text.outer);
    text.rows = rows_text(slab.outer, slab, text.height, text.outer);
    text.holes = "concat([]";
    for (const Outline& hole : slab.holes) {
      const std::string name = outline_name(hole);
      if (text.rows.empty()) text.rows = rows_text(hole, slab, text.height, name);
      text.hole_names.push_back(name);
      text.hole_points.push_back(points_per_tooth(hole, name));
      // a bore that its user sets to 0 is left out
      text.holes += ", len(" + name + ") > 0 ? [" + name + "] : []";
    }
    text.holes += ")";
    slabs_.push_back(text);
  }

  static std::string points_per_tooth(const Outline& outline, const std::string& name) {
    if (const auto* toothed = std::get_if<ToothedOutline>(&outline))
      return "len(" + name + ")/" + std::to_string(toothed->profile->gear().teeth);
    return "ceil(len(" + name + ")/16)";
  }

  /// The variable that holds an outline, declared when it is met first.
  std::string outline_name(const Outline& outline) {
    for (const auto& [known, name] : outlines_)
      if (same_outline(*known, outline)) return name;
    const std::string name = std::visit([&](const auto& o) { return declare(o); }, outline);
    outlines_.emplace_back(&outline, name);
    return name;
  }

  std::string declare(const ToothedOutline& outline) {
    const std::string name = fresh("teeth");
    const Gear& gear = outline.profile->gear();
    data_ += "// " + std::to_string(gear.teeth) + " teeth, module " +
             short_number(gear.normal_module_mm) + ", profile shift " + short_number(gear.shift) +
             "\n" + name + "_curves = [\n";
    const auto flanks = is_modified(outline) ? scad_flanks(outline) : std::nullopt;
    std::vector<Curve> curves;
    if (flanks) curves = flanks->curves;
    else
      for (const ProfilePiece& piece : outline.profile->pieces()) curves.push_back(piece.curve);
    for (const Curve& curve : curves)
      data_ += "  " + std::visit([&](const auto& c) { return curve_list(c, curve); }, curve.shape) + ",\n";
    data_ += "];\n";
    const std::string common = std::to_string(gear.teeth) + ", " + degrees(outline.rotation_rad);
    if (!flanks) {
      data_ += name + " = gear_outline(" + name + "_curves, " + common + ", tolerance,\n  " +
               slack_text(outline) + ");\n";
      return name;
    }
    // all heights that any slab has: chords are the same in all rows
    data_ += "// modified flanks\n" + name + "_flanks = " + flanks->profile + ";\n" + name + "_chords = modified_chords(" +
             name + "_curves, " + name + "_flanks, faces(" +
             scad_face(outline, 0.0, outline.twist.face_width_mm) + "), tolerance);\n" + name +
             " = modified_outline(" + name + "_curves, " + name + "_flanks, [0, 0, 0], " + name + "_chords, " +
             common + ",\n  " + slack_text(outline) + ");\n";
    return name;
  }

  std::string declare(const CircleOutline& outline) {
    const bool central = outline.centre == Point2::Zero();
    const bool rim = central && std::any_of(part_.slabs.begin(), part_.slabs.end(), [&](const Slab& s) {
      const auto* circle = std::get_if<CircleOutline>(&s.outer);
      return circle == &outline && s.holes.size() > 0 &&
             std::holds_alternative<ToothedOutline>(s.holes.front());
    });
    const std::string name = fresh(rim ? "rim" : central ? "neck" : "bolt_hole");
    const std::string diameter = name.starts_with("bolt_hole") ? bolt_hole_diameter(outline)
                                                               : name + "_diameter";
    if (central)
      add_size(diameter, 2.0 * outline.radius_mm, rim ? "outside of the ring" : "between the teeth");
    const std::string centre =
        central ? "" : ", " + list(number(outline.centre.x()), number(outline.centre.y()));
    data_ += name + " = " + diameter + " > 0 ? circle_outline(" + diameter + ", tolerance" + centre +
             ") : [];\n";
    return name;
  }

  /// Holes of one size share a parameter.
  std::string bolt_hole_diameter(const CircleOutline& outline) {
    for (const auto& [radius_mm, name] : hole_diameters_)
      if (radius_mm == outline.radius_mm) return name;
    const std::string name = fresh("hole_diameter");
    add_size(name, 2.0 * outline.radius_mm, "round holes beside the axis; 0: none");
    hole_diameters_.emplace_back(outline.radius_mm, name);
    return name;
  }

  std::string declare(const BoreOutline& outline) {
    const BoreDesign& bore = outline.bore;
    const std::string name = fresh("bore");
    const bool hex = bore.kind == BoreKind::kHex;
    const std::string size = name + (hex ? "_across_flats" : "_diameter");
    add_size(size, bore.diameter_mm, hex ? "hexagonal bore; 0: none" : "bore; 0: none");
    std::string call = hex ? "hex_outline(" + size + ")" : "circle_outline(" + size + ", tolerance)";
    if (bore.kind == BoreKind::kDFlat) {
      add_size(name + "_flat", bore.d_flat_mm, "from the flat to the opposite side of the bore");
      call = "d_outline(" + size + ", " + name + "_flat, tolerance)";
    } else if (bore.kind == BoreKind::kKeyway) {
      add_size(name + "_keyway_width", bore.keyway_width_mm, "keyway");
      add_size(name + "_keyway_depth", bore.keyway_depth_mm, "from the bore's circle to the floor");
      call = "keyway_outline(" + size + ", " + name + "_keyway_width, " + name +
             "_keyway_depth, tolerance)";
    }
    data_ += name + " = " + size + " > 0 ? " + call + " : [];\n";
    return name;
  }

  /// Whether `stack` can make it: neighbours one inside the other, one bore through all or none.
  bool is_nested() const {
    for (std::size_t i = 0; i < part_.slabs.size(); ++i) {
      const Slab& slab = part_.slabs[i];
      const auto& holes = part_.slabs.front().holes;
      if (slab.holes.size() != holes.size() || holes.size() > 1) return false;
      if (!holes.empty() && (!same_outline(slab.holes.front(), holes.front()) ||
                             !std::holds_alternative<BoreOutline>(holes.front())))
        return false;
      if (i == 0) continue;
      const OutlineExtent below = extent(part_.slabs[i - 1].outer), here = extent(slab.outer);
      if (!(below.outer_radius_mm < here.inner_radius_mm ||
            here.outer_radius_mm < below.inner_radius_mm))
        return false;
    }
    return true;
  }

  /// A ring whose teeth are twisted; every slab's first hole is its teeth, or its groove.
  [[nodiscard]] bool is_twisted_ring() const {
    return std::any_of(part_.slabs.begin(), part_.slabs.end(),
                       [](const Slab& s) { return !s.holes.empty() && is_twisted(s.holes.front()); });
  }
  std::string ring_text() const {
    std::string rings = "stack_in_rim(" + slabs_.front().outer + ", [";
    for (const SlabText& slab : slabs_)
      rings += (rings.ends_with('[') ? "" : ",\n  ") +
               (slab.rows.empty()
                    ? list(slab.height, slab.hole_names.front(), slab.hole_points.front())
                    : list(slab.height, slab.hole_names.front(), slab.hole_points.front(), slab.rows));
    rings += "]);\n";
    const auto& names = slabs_.front().hole_names;
    if (names.size() == 1) return " " + rings;
    std::string height, bolts;
    for (const SlabText& slab : slabs_) height += (height.empty() ? "" : " + ") + slab.height;
    for (std::size_t i = 1; i < names.size(); ++i) bolts += (bolts.empty() ? "" : ", ") + names[i];
    return " difference() {\n  " + rings + "  for (hole = [" + bolts + "]) if (len(hole) > 0)\n" +
           "    translate([0, 0, -1]) prism(" + height + " + 2, hole);\n}\n";
  }

  /// A slab of twisted teeth with holes beside the bore: these are drilled.
  std::string drilled_text(std::size_t i, const std::string& move) const {
    const SlabText& slab = slabs_[i];
    std::string bore = "[]", drilled;
    for (std::size_t h = 0; h < slab.hole_names.size(); ++h)
      if (std::holds_alternative<BoreOutline>(part_.slabs[i].holes[h])) bore = slab.hole_names[h];
      else drilled += (drilled.empty() ? "" : ", ") + slab.hole_names[h];
    const std::string body =
        "stack([" + list(slab.height, slab.outer, slab.points_per_tooth, slab.rows) + "], " + bore + ");";
    if (drilled.empty()) return move + " " + body + "\n";
    return move + " difference() {\n    " + body + "\n    for (hole = [" + drilled +
           "]) translate([0, 0, -1]) prism(" + slab.height + " + 2, hole);\n  }\n";
  }

  std::string prism_text(std::size_t i, const std::string& below) const {
    const SlabText& slab = slabs_[i];
    if (is_twisted(part_.slabs[i].outer))
      return drilled_text(i, below == "0" ? "" : " translate([0, 0, " + below + "])");
    const std::string move = below == "0" ? "" : " translate([0, 0, " + below + "])";
    return move + " prism(" + slab.height + ", " + slab.outer + ", " + slab.holes + ");\n";
  }
  std::string union_text() const {
    std::string text = " {\n", below = "0";
    for (std::size_t i = 0; i < slabs_.size(); ++i) {
      text += " " + prism_text(i, below);
      below += " + " + slabs_[i].height;
    }
    return text + "}\n";
  }
  std::string stack_text() const {
    std::string text = " stack([";
    for (const SlabText& slab : slabs_)
      text += (text.ends_with('[') ? "" : ",\n  ") +
              (slab.rows.empty() ? list(slab.height, slab.outer, slab.points_per_tooth)
                                 : list(slab.height, slab.outer, slab.points_per_tooth, slab.rows));
    const auto& holes = part_.slabs.front().holes;
    return text + "]" + (holes.empty() ? "" : ", " + outlines_name(holes.front())) + ");\n";
  }
  std::string outlines_name(const Outline& outline) const {
    for (const auto& [known, name] : outlines_)
      if (same_outline(*known, outline)) return name;
    return "[]";
  }

  const PartShape& part_;
  double tolerance_mm_;
  std::string sizes_, data_;
  std::vector<SlabText> slabs_;
  std::vector<std::pair<const Outline*, std::string>> outlines_;
  std::vector<std::pair<double, std::string>> hole_diameters_;
  std::vector<std::string> names_;
};

bool can_write_scad(const Outline& outline) {
  const auto* toothed = std::get_if<ToothedOutline>(&outline);
  return toothed == nullptr || !is_modified(*toothed) || scad_flanks(*toothed).has_value();
}

}  // namespace

Status write_scad(const std::filesystem::path& path, const std::string& design_name,
                  const PartShape& part, double tolerance_mm) {
  for (const Slab& slab : part.slabs) {
    if (!can_write_scad(slab.outer) || !std::all_of(slab.holes.begin(), slab.holes.end(), can_write_scad))
      return fail(Error{.code = ErrorCode::kUnsupported,
                        .message = part.name + ": an OpenSCAD file holds modifications of all teeth "
                                               "alike, and no corrections",
                        .key = "--formats",
                        .value = "scad",
                        .remedy = format_names(", ", FormatContent::kMesh)});
  }
  return write_file(path, PartText(part, tolerance_mm).build(design_name));
}

}  // namespace trueflank::io
