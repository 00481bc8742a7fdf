// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least that readers of AC1015 demand: all nine tables, the two spaces as blocks, a root
// dictionary, a handle and an owner for everything. AutoCAD's DXF Reference, 2000.
#include "trueflank/export/dxf_writer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/number_text.h"

namespace trueflank::io {
namespace {

// Fixed handles; entities count on from kFirstEntity.
constexpr int kViewports = 0x8, kLinetypes = 0x5, kLayers = 0x2, kStyles = 0x3, kViews = 0x6,
              kCoordinateSystems = 0x7, kApplications = 0x9, kDimensionStyles = 0xA,
              kBlockRecords = 0x1, kRootDictionary = 0xC, kGroups = 0xD, kModelSpace = 0x1F,
              kPaperSpace = 0x1B, kFirstEntity = 0x100;

/// Group code and value, a line each.
class DxfText {
 public:
  explicit DxfText(AtomicFile& file) : file_(file), text_(file.buffer()) {}

  void put(int code, std::string_view value) {
    put_code(code);
    text_ += value;
    text_ += '\n';
    file_.flush_when_full();
  }
  void put(int code, int value) {
    put_code(code);
    append_integer(text_, value);
    text_ += '\n';
  }
  void put(int code, double value) {
    put_code(code);
    const std::size_t begin = text_.size();
    append_shortest(text_, std::round(value * 1e9) * 1e-9);  // a picometre
    // Some readers take a real without a point for an error.
    if (text_.find_first_of(".e", begin) == std::string::npos) text_ += ".0";
    text_ += '\n';
  }
  void put_point(int code, const Point2& point) {
    put(code, point.x());
    put(code + 10, point.y());
  }
  void put_handle(int code, int handle) {
    constexpr char kDigits[] = "0123456789ABCDEF";
    std::string digits;
    for (int rest = handle; rest > 0; rest /= 16) digits += kDigits[rest % 16];
    if (digits.empty()) digits = "0";
    std::reverse(digits.begin(), digits.end());
    put(code, digits);
  }
  void begin_section(std::string_view name) {
    put(0, "SECTION");
    put(2, name);
  }
  void end_section() { put(0, "ENDSEC"); }
  void begin_table(std::string_view name, int handle, int count) {
    put(0, "TABLE");
    put(2, name);
    put_handle(5, handle);
    put_handle(330, 0);
    put(100, "AcDbSymbolTable");
    put(70, count);
  }
  void end_table() { put(0, "ENDTAB"); }
  void begin_record(std::string_view type, int handle, int owner, std::string_view subclass,
                    int handle_code = 5) {
    put(0, type);
    put_handle(handle_code, handle);
    put_handle(330, owner);
    put(100, "AcDbSymbolTableRecord");
    put(100, subclass);
  }

 private:
  void put_code(int code) {
    append_integer(text_, code);
    text_ += '\n';
  }
  AtomicFile& file_;
  std::string& text_;
};

struct Layer {
  std::string name;
  int colour = 7;  ///< AutoCAD colour index
  bool frozen = false;
};

std::string layer_name(const Section& section, const SectionBody& body) {
  std::string name = section.name + "_" + body.name;
  for (char& c : name) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    const bool plain = (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    if (!plain) c = '_';
  }
  return name;
}

int colour_index(const std::string& part) {
  const auto starts = [&](const char* word) { return part.rfind(word, 0) == 0; };
  if (starts("sun") || starts("pinion")) return 30;   // orange
  if (starts("planet")) return 5;                     // blue
  if (starts("ring2")) return 1;                      // red
  return 7;                                           // black on white, white on black
}

void put_header(DxfText& dxf, const Box2& box, int next_handle) {
  dxf.begin_section("HEADER");
  dxf.put(9, "$ACADVER");
  dxf.put(1, "AC1015");
  dxf.put(9, "$HANDSEED");
  dxf.put_handle(5, next_handle);
  dxf.put(9, "$DWGCODEPAGE");
  dxf.put(3, "ANSI_1252");
  dxf.put(9, "$INSUNITS");
  dxf.put(70, 4);  // millimetres
  dxf.put(9, "$MEASUREMENT");
  dxf.put(70, 1);  // metric
  dxf.put(9, "$EXTMIN");
  dxf.put_point(10, box.low);
  dxf.put(30, 0.0);
  dxf.put(9, "$EXTMAX");
  dxf.put_point(10, box.high);
  dxf.put(30, 0.0);
  dxf.end_section();
  dxf.begin_section("CLASSES");
  dxf.end_section();
}

void put_viewport_table(DxfText& dxf, const Box2& box) {
  dxf.begin_table("VPORT", kViewports, 1);
  dxf.begin_record("VPORT", 0x29, kViewports, "AcDbViewportTableRecord");
  dxf.put(2, "*ACTIVE");
  dxf.put(70, 0);
  dxf.put_point(10, {0.0, 0.0});
  dxf.put_point(11, {1.0, 1.0});
  dxf.put_point(12, 0.5 * (box.low + box.high));
  dxf.put_point(13, {0.0, 0.0});
  dxf.put_point(14, {1.0, 1.0});
  dxf.put_point(15, {1.0, 1.0});
  dxf.put_point(16, {0.0, 0.0});
  dxf.put(36, 1.0);
  dxf.put_point(17, {0.0, 0.0});
  dxf.put(37, 0.0);
  dxf.put(40, 1.1 * std::max(1.0, (box.high - box.low).maxCoeff()));  // height of the view
  dxf.put(41, 1.0);
  dxf.end_table();
}

void put_linetype_table(DxfText& dxf) {
  dxf.begin_table("LTYPE", kLinetypes, 3);
  int handle = 0x14;
  for (const auto& [name, description] :
       {std::pair("ByBlock", ""), std::pair("ByLayer", ""), std::pair("Continuous", "Solid line")}) {
    dxf.begin_record("LTYPE", handle++, kLinetypes, "AcDbLinetypeTableRecord");
    dxf.put(2, name);
    dxf.put(70, 0);
    dxf.put(3, description);
    dxf.put(72, 65);
    dxf.put(73, 0);
    dxf.put(40, 0.0);
  }
  dxf.end_table();
}

void put_layer_table(DxfText& dxf, const std::vector<Layer>& layers) {
  dxf.begin_table("LAYER", kLayers, static_cast<int>(layers.size()));
  int handle = 0x40;
  for (const Layer& layer : layers) {
    dxf.begin_record("LAYER", handle++, kLayers, "AcDbLayerTableRecord");
    dxf.put(2, layer.name);
    dxf.put(70, layer.frozen ? 1 : 0);
    dxf.put(62, layer.colour);
    dxf.put(6, "Continuous");
  }
  dxf.end_table();
}

void put_text_tables(DxfText& dxf) {
  dxf.begin_table("STYLE", kStyles, 1);
  dxf.begin_record("STYLE", 0x11, kStyles, "AcDbTextStyleTableRecord");
  dxf.put(2, "Standard");
  dxf.put(70, 0);
  dxf.put(40, 0.0);
  dxf.put(41, 1.0);
  dxf.put(50, 0.0);
  dxf.put(71, 0);
  dxf.put(42, 2.5);
  dxf.put(3, "txt");
  dxf.put(4, "");
  dxf.end_table();
  dxf.begin_table("VIEW", kViews, 0);
  dxf.end_table();
  dxf.begin_table("UCS", kCoordinateSystems, 0);
  dxf.end_table();
  dxf.begin_table("APPID", kApplications, 1);
  dxf.begin_record("APPID", 0x12, kApplications, "AcDbRegAppTableRecord");
  dxf.put(2, "ACAD");
  dxf.put(70, 0);
  dxf.end_table();
  dxf.begin_table("DIMSTYLE", kDimensionStyles, 1);
  dxf.put(100, "AcDbDimStyleTable");
  dxf.begin_record("DIMSTYLE", 0x27, kDimensionStyles, "AcDbDimStyleTableRecord", 105);
  dxf.put(2, "Standard");
  dxf.put(70, 0);
  dxf.end_table();
}

void put_blocks(DxfText& dxf) {
  const std::array<std::pair<const char*, int>, 2> spaces = {
      {{"*Model_Space", kModelSpace}, {"*Paper_Space", kPaperSpace}}};
  dxf.begin_table("BLOCK_RECORD", kBlockRecords, 2);
  for (const auto& [name, handle] : spaces) {
    dxf.begin_record("BLOCK_RECORD", handle, kBlockRecords, "AcDbBlockTableRecord");
    dxf.put(2, name);
  }
  dxf.end_table();
  dxf.end_section();
  dxf.begin_section("BLOCKS");
  int handle = 0x30;
  for (const auto& [name, record] : spaces) {
    dxf.put(0, "BLOCK");
    dxf.put_handle(5, handle++);
    dxf.put_handle(330, record);
    dxf.put(100, "AcDbEntity");
    if (record == kPaperSpace) dxf.put(67, 1);
    dxf.put(8, "0");
    dxf.put(100, "AcDbBlockBegin");
    dxf.put(2, name);
    dxf.put(70, 0);
    dxf.put_point(10, {0.0, 0.0});
    dxf.put(30, 0.0);
    dxf.put(3, name);
    dxf.put(1, "");
    dxf.put(0, "ENDBLK");
    dxf.put_handle(5, handle++);
    dxf.put_handle(330, record);
    dxf.put(100, "AcDbEntity");
    if (record == kPaperSpace) dxf.put(67, 1);
    dxf.put(8, "0");
    dxf.put(100, "AcDbBlockEnd");
  }
  dxf.end_section();
}

void put_contour(DxfText& dxf, const Contour& contour, const std::string& layer, int handle) {
  dxf.put(0, contour.circle ? "CIRCLE" : "LWPOLYLINE");
  dxf.put_handle(5, handle);
  dxf.put_handle(330, kModelSpace);
  dxf.put(100, "AcDbEntity");
  dxf.put(8, layer);
  if (contour.circle) {
    dxf.put(100, "AcDbCircle");
    dxf.put_point(10, contour.circle->centre);
    dxf.put(30, 0.0);
    dxf.put(40, contour.circle->radius_mm);
    return;
  }
  dxf.put(100, "AcDbPolyline");
  dxf.put(90, static_cast<int>(contour.vertices.size()));
  dxf.put(70, 1);  // closed
  dxf.put(43, 0.0);
  for (const ContourVertex& vertex : contour.vertices) {
    dxf.put_point(10, vertex.point);
    if (vertex.bulge != 0.0) dxf.put(42, vertex.bulge);
  }
}

void put_objects(DxfText& dxf) {
  dxf.begin_section("OBJECTS");
  dxf.put(0, "DICTIONARY");
  dxf.put_handle(5, kRootDictionary);
  dxf.put_handle(330, 0);
  dxf.put(100, "AcDbDictionary");
  dxf.put(281, 1);
  dxf.put(3, "ACAD_GROUP");
  dxf.put_handle(350, kGroups);
  dxf.put(0, "DICTIONARY");
  dxf.put_handle(5, kGroups);
  dxf.put_handle(330, kRootDictionary);
  dxf.put(100, "AcDbDictionary");
  dxf.put(281, 1);
  dxf.end_section();
}

}  // namespace

Status write_dxf(const std::filesystem::path& path, const std::vector<Section>& sections) {
  auto file = AtomicFile::create(path);
  if (!file) return fail(std::move(file.error()));
  Box2 box;
  std::vector<Layer> layers = {{"0", 7}};
  int count = 0;
  for (const Section& section : sections)
    for (const SectionBody& body : section.bodies) {
      include(box, body.outer);
      layers.push_back({layer_name(section, body), colour_index(body.part), body.frozen});
      count += 1 + static_cast<int>(body.holes.size());
    }
  DxfText dxf(*file);
  put_header(dxf, box, kFirstEntity + count);
  dxf.begin_section("TABLES");
  put_viewport_table(dxf, box);
  put_linetype_table(dxf);
  put_layer_table(dxf, layers);
  put_text_tables(dxf);
  put_blocks(dxf);
  dxf.begin_section("ENTITIES");
  int handle = kFirstEntity;
  for (const Section& section : sections)
    for (const SectionBody& body : section.bodies) {
      put_contour(dxf, body.outer, layer_name(section, body), handle++);
      for (const Contour& hole : body.holes)
        put_contour(dxf, hole, layer_name(section, body), handle++);
    }
  dxf.end_section();
  put_objects(dxf);
  dxf.put(0, "EOF");
  return file->commit();
}

}  // namespace trueflank::io
