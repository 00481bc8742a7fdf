// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "trueflank/base/units.h"
#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/drawing/drawn_part.h"
#include "trueflank/report/drawing/face_view.h"
#include "trueflank/report/drawing/part_frames.h"
#include "trueflank/report/drawing/part_notes.h"
#include "trueflank/report/drawing/sheet_frame.h"
#include "trueflank/report/drawing/workshop_drawings.h"

namespace trueflank::io {
namespace {

constexpr double kHoleTableWidth_mm = 138.0, kPositionWidth_mm = 25.0, kTableGap_mm = 4.0;

std::string hole_letter(std::size_t i) {
  // A is the datum and the section
  return i < 25 ? std::string(1, static_cast<char>('B' + i)) : "H" + std::to_string(i + 1);
}

/// A row a tool and a place, under a heading; empty: no holes.
std::vector<std::vector<std::string>> hole_table(const std::vector<HolePattern>& patterns) {
  std::vector<std::vector<std::string>> rows;
  if (!patterns.empty()) rows.push_back({"Holes", "Count", "Size", "Place", "Position"});
  for (std::size_t i = 0; i < patterns.size(); ++i) {
    std::vector<std::string> sizes = hole_words(patterns[i]);
    const std::vector<std::string> places = place_words(patterns[i]);
    if (!patterns[i].use.what.empty()) sizes.push_back("for " + patterns[i].use.what);
    for (std::size_t k = 0; k < std::max(sizes.size(), places.size()); ++k)
      rows.push_back({k == 0 ? hole_letter(i) : "",
                      k == 0 ? std::to_string(patterns[i].centres.size()) : "",
                      k < sizes.size() ? sizes[k] : "", k < places.size() ? places[k] : ""});
  }
  return rows;
}

class PartSheet {
 public:
  PartSheet(const DrawingModel& model, const PartShape& part)
      : model_(model),
        part_(part),
        section_(axial_section(part)),
        gears_(gears_of(*model.train, part)),
        made_(workmanship(*model.train)),
        dimensions_(part_dimensions(*model.train, part)),
        frames_(part, dimensions_, made_) {
    length_ = part.slabs.back().z_upper_mm;
    for (const Slab& slab : part.slabs) outer_ = std::max(outer_, outermost_mm(slab.outer));
    table_ = gear_table(*model.train, gears_, *model.report);
    hole_rows_ = hole_table(dimensions_.holes);
  }

  Sheet draw() {
    choose_size();
    sheet_.name = part_.name;
    sheet_.title = model_.train->design.name + ": " + part_.name;
    const DrawnMaterial material = material_of(model_, part_);
    draw_frame(sheet_, {.part = proper_name(part_.name),
                        .design = model_.train->design.name,
                        .material = material.name,
                        .mass = material.mass_text,
                        .scale = scale_name_,
                        .sheet_size = sheet_size_ + "  1/1",
                        .general_tolerances = general_tolerance_text(made_),
                        .surfaces = general_surface_text(made_),
                        .removal = removal_of(made_),
                        .other_surfaces = frames_.have_surfaces()});
    place_views();
    draw_section();
    draw_face();
    dimension_section();
    draw_gear_table();
    draw_hole_table();
    draw_notes(sheet_, {kBorderLeft_mm + 3.0, kBorder_mm + 3.0},
               part_notes(model_, part_, dimensions_, made_));
    return std::move(sheet_);
  }

 private:
  static std::string diameter_text(const PartDiameter& d) {
    return (d.bore && d.bore->kind == BoreKind::kHex ? "AF " : "Ø") +
           drawing_number(d.diameter_mm, 3) + limits_text(d.limits);
  }

  [[nodiscard]] double table_width() const {
    return std::max(
        table_.empty() ? 0.0 : 66.0 + 26.0 * static_cast<double>(table_.front().values.size()),
        hole_rows_.empty() ? 0.0 : kHoleTableWidth_mm);
  }
  [[nodiscard]] double table_height() const {
    return kRowHeight_mm * static_cast<double>(table_.size() + hole_rows_.size()) +
           (hole_rows_.empty() || table_.empty() ? 0.0 : kTableGap_mm);
  }
  [[nodiscard]] double left_room() const {
    return std::max(kGap_mm + kDimensionStep_mm * static_cast<double>(dimensions_.diameters.size()),
                    frames_.left_room_mm());
  }
  /// Above the part, beyond what always stands there.
  [[nodiscard]] double above_room() const { return std::max(10.0, frames_.above_mm() - 6.0); }
  [[nodiscard]] double below_room() const {
    return kGap_mm +
           kDimensionStep_mm * (1.0 + row_count(dimension_rows(lengths_below({0.0, 0.0})))) + 6.0;
  }

  static int row_count(const std::vector<int>& rows) {
    return rows.empty() ? 0 : 1 + *std::max_element(rows.begin(), rows.end());
  }

  /// Steps of the outside and of the bores, without the whole; the rows are not chosen. Those whose
  /// text stands outside come last: lines to rows below would cross it.
  [[nodiscard]] std::vector<Dimension> lengths_below(const Point2& origin) const {
    std::vector<Dimension> all;
    const auto add = [&](const PartWidth& w) {
      all.push_back({.from = origin + scale_ * Point2(w.z_lower_mm, -outer_),
                     .to = origin + scale_ * Point2(w.z_upper_mm, -outer_),
                     .text = drawing_number(w.width_mm(), 3)});
    };
    for (std::size_t i = 0; i + 1 < dimensions_.widths.size(); ++i) add(dimensions_.widths[i]);
    for (const PartWidth& depth : dimensions_.depths) add(depth);
    std::stable_partition(all.begin(), all.end(),
                          [](const Dimension& d) { return reach_of(d).second <= d.to.x() + 1e-9; });
    return all;
  }

  /// A4 where the views come out at half size at least and 50 mm high or more, else A3; the largest
  /// scale that fits.
  void choose_size() {
    struct Format {
      const char* name;
      double width, height;
    };
    for (const Format& format : {Format{"A4", 297.0, 210.0}, Format{"A3", 420.0, 297.0}}) {
      sheet_.width_mm = format.width;
      sheet_.height_mm = format.height;
      sheet_size_ = format.name;
      region_low_ = {kBorderLeft_mm + 3.0, kBorder_mm + kTitleHeight_mm + 4.0};
      region_high_ = {format.width - kBorder_mm - table_width() - 5.0,
                      format.height - kBorder_mm - 8.0};
      const bool table_fits =
          table_height() < format.height - 2.0 * kBorder_mm - kTitleHeight_mm - 2.0;
      const Point2 room = region_high_ - region_low_;
      for (const auto& [name, scale] : drawing_scales()) {
        scale_ = scale;
        scale_name_ = name;
        const double width =
            left_room() + length_ * scale + 2.0 * kGap_mm + 2.0 * outer_ * scale + 4.0;
        const double height = 2.0 * outer_ * scale + below_room() + above_room();
        if (width <= room.x() && height <= room.y()) break;
      }
      if (table_fits && 2.0 * outer_ * scale_ >= 50.0) return;
    }
  }

  void place_views() {
    const double spare =
        region_high_.y() - region_low_.y() - 2.0 * outer_ * scale_ - below_room() - above_room();
    const double y = region_low_.y() + below_room() + outer_ * scale_ + 0.5 * std::max(0.0, spare);
    const double width =
        left_room() + length_ * scale_ + 2.0 * kGap_mm + 2.0 * outer_ * scale_ + 4.0;
    const double side = 0.4 * std::max(0.0, region_high_.x() - region_low_.x() - width);
    section_origin_ = {region_low_.x() + left_room() + 0.5 * side, y};
    face_centre_ = {
        section_origin_.x() + length_ * scale_ + 2.0 * kGap_mm + outer_ * scale_ + 6.0 + 0.5 * side,
        y};
  }

  [[nodiscard]] Point2 in_section(double z, double x) const {
    return section_origin_ + scale_ * Point2(z, x);
  }
  /// Seen along +z with x up: y to the right.
  [[nodiscard]] Point2 in_face(const Point2& p) const {
    return face_centre_ + scale_ * Point2(p.y(), p.x());
  }

  void draw_section() {
    for (const SectionBand& band : section_.bands)
      if (!band.teeth)
        sheet_.hatch(in_section(band.z_lower_mm, band.from_mm),
                     in_section(band.z_upper_mm, band.to_mm), true);
    for (const SectionEdge& e : section_.edges)
      sheet_.line(in_section(e.z1_mm, e.x1_mm), in_section(e.z2_mm, e.x2_mm), Pen::kThick);
    for (const Slab& slab : part_.slabs) {
      draw_reference_lines(slab, slab.outer);
      for (const Outline& hole : slab.holes) draw_reference_lines(slab, hole);
    }
    sheet_.line(in_section(0.0, 0.0) - Point2(4.0, 0.0),
                in_section(length_, 0.0) + Point2(4.0, 0.0), Pen::kChain);
    // beside the extension line of a toleranced lower face
    const Point2 above = in_section(0.5 * length_, outer_) + Point2(0.0, 13.0);
    const double right_of_face = section_origin_.x() + 1.5 + 0.5 * text_width_mm("A-A", 3.5);
    sheet_.text({frames_.refer_to('B') ? std::max(above.x(), right_of_face) : above.x(), above.y()},
                "A-A", 3.5, TextAnchor::kMiddle);
  }

  void draw_reference_lines(const Slab& slab, const Outline& outline) {
    if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
      const double r = reference_radius_mm(teeth->profile->gear());
      for (double x : {-r, r})
        sheet_.line(in_section(slab.z_lower_mm, x) - Point2(2.0, 0.0),
                    in_section(slab.z_upper_mm, x) + Point2(2.0, 0.0), Pen::kChain);
    } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
      if (circle->centre.norm() > 1e-9 && std::abs(circle->centre.y()) < 1e-9)
        sheet_.line(in_section(slab.z_lower_mm, circle->centre.x()) - Point2(2.0, 0.0),
                    in_section(slab.z_upper_mm, circle->centre.x()) + Point2(2.0, 0.0),
                    Pen::kChain);
    }
  }

  void draw_face() {
    draw_view(sheet_, view_from_below({ViewedBody{.part = &part_}}), {face_centre_, scale_});
    const Point2 reach(outer_ * scale_ + 4.0, 0.0);
    sheet_.line(face_centre_ - reach, face_centre_ + reach, Pen::kChain);
    sheet_.line(face_centre_ - perpendicular(reach), face_centre_ + perpendicular(reach),
                Pen::kChain);
    // where the section is taken, seen from the right
    for (double up : {1.0, -1.0}) {
      const Point2 end = face_centre_ + Point2(0.0, up * (outer_ * scale_ + 4.0));
      sheet_.line(end, end + Point2(0.0, up * 4.0), Pen::kThick);
      sheet_.line(end + Point2(0.0, up * 2.0), end + Point2(7.0, up * 2.0), Pen::kThin);
      sheet_.arrow(end + Point2(0.3, up * 2.0), {-1.0, 0.0});
      sheet_.text(end + Point2(8.0, up * 2.0 - 1.4), "A", 3.5);
    }
    draw_hole_letters();
  }

  /// Circles of equal holes, and the letter of each kind at its first hole, outwards.
  void draw_hole_letters() {
    for (std::size_t i = 0; i < dimensions_.holes.size(); ++i) {
      const HolePattern& holes = dimensions_.holes[i];
      const bool several = holes.centres.size() > 1;
      double radius = 0.0;
      for (const HoleStep& step : holes.steps)
        radius = std::max(radius, 0.5 * scale_ * step.diameter_mm);
      // on the vertical axis the letter of the section is near
      const Point2 centre =
          in_face(holes.centres[several && std::abs(holes.centres[0].y()) < 1e-6 ? 1 : 0]);
      const Point2 outwards = (centre - face_centre_).normalized();
      // towards the axis where the letter would stand on the part's edge
      const Point2 away = (centre - face_centre_).norm() + radius + 5.0 > outer_ * scale_
                              ? Point2(-outwards)
                              : outwards;
      const Point2 aside(away.x() >= 0.0 ? 1.0 : -1.0, 0.0);
      sheet_.text(centre + (radius + 1.0) * away + 1.8 * aside - Point2(0.0, 1.2), hole_letter(i),
                  3.0, TextAnchor::kMiddle);
      if (several) {
        sheet_.circle(face_centre_, 0.5 * scale_ * holes.circle_diameter_mm, Pen::kChain);
        continue;
      }
      for (const Point2& arm : {Point2(radius + 1.5, 0.0), Point2(0.0, radius + 1.5)})
        sheet_.line(centre - arm, centre + arm, Pen::kChain);
    }
    if (dimensions_.holes.empty()) return;
    sheet_.text(face_centre_ + Point2(-4.0, outer_ * scale_ + 3.0), "x", 2.5);
    sheet_.text(face_centre_ + Point2(outer_ * scale_ + 2.0, 1.6), "y", 2.5);
  }

  void dimension_section() {
    double x = section_origin_.x() - kGap_mm;
    for (const PartDiameter& d : dimensions_.diameters) {
      const double r = 0.5 * d.diameter_mm;
      vertical_dimension(sheet_, {.from = in_section(d.z_mm, -r),
                                  .to = in_section(d.z_mm, r),
                                  .line_at_mm = x,
                                  .text = diameter_text(d)});
      if (d.datum && frames_.refer_to('A'))
        draw_datum(sheet_, {x, section_origin_.y() - r * scale_ - 1.0}, 'A');
      x -= kDimensionStep_mm;
    }
    const double y = section_origin_.y() - outer_ * scale_ - kGap_mm;
    std::vector<Dimension> lengths = lengths_below(section_origin_);
    const std::vector<int> rows = dimension_rows(lengths);
    for (std::size_t i = 0; i < lengths.size(); ++i)
      lengths[i].line_at_mm = y - kDimensionStep_mm * rows[i];
    move_texts_aside(lengths);
    for (const Dimension& length : lengths) horizontal_dimension(sheet_, length);
    const PartWidth& whole = dimensions_.widths.back();
    horizontal_dimension(sheet_, {.from = in_section(whole.z_lower_mm, -outer_),
                                  .to = in_section(whole.z_upper_mm, -outer_),
                                  .line_at_mm = y - kDimensionStep_mm * row_count(rows),
                                  .text = drawing_number(whole.width_mm(), 3)});
    frames_.draw(sheet_, {section_origin_, scale_}, top_of_texts());
  }

  /// Where the texts of small diameters end that are longer than their dimension.
  [[nodiscard]] double top_of_texts() const {
    double top = section_origin_.y() + outer_ * scale_;
    for (const PartDiameter& d : dimensions_.diameters)
      top = std::max(top, section_origin_.y() - 0.5 * d.diameter_mm * scale_ + 1.0 +
                              text_width_mm(diameter_text(d), 2.5));
    return top;
  }

  void draw_gear_table() {
    if (gears_.empty()) return;
    std::vector<TableColumn> columns = {{50.0, TextAnchor::kLeft}, {16.0, TextAnchor::kLeft, true}};
    for (std::size_t i = 0; i < table_.front().values.size(); ++i)
      columns.push_back({26.0, TextAnchor::kRight});
    std::vector<std::vector<std::string>> rows;
    for (const GearTableRow& row : table_) {
      rows.push_back({row.name, row.symbol});
      rows.back().insert(rows.back().end(), row.values.begin(), row.values.end());
    }
    draw_table(sheet_, {sheet_.width_mm - kBorder_mm, sheet_.height_mm - kBorder_mm}, columns,
               rows);
  }

  void draw_hole_table() {
    if (hole_rows_.empty()) return;
    const double below =
        table_.empty() ? 0.0 : kRowHeight_mm * static_cast<double>(table_.size()) + kTableGap_mm;
    draw_table(sheet_, {sheet_.width_mm - kBorder_mm, sheet_.height_mm - kBorder_mm - below},
               {{10.0, TextAnchor::kLeft},
                {10.0, TextAnchor::kRight},
                {50.0, TextAnchor::kLeft},
                {kHoleTableWidth_mm - kPositionWidth_mm - 70.0, TextAnchor::kLeft},
                {kPositionWidth_mm, TextAnchor::kLeft}},
               hole_rows_);
    std::size_t row = 0;
    for (std::size_t i = 0; i < dimensions_.holes.size(); ++i) {
      while (++row < hole_rows_.size() && hole_rows_[row][0] != hole_letter(i)) {
      }
      const Point2 corner(sheet_.width_mm - kBorder_mm - kPositionWidth_mm + 0.8,
                          sheet_.height_mm - kBorder_mm - below -
                              kRowHeight_mm * static_cast<double>(row + 1) + 0.3);
      for (const GeometricTolerance& t : dimensions_.of(ToleratedFeature::kHoles))
        if (t.pattern == i) draw_tolerance_small(sheet_, corner, t, kRowHeight_mm - 0.6);
    }
  }

  const DrawingModel& model_;
  const PartShape& part_;
  AxialSection section_;
  std::vector<const TrainGear*> gears_;
  std::vector<GearTableRow> table_;
  std::vector<std::vector<std::string>> hole_rows_;
  Workmanship made_;
  PartDimensions dimensions_;
  PartFrames frames_;
  Sheet sheet_;
  double length_ = 0.0, outer_ = 0.0, scale_ = 1.0;
  std::string scale_name_, sheet_size_;
  Point2 region_low_, region_high_, section_origin_, face_centre_;
};

}  // namespace

Sheet part_sheet(const DrawingModel& model, const PartShape& part) {
  return PartSheet(model, part).draw();
}

}  // namespace trueflank::io
