// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loaded before a program, sets the locale FOREIGN_LOCALE for it, as a host program of another
// country does: for C and for C++, whose streams group thousands by it.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <locale>

namespace {

[[gnu::constructor]] void set_locale() {
  const char* const name = std::getenv("FOREIGN_LOCALE");
  if (name == nullptr) return;
  char room[16];
  if (std::setlocale(LC_ALL, name) == nullptr ||
      std::snprintf(room, sizeof room, "%.1f", 0.5) != 3 || room[1] != ',')
    std::abort();
  std::locale::global(std::locale(name));
  if (std::use_facet<std::numpunct<char>>(std::locale()).grouping().empty()) std::abort();
}

}  // namespace
