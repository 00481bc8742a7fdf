// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

// The page of templates/search, embedded at build time (cmake/embed_texts.cmake).
namespace trueflank {

extern const std::string_view kSearchPage;

}  // namespace trueflank
