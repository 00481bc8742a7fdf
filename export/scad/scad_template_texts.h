// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

// The texts of templates/openscad, embedded at build time (cmake/embed_texts.cmake).
namespace trueflank::io::scad_template {

extern const std::string_view kLibrary;  ///< functions and modules that each part's file carries
extern const std::string_view kHousing, kCarrier, kMotorAdapter, kOutputFlange, kTestJig, kFitCoupon;

}  // namespace trueflank::io::scad_template
