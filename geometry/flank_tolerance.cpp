// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/flank_tolerance.h"

#include <cmath>

#include "trueflank/base/number_text.h"

namespace trueflank {
namespace {

/// 5.2.3: above 10 um to 1 um, from 5 um to 10 um to 0.5 um, below to 0.1 um.
double rounded_um(double value_um) {
  const double step = value_um > 10.0 ? 1.0 : value_um >= 5.0 ? 0.5 : 0.1;
  const double steps_per_um = step == 0.1 ? 10.0 : 1.0 / step;
  return std::round(value_um * steps_per_um) / steps_per_um;
}

std::string number(double value) { return printed("%.6g", value); }

Status in_scope(const char* what, double value, double least, double most) {
  if (value >= least && value <= most) return {};
  return fail({.code = ErrorCode::kOutOfRange,
               .message = std::string("ISO 1328-1 has no tolerances for ") + what + " " +
                          number(value),
               .value = number(value),
               .remedy = "its scope is " + number(least) + " to " + number(most)});
}

Status in_scope(const ToleranceSize& size) {
  // a module of 0.5 written in decimal must not fall out by rounding
  constexpr double kSlack = 1e-9;
  if (auto ok = in_scope("a tooth count of", size.teeth, 5, 1000); !ok) return ok;
  if (auto ok = in_scope("a reference diameter in mm of", size.reference_diameter_mm, 5.0 - kSlack,
                         15000.0);
      !ok)
    return ok;
  if (auto ok = in_scope("a normal module in mm of", size.normal_module_mm, 0.5 - kSlack, 70.0); !ok)
    return ok;
  if (auto ok = in_scope("a face width in mm of", size.face_width_mm, 4.0 - kSlack, 1200.0); !ok)
    return ok;
  return in_scope("a helix angle in deg of", std::abs(deg_from_rad(size.helix_angle_rad)), 0.0,
                  45.0 + kSlack);
}

}  // namespace

ToleranceSize tolerance_size(const Gear& gear, double face_width_mm) {
  return {.teeth = gear.teeth,
          .reference_diameter_mm = 2.0 * reference_radius_mm(gear),
          .normal_module_mm = gear.normal_module_mm,
          .face_width_mm = face_width_mm,
          .helix_angle_rad = gear.helix_angle_rad};
}

Result<FlankTolerances> flank_tolerances(const ToleranceSize& size, int tolerance_class) {
  if (auto ok = in_scope("a tolerance class of", tolerance_class, kFinestToleranceClass,
                         kCoarsestToleranceClass);
      !ok)
    return fail(ok.error());
  if (auto ok = in_scope(size); !ok) return fail(ok.error());
  const double d = size.reference_diameter_mm, m_n = size.normal_module_mm, b = size.face_width_mm;
  const double root_d = std::sqrt(d), root_b = std::sqrt(b);
  const double step = std::pow(2.0, 0.5 * (tolerance_class - 5));

  const double f_p = step * (0.001 * d + 0.4 * m_n + 5.0);
  const double F_p = step * (0.002 * d + 0.55 * root_d + 0.7 * m_n + 12.0);
  const double f_Ha = step * (0.4 * m_n + 0.001 * d + 4.0);
  const double f_fa = step * (0.55 * m_n + 5.0);
  const double f_Hb = step * (0.05 * root_d + 0.35 * root_b + 4.0);
  const double f_fb = step * (0.07 * root_d + 0.45 * root_b + 4.0);
  return FlankTolerances{.single_pitch_um = rounded_um(f_p),
                         .total_cumulative_pitch_um = rounded_um(F_p),
                         .profile_slope_um = rounded_um(f_Ha),
                         .profile_form_um = rounded_um(f_fa),
                         .total_profile_um = rounded_um(std::hypot(f_Ha, f_fa)),
                         .helix_slope_um = rounded_um(f_Hb),
                         .helix_form_um = rounded_um(f_fb),
                         .total_helix_um = rounded_um(std::hypot(f_Hb, f_fb)),
                         .runout_um = rounded_um(0.9 * F_p)};
}

}  // namespace trueflank
