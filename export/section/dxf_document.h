// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/section/section_contour.h"

// What every DXF file of ours has around its entities.
namespace trueflank::io {

/// Group code and value, a line each.
class DxfText {
 public:
  explicit DxfText(AtomicFile& file) : file_(file), text_(file.buffer()) {}

  void put(int code, std::string_view value);
  void put(int code, int value);
  void put(int code, double value);
  void put_point(int code, const Point2& point);
  void put_handle(int code, int handle);
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
  void put_code(int code);

  AtomicFile& file_;
  std::string& text_;
};

struct DxfLayer {
  std::string name;
  int colour = 7;  ///< AutoCAD colour index
  bool frozen = false;
  std::string line_type = "Continuous";  ///< or "CENTER"
  int width_hundredths_mm = -3;          ///< -3: the reader's default
};

/// Handles: the first that an entity may have, and the owner of all of them.
inline constexpr int kFirstDxfEntity = 0x100, kDxfModelSpace = 0x1F;

/// Header, tables and blocks, up to where the entities begin: `count` of them, handles from
/// kFirstDxfEntity. Layer "0" comes first.
void begin_dxf(DxfText& dxf, const Box2& box, const std::vector<DxfLayer>& layers, int count);
/// What begins every entity.
void put_dxf_entity(DxfText& dxf, std::string_view type, int handle, std::string_view layer);
void end_dxf(DxfText& dxf);

}  // namespace trueflank::io
