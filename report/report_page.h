// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

// The fixed parts of the page (templates/report), embedded at build time by cmake/report_page.cmake;
// the scripts hold nothing that ends a script element.
namespace trueflank::io::page {

extern const std::string_view kFrame;    ///< page.html, with @PLACES@ to fill
extern const std::string_view kStyle;    ///< style.css
extern const std::string_view kScript;   ///< page.js: tables
extern const std::string_view kDimensions;  ///< dimensions.js: sizes of the gears
extern const std::string_view kMeshes;   ///< meshes.js: drawings of the meshes
extern const std::string_view kViewer;   ///< viewer.js with three.js, bundled; may be empty
extern const std::string_view kLicence;  ///< of what is bundled; may be empty

}  // namespace trueflank::io::page
