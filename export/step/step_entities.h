// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/solid/brep/brep.h"

// The data section of a STEP file (ISO 10303-21) as it grows, entity by entity.
namespace trueflank::io {

/// Number of an entity: #id.
using StepId = int;

class StepEntities {
 public:
  /// Begins an entity; write its text with the functions below, then end().
  StepId begin(std::string_view opening);
  void end() { put(");\n"); }
  /// An entity that is all text.
  StepId add(std::string_view opening, std::string_view arguments);

  StepEntities& put(std::string_view text);
  StepEntities& put(StepId id);                         ///< #id
  StepEntities& put(const std::vector<StepId>& ids);    ///< (#1,#2)
  StepEntities& put_integer(int number);
  StepEntities& put_integers(const std::vector<int>& numbers);
  StepEntities& put_reals(const std::vector<double>& numbers);
  /// A real number: shortest that reads back the same, always with a decimal point.
  StepEntities& put(double number);
  /// Coordinates: to 1e-10 mm, a hundred thousandth of the 0.01 um that flanks may be off.
  StepEntities& put_coordinate(double value_mm);
  /// A quoted string; anything beyond printable ASCII as ISO 10303-21 spells it.
  StepEntities& put_quoted(std::string_view utf8);

  [[nodiscard]] std::string take();
  void reserve(std::size_t bytes) { static_cast<void>(room(bytes)); }

 private:
  /// Where the text ends, with room for so many bytes.
  char* room(std::size_t bytes) {
    if (text_.size() - size_ < bytes) grow(bytes);
    return text_.data() + size_;
  }
  void grow(std::size_t bytes);
  void ends_at(const char* end) { size_ = static_cast<std::size_t>(end - text_.data()); }

  std::string text_;  ///< longer than what is written, so that pieces are written in place
  std::size_t size_ = 0;
  StepId last_ = 0;
};

/// @name Geometry
/// @{
[[nodiscard]] StepId add_point(StepEntities& out, const Point3& point);
[[nodiscard]] StepId add_direction(StepEntities& out, const Point3& direction);
[[nodiscard]] StepId add_placement(StepEntities& out, const Frame3& frame);
struct SolidIds {
  StepId solid = 0;
  std::vector<StepId> faces;  ///< one a face of the solid
};
/// A MANIFOLD_SOLID_BREP with everything it needs.
[[nodiscard]] SolidIds add_solid(StepEntities& out, const Brep& solid, std::string_view name);
/// @}

}  // namespace trueflank::io
