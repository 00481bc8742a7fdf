// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/report_html.h"

#include <array>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/report/report_model.h"
#include "trueflank/report/report_page.h"

namespace trueflank::io {
namespace {

/// JSON inside a script element: '<' stands only in strings, and "</script" or "<!--" there would
/// end or confuse the element.
std::string json_for_script(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (;;) {
    const std::size_t at = json.find('<');
    text += json.substr(0, at);
    if (at == json.npos) return text;
    text += "\\u003c";
    json.remove_prefix(at + 1);
  }
}

std::string text_for_html(std::string_view plain) {
  std::string text;
  for (char c : plain) {
    switch (c) {
      case '&': text += "&amp;"; break;
      case '<': text += "&lt;"; break;
      case '>': text += "&gt;"; break;
      case '"': text += "&quot;"; break;
      default: text += c;
    }
  }
  return text;
}

/// The frame with its @PLACES@ filled, each once, in the order of the frame.
template <std::size_t N>
std::string filled(std::string_view frame,
                   const std::array<std::pair<std::string_view, std::string_view>, N>& places) {
  std::size_t size = frame.size();
  for (const auto& [place, text] : places) size += text.size();
  std::string page;
  page.reserve(size);
  for (const auto& [place, text] : places) {
    const std::size_t at = frame.find(place);
    TRUEFLANK_EXPECTS(at != std::string_view::npos);
    page.append(frame.substr(0, at)).append(text);
    frame.remove_prefix(at + place.size());
  }
  return page.append(frame);
}

}  // namespace

bool report_html_has_3d() { return !page::kViewer.empty(); }

std::string report_html(const Report& report, const HtmlModel& model) {
  TRUEFLANK_EXPECTS(report.train != nullptr);
  return report_html(report, report_json(report), report_model_json(report, model));
}

std::string report_html(const Report& report, std::string_view report_json_text,
                        std::string_view model_json_text) {
  TRUEFLANK_EXPECTS(report.train != nullptr);
  const std::string title = text_for_html(report.train->design.name);
  const std::string licence = text_for_html(page::kLicence);
  const std::string data = json_for_script(report_json_text);
  const std::string drawn = json_for_script(model_json_text);
  return filled<10>(page::kFrame, {{{"@TITLE@", title},
                                   {"@STYLE@", page::kStyle},
                                   {"@VERSION@", TRUEFLANK_VERSION},
                                   {"@LICENCE@", licence},
                                   {"@REPORT@", data},
                                   {"@MODEL@", drawn},
                                   {"@SCRIPT@", page::kScript},
                                   {"@DIMENSIONS@", page::kDimensions},
                                   {"@MESHES@", page::kMeshes},
                                   {"@VIEWER@", page::kViewer}}});
}

}  // namespace trueflank::io
