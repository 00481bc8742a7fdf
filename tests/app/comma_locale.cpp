// SPDX-License-Identifier: GPL-3.0-or-later
//
// Loaded before a program, sets the locale COMMA_LOCALE for it, as a host program in Germany does.
#include <clocale>
#include <cstdio>
#include <cstdlib>

namespace {

[[gnu::constructor]] void set_locale() {
  const char* const name = std::getenv("COMMA_LOCALE");
  if (name == nullptr) return;
  char room[16];
  if (std::setlocale(LC_ALL, name) == nullptr || std::snprintf(room, sizeof room, "%.1f", 0.5) != 3 || room[1] != ',')
    std::abort();
}

}  // namespace
