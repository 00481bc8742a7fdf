// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/requirements_keys.h"

#include "trueflank/design/requirements_sections.h"

namespace trueflank {
namespace requirements {

std::vector<std::string> words(const std::string& list) {
  std::vector<std::string> result(1);
  for (const char c : list) {
    if (c == ',')
      result.emplace_back();
    else if (c != ' ')
      result.back() += c;
  }
  return result;
}

namespace {

RequirementsSection top() {
  return {"",
          {{{.name = "format",
             .type = KeyType::kWhole,
             .lower = 1,
             .upper = 1,
             .required = true,
             .meaning = "of this file"},
            [](R&, const V&) { return std::string(); }},
           {{.name = "name",
             .type = KeyType::kText,
             .by_default = "the file's name",
             .meaning = "of the designs found"},
            [](R& r, const V& v) { return r.name = text(v), std::string(); }}}};
}

}  // namespace
}  // namespace requirements

const std::vector<RequirementsSection>& requirements_sections() {
  static const std::vector<RequirementsSection> kSections{
      requirements::top(),    requirements::gearbox(), requirements::rack(),
      requirements::cutter(), requirements::ratio(),   requirements::teeth(),
      requirements::shift(),  requirements::limits(),  requirements::strength(),
      requirements::motor(),  requirements::search(),  requirements::losses()};
  return kSections;
}

}  // namespace trueflank
