// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/build_html.h"

#include <algorithm>
#include <cmath>

#include "trueflank/check/quantity_text.h"
#include "trueflank/export/xml_text.h"
#include "trueflank/report/page_texts.h"
#include "trueflank/report/render/gearbox_pictures.h"
#include "trueflank/report/render/png.h"

namespace trueflank::io {
namespace {

constexpr int kStepWidth_px = 480, kStepHeight_px = 336, kHeroWidth_px = 800, kHeroHeight_px = 570;

std::string base64(const std::string& bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 63U];
  }
  return text;
}

std::string picture(const Image& image, const std::string& style, const std::string& words) {
  return "<img class=\"" + style + "\" width=\"" + std::to_string(image.width_px) + "\" height=\"" +
         std::to_string(image.height_px) + "\" alt=\"" + xml_escaped(words) +
         "\" src=\"data:image/png;base64," + base64(png_file(image)) + "\">\n";
}

std::string element(const std::string& tag, const std::string& text) {
  return "<" + tag + ">" + xml_escaped(text) + "</" + tag + ">\n";
}

std::string mass_text(double grams) { return std::isnan(grams) ? "" : number_text(grams, 1); }

std::string parts_list(const BillOfMaterials& bill) {
  std::string made =
      "<div class=\"card\"><h3>Made</h3><table><tr><th>part</th><th "
      "class=\"n\">count</th><th>material</th><th class=\"n\">g each</th></tr>\n";
  std::string bought =
      "<div class=\"card\"><h3>Bought</h3><table><tr><th>designation</th><th "
      "class=\"n\">count</th></tr>\n";
  for (const BillLine& line : bill) {
    const std::string count = "</td><td class=\"n\">" + std::to_string(line.count) + "</td>";
    if (line.designation.empty())
      made += "<tr><td>" + xml_escaped(line.part) + count + "<td>" + xml_escaped(line.material) +
              "</td><td class=\"n\">" + mass_text(line.mass_g) + "</td></tr>\n";
    else
      bought += "<tr><td>" + xml_escaped(line.designation) + count + "</tr>\n";
  }
  return "<div class=\"tables\">" + made + "</table></div>\n" + bought + "</table></div>\n";
}

class Page {
 public:
  Page(const GearTrain& train, const PartShapes& shapes, const BuildGuide& guide,
       const BillOfMaterials& bill)
      : train_(train), guide_(guide), bill_(bill), pictures_(train, shapes, kHeroWidth_px) {}

  std::string html() {
    const std::string title = "Building " + train_.design.name;
    std::string body = element("h1", title);
    body += "<p class=\"lead\">" + std::to_string(step_count()) +
            " steps. Every one was checked: what is moved in comes straight along the axis and "
            "meets nothing that is there already.</p>\n";
    body += picture(pictures_.assembly(kHeroWidth_px, kHeroHeight_px), "hero",
                    "The gearbox, a quarter cut away");
    body += element("h2", "What you need") + parts_list(bill_) + tools() + "</div>\n";
    for (const GuideSection& section : guide_.sections) add(section, body);
    body +=
        "<footer>In the pictures, grey is there already and coloured is new. Parts are named as "
        "their files. "
        "The same list for ordering: bom.csv.</footer>\n";
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
           "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
           xml_escaped(title) + "</title>\n<style>\n" + std::string(page_texts::kBuildStyle) + "</style></head>\n<body><main>\n" +
           body + "</main></body></html>\n";
  }

 private:
  [[nodiscard]] std::size_t step_count() const {
    std::size_t count = 0;
    for (const GuideSection& section : guide_.sections) count += section.steps.size();
    return count;
  }
  [[nodiscard]] std::string tools() const {
    std::string text = "<div class=\"card\"><h3>Tools</h3><ul>\n";
    for (const std::string& tool : guide_.tools) text += element("li", tool);
    return text + element("li", "grease for the teeth and the pins") + "</ul></div>\n";
  }

  void add(const GuideSection& section, std::string& body) {
    if (section.steps.empty()) return;
    body += element("h2", section.title);
    double side = 0.0;
    for (const GuideStep& step : section.steps) {
      const bool turned = side != 0.0 && step.from != side;
      side = step.from;
      body += "<section class=\"step\"><div>\n" + step_picture(step) +
              "</div><div>\n<h3><span class=\"number\">" + std::to_string(++number_) + "</span>" +
              xml_escaped(step.title) + "</h3>\n";
      if (turned) body += "<p class=\"turn\">Turn what you have over first.</p>\n";
      body += "<p class=\"label\">Take</p><ul>\n";
      for (const GuideNeed& need : step.needs)
        body += element("li", std::to_string(need.count) + " x " + need.name);
      body += "</ul>\n";
      if (!step.tool.empty()) body += "<p class=\"label\">Tool</p>" + element("p", step.tool);
      for (const std::string& line : step.lines) body += element("p", line);
      body += "</div></section>\n";
    }
  }

  [[nodiscard]] std::string step_picture(const GuideStep& step) const {
    return picture(pictures_.step(step.there, step.added, step.from, kStepWidth_px, kStepHeight_px),
                   "", step.title);
  }

  const GearTrain& train_;
  const BuildGuide& guide_;
  const BillOfMaterials& bill_;
  const GearboxPictures pictures_;
  int number_ = 0;
};

}  // namespace

std::string build_html(const GearTrain& train, const PartShapes& shapes, const BuildGuide& guide,
                       const BillOfMaterials& bill) {
  return Page(train, shapes, guide, bill).html();
}

}  // namespace trueflank::io
