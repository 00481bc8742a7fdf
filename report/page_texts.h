// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

// Styles and scripts of templates/loop and templates/build, embedded at build time (cmake/embed_texts.cmake).
namespace trueflank::page_texts {

extern const std::string_view kLoopStyle;    ///< style.css: the report's colours and type
extern const std::string_view kLoopPointer;  ///< pointer.js: the value under the pointer, of every chart with data-chart
extern const std::string_view kBuildStyle;   ///< of build.html

}  // namespace trueflank::page_texts
