// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "trueflank/base/units.h"
#include "trueflank/export/section/section_contour.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/drawing/balloons.h"
#include "trueflank/report/drawing/drawn_part.h"
#include "trueflank/report/drawing/face_view.h"
#include "trueflank/report/drawing/sheet_frame.h"
#include "trueflank/report/drawing/workshop_drawings.h"
#include "trueflank/solid/shape/outline_loop.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank::io {
namespace {

constexpr double kDimensionRoom_mm = 14.0;  // left of the numbers, and below the section
constexpr double kNumberRoom_mm = 22.0;     // on each side of the section
constexpr double kTopRoom_mm = 12.0;

/// A row of the parts list: a part that is made, or all that is ordered by one designation.
struct ListedItem {
  std::vector<int> parts;  ///< indices into PartShapes::parts
  std::string bought;
  int without_body = 0;  ///< pieces that are ordered and not drawn: a set screw in its hub
};

class AssemblySheet {
 public:
  explicit AssemblySheet(const DrawingModel& model) : model_(model) {
    for (const Placement& placement : model.shapes->assembly) {
      for (const Slab& slab : part_of(placement).slabs) {
        const OutlineExtent size = extent(slab.outer);
        const Point2 centre = rotated(size.centre, placement.rotation_rad) + offset(placement), reach(size.outer_radius_mm, size.outer_radius_mm);
        box_.low = box_.low.cwiseMin(centre - reach);
        box_.high = box_.high.cwiseMax(centre + reach);
        // one circle about one axis encloses the whole: its diameter can be said
        if (size.outer_radius_mm > round_.radius_mm) round_ = {centre, size.outer_radius_mm};
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
    items_ = listed_items();
    choose_scale();
    double mass = 0.0;
    const auto rows = parts_list(mass);
    draw_frame(sheet_, {.part = "Assembly", .design = model_.train->design.name, .material = "see parts list",
                        .mass = std::isnan(mass) ? "" : drawing_number(1e3 * mass, 1) + " g" + (has_bought() ? " without bought parts" : ""),
                        .scale = scale_name_, .sheet_size = "A3  1/1"});
    draw_section();
    draw_numbers();
    draw_sizes();
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

  /// Made parts in their order, then what is ordered, by designation.
  [[nodiscard]] std::vector<ListedItem> listed_items() const {
    std::vector<ListedItem> made;
    std::map<std::string, ListedItem> ordered;
    for (std::size_t i = 0; i < model_.shapes->parts.size(); ++i) {
      const PartShape& part = model_.shapes->parts[i];
      ListedItem& item = part.bought.empty() ? made.emplace_back() : ordered[part.bought];
      item.bought = part.bought;
      item.parts.push_back(static_cast<int>(i));
    }
    if (const auto layout = machine_layout(*model_.train))
      for (const std::string& designation : bought_for_set_screw(layout->set_screw)) {
        ordered[designation].bought = designation;
        ++ordered[designation].without_body;
      }
    for (auto& [designation, item] : ordered) made.push_back(std::move(item));
    return made;
  }
  [[nodiscard]] bool has_bought() const {
    return std::any_of(items_.begin(), items_.end(), [](const ListedItem& item) { return !item.bought.empty(); });
  }

  void choose_scale() {
    const double lists = kTitleHeight_mm + kRowHeight_mm * static_cast<double>(items_.size() + 1);
    const double beside = kDimensionRoom_mm + 2.0 * kNumberRoom_mm + 20.0, above = kTopRoom_mm + kDimensionRoom_mm + 6.0;
    const Point2 room(sheet_.width_mm - kBorderLeft_mm - kBorder_mm, sheet_.height_mm - 2.0 * kBorder_mm - lists);
    Point2 size = Point2::Zero();
    for (const auto& [name, scale] : drawing_scales()) {
      scale_ = scale;
      scale_name_ = name;
      size = scale * Point2(high_ - low_ + box_.high.y() - box_.low.y(), box_.high.x() - box_.low.x()) + Point2(beside, above);
      if (size.x() <= room.x() && size.y() <= room.y()) break;
    }
    const Point2 spare = (room - size).cwiseMax(0.0);
    const double y = sheet_.height_mm - kBorder_mm - kTopRoom_mm - 0.4 * spare.y() - box_.high.x() * scale_;
    section_origin_ = {kBorderLeft_mm + 6.0 + kDimensionRoom_mm + kNumberRoom_mm + 0.25 * spare.x() - low_ * scale_, y};
    face_centre_ = {section_origin_.x() + high_ * scale_ + kNumberRoom_mm + 10.0 + 0.4 * spare.x() - box_.low.y() * scale_, y};
  }

  /// Bodies whose axis lies in the plane of the section; of the others nothing is cut.
  static bool in_plane(const Placement& placement) { return std::abs(placement.translation_mm[1]) < 1e-6; }

  [[nodiscard]] auto placed(const Placement& placement) const {
    const Point2 at = section_origin_ + scale_ * Point2(placement.translation_mm[2], placement.translation_mm[0]);
    return [at, scale = scale_](double z, double x) { return Point2(at + scale * Point2(z, x)); };
  }

  void draw_section() {
    for (const Placement& placement : model_.shapes->assembly) {
      if (!in_plane(placement)) continue;
      const PartShape& part = part_of(placement);
      const AxialSection section = axial_section(part);
      const auto place = placed(placement);
      for (const SectionBand& band : section.bands)
        if (!band.teeth) fill_band(placement.part, part, place(band.z_lower_mm, band.from_mm), place(band.z_upper_mm, band.to_mm));
      for (const SectionEdge& e : section.edges)
        sheet_.line(place(e.z1_mm, e.x1_mm), place(e.z2_mm, e.x2_mm), Pen::kThick);
      sheet_.line(place(part.slabs.front().z_lower_mm, 0.0) - Point2(3.0, 0.0),
                  place(part.slabs.back().z_upper_mm, 0.0) + Point2(3.0, 0.0), Pen::kChain);
    }
  }

  /// Hatching of a part that is made; screws, pins, inserts and motors are not cut (ISO 128-44), and a
  /// rolling bearing has the upright cross of ISO 8826-1.
  void fill_band(int number, const PartShape& part, const Point2& low, const Point2& high) {
    if (part.bought.empty()) return sheet_.hatch(low, high, number % 2 == 0, 1.6 + 0.5 * (number % 3));
    if (part.bought.find("bearing") == std::string::npos) return;
    const Point2 middle = 0.5 * (low + high);
    const double arm = 0.35 * (high - low).minCoeff();
    sheet_.line(middle - Point2(arm, 0.0), middle + Point2(arm, 0.0), Pen::kThin);
    sheet_.line(middle - Point2(0.0, arm), middle + Point2(0.0, arm), Pen::kThin);
  }

  /// Where the plane meets an item's bodies, the largest pieces first.
  [[nodiscard]] std::vector<Point2> places_of(const ListedItem& item) const {
    constexpr std::size_t kMost = 6;
    struct Piece {
      double least_mm;
      Point2 middle;
    };
    std::vector<Piece> pieces;
    for (const Placement& placement : model_.shapes->assembly) {
      if (!in_plane(placement) || std::find(item.parts.begin(), item.parts.end(), placement.part) == item.parts.end()) continue;
      const auto place = placed(placement);
      for (const SectionBand& band : axial_section(part_of(placement)).bands) {
        const Point2 low = place(band.z_lower_mm, band.from_mm), high = place(band.z_upper_mm, band.to_mm);
        pieces.push_back({(high - low).minCoeff(), 0.5 * (low + high)});
      }
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.least_mm > b.least_mm; });
    std::vector<Point2> places;
    for (const Piece& piece : pieces)
      if (places.size() < kMost && piece.least_mm > 0.3 * pieces.front().least_mm) places.push_back(piece.middle);
    return places;
  }

  /// Columns of item numbers on both sides of the section.
  void draw_numbers() {
    std::vector<Balloon> balloons;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      Balloon balloon{static_cast<int>(i) + 1, places_of(items_[i])};
      if (balloon.places.empty())
        unseen_ += (unseen_.empty() ? "" : ", ") + std::to_string(balloon.number);
      else
        balloons.push_back(std::move(balloon));
    }
    const double top = sheet_.height_mm - kBorder_mm - kBalloonRadius_mm - 2.0, middle = 0.5 * (box_.low.x() + box_.high.x());
    const double fitting = std::floor((box_.high.x() - box_.low.x()) * scale_ / kBalloonStep_mm), needed = std::ceil(0.5 * static_cast<double>(balloons.size()));
    const auto count = static_cast<int>(std::max({fitting, needed, 1.0}));
    const double first = std::min(top, section_origin_.y() + middle * scale_ + 0.5 * kBalloonStep_mm * (count - 1));
    std::vector<Point2> seats;
    for (double x : {section_origin_.x() + low_ * scale_ - kNumberRoom_mm + kBalloonRadius_mm, section_origin_.x() + high_ * scale_ + kNumberRoom_mm - kBalloonRadius_mm})
      for (int i = 0; i < count; ++i) seats.emplace_back(x, first - kBalloonStep_mm * i);
    draw_balloons(sheet_, balloons, seats);
  }

  void draw_sizes() {
    const auto corner = [&](double z, double x) { return Point2(section_origin_ + scale_ * Point2(z, x)); };
    const double below = box_.low.x(), above = box_.high.x();
    const bool round = std::abs(2.0 * round_.radius_mm - (above - below)) < 1e-6 && std::abs(round_.radius_mm + round_.centre.y() - box_.high.y()) < 1e-6;
    horizontal_dimension(sheet_, {.from = corner(low_, below), .to = corner(high_, below),
                                  .line_at_mm = section_origin_.y() + below * scale_ - 10.0, .text = drawing_number(high_ - low_, 3)});
    vertical_dimension(sheet_, {.from = corner(low_, below), .to = corner(low_, above),
                                .line_at_mm = section_origin_.x() + low_ * scale_ - kNumberRoom_mm - 6.0,
                                .text = (round ? "Ø" : "") + drawing_number(above - below, 3)});
  }

  void draw_face() {
    std::vector<ViewedBody> bodies;
    for (const Placement& placement : model_.shapes->assembly)
      bodies.push_back({&part_of(placement), placement.rotation_rad, offset(placement), placement.translation_mm[2]});
    std::vector<ViewedEdge> edges = view_from_below(bodies);
    // a set is read without what lies behind and without root circles
    std::erase_if(edges, [](const ViewedEdge& edge) { return edge.hidden || edge.pen == Pen::kThin; });
    draw_view(sheet_, edges, {face_centre_, scale_});
    for (const ViewedBody& body : bodies) {
      const bool seen = std::any_of(edges.begin(), edges.end(), [&](const ViewedEdge& edge) { return (edge.centre - body.offset).norm() < 1e-6; });
      if (!seen || body.offset.norm() < 1e-9 || gears_of(*model_.train, *body.part).empty()) continue;
      const Point2 centre = ViewPlace{face_centre_, scale_}(body.offset);
      const double reach = scale_ * extent(body.part->slabs.front().outer).outer_radius_mm + 3.0;
      sheet_.line(centre - Point2(reach, 0.0), centre + Point2(reach, 0.0), Pen::kChain);
      sheet_.line(centre - Point2(0.0, reach), centre + Point2(0.0, reach), Pen::kChain);
    }
    const Point2 low = face_centre_ + scale_ * Point2(box_.low.y(), box_.low.x()), high = face_centre_ + scale_ * Point2(box_.high.y(), box_.high.x());
    sheet_.line({low.x() - 4.0, face_centre_.y()}, {high.x() + 4.0, face_centre_.y()}, Pen::kChain);
    sheet_.line({face_centre_.x(), low.y() - 4.0}, {face_centre_.x(), high.y() + 4.0}, Pen::kChain);
  }

  [[nodiscard]] std::vector<std::vector<std::string>> parts_list(double& mass) const {
    std::vector<std::vector<std::string>> rows = {{"Item", "Count", "Part", "Material", "Mass each"}};
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const ListedItem& item = items_[i];
      const auto count = item.without_body + std::count_if(model_.shapes->assembly.begin(), model_.shapes->assembly.end(), [&](const Placement& p) {
        return std::find(item.parts.begin(), item.parts.end(), p.part) != item.parts.end();
      });
      rows.push_back({std::to_string(i + 1), std::to_string(count), item.bought, "to buy", ""});
      if (!item.bought.empty()) continue;
      const PartShape& part = model_.shapes->parts[static_cast<std::size_t>(item.parts.front())];
      const DrawnMaterial material = material_of(model_, part);
      mass += static_cast<double>(count) * material.mass_kg;
      std::string name = proper_name(part.name);
      for (const TrainGear* gear : gears_of(*model_.train, part))
        name += ", z " + std::to_string(gear->profile.gear().teeth);
      rows.back() = {std::to_string(i + 1), std::to_string(count), name, material.name, material.mass_text};
    }
    return rows;
  }

  [[nodiscard]] std::vector<std::string> notes() const {
    std::vector<std::string> all = {"Dimensions in mm. Teeth drawn by ISO 2203."};
    const auto& train = model_.report->at("train");
    if (train.at("centre_distance_mm").is_number())
      all.push_back("Centre distance " + drawing_number(train.at("centre_distance_mm").get<double>(), 4) + ".");
    if (train.contains("stages"))
      for (std::size_t s = 0; s < train.at("stages").size(); ++s)
        all.push_back("Centre distance of stage " + std::to_string(s + 1) + ": " +
                      drawing_number(train.at("stages")[s].at("centre_distance_mm").get<double>(), 4) + ".");
    if (train.at("ratio").is_number())
      all.push_back("Ratio " + drawing_number(train.at("ratio").get<double>(), 4) + ", output turns in the " +
                    train.at("direction").get<std::string>() + " direction.");
    if (!unseen_.empty()) {
      const bool several = unseen_.find(',') != std::string::npos;
      all.push_back("Not met by the plane of the section: " + std::string(several ? "items " : "item ") + unseen_ + ".");
    }
    return all;
  }

  const DrawingModel& model_;
  Sheet sheet_;
  Box2 box_;
  CircleOutline round_ = {.radius_mm = 0.0};  // the largest
  double low_ = 0.0, high_ = 0.0, scale_ = 1.0;
  std::string scale_name_, unseen_;
  std::vector<ListedItem> items_;
  Point2 section_origin_, face_centre_;
};

}  // namespace

Sheet assembly_sheet(const DrawingModel& model) { return AssemblySheet(model).draw(); }

}  // namespace trueflank::io
