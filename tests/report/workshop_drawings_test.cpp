// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/drawing/workshop_drawings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/check/machine_designs.h"
#include "trueflank/base/units.h"
#include "trueflank/check/check_gearbox.h"
#include "trueflank/design/design_file.h"
#include "trueflank/export/hole_patterns.h"
#include "trueflank/report/drawing/axial_section.h"
#include "trueflank/report/drawing/balloons.h"
#include "trueflank/report/drawing/face_view.h"
#include "trueflank/report/report.h"

namespace trueflank::io {
namespace {

/// An example laid out, with its report; lives as long as its sheets are looked at.
GearboxDesign design_of(const std::string& example) {
  const auto file =
      read_design_file(std::string(TRUEFLANK_SOURCE_DIR) + "/examples/" + example + "/design.toml");
  EXPECT_TRUE(file.has_value());
  return file->design;
}

struct Drawn {
  explicit Drawn(const std::string& example) : Drawn(design_of(example)) {}
  explicit Drawn(const GearboxDesign& design) {
    train = std::make_shared<const GearTrain>(*lay_out(design));
    shapes = *part_shapes(*train);
    Report document;
    document.train = train;
    document.shapes = shapes;
    document.efficiency = efficiency(*train);
    report = nlohmann::ordered_json::parse(report_json(document));
  }
  [[nodiscard]] DrawingModel model() const {
    return {.train = train.get(), .shapes = &shapes, .report = &report, .materials = &materials};
  }
  [[nodiscard]] const PartShape& part(const std::string& name) const {
    for (const PartShape& p : shapes.parts)
      if (p.name == name) return p;
    throw std::runtime_error("no part " + name);
  }
  std::shared_ptr<const GearTrain> train;
  PartShapes shapes;
  nlohmann::ordered_json report;
  StrengthOptions materials;
};

bool says(const Sheet& sheet, const std::string& words) {
  for (const SheetText& text : sheet.texts)
    if (text.text == words) return true;
  return false;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

double hatched_area(const AxialSection& section) {
  double area = 0.0;
  for (const SectionBand& band : section.bands)
    if (!band.teeth) area += (band.z_upper_mm - band.z_lower_mm) * (band.to_mm - band.from_mm);
  return area;
}

TEST(AxialSection, TheHatchedAreaIsThatOfBodyWithoutTeethAndHoles) {
  const Drawn drawn("bilateral_drive");
  const auto& gears = drawn.report["gears"];
  const double root = gears["sun"]["root_diameter_mm"], width = gears["sun"]["face_width_mm"];
  const BoreDesign& bore = find_gear(drawn.train->design, "sun")->bore;
  ASSERT_EQ(bore.kind, BoreKind::kDFlat);  // the plane of the section meets the flat
  EXPECT_NEAR(hatched_area(axial_section(drawn.part("sun"))), width * (root - bore.d_flat_mm),
              1e-9);
}

TEST(AxialSection, EveryEdgeIsOnTheBoundaryOfMaterialOrAcrossAHole) {
  const Drawn drawn("bilateral_drive");
  for (const PartShape& part : drawn.shapes.parts)
    for (const SectionEdge& edge : axial_section(part).edges) {
      EXPECT_TRUE(edge.z1_mm == edge.z2_mm || edge.x1_mm == edge.x2_mm);
      EXPECT_LE(std::abs(edge.x1_mm), outermost_mm(part.slabs.front().outer) + 100.0);
    }
}

TEST(WorkshopDrawings, TheTableHoldsTheNumbersOfTheReport) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("planet"));
  for (const char* gear : {"planet1", "planet2"})
    for (const char* key : {"tip_diameter_mm", "root_diameter_mm", "base_diameter_mm"})
      EXPECT_TRUE(says(sheet, drawing_number(drawn.report["gears"][gear][key], 4)))
          << gear << ' ' << key;
  EXPECT_TRUE(says(sheet, "39"));
  EXPECT_TRUE(says(sheet, "ring2, z 81"));
}

const PartDiameter* diameter_of(const PartDimensions& dimensions, double diameter_mm) {
  for (const PartDiameter& d : dimensions.diameters)
    if (std::abs(d.diameter_mm - diameter_mm) < 1e-9) return &d;
  return nullptr;
}

TEST(WorkshopDrawings, EveryGearOfAPartAndItsFacesAreToleranced) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("planet"));
  const PartDimensions asked = part_dimensions(*drawn.train, drawn.part("planet"));
  const auto tips = asked.of(ToleratedFeature::kTips),
             upper = asked.of(ToleratedFeature::kUpperFace);
  const auto lower = asked.of(ToleratedFeature::kLowerFace),
             bore = asked.of(ToleratedFeature::kSeat);
  ASSERT_EQ(tips.size(), 2U);
  ASSERT_EQ(upper.size(), 2U);
  // a fifth of 16 um over 12 mm of teeth, on a face of 35.2551 mm: 9.4 um, which a face need not
  // keep
  EXPECT_EQ(upper[0].kind, ToleranceKind::kCircularRunout);
  EXPECT_EQ(upper[0].value_mm, 0.01);
  EXPECT_EQ(upper[1].kind, ToleranceKind::kFlatness);
  EXPECT_EQ(upper[1].value_mm, 0.01);
  ASSERT_EQ(lower.size(), 1U);
  EXPECT_EQ(lower[0].kind, ToleranceKind::kParallelism);
  EXPECT_EQ(lower[0].datum, 'B');
  ASSERT_EQ(bore.size(), 1U);
  EXPECT_EQ(bore[0].kind, ToleranceKind::kCylindricity);
  EXPECT_EQ(bore[0].value_mm, 0.0045);  // half of IT5 of 19 mm: ISO 286-1, 9 um
  for (const char* words : {"0.01", "0.0045", "Ra 1.6", "Ra 3.2", "B"})
    EXPECT_TRUE(says(sheet, words)) << words;
  EXPECT_TRUE(says(sheet, drawing_number(tips[0].value_mm, 3)));
  EXPECT_EQ(std::count_if(sheet.texts.begin(), sheet.texts.end(),
                          [](const SheetText& t) { return t.text == "A" && t.height_mm < 3.2; }),
            4);
}

TEST(WorkshopDrawings, AGearWithoutABoreHasNoDatumAndNoTolerances) {
  const Drawn drawn("pinion_8_undercut");
  for (const PartShape& part : drawn.shapes.parts) {
    PartShape solid = part;
    for (Slab& slab : solid.slabs) slab.holes.clear();
    const PartDimensions asked = part_dimensions(*drawn.train, solid);
    EXPECT_EQ(asked.datum(), nullptr);
    EXPECT_TRUE(asked.tolerances.empty());
  }
}

TEST(WorkshopDrawings, WhatIsPrintedIsNotAskedForWhatIsMachined) {
  const Drawn drawn(
      "printed_actuator");  // fdm-0.4: +-0.04 between two walls, runout 0.08, layers of 0.2
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("planet"));
  for (const char* words :
       {"±(0.04 + 0.2 %), height ±0.2", "none, fdm-0.4", "0.08", "as printed", "Ø16.1 ±0.04", "Ø12.15"})
    EXPECT_TRUE(says(sheet, words)) << words;
  for (const char* words : {"ISO 2768-mK", "Ra 1.6", "Ra 3.2", "7", "Edges broken 0.1 to 0.3."})
    EXPECT_FALSE(says(sheet, words)) << words;
  for (const GeometricTolerance& t : part_dimensions(*drawn.train, drawn.part("planet")).tolerances)
    EXPECT_EQ(t.value_mm, 0.08) << to_text(t.kind);
}

TEST(WorkshopDrawings, SpanAndPinsHaveTheLimitsThatTheProcessHolds) {
  const Drawn drawn("printed_actuator");
  const auto& flanks = drawn.report["parts"]["planet"]["flanks"]["planet1"];
  const double least = flanks["span_min_mm"], most = flanks["span_max_mm"];
  // +-0.04 of thickness on the reference circle is that times the cosine of 20 degrees along the base tangent
  EXPECT_NEAR(most - least, 0.08 * std::cos(rad_from_deg(20.0)), 1e-9);
  EXPECT_TRUE(says(part_sheet(drawn.model(), drawn.part("planet")), drawing_number(least, 3) + " .. " + drawing_number(most, 3)));
  EXPECT_TRUE(Drawn("external_pair").report["parts"]["pinion"]["flanks"]["pinion"]["span_min_mm"].is_null());
}

TEST(WorkshopDrawings, TheClassIsTheDesignsThenTheProcesssThenSeven) {
  GearboxDesign design = design_of("external_pair");
  EXPECT_EQ(workmanship(*lay_out(design)).flank_class, 7);
  design.made.process = *ProcessTable().find("cnc-hobbing");
  EXPECT_EQ(workmanship(*lay_out(design)).flank_class, 8);
  design.made.tolerance_class = 5;
  EXPECT_EQ(workmanship(*lay_out(design)).flank_class, 5);
  const Drawn drawn(design);
  EXPECT_TRUE(says(part_sheet(drawn.model(), drawn.part("pinion")), "Ra 0.8"));
  design.made = {.process = *ProcessTable().find("laser")};
  EXPECT_EQ(workmanship(*lay_out(design)).flank_class, 0);
  EXPECT_EQ(general_tolerance_text(workmanship(*lay_out(design))), "ISO 2768-mK");
}

TEST(WorkshopDrawings, ATextureIsNoHigherThanItsTolerance) {
  for (const auto& [tolerance_um, ra] : {std::pair{50.0, 3.2},
                                         {19.3, 3.2},
                                         {11.0, 1.6},
                                         {9.7, 1.6},
                                         {5.6, 0.8},
                                         {2.0, 0.2},
                                         {0.1, 0.1}})
    EXPECT_EQ(roughness_um(tolerance_um), ra) << tolerance_um;
}

TEST(WorkshopDrawings, SeatsOfACarrierFitAndItsPinsStandWhereTheyHaveTo) {
  const Drawn drawn("carried_drive");
  const PartDimensions plate = part_dimensions(*drawn.train, drawn.part("carrier"));
  ASSERT_NE(diameter_of(plate, 32.0), nullptr);
  EXPECT_EQ(diameter_of(plate, 32.0)->limits.fit, "H7");
  EXPECT_EQ(plate.datum(), diameter_of(plate, 32.0));
  EXPECT_EQ(part_dimensions(*drawn.train, drawn.part("carrier_pin")).diameters.at(0).limits.fit,
            "h6");
  const auto holes = plate.of(ToleratedFeature::kHoles);
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(holes[0].value_mm, 0.021);  // IT7 of 25.6826 mm: ISO 286-1
  const Sheet sheet = part_sheet(drawn.model(), drawn.part("carrier"));
  for (const char* words : {"Ø0.021", "Ø10.02 H7 (+0.018 / 0) through", "Ø32 H7 (+0.025 / 0)"})
    EXPECT_TRUE(says(sheet, words)) << words;
}

TEST(WorkshopDrawings, HolesOfScrewsMayBeOffByHalfTheirPlay) {
  const Drawn drawn("printed_actuator");
  const PartDimensions housing = part_dimensions(*drawn.train, drawn.part("housing"));
  const auto holes = housing.of(ToleratedFeature::kHoles);
  ASSERT_EQ(holes.size(), housing.holes.size());
  for (const GeometricTolerance& t : holes) EXPECT_EQ(t.value_mm, 0.2);  // M3 in 3.4: half of 0.4
  EXPECT_EQ(housing.holes.back().use.thread, "M3");
}

TEST(WorkshopDrawings, AnIndexMarkIsNoHole) {
  const Drawn drawn("printed_actuator");
  const PartShape& planet = drawn.part("planet");
  ASSERT_EQ(planet.marks.size(), 1U);
  EXPECT_TRUE(part_dimensions(*drawn.train, planet).holes.empty());
  const Sheet sheet = part_sheet(drawn.model(), planet);
  EXPECT_FALSE(says(sheet, "Holes"));
  EXPECT_TRUE(std::any_of(sheet.texts.begin(), sheet.texts.end(), [](const SheetText& t) {
    return t.text.find("Index mark: 1 x") != std::string::npos;
  }));
}

TEST(WorkshopDrawings, SizesWithoutAFitHaveTheGeneralTolerance) {
  // ISO 2768-1, class m
  for (const auto& [size, limit] : {std::pair{0.5, 0.1},
                                    {6.0, 0.1},
                                    {6.1, 0.2},
                                    {30.0, 0.2},
                                    {31.0, 0.3},
                                    {120.0, 0.3},
                                    {400.0, 0.5},
                                    {1000.0, 0.8}}) {
    EXPECT_EQ(general_limits(size).upper_mm, limit) << size;
    EXPECT_EQ(general_limits(size).lower_mm, -limit) << size;
  }
  EXPECT_TRUE(std::isnan(general_limits(0.4).upper_mm));
  EXPECT_TRUE(std::isnan(general_limits(5000.0).upper_mm));
}

TEST(WorkshopDrawings, TheAssemblyListsEveryPartWithItsCount) {
  const Drawn drawn("bilateral_drive");
  const Sheet sheet = assembly_sheet(drawn.model());
  EXPECT_TRUE(says(sheet, "Planet, z 39, z 32"));
  EXPECT_TRUE(says(sheet, "3"));
  EXPECT_TRUE(says(sheet, "Ring 2, z 81"));
}

const char* const kExamples[] = {
    "bilateral_drive", "external_pair",    "internal_pair",      "helical_planetary",
    "carried_drive",   "simple_planetary", "pinion_8_undercut",  "ring_shaper",
    "relieved_3k",     "herringbone_pair", "printed_actuator",   "boxed_pair",
    "split_ring",      "stepped",          "planetary_actuator", "stepped_actuator"};

std::vector<Sheet> sheets_of(const Drawn& drawn) {
  std::vector<Sheet> sheets;
  for (const PartShape& part : drawn.shapes.parts)
    if (part.bought.empty()) sheets.push_back(part_sheet(drawn.model(), part));
  if (drawn.shapes.assembly.size() > 1) sheets.push_back(assembly_sheet(drawn.model()));
  return sheets;
}

/// The rectangle of a text, as narrow as Helvetica is.
std::pair<Point2, Point2> place_of(const SheetText& text) {
  const double width = 0.7 * text_width_mm(text.text, text.height_mm);
  const double from = text.anchor == TextAnchor::kLeft    ? 0.0
                      : text.anchor == TextAnchor::kRight ? -width
                                                          : -0.5 * width;
  const Point2 along = unit_vector(text.rotation_rad), up = perpendicular(along);
  const Point2 a = text.at + from * along,
               b = text.at + (from + width) * along + text.height_mm * up;
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

TEST(WorkshopDrawings, EverythingLiesOnTheSheetForEveryExample) {
  for (const char* example : kExamples)
    for (const Sheet& sheet : sheets_of(Drawn(example))) {
      const Point2 high(sheet.width_mm - 9.9, sheet.height_mm - 9.9);
      const auto inside = [&](const Point2& low, const Point2& top) {
        return low.minCoeff() > 9.9 && (high - top).minCoeff() > 0.0;
      };
      for (const SheetPath& path : sheet.paths)
        for (const Point2& p : path.points)
          EXPECT_TRUE(inside(p, p)) << example << ' ' << sheet.name;
      for (const SheetArc& arc : sheet.arcs) {
        const Point2 reach = arc.to_rad - arc.from_rad < 6.28
                                 ? Point2(0.0, 0.0)
                                 : Point2(arc.radius_mm, arc.radius_mm);
        EXPECT_TRUE(inside(arc.centre - reach, arc.centre + reach)) << example << ' ' << sheet.name;
      }
      for (const SheetText& text : sheet.texts)
        EXPECT_TRUE(inside(place_of(text).first, place_of(text).second))
            << example << ' ' << sheet.name << ' ' << text.text;
    }
}

TEST(WorkshopDrawings, NoTextStandsOnAnother) {
  for (const char* example : kExamples)
    for (const Sheet& sheet : sheets_of(Drawn(example)))
      for (std::size_t i = 0; i < sheet.texts.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
          const auto [low1, high1] = place_of(sheet.texts[i]);
          const auto [low2, high2] = place_of(sheet.texts[k]);
          const bool apart =
              ((low1 - high2).array() > -0.05).any() || ((low2 - high1).array() > -0.05).any();
          EXPECT_TRUE(apart) << example << ' ' << sheet.name << ": " << sheet.texts[i].text
                             << " on " << sheet.texts[k].text;
        }
}

TEST(WorkshopDrawings, HolesAreSaidByToolAndPlace) {
  const Drawn drawn("printed_actuator");
  const Sheet housing = part_sheet(drawn.model(), drawn.part("housing"));
  // the motor's screws go through the floor, their heads are sunk from inside; inserts come from
  // outside
  for (const char* words : {"Ø3.4 through", "Ø6.1 x 3.2 deep from the right",
                            "Ø4 x 10.8 deep from the left", "first at 45 deg from x"})
    EXPECT_TRUE(says(housing, words)) << words;
  const Sheet top = part_sheet(drawn.model(), drawn.part("carrier_top"));
  EXPECT_TRUE(says(top, "Ø5.1 ±0.04 x 4.3 deep from the left"));  // blind, for the planets' pins
  EXPECT_TRUE(says(top, "1.6"));                            // depth of the bore about the axis
}

TEST(WorkshopDrawings, HolesTakeAwayWhatTheShapeLacks) {
  for (const char* example : {"printed_actuator", "boxed_pair", "carried_drive"})
    for (const PartShape& part : Drawn(example).shapes.parts) {
      double drilled = 0.0, missing = 0.0;
      for (const HolePattern& pattern : hole_patterns(part))
        for (const HoleStep& step : pattern.steps)
          drilled += static_cast<double>(pattern.centres.size()) * step.diameter_mm *
                     step.diameter_mm * step.depth_mm();
      for (const CircleOutline& mark : part.marks)
        drilled += 4.0 * mark.radius_mm * mark.radius_mm *
                   (part.slabs.back().z_upper_mm - part.slabs.back().z_lower_mm);
      for (const Slab& slab : part.slabs)
        for (const Outline& hole : slab.holes)
          if (const auto* circle = std::get_if<CircleOutline>(&hole);
              circle && circle->centre.norm() > 1e-6)
            missing +=
                4.0 * circle->radius_mm * circle->radius_mm * (slab.z_upper_mm - slab.z_lower_mm);
      EXPECT_NEAR(drilled, missing, 1e-6 * (1.0 + missing)) << example << ' ' << part.name;
    }
}

TEST(WorkshopDrawings, AnAssemblyIsAsLargeAsItsBodies) {
  // the wheel stands beside the axis: twice the largest distance from it would be far too much
  const Drawn drawn("external_pair");
  const auto& gears = drawn.report["gears"];
  const double height = 0.5 * gears["pinion"]["tip_diameter_mm"].get<double>() +
                        drawn.report["train"]["centre_distance_mm"].get<double>() +
                        0.5 * gears["wheel"]["tip_diameter_mm"].get<double>();
  EXPECT_TRUE(says(assembly_sheet(drawn.model()), drawing_number(height, 3)));
}

TEST(WorkshopDrawings, WhatIsBoughtAndNoBodyIsListedToo) {
  // a round shaft: a set screw and its nut hold the sun
  const Sheet sheet =
      assembly_sheet(Drawn(*read_design_text(round_shaft(k3k + kMachine), "design.toml")).model());
  EXPECT_TRUE(says(sheet, "set screw ISO 4029 M3x4"));
  EXPECT_TRUE(says(sheet, "square nut DIN 562 M3"));
}

TEST(WorkshopDrawings, WhatIsBoughtIsOneRowADesignationWithoutMaterial) {
  const Drawn drawn("printed_actuator");
  const Sheet sheet = assembly_sheet(drawn.model());
  EXPECT_EQ(std::count_if(sheet.texts.begin(), sheet.texts.end(),
                          [](const SheetText& t) { return t.text == "ISO 4762 M3x30"; }),
            1);
  EXPECT_TRUE(says(sheet, "18"));  // inserts M3x5.7 of four groups of screws
  EXPECT_TRUE(says(sheet, "to buy"));
}

TEST(WorkshopDrawings, LinesToItemNumbersDoNotCrossWhereTheyNeedNot) {
  std::vector<Balloon> balloons;
  std::vector<Point2> seats;
  for (int i = 0; i < 12; ++i) {
    // by height alone each would get the seat on the other side, and every line cross the next
    balloons.push_back({i + 1, {{i % 2 == 0 ? 30.0 : -20.0, 10.0 * i + 3.0}}});
    seats.emplace_back(i % 2 == 0 ? -30.0 : 40.0, 10.0 * i);
  }
  Sheet sheet;
  draw_balloons(sheet, balloons, seats);
  ASSERT_EQ(sheet.paths.size(), 12U);
  const auto side = [](const Point2& a, const Point2& b, const Point2& c) {
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
  };
  int crossings = 0;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const auto &p = sheet.paths[i].points, &q = sheet.paths[k].points;
      crossings += side(p[0], p[1], q[0]) * side(p[0], p[1], q[1]) < 0.0 &&
                           side(q[0], q[1], p[0]) * side(q[0], q[1], p[1]) < 0.0
                       ? 1
                       : 0;
    }
  EXPECT_EQ(crossings, 0);
}

TEST(WorkshopDrawings, ATextMovesAwayFromLinesToRowsBelow) {
  std::vector<Dimension> both = {
      {.from = {0.0, 0.0}, .to = {40.0, 0.0}, .line_at_mm = -10.0, .text = "11"},
      {.from = {19.0, 0.0}, .to = {21.0, 0.0}, .line_at_mm = -18.0, .text = "1"}};
  move_texts_aside(both);
  EXPECT_GT(std::abs(both[0].text_aside_mm), 1.0 + 0.5 * text_width_mm("11", 2.5));
  EXPECT_LT(std::abs(both[0].text_aside_mm), 18.0);
  EXPECT_EQ(both[1].text_aside_mm, 0.0);
}

PartShape disc(double radius_mm, const Point2& centre, double thickness_mm) {
  return {.name = "disc", .slabs = {{0.0, thickness_mm, CircleOutline{centre, radius_mm}, {}}}};
}

TEST(FaceView, WhatStandsInFrontHides) {
  // a disc of radius 5 before one of radius 10 whose centre is 10 away: two circles cut where cos =
  // 1 - 25 / 200
  const PartShape near = disc(5.0, Point2::Zero(), 2.0), far = disc(10.0, Point2::Zero(), 2.0);
  const auto edges =
      view_from_below({{.part = &near}, {.part = &far, .offset = {10.0, 0.0}, .z_mm = 2.0}});
  double seen = 0.0, hidden = 0.0;
  for (const ViewedEdge& edge : edges)
    if (edge.radius_mm == 10.0) (edge.hidden ? hidden : seen) += edge.to_rad - edge.from_rad;
  EXPECT_NEAR(hidden, 2.0 * std::acos(1.0 - 25.0 / 200.0), 1e-5);
  EXPECT_NEAR(seen + hidden, kTwoPi, 1e-9);
}

TEST(FaceView, AHoleShowsWhatIsBehindIt) {
  PartShape plate = disc(20.0, Point2::Zero(), 2.0);
  plate.slabs.front().holes.push_back(CircleOutline{{10.0, 0.0}, 4.0});
  const PartShape pin = disc(2.0, Point2::Zero(), 2.0);
  for (const auto& [x, hidden] : {std::pair{10.0, false}, {-10.0, true}})
    for (const ViewedEdge& edge :
         view_from_below({{.part = &plate}, {.part = &pin, .offset = {x, 0.0}, .z_mm = 2.0}})) {
      if (edge.radius_mm == 2.0) {
        EXPECT_EQ(edge.hidden, hidden);
      }
    }
}

TEST(WorkshopDrawings, TheSameDesignGivesTheSameBytes) {
  const Drawn drawn("external_pair");
  const std::filesystem::path folder =
      std::filesystem::path(TRUEFLANK_TEST_OUTPUT_DIR) / "drawings";
  for (const char* run : {"1", "2"}) {
    std::filesystem::create_directories(folder / run);
    const auto files = write_workshop_drawings(drawn.model(), {.folder = folder / run, .part = ""});
    ASSERT_TRUE(files.has_value());
    EXPECT_EQ(files->size(), 6U);  // pinion, wheel, assembly
  }
  for (const char* name : {"pinion.pdf", "pinion_drawing.dxf", "assembly.pdf"})
    EXPECT_EQ(bytes_of(folder / "1" / name), bytes_of(folder / "2" / name)) << name;
}

TEST(WorkshopDrawings, AFolderThatIsNotThereIsSaid) {
  const Drawn drawn("external_pair");
  const auto files =
      write_workshop_drawings(drawn.model(), {.folder = "/nonexistent/folder", .part = ""});
  ASSERT_FALSE(files.has_value());
  EXPECT_EQ(files.error().code, ErrorCode::kFileNotFound);
}

}  // namespace
}  // namespace trueflank::io
