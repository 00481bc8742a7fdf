// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/base/units.h"
#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/drawing/drawn_part.h"
#include "trueflank/report/drawing/sheet_frame.h"
#include "trueflank/report/drawing/workshop_drawings.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank::io {
namespace {

constexpr double kDimensionStep_mm = 8.0;
constexpr double kFrameStep_mm = 6.0;
constexpr double kGap_mm = 12.0;  // between views, and of the first dimension line from its view

class PartSheet {
 public:
  PartSheet(const DrawingModel& model, const PartShape& part)
      : model_(model), part_(part), section_(axial_section(part)), gears_(gears_of(*model.train, part)),
        dimensions_(part_dimensions(*model.train, part, model.tolerance_class)) {
    length_ = part.slabs.back().z_upper_mm;
    for (const Slab& slab : part.slabs) outer_ = std::max(outer_, outermost_mm(slab.outer));
    table_ = gear_table(*model.train, gears_, *model.report, model.tolerance_class);
  }

  Sheet draw() {
    choose_size();
    sheet_.name = part_.name;
    sheet_.title = model_.train->design.name + ": " + part_.name;
    const DrawnMaterial material = material_of(model_, part_);
    draw_frame(sheet_, {.part = proper_name(part_.name), .design = model_.train->design.name,
                        .material = material.name, .mass = material.mass_text, .scale = scale_name_,
                        .sheet_size = sheet_size_ + "  1/1"});
    place_views();
    draw_section();
    draw_face();
    dimension_section();
    draw_gear_table();
    draw_notes(sheet_, {kBorderLeft_mm + 3.0, kBorder_mm + 3.0}, notes());
    return std::move(sheet_);
  }

 private:
  static std::string diameter_text(const PartDiameter& d) {
    std::string text = d.bore && d.bore->kind == BoreKind::kHex ? "AF " : "Ø";
    text += drawing_number(d.diameter_mm, 3);
    if (!d.limits.fit.empty())
      text += " " + d.limits.fit + " (+" + drawing_number(d.limits.upper_mm, 3) + " / " + drawing_number(d.limits.lower_mm, 3) + ")";
    if (const std::string shape = d.bore ? bore_shape_text(*d.bore) : std::string(); !shape.empty()) text += ", " + shape;
    return text;
  }

  [[nodiscard]] double table_width() const { return gears_.empty() ? 0.0 : 66.0 + 26.0 * static_cast<double>(gears_.size()); }
  [[nodiscard]] double left_room() const { return kGap_mm + kDimensionStep_mm * static_cast<double>(dimensions_.diameters.size()); }
  [[nodiscard]] double below_room() const { return kGap_mm + kDimensionStep_mm * (dimensions_.widths.size() > 1 ? 2.0 : 1.0) + 6.0; }

  /// A4 where the views come out at half size at least and 50 mm high or more, else A3; the largest scale that fits.
  void choose_size() {
    struct Format { const char* name; double width, height; };
    for (const Format& format : {Format{"A4", 297.0, 210.0}, Format{"A3", 420.0, 297.0}}) {
      sheet_.width_mm = format.width;
      sheet_.height_mm = format.height;
      sheet_size_ = format.name;
      region_low_ = {kBorderLeft_mm + 3.0, kBorder_mm + kTitleHeight_mm + 4.0};
      region_high_ = {format.width - kBorder_mm - table_width() - 5.0, format.height - kBorder_mm - 8.0};
      const double table_height = kRowHeight_mm * static_cast<double>(table_.size());
      const bool table_fits = table_height < format.height - 2.0 * kBorder_mm - kTitleHeight_mm - 2.0;
      const Point2 room = region_high_ - region_low_;
      for (const auto& [name, scale] : drawing_scales()) {
        scale_ = scale;
        scale_name_ = name;
        const double width = left_room() + length_ * scale + 2.0 * kGap_mm + 2.0 * outer_ * scale + 4.0;
        const double height = 2.0 * outer_ * scale + below_room() + 10.0;
        if (width <= room.x() && height <= room.y()) break;
      }
      if (table_fits && 2.0 * outer_ * scale_ >= 50.0) return;
    }
  }

  void place_views() {
    const double spare = region_high_.y() - region_low_.y() - 2.0 * outer_ * scale_ - below_room();
    const double y = region_low_.y() + below_room() + outer_ * scale_ + 0.5 * std::max(0.0, spare);
    const double width = left_room() + length_ * scale_ + 2.0 * kGap_mm + 2.0 * outer_ * scale_ + 4.0;
    const double side = 0.4 * std::max(0.0, region_high_.x() - region_low_.x() - width);
    section_origin_ = {region_low_.x() + left_room() + 0.5 * side, y};
    face_centre_ = {section_origin_.x() + length_ * scale_ + 2.0 * kGap_mm + outer_ * scale_ + 6.0 + 0.5 * side, y};
  }

  [[nodiscard]] Point2 in_section(double z, double x) const { return section_origin_ + scale_ * Point2(z, x); }
  /// Seen along +z with x up: y to the right.
  [[nodiscard]] Point2 in_face(const Point2& p) const { return face_centre_ + scale_ * Point2(p.y(), p.x()); }

  void draw_section() {
    for (const SectionBand& band : section_.bands)
      if (!band.teeth)
        sheet_.hatch(in_section(band.z_lower_mm, band.from_mm), in_section(band.z_upper_mm, band.to_mm), true);
    for (const SectionEdge& e : section_.edges)
      sheet_.line(in_section(e.z1_mm, e.x1_mm), in_section(e.z2_mm, e.x2_mm), Pen::kThick);
    for (const Slab& slab : part_.slabs) {
      draw_reference_lines(slab, slab.outer);
      for (const Outline& hole : slab.holes) draw_reference_lines(slab, hole);
    }
    sheet_.line(in_section(0.0, 0.0) - Point2(4.0, 0.0), in_section(length_, 0.0) + Point2(4.0, 0.0), Pen::kChain);
    sheet_.text(in_section(0.5 * length_, outer_) + Point2(0.0, 13.0), "A-A", 3.5, TextAnchor::kMiddle);
  }

  void draw_reference_lines(const Slab& slab, const Outline& outline) {
    if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
      const double r = reference_radius_mm(teeth->profile->gear());
      for (double x : {-r, r})
        sheet_.line(in_section(slab.z_lower_mm, x) - Point2(2.0, 0.0), in_section(slab.z_upper_mm, x) + Point2(2.0, 0.0),
                    Pen::kChain);
    } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
      if (circle->centre.norm() > 1e-9 && std::abs(circle->centre.y()) < 1e-9)
        sheet_.line(in_section(slab.z_lower_mm, circle->centre.x()) - Point2(2.0, 0.0),
                    in_section(slab.z_upper_mm, circle->centre.x()) + Point2(2.0, 0.0), Pen::kChain);
    }
  }

  void draw_face() {
    double seen = 0.0;
    for (const Slab& slab : part_.slabs) {
      if (outermost_mm(slab.outer) > seen + 1e-9) draw_outline(slab.outer);
      seen = std::max(seen, outermost_mm(slab.outer));
    }
    for (const Outline& hole : part_.slabs.front().holes) draw_outline(hole);
    const Point2 reach(outer_ * scale_ + 4.0, 0.0);
    sheet_.line(face_centre_ - reach, face_centre_ + reach, Pen::kChain);
    sheet_.line(face_centre_ - perpendicular(reach), face_centre_ + perpendicular(reach), Pen::kChain);
    // where the section is taken, seen from the right
    for (double up : {1.0, -1.0}) {
      const Point2 end = face_centre_ + Point2(0.0, up * (outer_ * scale_ + 4.0));
      sheet_.line(end, end + Point2(0.0, up * 4.0), Pen::kThick);
      sheet_.line(end + Point2(0.0, up * 2.0), end + Point2(7.0, up * 2.0), Pen::kThin);
      sheet_.arrow(end + Point2(0.3, up * 2.0), {-1.0, 0.0});
      sheet_.text(end + Point2(8.0, up * 2.0 - 1.4), "A", 3.5);
    }
    draw_bolt_circles();
  }

  void draw_outline(const Outline& outline) {
    if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
      sheet_.circle(face_centre_, scale_ * teeth->profile->tip_radius_mm(), Pen::kThick);
      sheet_.circle(face_centre_, scale_ * reference_radius_mm(teeth->profile->gear()), Pen::kChain);
      sheet_.circle(face_centre_, scale_ * teeth->profile->root_radius_mm(), Pen::kThin);
    } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
      sheet_.circle(in_face(circle->centre), scale_ * circle->radius_mm, Pen::kThick);
    } else {
      draw_bore(std::get<BoreOutline>(outline).bore);
    }
  }

  void draw_bore(const BoreDesign& bore) {
    const double r = 0.5 * bore.diameter_mm;
    SheetPath path{.closed = true};
    if (bore.kind == BoreKind::kHex) {
      for (int i = 0; i < 6; ++i) path.points.push_back(in_face(2.0 * r / std::sqrt(3.0) * unit_vector(rad_from_deg(30.0 + 60.0 * i))));
    } else if (bore.kind == BoreKind::kRound) {
      return sheet_.circle(face_centre_, scale_ * r, Pen::kThick);
    } else {
      const double flat = bore.kind == BoreKind::kDFlat ? bore.d_flat_mm - r : r;
      const double half = bore.kind == BoreKind::kDFlat ? std::acos(std::clamp(flat / r, -1.0, 1.0))
                                                        : std::asin(std::clamp(0.5 * bore.keyway_width_mm / r, 0.0, 1.0));
      constexpr int kPieces = 72;
      for (int i = 0; i <= kPieces; ++i)
        path.points.push_back(in_face(r * unit_vector(half + (kTwoPi - 2.0 * half) * i / kPieces)));
      if (bore.kind == BoreKind::kKeyway)
        for (double side : {-1.0, 1.0})
          path.points.push_back(in_face({r + bore.keyway_depth_mm, side * 0.5 * bore.keyway_width_mm}));
    }
    sheet_.paths.push_back(std::move(path));
  }

  void draw_bolt_circles() {
    double y = face_centre_.y() - outer_ * scale_ - 14.0;
    for (const BoltCircle& bolts : dimensions_.bolt_circles) {
      sheet_.circle(face_centre_, 0.5 * scale_ * bolts.circle_diameter_mm, Pen::kChain);
      sheet_.text({face_centre_.x(), y}, std::to_string(bolts.count) + " x Ø" + drawing_number(bolts.hole_diameter_mm, 3) +
                      " through, equally spaced on Ø" + drawing_number(bolts.circle_diameter_mm, 3),
                  2.5, TextAnchor::kMiddle);
      y -= 5.0;
    }
  }

  void dimension_section() {
    double x = section_origin_.x() - kGap_mm;
    for (const PartDiameter& d : dimensions_.diameters) {
      const double r = 0.5 * d.diameter_mm;
      vertical_dimension(sheet_, {.from = in_section(d.z_mm, -r), .to = in_section(d.z_mm, r), .line_at_mm = x, .text = diameter_text(d)});
      if (d.datum) draw_datum({x, section_origin_.y() - r * scale_});
      x -= kDimensionStep_mm;
    }
    double y = section_origin_.y() - outer_ * scale_ - kGap_mm;
    for (std::size_t i = 0; i < dimensions_.widths.size(); ++i) {
      const PartWidth& width = dimensions_.widths[i];
      if (i > 0 && i + 1 == dimensions_.widths.size()) y -= kDimensionStep_mm;  // the whole, below its parts
      horizontal_dimension(sheet_, {.from = in_section(width.z_lower_mm, -outer_), .to = in_section(width.z_upper_mm, -outer_),
                                    .line_at_mm = y, .text = drawing_number(width.width_mm(), 3)});
    }
    draw_tip_runouts();
    draw_face_runout();
  }

  void draw_datum(const Point2& at) {
    const Point2 tip = at - Point2(0.0, 1.0);
    sheet_.fills.push_back({tip, tip + Point2(-1.6, -2.6), tip + Point2(1.6, -2.6)});
    sheet_.line(tip - Point2(0.0, 2.6), tip - Point2(0.0, 5.0), Pen::kThin);
    sheet_.box(tip + Point2(-2.4, -9.8), tip + Point2(2.4, -5.0), Pen::kThin);
    sheet_.text(tip + Point2(0.0, -8.8), "A", 3.0, TextAnchor::kMiddle);
  }

  /// The frames stand above each other, that of the rightmost gear lowest: no leader crosses another.
  void draw_tip_runouts() {
    Point2 corner(section_origin_.x() + length_ * scale_ + 3.0, section_origin_.y() + outer_ * scale_ + 2.0);
    for (auto runout = dimensions_.tip_runouts.rbegin(); runout != dimensions_.tip_runouts.rend(); ++runout) {
      const Point2 feature = in_section(0.5 * (runout->z_lower_mm + runout->z_upper_mm), runout->gear->profile.tip_radius_mm());
      frame_of_tolerance(corner, drawing_number(runout->value_mm, 3));
      sheet_.line(corner + Point2(0.0, 3.0), {feature.x(), corner.y() + 3.0}, Pen::kThin);
      sheet_.line({feature.x(), corner.y() + 3.0}, feature, Pen::kThin);
      sheet_.arrow(feature, {0.0, -1.0});
      corner.y() += kFrameStep_mm;
    }
  }

  /// Between the views, where the upper face has material.
  void draw_face_runout() {
    if (!dimensions_.face_runout) return;
    double from = 0.0, to = 0.0;
    for (const SectionBand& band : section_.bands)
      if (!band.teeth && band.z_upper_mm == length_ && band.to_mm > to) {
        from = std::max(0.0, band.from_mm);
        to = band.to_mm;
      }
    const Point2 feature = in_section(length_, 0.5 * (from + to)), bend = feature + Point2(3.0, 0.0);
    const Point2 frame(bend.x(), std::min(bend.y(), section_origin_.y() + outer_ * scale_ - 3.0));  // below those of the tips
    sheet_.line(feature, bend, Pen::kThin);
    sheet_.line(bend, frame, Pen::kThin);
    sheet_.line(frame, frame + Point2(2.0, 0.0), Pen::kThin);
    sheet_.arrow(feature, {-1.0, 0.0});
    frame_of_tolerance(frame + Point2(2.0, -3.0), drawing_number(dimensions_.face_runout->value_mm, 3));
  }

  void frame_of_tolerance(const Point2& corner, const std::string& value) {
    const double w = text_width_mm(value, 2.5) + 3.0;
    sheet_.box(corner, corner + Point2(7.0, 6.0), Pen::kThin);
    sheet_.box(corner + Point2(7.0, 0.0), corner + Point2(7.0 + w, 6.0), Pen::kThin);
    sheet_.box(corner + Point2(7.0 + w, 0.0), corner + Point2(13.0 + w, 6.0), Pen::kThin);
    sheet_.line(corner + Point2(1.8, 1.2), corner + Point2(5.2, 4.8), Pen::kThin);  // circular runout: one slanting arrow
    sheet_.arrow(corner + Point2(5.2, 4.8), Point2(1.0, 1.06).normalized());
    sheet_.text(corner + Point2(7.0 + 0.5 * w, 1.8), value, 2.5, TextAnchor::kMiddle);
    sheet_.text(corner + Point2(10.0 + w, 1.8), "A", 2.5, TextAnchor::kMiddle);
  }

  void draw_gear_table() {
    if (gears_.empty()) return;
    std::vector<TableColumn> columns = {{50.0, TextAnchor::kLeft}, {16.0, TextAnchor::kLeft}};
    for (std::size_t i = 0; i < gears_.size(); ++i) columns.push_back({26.0, TextAnchor::kRight});
    std::vector<std::vector<std::string>> rows;
    for (const GearTableRow& row : table_) {
      rows.push_back({row.name, row.symbol});
      rows.back().insert(rows.back().end(), row.values.begin(), row.values.end());
    }
    draw_table(sheet_, {sheet_.width_mm - kBorder_mm, sheet_.height_mm - kBorder_mm}, columns, rows);
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all = {"Dimensions in mm."};
    if (!gears_.empty()) {
      all.push_back("Teeth drawn by ISO 2203; true profile: " + part_.name + ".step.");
      all.push_back(additive(*model_.train) ? "Flanks as printed, free of strings and blobs." : "Tooth flanks Ra 1.6, other surfaces Ra 3.2.");
      for (const TrainGear* gear : gears_)
        if (std::string text = modification_text(*model_.train, gear->name); !text.empty()) all.push_back(text);
    }
    if (const auto layout = machine_layout(*model_.train);
        layout && part_.bought.empty() && part_.member == model_.train->topology().input && !gears_.empty())
      if (std::string text = set_screw_operation(*layout); !text.empty()) all.push_back(text);
    if (!additive(*model_.train)) all.push_back("Edges broken 0.1 to 0.3.");
    return all;
  }

  const DrawingModel& model_;
  const PartShape& part_;
  AxialSection section_;
  std::vector<const TrainGear*> gears_;
  std::vector<GearTableRow> table_;
  PartDimensions dimensions_;
  Sheet sheet_;
  double length_ = 0.0, outer_ = 0.0, scale_ = 1.0;
  std::string scale_name_, sheet_size_;
  Point2 region_low_, region_high_, section_origin_, face_centre_;
};

}  // namespace

Sheet part_sheet(const DrawingModel& model, const PartShape& part) { return PartSheet(model, part).draw(); }

}  // namespace trueflank::io
