// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "trueflank/loop/gear/flank_geometry.h"
#include "trueflank/loop/gear/making.h"
#include "trueflank/loop/result/effect_facts.h"
#include "trueflank/loop/result/loop_result.h"

namespace trueflank::loop {

/// Which flanks an effect acts on.
enum class FlankChoice { kBoth, kLeft, kRight };

/// The flank that a place is on; both where it is on none.
[[nodiscard]] FlankChoice flank_of(const FlankGeometry& geometry, const Place& place);

/// What the correction may do with an effect.
enum class Correctable { kGeometry, kNoCause };

/// Shape values of an effect: order, height, tooth, ...
using EffectShape = std::vector<double>;

/// What a value more has to take off the chi-square of what is left, so that it is worth telling.
inline constexpr double kChiSquareOfValue = 8.0;

struct Effect;

/// A form to be put into words.
struct ToldForm {
  const FlankGeometry& geometry;
  const EffectShape& shape;
  FlankChoice flank = FlankChoice::kBoth;
  std::span<const double> amounts = {};  ///< its coefficients; empty: not known

  /// Of its one coefficient: +1, more material (on opposite flanks: turned counter-clockwise), or
  /// -1; 0 where it is not known, or where there are two.
  [[nodiscard]] int sign() const;
  /// Of its two coefficients [rad]; NaN where they are not known, or where there is one.
  [[nodiscard]] double direction_rad() const;
};

/// Along what a gear must have been measured before an effect can be seen.
struct NeedsToBeSeen {
  bool along_profile = false, along_face = false;
  bool several_heights = false;  ///< anything at more than one height
  bool crossed = false;  ///< profile at several heights, or helix at several diameters
};

/// One kind of effect of a gear: where its columns come from and how it is told. One object in one file of
/// effects/, listed in effects/registry.cpp; nothing else knows an effect by its name.
/// Columns are the deviation [um, + = material, along the normal] per unit coefficient; coefficients are
/// in the parameters' unit.
struct EffectFamily : EffectFacts {
  bool one_flank_too = false;       ///< may act on one flank only
  bool flank_only = false;          ///< must act on one flank only
  bool local = false;               ///< lives on one tooth
  bool of_one_file = false;      ///< of records: its number is the first shape value (Place::file)
  bool is_of_one_tooth = false;  ///< a form without a name on the tooth that its shape begins with
  bool tells_its_end = false;       ///< stands at the lower end by its cause: says which end is up
  Correctable correctable = Correctable::kGeometry;
  /// Ways of making that can have it, each with its cause; empty: any.
  std::vector<CauseOfMaking> causes = {};
  /// What the maker should do first, by way of making, in place of what `correction` begins with.
  /// Empty: that holds for all.
  std::vector<CauseOfMaking> corrections = {};
  /// Declared by a user: name and formula of every parameter, as declared.
  std::vector<std::pair<std::string, std::string>> formulas = {};

  /// @name Columns
  /// @{
  std::function<int(const EffectShape&)> columns;
  std::function<std::vector<EffectShape>(const FlankGeometry&)> shapes;
  std::function<void(const FlankGeometry&, const Place&, const EffectShape&, double* columns)> evaluate;
  /// Columns of several effects of the family at one place, on whatever flanks they act, side by
  /// side: where they share work. Empty: each is evaluated by itself.
  std::function<void(const FlankGeometry&, const Place&, std::span<const Effect>, double* columns)>
      evaluate_together = {};
  double operations = 40.0;  ///< of an evaluation, about: what it costs
  /// Depends on nothing but the flank, its roll length and the height: the same on every tooth. Empty: it is not.
  std::function<bool(const EffectShape&)> same_on_every_tooth = {};
  /// Of columns that are a form, the same on every tooth, times a factor of the tooth each: the two
  /// apart, for whoever asks many rows of few teeth. 0: the form does not act there. Empty: they
  /// are not of that kind.
  struct FormTimesTooth {
    std::function<void(const FlankGeometry&, int tooth, const EffectShape&, double* factors)> tooth;
    std::function<double(const FlankGeometry&, const Place& on_flank, const EffectShape&)> form;
  };
  std::optional<FormTimesTooth> form_times_tooth = {};
  /// Of a form that is a course over the profile times one over the face: families of one column of
  /// the two, and how many values of a course the shape has, one after the other. A value that is
  /// not 0 follows where the sides are opposite. None: it is no such product.
  struct ProductOfCourses {
    const EffectFamily* profile = nullptr;
    const EffectFamily* face = nullptr;
    std::size_t values = 0;
  } product_of_courses = {};
  /// Of a form of one column that is a product: families of one column whose values, one times the
  /// next in this order, it is, digit for digit. Where shapes are tried these are asked and kept:
  /// most shapes differ from others in one of them. Empty: it is no such product.
  std::function<std::vector<Effect>(const EffectShape&)> parts = {};
  bool shape_is_continuous = false;  ///< refined after the choice
  bool shape_is_step = false;        ///< the first value is a height at which the deviation jumps
  bool is_one_of_its_shapes = false; ///< once in a model, as when its shape is continuous
  /// Varies within a patch: its mean there is taken over single values. Empty: it does not.
  std::function<bool(const FlankGeometry&, const EffectShape&)> is_fine = {};
  /// Shapes beside one, tried on the single values once it is chosen.
  std::function<std::vector<EffectShape>(const FlankGeometry&, const EffectShape&)> nearby = {};
  /// Where the k-th shape value still means what its name says.
  std::function<std::pair<double, double>(const FlankGeometry&, std::size_t k)> shape_limits = {};
  /// @}

  /// @name How it is chosen
  /// @{
  std::function<NeedsToBeSeen(const EffectShape&)> needs = {};  ///< empty: any data show it
  /// Waves around the gear; empty: it is none.
  std::function<double(const EffectShape&)> order = {};
  /// Share of what a wave explains that may stay unexplained at its order before its name is doubted; 0:
  /// never is. From the second order on.
  double doubt_share = 0.0;
  bool doubted_by_any_order = false;
  /// Begins anew at one tooth: where its zero lies, and slow waves beside it, are parts of one drift.
  bool is_drift = false;
  /// Differs from tooth to tooth by the direction in which each stands: what is alike on all of
  /// them beside it is no part of it but for its mean around the gear.
  bool faces_a_direction = false;
  /// A form that many pieces follow closely, and that need not follow them to the last bit: a pose,
  /// a tip or large motions beside it take some of it.
  bool is_followed_nearly = false;
  bool is_like_many = false;  ///< a form that names with a free shape follow closely
  bool of_traces_only = false;  ///< scans cannot have it
  bool tells_order_along_profile = false;  ///< few teeth tell its orders apart
  bool shows_in_sizes = false;    ///< span, over pins, diameters tell it
  int penalty_of_traces = 0;      ///< on top of the preference where only traces were measured
  std::function<double(const EffectShape&)> complexity = {};  ///< among equals the simplest wins
  /// Of a form without a name: how many of its shape values were sought among all numbers, as
  /// places and widths are. Empty: the numbers among its term_keys.
  std::function<int(const EffectShape&)> values_sought = {};
  /// @}

  /// @name How it is told
  /// @{
  /// In words that say where there is more material and where less; empty: its id and shape values.
  std::function<std::string(const ToldForm&)> words = {};
  /// What is said of it besides, where no effect of the other form word was found: empty, or both.
  struct Remark {
    std::string text, not_beside;
  } remark = {};
  /// What is wrong and what follows, for the shop, from the effect as found; empty: its description.
  std::function<std::string(const FlankGeometry&, const FoundEffect&)> sentence = {};
  /// @}

  /// @name How it is corrected
  /// @{
  /// Effects that move the body: the displacement [mm] of a point [mm] for coefficients in the
  /// parameters' units; empty where the deviation along the normal says all.
  std::function<std::array<double, 3>(const FlankGeometry&, const std::array<double, 3>& point,
                                      const EffectShape&, const double* coefficients)>
      displacement_mm;
  /// Shapes whose columns are the same, and which only points that moved far tell apart. Empty: none.
  std::function<std::vector<EffectShape>(const FlankGeometry&, const EffectShape&)> other_motions = {};
  bool moves_whole_part = false;  ///< bore and rim too
  bool moves_circles = false;     ///< tip and root circles move as the walls do
  /// How far all walls stand outside the model [um]; empty: they do not as a whole.
  std::function<double(const FlankGeometry&, const double* coefficients)> walls_outside_um = {};
  std::function<bool(const EffectShape&)> bends_over_the_face = {};  ///< empty: it does not
  /// @}
};

/// An effect with its shape fixed: what a candidate of the selection is.
struct Effect {
  const EffectFamily* family = nullptr;
  FlankChoice flank = FlankChoice::kBoth;
  EffectShape shape;

  [[nodiscard]] bool operator==(const Effect&) const = default;
  [[nodiscard]] int columns() const { return family->columns(shape); }
  /// Whether it acts on the flank that a place is on; true of places on none.
  [[nodiscard]] bool acts_on_flank_of(const FlankGeometry& geometry, const Place& place) const;
  /// Columns at a place; zero where the effect does not act on that flank.
  void evaluate(const FlankGeometry& geometry, const Place& place, double* values) const;
  /// Waves around the gear; 0: none.
  [[nodiscard]] double order() const { return family->order ? family->order(shape) : 0.0; }
  [[nodiscard]] NeedsToBeSeen needs() const {
    return family->needs ? family->needs(shape) : NeedsToBeSeen{};
  }
  /// A term of a description without a name, gathered with others of its order.
  [[nodiscard]] bool is_term() const { return !family->named && !family->local; }
};

/// An effect asked at many places of one gear: the factors of teeth that its columns have
/// (EffectFamily::FormTimesTooth) are computed once. The same bits as Effect::evaluate; for any
/// number of threads.
class PreparedEffect {
 public:
  PreparedEffect(const FlankGeometry& geometry, Effect effect);
  [[nodiscard]] int columns() const { return columns_; }
  void evaluate(const Place& place, double* values) const;
  /// @name The same in two steps, of a place of which is known where it is
  /// @{
  /// False where all columns are 0. `tooth`: on whose flank it is, and `flank` (flank_of); 0 and
  /// both: on none.
  [[nodiscard]] bool acts_on(int tooth, FlankChoice flank) const {
    if (effect_.flank != FlankChoice::kBoth && effect_.flank != flank) return false;
    return factors_.empty() ||
           (tooth > 0 && is_on_tooth_[static_cast<std::size_t>(tooth - 1)] != 0);
  }
  void evaluate_where_it_acts(const Place& place, double* values) const {
    if (factors_.empty())
      effect_.family->evaluate(geometry_, place, effect_.shape, values);
    else
      put_form_times_tooth(place, values);
  }
  /// @}

 private:
  void put_form_times_tooth(const Place& place, double* values) const;

  const FlankGeometry& geometry_;
  Effect effect_;
  int columns_;
  std::vector<double> factors_;    ///< of the first tooth, the second, ...; empty: no such columns
  std::vector<char> is_on_tooth_;  ///< where not all are 0
};

/// Effects of one family whose columns are asked for side by side: the same as of each by itself but
/// for the last digit, for less work.
class EffectsTogether {
 public:
  /// They stay where they are.
  explicit EffectsTogether(std::span<const Effect> effects);
  [[nodiscard]] int columns() const { return columns_; }
  void evaluate(const FlankGeometry& geometry, const Place& place, double* columns) const;

 private:
  struct One {
    int column = 0, columns = 0;
    FlankChoice flank = FlankChoice::kBoth;
    bool same_shape = false;  ///< as the one before: one shape on both, left and right flanks
  };
  std::span<const Effect> effects_;
  std::vector<One> ones_;
  int columns_ = 0;
  bool any_on_one_flank_ = false;
};

/// The library: all families, named ones first. Lives as long as the program.
[[nodiscard]] const std::vector<EffectFamily>& effect_library();
/// The family of an id; nullptr where there is none.
[[nodiscard]] const EffectFamily* find_family(const std::string& id);
/// Forms of the library without their name and cause (EffectFacts::form_word), for gears made in a way that
/// cannot have the cause; nullptr where there is none of that word.
[[nodiscard]] const EffectFamily* find_form(const std::string& form_word);
/// True where a way of making can have the effect.
[[nodiscard]] bool can_have(Makings makings, const EffectFamily& family);
/// Families a user declared. Shared: effects point into them.
using DeclaredFamilies = std::shared_ptr<const std::vector<EffectFamily>>;
/// Every candidate for a gear made in one of these ways: of the library and of what the user declared.
[[nodiscard]] std::vector<Effect> candidate_effects(const FlankGeometry& geometry,
                                                    const DeclaredFamilies& declared = nullptr,
                                                    Makings makings = kAnyMaking);

/// Share of the flank's normal that lies in the transverse plane: what a displacement there is worth.
[[nodiscard]] double normal_part(const FlankGeometry& geometry, const Place& place, double ux,
                                 double uy);

}  // namespace trueflank::loop
