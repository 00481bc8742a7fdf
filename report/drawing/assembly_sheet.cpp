// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "trueflank/base/units.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/drawing/drawn_part.h"
#include "trueflank/report/drawing/sheet_frame.h"
#include "trueflank/report/drawing/workshop_drawings.h"

namespace trueflank::io {
namespace {

constexpr double kBalloonRadius_mm = 4.0;

class AssemblySheet {
 public:
  explicit AssemblySheet(const DrawingModel& model) : model_(model) {
    for (const Placement& placement : model.shapes->assembly) {
      const PartShape& part = part_of(placement);
      for (const Slab& slab : part.slabs) {
        outer_ = std::max(outer_, outermost_mm(slab.outer) + offset(placement).norm());
        low_ = std::min(low_, placement.translation_mm[2] + slab.z_lower_mm);
        high_ = std::max(high_, placement.translation_mm[2] + slab.z_upper_mm);
      }
    }
  }

  Sheet draw() {
    sheet_.name = "assembly";
    sheet_.title = model_.train->design.name + ": assembly";
    sheet_.width_mm = 420.0;
    sheet_.height_mm = 297.0;
    choose_scale();
    double mass = 0.0;
    const auto rows = parts_list(mass);
    draw_frame(sheet_, {.part = "Assembly", .design = model_.train->design.name, .material = "see parts list",
                        .mass = std::isnan(mass) ? "" : drawing_number(1e3 * mass, 1) + " g",
                        .scale = scale_name_, .sheet_size = "A3  1/1"});
    draw_section();
    draw_face();
    const Point2 corner(sheet_.width_mm - kBorder_mm, kBorder_mm + kTitleHeight_mm + kRowHeight_mm * static_cast<double>(rows.size()));
    draw_table(sheet_, corner, {{10.0, TextAnchor::kRight}, {12.0, TextAnchor::kRight}, {70.0, TextAnchor::kLeft}, {60.0, TextAnchor::kLeft}, {28.0, TextAnchor::kRight}}, rows);
    draw_notes(sheet_, {kBorderLeft_mm + 3.0, kBorder_mm + 3.0}, notes());
    return std::move(sheet_);
  }

 private:
  [[nodiscard]] const PartShape& part_of(const Placement& placement) const {
    return model_.shapes->parts[static_cast<std::size_t>(placement.part)];
  }
  static Point2 offset(const Placement& placement) { return {placement.translation_mm[0], placement.translation_mm[1]}; }

  void choose_scale() {
    const double lists = kTitleHeight_mm + kRowHeight_mm * static_cast<double>(model_.shapes->parts.size() + 1);
    const Point2 room(sheet_.width_mm - kBorderLeft_mm - kBorder_mm, sheet_.height_mm - 2.0 * kBorder_mm - lists);
    for (const auto& [name, scale] : drawing_scales()) {
      scale_ = scale;
      scale_name_ = name;
      if ((high_ - low_ + 4.0 * outer_) * scale + 110.0 <= room.x() && 2.0 * outer_ * scale + 36.0 <= room.y()) break;
    }
    const double y = sheet_.height_mm - kBorder_mm - 18.0 - outer_ * scale_;
    section_origin_ = {kBorderLeft_mm + 45.0 - low_ * scale_ + 10.0, y};
    face_centre_ = {section_origin_.x() + high_ * scale_ + 45.0 + outer_ * scale_, y};
  }

  /// Bodies whose axis lies in the plane of the section; of the others nothing is cut.
  static bool in_plane(const Placement& placement) { return std::abs(placement.translation_mm[1]) < 1e-6; }

  void draw_section() {
    struct Item {
      int number;
      Point2 feature;
    };
    std::map<int, Item> items;  // by part: the first of its bodies that the plane meets
    for (const Placement& placement : model_.shapes->assembly) {
      if (!in_plane(placement)) continue;
      const PartShape& part = part_of(placement);
      const AxialSection section = axial_section(part);
      const Point2 at = section_origin_ + scale_ * Point2(placement.translation_mm[2], placement.translation_mm[0]);
      const auto place = [&](double z, double x) { return Point2(at + scale_ * Point2(z, x)); };
      for (const SectionBand& band : section.bands)
        if (!band.teeth)
          sheet_.hatch(place(band.z_lower_mm, band.from_mm), place(band.z_upper_mm, band.to_mm),
                       placement.part % 2 == 0, 1.6 + 0.5 * (placement.part % 3));
      for (const SectionEdge& e : section.edges)
        sheet_.line(place(e.z1_mm, e.x1_mm), place(e.z2_mm, e.x2_mm), Pen::kThick);
      sheet_.line(place(part.slabs.front().z_lower_mm, 0.0) - Point2(3.0, 0.0),
                  place(part.slabs.back().z_upper_mm, 0.0) + Point2(3.0, 0.0), Pen::kChain);
      if (section.bands.empty()) continue;
      const auto top = std::max_element(section.bands.begin(), section.bands.end(), [](const SectionBand& a, const SectionBand& b) {
        return a.teeth != b.teeth ? a.teeth : a.to_mm < b.to_mm;
      });
      items.try_emplace(placement.part,
                        Item{placement.part + 1, place(0.5 * (top->z_lower_mm + top->z_upper_mm), 0.5 * (top->from_mm + top->to_mm))});
    }
    std::vector<Item> sorted;
    for (const auto& [part, item] : items) sorted.push_back(item);
    std::sort(sorted.begin(), sorted.end(), [](const Item& a, const Item& b) { return a.feature.y() > b.feature.y(); });
    double y = section_origin_.y() + outer_ * scale_ + 4.0;
    for (const Item& item : sorted) {
      y = std::min(y - 2.0 * kBalloonRadius_mm - 3.0, item.feature.y() + 6.0);
      draw_balloon(item.number, item.feature, y);
    }
    horizontal_dimension(sheet_, {.from = section_origin_ + scale_ * Point2(low_, -outer_), .to = section_origin_ + scale_ * Point2(high_, -outer_),
                                  .line_at_mm = section_origin_.y() - outer_ * scale_ - 10.0, .text = drawing_number(high_ - low_, 3)});
    vertical_dimension(sheet_, {.from = section_origin_ + scale_ * Point2(low_, -outer_), .to = section_origin_ + scale_ * Point2(low_, outer_),
                                .line_at_mm = section_origin_.x() + low_ * scale_ - 42.0, .text = "Ø" + drawing_number(2.0 * outer_, 3)});
  }

  /// An item number left of the section, with a line to its part.
  void draw_balloon(int number, const Point2& feature, double y) {
    const Point2 centre(section_origin_.x() + low_ * scale_ - 20.0, y);
    const Point2 towards = (feature - centre).normalized();
    sheet_.circle(centre, kBalloonRadius_mm, Pen::kThin);
    sheet_.text(centre - Point2(0.0, 1.4), std::to_string(number), 3.0, TextAnchor::kMiddle);
    sheet_.line(centre + kBalloonRadius_mm * towards, feature, Pen::kThin);
    sheet_.arrow(feature, towards);
  }

  void draw_face() {
    const auto at = [&](const Point2& p) { return Point2(face_centre_ + scale_ * Point2(p.y(), p.x())); };
    for (const Placement& placement : model_.shapes->assembly)
      for (const Slab& slab : part_of(placement).slabs) {
        draw_circles(slab.outer, at(offset(placement)));
        for (const Outline& hole : slab.holes) draw_circles(hole, at(offset(placement)));
      }
    const Point2 reach(outer_ * scale_ + 4.0, 0.0);
    sheet_.line(face_centre_ - reach, face_centre_ + reach, Pen::kChain);
    sheet_.line(face_centre_ - perpendicular(reach), face_centre_ + perpendicular(reach), Pen::kChain);
  }

  /// Bodies concentric with `centre`, seen through each other: tip, reference and bore circles.
  void draw_circles(const Outline& outline, const Point2& centre) {
    if (const auto* teeth = std::get_if<ToothedOutline>(&outline)) {
      once(centre, scale_ * teeth->profile->tip_radius_mm(), Pen::kThick);
      once(centre, scale_ * reference_radius_mm(teeth->profile->gear()), Pen::kChain);
    } else if (const auto* circle = std::get_if<CircleOutline>(&outline)) {
      if (circle->centre.norm() < 1e-9) once(centre, scale_ * circle->radius_mm, Pen::kThick);
    } else {
      once(centre, 0.5 * scale_ * std::get<BoreOutline>(outline).bore.diameter_mm, Pen::kThick);
    }
  }
  void once(const Point2& centre, double radius, Pen pen) {
    const bool there = std::any_of(sheet_.arcs.begin(), sheet_.arcs.end(), [&](const SheetArc& a) {
      return a.pen == pen && (a.centre - centre).norm() < 1e-6 && std::abs(a.radius_mm - radius) < 1e-6;
    });
    if (!there) sheet_.circle(centre, radius, pen);
  }

  [[nodiscard]] std::vector<std::vector<std::string>> parts_list(double& mass) const {
    std::vector<std::vector<std::string>> rows = {{"Item", "Count", "Part", "Material", "Mass each"}};
    for (std::size_t i = 0; i < model_.shapes->parts.size(); ++i) {
      const PartShape& part = model_.shapes->parts[i];
      const auto count = std::count_if(model_.shapes->assembly.begin(), model_.shapes->assembly.end(),
                                       [&](const Placement& p) { return p.part == static_cast<int>(i); });
      const DrawnMaterial material = material_of(model_, part);
      mass += static_cast<double>(count) * material.mass_kg;
      std::string name = proper_name(part.name);
      for (const TrainGear* gear : gears_of(*model_.train, part))
        name += ", z " + std::to_string(gear->profile.gear().teeth);
      rows.push_back({std::to_string(i + 1), std::to_string(count), name, material.name, material.mass_text});
    }
    return rows;
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all = {"Dimensions in mm. Teeth drawn by ISO 2203."};
    const auto& train = model_.report->at("train");
    if (train.at("centre_distance_mm").is_number())
      all.push_back("Centre distance " + drawing_number(train.at("centre_distance_mm").get<double>(), 4) + ".");
    if (train.at("ratio").is_number())
      all.push_back("Ratio " + drawing_number(train.at("ratio").get<double>(), 4) + ", output turns in the " +
                    train.at("direction").get<std::string>() + " direction.");
    return all;
  }

  const DrawingModel& model_;
  Sheet sheet_;
  double outer_ = 0.0, low_ = 0.0, high_ = 0.0, scale_ = 1.0;
  std::string scale_name_;
  Point2 section_origin_, face_centre_;
};

}  // namespace

Sheet assembly_sheet(const DrawingModel& model) { return AssemblySheet(model).draw(); }

}  // namespace trueflank::io
