// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/part_frames.h"

#include <algorithm>
#include <cmath>

#include "trueflank/report/drawing/axial_section.h"

namespace trueflank::io {
namespace {

constexpr double kLeaderRise_mm = 3.0;  // of the first frame over the part

double width_of(const std::vector<GeometricTolerance>& frames) {
  double width = 0.0;
  for (const GeometricTolerance& t : frames) width = std::max(width, frame_width_mm(t));
  return width;
}
/// Roughness of a face by what it is toleranced to; empty: the general one.
std::string face_surface(const std::vector<GeometricTolerance>& frames) {
  double ra = kGeneralRoughness_um;
  for (const GeometricTolerance& t : frames)
    if (t.kind != ToleranceKind::kCircularRunout)
      ra = std::min(ra, roughness_um(1000.0 * t.value_mm));
  return ra < kGeneralRoughness_um ? "Ra " + drawing_number(ra, 2) : std::string();
}
}  // namespace

Removal removal_of(const Workmanship& made) {
  return made.making == Making::kPrinted ? Removal::kForbidden : Removal::kRequired;
}

PartFrames::PartFrames(const PartShape& part, const PartDimensions& dimensions,
                       const Workmanship& made)
    : part_(part), dimensions_(dimensions), made_(made), seats_(seat_frames()) {}

double PartFrames::left_room_mm() const {
  double room = 0.0;
  for (const SeatFrames& seat : seats_)
    room = std::max(room, seat.from_part_mm + width_of(seat.tolerances) + 4.0);
  return room;
}

double PartFrames::above_mm() const {
  double height = kLeaderRise_mm;
  for (const SeatFrames& seat : seats_) height += height_of(seat);
  return height;
}

double PartFrames::height_of(const SeatFrames& seat) {
  return kFrameHeight_mm * static_cast<double>(seat.tolerances.size()) +
         (seat.surface.empty() ? 0.0 : kSurfaceHeight_mm + 0.5) + 1.5;
}

bool PartFrames::refer_to(char datum) const {
  return std::any_of(dimensions_.tolerances.begin(), dimensions_.tolerances.end(),
                     [&](const GeometricTolerance& t) { return t.datum == datum; });
}

bool PartFrames::have_surfaces() const {
  return std::any_of(seats_.begin(), seats_.end(),
                     [](const SeatFrames& s) { return !s.surface.empty(); }) ||
         !flank_surface().empty() ||
         !face_surface(dimensions_.of(ToleratedFeature::kUpperFace)).empty();
}

double PartFrames::outer_mm() const {
  double outer = 0.0;
  for (const Slab& slab : part_.slabs) outer = std::max(outer, outermost_mm(slab.outer));
  return outer;
}

void PartFrames::draw(Sheet& sheet, const SectionPlace& place, double top_mm) const {
  draw_tip_runouts(sheet, place);
  draw_upper_face(sheet, place);
  draw_seats(sheet, place, top_mm);
  draw_flank_surface(sheet, place);
}

/// The frames stand above each other, that of the rightmost gear lowest: no leader crosses
/// another.
void PartFrames::draw_tip_runouts(Sheet& sheet, const SectionPlace& place) const {
  Point2 corner(place.origin.x() + length_mm() * place.scale + 3.0,
                place.origin.y() + outer_mm() * place.scale + 2.0);
  const auto tips = dimensions_.of(ToleratedFeature::kTips);
  for (auto tip = tips.rbegin(); tip != tips.rend(); ++tip) {
    const Point2 feature =
        place(0.5 * (tip->z_lower_mm + tip->z_upper_mm), tip->gear->profile.tip_radius_mm());
    draw_tolerance(sheet, corner, *tip);
    sheet.line(corner + Point2(0.0, 3.0), {feature.x(), corner.y() + 3.0}, Pen::kThin);
    sheet.line({feature.x(), corner.y() + 3.0}, feature, Pen::kThin);
    sheet.arrow(feature, {0.0, -1.0});
    corner.y() += kFrameHeight_mm;
  }
}

/// Between the views, where the upper face has material: its frames under each other, datum B
/// below them.
void PartFrames::draw_upper_face(Sheet& sheet, const SectionPlace& place) const {
  const auto frames = dimensions_.of(ToleratedFeature::kUpperFace);
  if (frames.empty()) return;
  double from = 0.0, to = 0.0;
  for (const SectionBand& band : axial_section(part_).bands)
    if (!band.teeth && band.z_upper_mm == length_mm() && band.to_mm > to) {
      from = std::max(0.0, band.from_mm);
      to = band.to_mm;
    }
  const std::string surface = face_surface(frames);
  const double below_tips = surface.empty() ? 3.0 : 4.0 + kSurfaceHeight_mm;
  const Point2 feature = place(length_mm(), 0.5 * (from + to)), bend = feature + Point2(3.0, 0.0);
  const Point2 frame(bend.x(),
                     std::min(bend.y(), place.origin.y() + outer_mm() * place.scale - below_tips));
  sheet.line(feature, bend, Pen::kThin);
  sheet.line(bend, frame, Pen::kThin);
  sheet.line(frame, frame + Point2(2.0, 0.0), Pen::kThin);
  sheet.arrow(feature, {-1.0, 0.0});
  Point2 corner = frame + Point2(2.0, -0.5 * kFrameHeight_mm);
  if (!surface.empty())
    draw_surface(sheet, corner + Point2(3.0, kFrameHeight_mm), surface, removal_of(made_));
  for (const GeometricTolerance& t : frames) {
    draw_tolerance(sheet, corner, t);
    corner.y() -= kFrameHeight_mm;
  }
  if (refer_to('B')) draw_datum(sheet, corner + Point2(8.0, kFrameHeight_mm), 'B');
}

/// The outermost dimension line first: its frames are the lowest, and no leader crosses another's
/// frame.
std::vector<PartFrames::SeatFrames> PartFrames::seat_frames() const {
  constexpr double kBesideDimension_mm = 2.6;
  std::vector<SeatFrames> all;
  const auto seats = dimensions_.of(ToleratedFeature::kSeat);
  for (std::size_t i = dimensions_.diameters.size(); i-- > 0;) {
    const PartDiameter& d = dimensions_.diameters[i];
    SeatFrames frames{
        .from_part_mm = kGap_mm + kDimensionStep_mm * static_cast<double>(i) - kBesideDimension_mm,
        .radius_mm = 0.5 * d.diameter_mm};
    for (const GeometricTolerance& t : seats)
      if (t.diameter_mm == d.diameter_mm && t.hole == d.hole) frames.tolerances.push_back(t);
    if (frames.tolerances.empty()) continue;
    frames.surface = "Ra " + drawing_number(seat_roughness_um(d.limits.fit), 2);
    all.push_back(std::move(frames));
  }
  if (auto lower = dimensions_.of(ToleratedFeature::kLowerFace); !lower.empty())
    all.push_back(
        {.tolerances = lower, .surface = face_surface(lower), .from_part_mm = 4.0, .face = true});
  return all;
}

void PartFrames::draw_seats(Sheet& sheet, const SectionPlace& place, double top_mm) const {
  double y = top_mm + kLeaderRise_mm;
  for (const SeatFrames& seat : seats_) {
    draw_seat(sheet, place, seat, y);
    y += height_of(seat);
  }
}

void PartFrames::draw_seat(Sheet& sheet, const SectionPlace& place, const SeatFrames& seat,
                           double y_mm) const {
  const double x = place.origin.x() - seat.from_part_mm, middle = y_mm + 0.5 * kFrameHeight_mm;
  Point2 corner(x - 2.0 - width_of(seat.tolerances), y_mm);
  for (auto t = seat.tolerances.rbegin(); t != seat.tolerances.rend(); ++t) {
    draw_tolerance(sheet, corner, *t);
    corner.y() += kFrameHeight_mm;
  }
  if (!seat.surface.empty())
    draw_surface(sheet, corner + Point2(3.0, 0.0), seat.surface, removal_of(made_));
  const Point2 feature = seat.face ? Point2(place.origin.x(), middle)
                                   : place(0.0, seat.radius_mm) - Point2(seat.from_part_mm, 0.0);
  sheet.line({x - 2.0, middle}, {seat.face ? feature.x() : x, middle}, Pen::kThin);
  if (seat.face)
    sheet.line({feature.x(), place(0.0, outermost_mm(part_.slabs.front().outer)).y() + 0.8},
               {feature.x(), middle + 1.6}, Pen::kThin);
  else
    sheet.line({x, middle}, feature, Pen::kThin);
  sheet.arrow(feature, seat.face ? Point2(1.0, 0.0) : Point2(0.0, -1.0));
}

/// Of the gear that ends at the upper face; that of all stands in the table.
const TrainGear* PartFrames::rightmost_gear() const {
  for (const GeometricTolerance& t : dimensions_.of(ToleratedFeature::kTips))
    if (t.z_upper_mm > length_mm() - 1e-9) return t.gear;
  return nullptr;
}
std::string PartFrames::flank_surface() const {
  const TrainGear* gear = rightmost_gear();
  if (!gear || std::isnan(flank_roughness_um(*gear, made_))) return {};
  return "Ra " + flank_surface_text(*gear, made_);
}
/// On the line of the reference circle (ISO 1340).
void PartFrames::draw_flank_surface(Sheet& sheet, const SectionPlace& place) const {
  const std::string words = flank_surface();
  if (words.empty()) return;
  const Point2 line = place(length_mm(), -reference_radius_mm(rightmost_gear()->profile.gear()));
  sheet.line(line + Point2(2.0, 0.0), line + Point2(9.0, 0.0), Pen::kThin);
  draw_surface(sheet, line + Point2(6.0, 0.0), words, removal_of(made_));
}

}  // namespace trueflank::io
