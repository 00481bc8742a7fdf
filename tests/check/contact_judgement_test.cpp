// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the quick judge of a search complains of, against the findings of the checks it asks and
// against turned teeth.
#include "trueflank/check/contact_judgement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/check/check_designs.h"
#include "tests/check/random_pairs.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/check/clearance/modified_clearance.h"
#include "trueflank/check/corner_contact.h"
#include "trueflank/check/mesh_clearance.h"
#include "trueflank/check/ring_criteria.h"

namespace trueflank::test {
namespace {

TEST(Judgement, FailingAndWorryingAreSumsOfOneEachAndWhatIsLackingUpToOne) {
  const Judgement judgement{
      .complaints = {{.id = "a", .layer = 1, .lacking = 0.25, .fails = true},
                     {.id = "b", .layer = 1, .lacking = 7.0, .fails = true},
                     {.id = "c", .layer = 2, .lacking = 0.5, .fails = false},
                     {.id = "d", .layer = 2, .lacking = 0.01, .fails = false},
                     {.id = "e", .layer = 2, .lacking = 3.0, .fails = false}}};
  EXPECT_DOUBLE_EQ(judgement.failing(), 1.25 + 2.0);
  EXPECT_DOUBLE_EQ(judgement.worrying(), 1.5 + 1.01 + 2.0);
  EXPECT_EQ(Judgement{}.failing(), 0.0);
  EXPECT_EQ(Judgement{}.worrying(), 0.0);
}

/// A random design of another module: what is lacking is told in modules.
std::optional<GearTrain> random_train(std::uint64_t seed, double module_mm) {
  GearboxDesign design = random_design(seed);
  design.module_mm = module_mm;
  design.backlash_mm *= module_mm;
  if (design.centre_distance_mm) *design.centre_distance_mm *= module_mm;
  for (GearDesign& g : design.gears)
    if (g.tip_diameter_mm) *g.tip_diameter_mm *= module_mm;
  auto train = lay_out(design);
  if (!train) return std::nullopt;
  return std::move(*train);
}

/// Findings by checks that need no turning, and of the line of action what lies beyond a start of
/// an involute.
std::vector<Complaint> complaints_of(const GearTrain& train) {
  std::vector<Complaint> complaints;
  const Findings findings = check_gearbox(
      train, std::vector<MeshState>(train.meshes.size(), MeshState{.removal = RadialRemoval{}}));
  for (const char* id :
       {"centre_distance", "backlash", "tip_clearance", "contact_ratio", "planet_spacing", "axial"})
    for (const Finding& f : findings) {
      if (f.id != id || f.status == CheckStatus::kPass || f.status == CheckStatus::kNotApplicable)
        continue;
      const double lacking = f.unit == "mm" ? -f.margin / train.design.module_mm : -f.margin;
      int layer = train.find(f.where) ? train.find(f.where)->layer : 0;
      for (const TrainMesh& mesh : train.meshes)
        if (mesh.name == f.where) layer = train.gears[static_cast<std::size_t>(mesh.gear2)].layer;
      complaints.push_back({f.id, layer, std::isnan(f.margin) ? 1.0 : std::max(lacking, 1e-6),
                            f.status == CheckStatus::kFail});
    }
  for (const TrainMesh& mesh : train.meshes) {
    const GearPair pair = train.pair(mesh);
    const LineOfAction line = line_of_action(pair);
    const double lost =
        std::max(line.effective_start_mm - line.start_mm, line.end_mm - line.effective_end_mm);
    if (lost > 1e-9)
      complaints.push_back({"fillet_interference",
                            train.gears[static_cast<std::size_t>(mesh.gear1)].layer,
                            lost / train.design.module_mm, false});
  }
  if (train.design.planets > 1 && !train.assembly.equal_spacing)
    complaints.push_back({"assembly", 0, 1.0, true});
  return complaints;
}

TEST(ContactJudge, ComplainsOfWhatTheChecksComplainOfAndByAsManyModules) {
  std::map<std::string, int> seen;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const auto train = random_train(seed, 2.5);
    if (!train) continue;
    SCOPED_TRACE(seed);
    const std::vector<Complaint> all = complaints_of(*train);
    for (const int layer : {0, 1, 2}) {
      std::vector<Complaint> expected;
      std::copy_if(all.begin(), all.end(), std::back_inserter(expected),
                   [&](const Complaint& c) { return layer == 0 || c.layer == layer; });
      const Judgement judged = ContactJudge::without_turning(*train, layer);
      ASSERT_EQ(judged.complaints.size(), expected.size()) << layer;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const Complaint& c = judged.complaints[i];
        EXPECT_EQ(c.id, expected[i].id);
        EXPECT_EQ(c.layer, expected[i].layer) << c.id;
        EXPECT_EQ(c.fails, expected[i].fails) << c.id;
        EXPECT_NEAR(c.lacking, expected[i].lacking, 1e-12) << c.id;
        ++seen[c.id];
      }
    }
  }
  for (const char* id : {"centre_distance", "tip_clearance", "contact_ratio", "planet_spacing",
                         "fillet_interference", "assembly"})
    EXPECT_GT(seen[id], 1) << id;
}

TEST(ContactJudge, ComplainsOfClearancesThatAreMissingAndOfTheirShareOfTheModule) {
  std::map<std::string, int> seen;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    auto train = random_train(seed, 2.0);
    if (!train) continue;
    SCOPED_TRACE(seed);
    if (seed % 3 == 1) train->design.made.clearance_mm = 0.03;
    if (seed % 4 == 2) train->design.corner_contact_limit_mm = 0.02;
    const double asked = train->design.made.clearance_mm.value_or(0.0);
    std::vector<Complaint> expected;
    for (const TrainMesh& mesh : train->meshes) {
      const GearPair pair = train->pair(mesh);
      const double centred = sweep_clearance_mm(pair),
                   played = driving_clearance(pair).clearance_mm;
      const double driving = std::isnan(played) ? centred : played;
      const int layer = train->gears[static_cast<std::size_t>(mesh.gear1)].layer;
      if (centred < asked - tolerance::kTouch_mm)
        expected.push_back({"overlap", layer, (asked - centred) / 2.0, true});
      if (driving < -tolerance::kTouch_mm)  // five thousandths of the module, if nothing is said
        expected.push_back(
            {"corner_contact", layer, -driving / 2.0, -driving > (seed % 4 == 2 ? 0.02 : 0.01)});
    }
    ContactJudge judge;
    const Judgement judged = judge.by_turning(*train);
    ASSERT_EQ(judged.complaints.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const Complaint& c = judged.complaints[i];
      EXPECT_EQ(c.id, expected[i].id);
      EXPECT_EQ(c.layer, expected[i].layer) << c.id;
      EXPECT_EQ(c.fails, expected[i].fails) << c.id << ' ' << c.lacking;
      EXPECT_NEAR(c.lacking, expected[i].lacking, 1e-12) << c.id;
      ++seen[c.id + (c.fails ? " fails" : " warns")];
    }
    // what was turned is remembered
    const int turned = judge.turned();
    EXPECT_EQ(turned, static_cast<int>(train->meshes.size()));
    EXPECT_EQ(judge.by_turning(*train).complaints.size(), expected.size());
    EXPECT_EQ(judge.turned(), turned);
  }
  for (const char* what : {"overlap fails", "corner_contact fails", "corner_contact warns"})
    EXPECT_GT(seen[what], 0) << what;
}

TEST(ContactJudge, TheTipInTheWayIsTheOneThatIsTooLong) {
  int cured = 0;
  for (const bool ring : {false, true})
    for (const double backlash_mm : {0.0, 0.05})
      for (const char* longer : {"pinion", "wheel"}) {
        GearboxDesign design = pair_design(24, 61, ring, backlash_mm);
        design.gears[0].shift = design.gears[1].shift = 0.0;
        const bool inwards = ring && longer == std::string("wheel");
        gear(design, longer).tip_diameter_mm =
            (longer == std::string("wheel") ? 61.0 : 24.0) + (inwards ? -2.7 : 2.7);
        const GearTrain train = laid_out(design);
        ContactJudge judge;
        const ContactJudge::Clearances& c = judge.clearances(train, train.meshes[0]);
        EXPECT_LT(c.centred_mm, 0.0);
        // the check of the same teeth names the same tip; where the other one is in the way as
        // well, none
        const Finding corner =
            only(check_corner_contact(train, mesh_states(train)), "corner_contact");
        if (corner.cure.find("tip diameter of ") != std::string::npos) {
          EXPECT_EQ(corner.cure.find(std::string("tip diameter of ") + longer + " "), 0u)
              << corner.cure;
          ++cured;
        }
        EXPECT_EQ(c.tip_of_gear1, longer == std::string("pinion"))
            << ring << ' ' << backlash_mm << ' ' << longer;
      }
  EXPECT_GE(cured, 6);
}

TEST(MeshStates, OfATrainAreThoseOfItsMeshesAlone) {
  GearboxDesign modified = paper_design(0.06);
  gear(modified, "planet1").modifications.crowning_um = 12.0;
  gear(modified, "ring2").modifications.profile_slope_um = 8.0;
  for (const GearboxDesign& design : {paper_design(0.06), modified, pair_design(19, 53, true, 0.05),
                                      pair_design(19, 37, false, 0.05)}) {
    const GearTrain train = laid_out(design);
    const std::vector<MeshState> states = mesh_states(train);
    ASSERT_EQ(states.size(), train.meshes.size());
    for (std::size_t i = 0; i < states.size(); ++i) {
      SCOPED_TRACE(train.meshes[i].name);
      const GearPair pair = train.pair(train.meshes[i]);
      const bool plain = std::isnan(states[i].centred.z_mm);
      if (plain) {
        EXPECT_EQ(states[i].centred.clearance_mm, mesh_clearance(pair).clearance_mm);
        EXPECT_EQ(states[i].driving.clearance_mm, driving_clearance(pair).clearance_mm);
      } else {
        EXPECT_EQ(states[i].centred.clearance_mm, modified_clearance_mm(train, train.meshes[i]));
      }
      ASSERT_EQ(states[i].removal.has_value(), pair.internal());
      if (!pair.internal()) continue;
      const RadialRemoval alone =
          plain ? radial_removal(pair) : modified_removal(train, train.meshes[i]);
      EXPECT_EQ(states[i].removal->free_at, alone.free_at);
      EXPECT_EQ(states[i].removal->free_share, alone.free_share);
      EXPECT_EQ(states[i].removal->at_every_rotation, alone.at_every_rotation);
    }
  }
}

}  // namespace
}  // namespace trueflank::test
