// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/export/part_dimensions.h"
#include "trueflank/report/drawing/sheet.h"
#include "trueflank/report/drawing/tolerance_frames.h"

// Tolerance frames and surface signs about the section of a part, and the room they take.
namespace trueflank::io {

// Dimension lines of diameters stand left of the section: the first this far, then step by step.
inline constexpr double kGap_mm = 12.0, kDimensionStep_mm = 8.0;

/// Where the section stands on the sheet: its axis at z = 0.
struct SectionPlace {
  Point2 origin = Point2::Zero();
  double scale = 1.0;
  [[nodiscard]] Point2 operator()(double z_mm, double x_mm) const {
    return origin + scale * Point2(z_mm, x_mm);
  }
};

[[nodiscard]] Removal removal_of(const Workmanship& made);

/// Of one part; refers to what it is made of.
class PartFrames {
 public:
  PartFrames(const PartShape& part, const PartDimensions& dimensions, const Workmanship& made);

  /// Left of the section and above it, on paper.
  [[nodiscard]] double left_room_mm() const;
  [[nodiscard]] double above_mm() const;
  /// Whether a tolerance has this datum.
  [[nodiscard]] bool refer_to(char datum) const;
  /// Whether a surface has a sign of its own.
  [[nodiscard]] bool have_surfaces() const;

  /// Tips to the upper right, the upper face to the right, seats and the lower face to the upper
  /// left, above `top_mm`, the flanks' surface on the reference line.
  void draw(Sheet& sheet, const SectionPlace& place, double top_mm) const;

 private:
  /// Frames of one seat, or of the lower face, and where their leader goes.
  struct SeatFrames {
    std::vector<GeometricTolerance> tolerances;
    std::string surface;
    double from_part_mm = 0.0;  ///< of the leader, left of the part
    double radius_mm = 0.0;     ///< of the seat
    bool face = false;
  };
  static double height_of(const SeatFrames& seat);
  [[nodiscard]] std::vector<SeatFrames> seat_frames() const;
  [[nodiscard]] double outer_mm() const;
  [[nodiscard]] double length_mm() const { return part_.slabs.back().z_upper_mm; }
  [[nodiscard]] const TrainGear* rightmost_gear() const;
  [[nodiscard]] std::string flank_surface() const;
  void draw_tip_runouts(Sheet& sheet, const SectionPlace& place) const;
  void draw_upper_face(Sheet& sheet, const SectionPlace& place) const;
  void draw_seats(Sheet& sheet, const SectionPlace& place, double top_mm) const;
  void draw_seat(Sheet& sheet, const SectionPlace& place, const SeatFrames& seat,
                 double y_mm) const;
  void draw_flank_surface(Sheet& sheet, const SectionPlace& place) const;

  const PartShape& part_;
  const PartDimensions& dimensions_;
  const Workmanship& made_;
  std::vector<SeatFrames> seats_;
};

}  // namespace trueflank::io
