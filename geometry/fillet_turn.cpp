// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/geometry/fillet_turn.h"

#include "trueflank/base/contract.h"

namespace trueflank {
namespace {

double smooth_step(double t) { return t * t * (3.0 - 2.0 * t); }

}  // namespace

double fillet_turn_share(const ToothProfile& profile, std::size_t piece, double parameter) {
  const auto& pieces = profile.pieces();
  TRUEFLANK_EXPECTS(piece < pieces.size() && pieces[piece].kind == PieceKind::kFillet);
  const Curve& curve = pieces[piece].curve;
  const double within = (parameter - curve.begin) / (curve.end - curve.begin);
  const auto is_fillet = [&](std::size_t i) {
    return i < pieces.size() && pieces[i].kind == PieceKind::kFillet;
  };
  const auto length = [&](std::size_t i) {
    return (pieces[i].curve.end_point() - pieces[i].curve.start_point()).norm();
  };
  double share = within;
  if (is_fillet(piece + 1)) {
    const double first = length(piece);
    share = within * first / (first + length(piece + 1));
  } else if (piece > 0 && is_fillet(piece - 1)) {
    const double first = length(piece - 1), second = length(piece);
    share = (first + within * second) / (first + second);
  }
  return 1.0 - smooth_step(share);
}

}  // namespace trueflank
