// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/section/svg_writer.h"

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"
#include "trueflank/export/scene.h"
#include "trueflank/export/xml_text.h"

namespace trueflank::io {
namespace {

constexpr double kMargin_mm = 2.0;

void append_svg_attribute(std::string& text, std::string_view name, double value) {
  text += ' ';
  text += name;
  text += "=\"";
  append_decimal(text, value);
  text += '"';
}

void append_point(std::string& text, const Point2& point) {
  append_decimal(text, point.x());
  text += ' ';
  append_decimal(text, point.y());
}

void append_path_data(std::string& text, const Contour& contour) {
  if (contour.circle) {  // two half circles
    const double r = contour.circle->radius_mm;
    const Point2 right = contour.circle->centre + Point2(r, 0.0);
    text += 'M';
    append_point(text, right);
    for (const double side : {-1.0, 1.0}) {
      text += 'A';
      append_point(text, {r, r});
      text += " 0 0 1 ";
      append_point(text, contour.circle->centre + Point2(side * r, 0.0));
    }
  }
  for (std::size_t i = 0; i < contour.vertices.size(); ++i) {
    text += i == 0 ? "M" : i == 1 ? "L" : " ";
    append_point(text, contour.vertices[i].point);
  }
  text += 'Z';
}

void append_outline(std::string& text, const Contour& contour) {
  if (contour.circle) {
    text += "<circle";
    append_svg_attribute(text, "cx", contour.circle->centre.x());
    append_svg_attribute(text, "cy", contour.circle->centre.y());
    append_svg_attribute(text, "r", contour.circle->radius_mm);
    text += "/>\n";
    return;
  }
  text += "<path d=\"";
  append_path_data(text, contour);
  text += "\"/>\n";
}

/// A shaded face under the outlines, so that a section is seen for what it is.
void append_face(std::string& text, const SectionBody& body) {
  text += "<path class=\"face\" style=\"fill:" + hex_text(part_colour(body.role)) + "\" d=\"";
  append_path_data(text, body.outer);
  for (const Contour& hole : body.holes) append_path_data(text, hole);
  text += "\"/>\n";
}

void append_section(std::string& text, const Section& section, const Point2& origin, bool faces) {
  text += "<g id=\"" + xml_escaped(section.name) + "\" transform=\"translate(";
  append_point(text, origin);
  text += ") scale(1 -1)\">\n<title>" + xml_escaped(section.name) + ", z = ";
  append_decimal(text, section.z_lower_mm);
  text += " .. ";
  append_decimal(text, section.z_upper_mm);
  text += " mm</title>\n";
  for (const SectionBody& body : section.bodies) {
    text += "<g><title>" + xml_escaped(body.name) + "</title>\n";
    if (faces) append_face(text, body);
    append_outline(text, body.outer);
    for (const Contour& hole : body.holes) append_outline(text, hole);
    text += "</g>\n";
  }
  text += "</g>\n";
}

}  // namespace

Status write_svg(const std::filesystem::path& path, const std::string& title,
                 const std::vector<Section>& sections) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  Box2 box;
  bool faces = false;  // parts alone are for cutting: nothing but outlines
  for (const Section& section : sections) {
    for (const SectionBody& body : section.bodies) include(box, body.outer);
    faces = faces || section.bodies.size() > 1;
  }
  // whole millimetres: a page of a size one can name
  const Point2 low = (box.low.array() - kMargin_mm).floor();
  const Point2 size = Point2((box.high.array() + kMargin_mm).ceil()) - low;
  const double width = size.x() * static_cast<double>(sections.size());
  const double height = size.y();

  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"";
  append_decimal(text, width);
  text += "mm\" height=\"";
  append_decimal(text, height);
  text += "mm\" viewBox=\"0 0 ";
  append_point(text, {width, height});
  text += "\">\n<title>" + xml_escaped(title) +
          "</title>\n<style>path,circle{fill:none;stroke:#000;stroke-width:.1;"
          "stroke-linejoin:round}.face{fill-rule:evenodd;stroke:none;fill-opacity:.55}</style>\n";
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const Point2 origin(size.x() * static_cast<double>(i) - low.x(), low.y() + size.y());
    append_section(text, sections[i], origin, faces);
    file->write(text);
    text.clear();
  }
  file->write("</svg>\n");
  return file->commit();
}

}  // namespace trueflank::io
