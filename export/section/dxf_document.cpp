// SPDX-License-Identifier: GPL-3.0-or-later
//
// The least that readers of AC1015 demand: all nine tables, the two spaces as blocks, a root
// dictionary, a handle and an owner for everything. AutoCAD's DXF Reference, 2000.
#include "trueflank/export/section/dxf_document.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "trueflank/export/number_text.h"

namespace trueflank::io {
namespace {

// Fixed handles; entities count on from kFirstEntity.
constexpr int kViewports = 0x8, kLinetypes = 0x5, kLayers = 0x2, kStyles = 0x3, kViews = 0x6,
              kCoordinateSystems = 0x7, kApplications = 0x9, kDimensionStyles = 0xA,
              kBlockRecords = 0x1, kRootDictionary = 0xC, kGroups = 0xD, kPaperSpace = 0x1B;

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

/// Axes and reference circles of drawings: 6 mm, gap 1, 0.7, gap 1.
void put_centre_linetype(DxfText& dxf, int handle) {
  dxf.begin_record("LTYPE", handle, kLinetypes, "AcDbLinetypeTableRecord");
  dxf.put(2, "CENTER");
  dxf.put(70, 0);
  dxf.put(3, "Center ____ _ ____ _ ____");
  dxf.put(72, 65);
  dxf.put(73, 4);
  dxf.put(40, 8.7);
  for (double dash : {6.0, -1.0, 0.7, -1.0}) {
    dxf.put(49, dash);
    dxf.put(74, 0);
  }
}

void put_linetype_table(DxfText& dxf, bool with_centre) {
  dxf.begin_table("LTYPE", kLinetypes, with_centre ? 4 : 3);
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
  if (with_centre) put_centre_linetype(dxf, handle);
  dxf.end_table();
}

void put_layer_table(DxfText& dxf, const std::vector<DxfLayer>& layers) {
  dxf.begin_table("LAYER", kLayers, static_cast<int>(layers.size()));
  int handle = 0x40;
  for (const DxfLayer& layer : layers) {
    dxf.begin_record("LAYER", handle++, kLayers, "AcDbLayerTableRecord");
    dxf.put(2, layer.name);
    dxf.put(70, layer.frozen ? 1 : 0);
    dxf.put(62, layer.colour);
    dxf.put(6, layer.line_type);
    if (layer.width_hundredths_mm != -3) dxf.put(370, layer.width_hundredths_mm);
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
      {{"*Model_Space", kDxfModelSpace}, {"*Paper_Space", kPaperSpace}}};
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

void DxfText::put(int code, std::string_view value) {
  put_code(code);
  text_ += value;
  text_ += '\n';
  file_.flush_when_full();
}

void DxfText::put(int code, int value) {
  put_code(code);
  append_integer(text_, value);
  text_ += '\n';
}

void DxfText::put(int code, double value) {
  put_code(code);
  const std::size_t begin = text_.size();
  append_shortest(text_, std::round(value * 1e9) * 1e-9);  // a picometre
  // Some readers take a real without a point for an error.
  if (text_.find_first_of(".e", begin) == std::string::npos) text_ += ".0";
  text_ += '\n';
}

void DxfText::put_point(int code, const Point2& point) {
  put(code, point.x());
  put(code + 10, point.y());
}

void DxfText::put_handle(int code, int handle) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string digits;
  for (int rest = handle; rest > 0; rest /= 16) digits += kDigits[rest % 16];
  if (digits.empty()) digits = "0";
  std::reverse(digits.begin(), digits.end());
  put(code, digits);
}

void DxfText::put_code(int code) {
  append_integer(text_, code);
  text_ += '\n';
}

void begin_dxf(DxfText& dxf, const Box2& box, const std::vector<DxfLayer>& layers, int count) {
  std::vector<DxfLayer> all = {{"0", 7}};
  all.insert(all.end(), layers.begin(), layers.end());
  const bool centre = std::any_of(all.begin(), all.end(), [](const DxfLayer& l) { return l.line_type == "CENTER"; });
  put_header(dxf, box, kFirstDxfEntity + count);
  dxf.begin_section("TABLES");
  put_viewport_table(dxf, box);
  put_linetype_table(dxf, centre);
  put_layer_table(dxf, all);
  put_text_tables(dxf);
  put_blocks(dxf);
  dxf.begin_section("ENTITIES");
}

void put_dxf_entity(DxfText& dxf, std::string_view type, int handle, std::string_view layer) {
  dxf.put(0, type);
  dxf.put_handle(5, handle);
  dxf.put_handle(330, kDxfModelSpace);
  dxf.put(100, "AcDbEntity");
  dxf.put(8, layer);
}

void end_dxf(DxfText& dxf) {
  dxf.end_section();
  put_objects(dxf);
  dxf.put(0, "EOF");
}

}  // namespace trueflank::io
