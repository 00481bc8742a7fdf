// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/mesh_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "trueflank/check/quantity_text.h"
#include "trueflank/geometry/polyline.h"

namespace trueflank {
namespace {

constexpr double kChord = 2e-3;      // of the module
constexpr double kInsetChord = 5e-4;  // of the inset's half width
constexpr const char *kColour1 = "#2b6cb0", *kColour2 = "#b7791f", *kBad = "#c53030";

/// A window on the plane: millimetres to pixels, y up.
struct View {
  Point2 centre_mm = Point2::Zero();
  double half_width_mm = 1.0, half_height_mm = 1.0;
  double scale = 1.0;                 ///< px per mm
  double left_px = 0.0, top_px = 0.0;

  [[nodiscard]] Point2 px(const Point2& p) const {
    return {left_px + (p.x() - centre_mm.x() + half_width_mm) * scale,
            top_px + (centre_mm.y() - p.y() + half_height_mm) * scale};
  }
  [[nodiscard]] bool near(const Point2& p, double slack_mm) const {
    return std::abs(p.x() - centre_mm.x()) < half_width_mm + slack_mm &&
           std::abs(p.y() - centre_mm.y()) < half_height_mm + slack_mm;
  }
};

std::string px_text(double value) { return number_text(value, 3); }
std::string point_text(const Point2& p) { return px_text(p.x()) + "," + px_text(p.y()); }

std::string path(const View& view, const std::vector<Point2>& points, const std::string& style) {
  std::string d;
  for (const Point2& p : points) d += (d.empty() ? "M" : " L") + point_text(view.px(p));
  return "<path d=\"" + d + "\" style=\"" + style + "\"/>\n";
}

std::string circle(const View& view, const Point2& centre, double radius_mm, const char* style) {
  const Point2 c = view.px(centre);
  return "<circle cx=\"" + px_text(c.x()) + "\" cy=\"" + px_text(c.y()) + "\" r=\"" +
         px_text(radius_mm * view.scale) + "\" style=\"" + style + "\"/>\n";
}

/// One gear in the picture.
struct Drawn {
  const ToothProfile& profile;
  double rotation_rad;
  Point2 axis;
  const char* colour;
};

/// The teeth that a view shows, as one open outline closed through the body of the gear.
std::string teeth(const View& view, const Drawn& gear, double chord_mm) {
  const int z = gear.profile.gear().teeth;
  const double pitch = kTwoPi / z;
  const HalfToothPolyline half = tessellate(gear.profile, chord_mm);
  const HalfToothPolyline clockwise =
      gear.profile.symmetric() ? half : tessellate(gear.profile.mirror_image(), chord_mm);
  const double slack = 3.0 * gear.profile.gear().normal_module_mm;
  const Point2 towards = view.centre_mm - gear.axis;
  const int middle = static_cast<int>(
      std::lround((polar_angle_rad(towards) - gear.rotation_rad) / pitch));
  std::vector<Point2> outline;
  for (int k = middle - z / 2; k <= middle + (z - 1) / 2; ++k) {
    const double turn = gear.rotation_rad + pitch * k;
    if (!view.near(gear.axis + gear.profile.tip_radius_mm() * unit_vector(turn), slack)) continue;
    for (auto p = clockwise.points.rbegin(); p != clockwise.points.rend(); ++p)
      outline.push_back(gear.axis + rotated(mirrored(*p), turn));
    for (const Point2& p : half.points) outline.push_back(gear.axis + rotated(p, turn));
  }
  if (outline.empty()) return "";
  // the body: inwards for an external gear, outwards for a ring
  const bool external = gear.profile.gear().kind == GearKind::kExternal;
  const double module = gear.profile.gear().normal_module_mm;
  const double back = gear.profile.root_radius_mm() + (external ? -4.0 : 4.0) * module;
  const double first = polar_angle_rad(Point2(outline.front() - gear.axis));
  double last = polar_angle_rad(Point2(outline.back() - gear.axis));
  if (last < first) last += kTwoPi;
  for (int i = 48; i >= 0; --i)
    outline.push_back(gear.axis + std::max(back, 0.0) * unit_vector(first + (last - first) * i / 48.0));
  return path(view, outline,
              std::string("fill:") + gear.colour + ";fill-opacity:0.18;stroke:" + gear.colour +
                  ";stroke-width:1.2");
}

/// Both flanks of the teeth in view, between the radii that touch the mate.
std::string active_profile(const View& view, const Drawn& gear, double from_mm, double to_mm) {
  const Gear& g = gear.profile.gear();
  const double r_b = base_radius_mm(g);
  const double low = std::max(std::min(from_mm, to_mm), r_b), high = std::max(from_mm, to_mm);
  if (!(high > low)) return "";
  std::string text;
  for (int k = 0; k < g.teeth; ++k) {
    const double turn = gear.rotation_rad + kTwoPi * k / g.teeth;
    if (!view.near(gear.axis + gear.profile.tip_radius_mm() * unit_vector(turn), g.normal_module_mm))
      continue;
    for (const double side : {1.0, -1.0}) {
      std::vector<Point2> line;
      for (int i = 0; i <= 16; ++i) {
        const double r = low + (high - low) * i / 16.0;
        line.push_back(gear.axis + r * unit_vector(turn + side * tooth_half_angle_rad(g, r)));
      }
      text += path(view, line, std::string("fill:none;stroke:") + gear.colour + ";stroke-width:2.6");
    }
  }
  return text;
}

/// Line of action of the left flank of gear 1 (driving clockwise) and its mirror image.
std::string action(const View& view, const GearPair& pair) {
  const LineOfAction line = line_of_action(pair);
  const double alpha = working_pressure_angle_rad(pair);
  const double r_b = base_radius_mm(pair.gear1());
  std::string text;
  for (const double side : {1.0, -1.0}) {
    const Point2 foot = r_b * unit_vector(side * alpha);
    const Point2 along = -side * perpendicular(unit_vector(side * alpha));
    const auto at = [&](double roll) { return Point2(foot + roll * along); };
    const double beyond = 2.0 * pair.gear1().normal_module_mm;
    text += path(view, {at(line.start_mm - beyond), at(line.end_mm + beyond)},
                 "fill:none;stroke:#718096;stroke-width:0.8;stroke-dasharray:5 4");
    if (line.effective_end_mm > line.effective_start_mm)
      text += path(view, {at(line.effective_start_mm), at(line.effective_end_mm)},
                   "fill:none;stroke:#2f855a;stroke-width:2");
  }
  return text;
}

std::string label(double x, double y, const std::string& text, const char* colour, double size = 13.0) {
  std::string safe;
  for (char c : text)
    safe += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  return "<text x=\"" + px_text(x) + "\" y=\"" + px_text(y) + "\" style=\"font:" + px_text(size) +
         "px sans-serif;fill:" + colour + "\">" + safe + "</text>\n";
}

std::string clip(const char* id, const View& view) {
  return std::string("<clipPath id=\"") + id + "\"><rect x=\"" + px_text(view.left_px) + "\" y=\"" +
         px_text(view.top_px) + "\" width=\"" + px_text(2.0 * view.half_width_mm * view.scale) +
         "\" height=\"" + px_text(2.0 * view.half_height_mm * view.scale) + "\"/></clipPath>\n";
}

std::string frame(const View& view, const char* colour) {
  return "<rect x=\"" + px_text(view.left_px) + "\" y=\"" + px_text(view.top_px) + "\" width=\"" +
         px_text(2.0 * view.half_width_mm * view.scale) + "\" height=\"" +
         px_text(2.0 * view.half_height_mm * view.scale) + "\" style=\"fill:none;stroke:" + colour +
         "\"/>\n";
}

/// A bar as long as the clearance, in the scale of the inset, or a round length.
std::string scale_bar(const View& view, double length_mm, const std::string& text, const char* colour) {
  const double x = view.left_px + 10.0;
  const double y = view.top_px + 2.0 * view.half_height_mm * view.scale - 12.0;
  return "<path d=\"M" + px_text(x) + "," + px_text(y) + " h" + px_text(length_mm * view.scale) +
         "\" style=\"stroke:" + colour + ";stroke-width:4\"/>\n" +
         label(x + length_mm * view.scale + 8.0, y + 4.0, text, colour, 12.0);
}

}  // namespace

std::string mesh_picture_svg(const GearPair& pair, const MeshClearance& clearance,
                             const MeshPictureOptions& options) {
  const double m = pair.gear1().normal_module_mm;
  const double pitch1 = pitch_radius1_mm(pair), pitch2 = pitch_radius2_mm(pair);
  const Point2 axis2(pair.internal() ? -pair.centre_distance_mm : pair.centre_distance_mm, 0.0);
  const double ratio = static_cast<double>(pair.gear1().teeth) / pair.gear2().teeth;
  const MeshPlace& place = clearance.place;
  const Drawn gear1{*pair.profile1, place.rotation1_rad + options.turn_rad, Point2::Zero(), kColour1};
  const Drawn gear2{*pair.profile2,
                    place.rotation2_rad + (pair.internal() ? ratio : -ratio) * options.turn_rad, axis2,
                    kColour2};

  View view;
  const double half = std::max(5.0 * m, std::abs(place.point_mm.y()) + 3.0 * m);
  view.centre_mm = {pitch1, 0.0};
  if (std::abs(place.point_mm.x() - pitch1) > 3.0 * m)
    view.centre_mm.x() = 0.5 * (pitch1 + place.point_mm.x());
  view.half_width_mm = view.half_height_mm =
      std::max(half, std::abs(place.point_mm.x() - view.centre_mm.x()) + 3.0 * m);
  const double side_px = 0.62 * options.width_px;
  view.scale = side_px / (2.0 * view.half_width_mm);
  view.top_px = 34.0;

  View inset;
  const double size = std::clamp(6.0 * std::abs(clearance.clearance_mm), 2e-3 * m, 1.2 * m);
  inset.centre_mm = place.point_mm;
  inset.half_width_mm = inset.half_height_mm = size;
  const double inset_px = options.width_px - side_px - 12.0;
  inset.scale = inset_px / (2.0 * size);
  inset.left_px = side_px + 12.0;
  inset.top_px = 34.0;

  const bool bad = clearance.clearance_mm < 0.0;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " +
                    px_text(options.width_px) + " " + px_text(side_px + 44.0) + "\">\n" +
                    "<rect width=\"100%\" height=\"100%\" style=\"fill:#fff\"/>\n<defs>" +
                    clip("view", view) + clip("inset", inset) + "</defs>\n";
  svg += label(8.0, 22.0,
               options.name1 + " and " + options.name2 + ": " +
                   (bad ? "penetration " + um_text(clearance.penetration_mm())
                        : "smallest clearance " + um_text(clearance.minimum_clearance_mm())),
               bad ? kBad : "#1a202c", 15.0);
  svg += "<g clip-path=\"url(#view)\">\n" + teeth(view, gear1, kChord * m) +
         teeth(view, gear2, kChord * m);
  constexpr const char* kThin = "fill:none;stroke:#a0aec0;stroke-width:0.7";
  constexpr const char* kPitch = "fill:none;stroke:#a0aec0;stroke-width:0.7;stroke-dasharray:8 3 2 3";
  svg += circle(view, Point2::Zero(), base_radius_mm(pair.gear1()), kThin) +
         circle(view, axis2, base_radius_mm(pair.gear2()), kThin) +
         circle(view, Point2::Zero(), pitch1, kPitch) + circle(view, axis2, pitch2, kPitch);
  svg += active_profile(view, gear1,
                        std::max(start_of_active_profile1_mm(pair), pair.profile1->root_form_radius_mm()),
                        pair.profile1->tip_form_radius_mm());
  const double start2 = start_of_active_profile2_mm(pair), form2 = pair.profile2->root_form_radius_mm();
  svg += active_profile(view, gear2, pair.internal() ? std::min(start2, form2) : std::max(start2, form2),
                        pair.profile2->tip_form_radius_mm());
  svg += action(view, pair) + circle(view, place.point_mm, 0.18 * m,
                                     "fill:none;stroke:#c53030;stroke-width:1.6") + "</g>\n";
  svg += "<g clip-path=\"url(#inset)\">\n" + teeth(inset, gear1, kInsetChord * size) +
         teeth(inset, gear2, kInsetChord * size) + "</g>\n" + frame(view, "#cbd5e0") + frame(inset, kBad);
  const double exact = std::abs(clearance.clearance_mm);
  svg += exact > 0.0 ? scale_bar(inset, exact, um_text(exact), bad ? kBad : "#2f855a")
                     : scale_bar(inset, 0.5 * size, um_text(0.5 * size), "#4a5568");
  svg += label(inset.left_px, inset.top_px + inset_px + 20.0,
               options.name1 + ": diameter " + mm_text(2.0 * place.radius1_mm), kColour1) +
         label(inset.left_px, inset.top_px + inset_px + 38.0,
               options.name2 + ": diameter " + mm_text(2.0 * place.radius2_mm), kColour2) +
         label(inset.left_px, inset.top_px + inset_px + 56.0,
               "magnified " + number_text(inset.scale / view.scale, 0) + " times", "#4a5568") +
         label(inset.left_px, inset.top_px + inset_px + 74.0,
               "green: path of contact; thick: active profile", "#4a5568");
  return svg + "</svg>\n";
}

}  // namespace trueflank
