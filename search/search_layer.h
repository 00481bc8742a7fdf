// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "trueflank/geometry/gear.h"
#include "trueflank/geometry/gear_pair.h"
#include "trueflank/search/search_corner.h"
#include "trueflank/search/search_model.h"
#include "trueflank/search/search_requirements.h"
#include "trueflank/search/search_train.h"
#include "trueflank/train/efficiency_sliding.h"

// Margins and losses of one layer of gears at one centre distance: what an optimiser asks most.
// Lengths are in modules of the layer.
namespace trueflank {

/// Writes margins in order and knows when to stop.
class Margins {
 public:
  Margins(std::array<double, kLayerLimits>& margins, std::size_t count, double stop_below)
      : margins_(margins), count_(count), stop_below_(stop_below) {
    margins_.fill(-1e9);
  }
  void add(double margin) {
    margins_[next_++] = margin;
    least_ = margin < least_ ? margin : least_;
  }
  [[nodiscard]] bool stop() const { return least_ < stop_below_; }
  [[nodiscard]] std::size_t added() const { return next_; }
  [[nodiscard]] double least() const { return next_ == count_ ? least_ : std::min(least_, -1e9); }

 private:
  std::array<double, kLayerLimits>& margins_;
  std::size_t count_;
  double stop_below_;
  std::size_t next_ = 0;
  double least_ = 1e300;
};

/// The gears of a layer; none where the train has none.
struct LayerGears {
  Gear planet;
  std::optional<Gear> sun = {}, ring = {};
  double shortened_tip = kNaN;  ///< radius of the planet's tip, by its mesh with the sun
};

/// What a mesh has before its profiles are known: contact ratios and path from the tip circles.
struct MeshView {
  double approach = 0.0, recess = 0.0;
  double span = 0.0;  ///< between the tangent points of the base circles
  ContactPath path;
};

/// Lengths in modules of the layer.
struct LayerLengths {
  double centre_distance = kNaN, face_width = kNaN;
};

[[nodiscard]] Gear gear_of(const SearchRequirements& r, GearKind kind, int teeth, double shift);
[[nodiscard]] MeshView view_of(const Gear& gear1, const Gear& gear2, double centre_distance,
                               double face_width);

void add_shift_margins(const SearchRequirements& r, double shift, Margins& margins);
/// Of neighbouring planets.
[[nodiscard]] double spacing_margin(const SearchRequirements& r, int planets, double centre_distance,
                                    double tip_radius, double module_mm);
void add_thickness_margins(const SearchRequirements& r, const LayerGears& gears, double module_mm,
                           Margins& margins);
/// What the tip circles say of the meshes with sun and ring: contact ratios, clearances, tips outside
/// the line of action.
void add_mesh_margins(const SearchRequirements& r, const LayerGears& gears, const MeshView& outer,
                      const MeshView& inner, double centre_distance, Margins& margins);

/// Neither undercut nor a fillet shortens a path of the layer.
[[nodiscard]] bool is_surely_whole(const SearchRequirements& r, const LayerGears& gears,
                                   const MeshView& outer, const MeshView& inner);
/// The part of a path that loses least: of what undercut or a fillet can leave of it nothing loses
/// less.
[[nodiscard]] ContactPath best_part(const MeshView& view);
/// By the paper's formula.
[[nodiscard]] MeshLoss formula_loss(const SearchRequirements& r, const MeshTeeth& mesh,
                                    double approach, double recess);
/// By the sliding along the path.
[[nodiscard]] MeshLoss path_loss(const SearchRequirements& r, ContactPath path);

/// A layer as its tip circles and centre distance lay it out.
struct LayerSetting {
  LayerGears gears;
  MeshView outer = {}, inner = {};
  LayerLengths lengths = {};
};

/// The margins of a layer that need profiles, each computed when it is asked for: of the mesh with the
/// sun the corners in root 1 and in root 2 and the contact ratio, then those of the mesh with the ring.
class ProfileJudge {
 public:
  /// The requirements must outlive it.
  ProfileJudge(const SearchRequirements& r, LayerSetting setting);

  [[nodiscard]] std::size_t count() const { return 3 * (outer_ + inner_); }
  /// Whether the gears that a margin is of have teeth.
  [[nodiscard]] bool exists(std::size_t margin);
  /// Requires: it exists. `first`: see look_for_corner_in_gear1().
  [[nodiscard]] CornerLook look(std::size_t margin, double enough, int& first);
  /// Of a corner: its clearance at one sample of the root, from the profile of that gear alone. Nothing
  /// where that does not tell it, or for another margin.
  [[nodiscard]] std::optional<double> at_sample(std::size_t margin, int sample);
  /// Replaces the losses of paths that undercut, or a root form circle above the mate's tip, shortens.
  void correct_losses(LayerEvaluation& result);

 private:
  using Maker = std::optional<Result<ToothProfile>>;
  [[nodiscard]] static const ToothProfile* made(const std::optional<Gear>& gear, Maker& profile);
  [[nodiscard]] bool is_outer(std::size_t margin) const { return outer_ > 0 && margin < 3; }
  /// Requires: both gears have teeth.
  [[nodiscard]] GearPair pair_of(bool outer);
  [[nodiscard]] const LineOfAction& line_of(bool outer);

  const SearchRequirements* r_;
  LayerSetting setting_;
  std::size_t outer_, inner_;  ///< 1 or 0 meshes
  std::optional<Gear> planet_gear_;
  Maker planet_, sun_, ring_;
  std::array<std::optional<LineOfAction>, 2> lines_;
};

/// A layer of which the margins that need profiles are computed one by one.
struct PartlyJudged {
  LayerEvaluation evaluation;
  std::optional<ProfileJudge> profiles;  ///< none: all margins are computed, or those before end it
  std::size_t first_of_profiles = 0;
};

/// The margins that need profiles, and the losses of paths that undercut, or a root form circle above
/// the mate's tip, shortens. Ends early where a gear has no tooth.
void judge_profiles(const SearchRequirements& r, const LayerSetting& setting, Margins& margins,
                    LayerEvaluation& result);
}  // namespace trueflank
