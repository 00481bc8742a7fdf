// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/measured/read_measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace trueflank::loop {
namespace {

using Notes = std::vector<std::string>;

TEST(ScanCsv, ReadsColumnsInAnyOrderWithComments) {
  Notes notes;
  const auto scan = read_scan_csv("a.csv", "# unit = mm\nz_mm,x_mm,y_mm,sigma_um\n3,1,2,5\r\n6,4,5,\n",
                                  notes);
  ASSERT_TRUE(scan);
  ASSERT_EQ(scan->points_mm.size(), 2u);
  EXPECT_EQ(scan->points_mm[0], (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(scan->sigma_um[0], 5.0);
  EXPECT_TRUE(notes.empty());
}

TEST(ScanCsv, UsesTheGoodHalfAndSaysSo) {
  Notes notes;
  const auto scan = read_scan_csv("a.csv", "x_mm,y_mm,z_mm\n1,2,3\n1,x,3\n1,nan,3\n1,2\n", notes);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->points_mm.size(), 1u);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_NE(notes[0].find("a.csv:3:"), std::string::npos);
}

TEST(ScanCsv, LeavesOutPointsFartherThanAnyMeasurement) {
  Notes notes;
  const auto scan = read_scan_csv("a.csv", "x_mm,y_mm,z_mm\n1,2,3\n1,2,1e300\n-2e6,0,0\n", notes);
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->points_mm.size(), 1u);
  EXPECT_EQ(notes.size(), 2u);
  EXPECT_EQ(read_xyz("a.xyz", "1 2 3\n1 1e7 3\n4 5 6\n", notes)->points_mm.size(), 2u);
  const auto far = read_scan_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1e30 0\nf 1 2 3\n", notes);
  ASSERT_TRUE(far);
  for (const auto& p : far->points_mm) EXPECT_TRUE(is_measured_point(p));
}

TEST(ScanCsv, WithoutAUsablePointNamesFileAndLine) {
  Notes notes;
  const auto scan = read_scan_csv("a.csv", "x_mm,y_mm,z_mm\n1,,3\n", notes);
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().file, "a.csv");
  EXPECT_EQ(scan.error().line, 2);
  EXPECT_EQ(scan.error().code, ErrorCode::kSyntax);
}

TEST(ScanCsv, WithoutAColumnSaysWhich) {
  Notes notes;
  const auto scan = read_scan_csv("a.csv", "x_mm,y_mm\n1,2\n", notes);
  ASSERT_FALSE(scan);
  EXPECT_EQ(scan.error().key, "z_mm");
}

TEST(InspectionCsv, ReadsRecordsFlanksAndZero) {
  Notes notes;
  const auto data = read_inspection_csv(
      "i.csv",
      "# zero = common\n# ball_diameter_mm = 2.5\nrecord,tooth,flank,diameter_mm,z_mm,deviation_um\n"
      "profile,1,left,24.1,5,1.5\nhelix,2,Right,24,1,-2\nindex,3,left,,,4\nradial,3,,,,1\n",
      notes);
  ASSERT_TRUE(data);
  ASSERT_EQ(data->rows.size(), 4u);
  EXPECT_TRUE(data->common_zero);
  EXPECT_EQ(data->ball_diameter_mm, 2.5);
  EXPECT_EQ(data->rows[1].flank, Flank::kRight);
  EXPECT_EQ(data->rows[0].line, 4);
}

TEST(InspectionCsv, ABallHasADiameter) {
  const std::string rows = "\nrecord,tooth,flank,diameter_mm,z_mm,deviation_um\nradial,3,,,,1\n";
  Notes notes;
  for (const std::string ball : {"0", "-1.7", "nan", "small", "1.7 in"}) {
    const auto data = read_inspection_csv("i.csv", "# ball_diameter_mm = " + ball + rows, notes);
    ASSERT_FALSE(data) << ball;
    EXPECT_EQ(data.error().key, "ball_diameter_mm");
    EXPECT_EQ(data.error().value, ball);
    EXPECT_EQ(data.error().file, "i.csv");
  }
  EXPECT_TRUE(read_inspection_csv("i.csv", "# ball_diameter_mm =" + rows, notes));  // not told
}

TEST(InspectionCsv, EveryWrongRowIsNamed) {
  Notes notes;
  const auto data = read_inspection_csv("i.csv",
                                        "record,tooth,flank,diameter_mm,z_mm,deviation_um\n"
                                        "profil,1,left,24,5,1\nprofile,0,left,24,5,1\n"
                                        "profile,1,top,24,5,1\n",
                                        notes);
  ASSERT_FALSE(data);
  EXPECT_EQ(data.error().line, 2);
  EXPECT_NE(data.error().message.find("profil"), std::string::npos);
}

TEST(SizesCsv, NeedsTheDetailOfASpan) {
  Notes notes;
  const auto data = read_sizes_csv("s.csv", "quantity,value_mm,detail\nspan,10.1,\nbore,5.01,\n", notes);
  ASSERT_TRUE(data);
  EXPECT_EQ(data->rows.size(), 1u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("s.csv:2"), std::string::npos);
}

TEST(ScanMesh, StlOfBothKindsGivesTheSamePoints) {
  Notes notes;
  const std::string ascii =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
      "endfacet\nendsolid a\n";
  std::string binary(84 + 50, '\0');
  const std::uint32_t one = 1;
  std::memcpy(binary.data() + 80, &one, 4);
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::memcpy(binary.data() + 96, corners, 36);
  const auto a = read_scan_mesh("a.stl", ascii, notes), b = read_scan_mesh("b.stl", binary, notes);
  ASSERT_TRUE(a);
  ASSERT_TRUE(b);
  EXPECT_EQ(a->points_mm, b->points_mm);
  ASSERT_EQ(a->normals.size(), 3u);
  EXPECT_EQ(a->normals[0][2], 1.0f);
}

TEST(ScanMesh, ReadsPlyCloudsAndObjFaces) {
  Notes notes;
  const auto ply = read_scan_mesh("a.ply",
                                  "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                                  "property float y\nproperty float z\nend_header\n1 2 3\n4 5 6\n",
                                  notes);
  ASSERT_TRUE(ply);
  EXPECT_EQ(ply->points_mm.size(), 2u);
  EXPECT_TRUE(ply->normals.empty());
  const auto obj = read_scan_mesh("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1/1 2/2 4/4 3/3\n", notes);
  ASSERT_TRUE(obj);
  EXPECT_EQ(obj->points_mm.size(), 4u);
}

TEST(ScanMesh, ABinaryFileCutShortIsUsedForWhatItHolds) {
  std::string text(80, '\0');
  const std::uint32_t promised = 300, there = 150;
  text.append(reinterpret_cast<const char*>(&promised), 4);
  for (std::uint32_t i = 0; i < there; ++i) {
    const float x = static_cast<float>(i);
    const std::array<float, 12> facet{0, 0, 1, x, 0, 0, x + 1, 0, 0, x, 1, 0};
    text.append(reinterpret_cast<const char*>(facet.data()), 48);
    text.append(2, '\0');
  }
  Notes notes;
  const auto scan = read_scan_mesh("cut.stl", text + "half", notes);
  ASSERT_TRUE(scan);
  EXPECT_GE(scan->points_mm.size(), there);
  ASSERT_FALSE(notes.empty());
  EXPECT_NE(notes[0].find("150 of 300"), std::string::npos);
}

TEST(ScanMesh, BrokenFilesAreRefused) {
  Notes notes;
  EXPECT_FALSE(read_scan_mesh("a.stl", "rubbish", notes));
  EXPECT_FALSE(read_scan_mesh("a.ply", "plu\n", notes));
  EXPECT_FALSE(read_scan_mesh("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n", notes));
  const auto obj = read_scan_mesh("a.obj", "v 0 0 0\nf 1 2 3\n", notes);
  ASSERT_FALSE(obj);
  EXPECT_EQ(obj.error().line, 2);
}

TEST(Mka, ReadsTracesOverTheMeasuredRange) {
  Notes notes;
  const std::string text =
      "  21 :Normalmodul mn........[mm]..:  1.859\n"
      " 40 :Start Messbereich.....da  [mm]..:  174.2  174.2\n"
      " 43 :Ende Messbereich......de  [mm]..:  182.8  182.8\n"
      " 44 :Start Messbereich.....ba  [mm]..:  0.0\n"
      " 45 :Ende Messbereich......be  [mm]..:  42.0\n"
      "Profil:  Zahn-Nr.: 1a rechts / 3 Werte  / z= 21.0\n  1.0  2.0\n -2147483.648\n\n"
      "Flankenlinie:  Zahn-Nr.: 12 links / 3 Werte  / d= 178.0\n 0.5 0.6 0.7\n\n"
      "linke Zahnflanke\n";  // an empty table
  const auto data = read_mka("a.mka", text, notes);
  ASSERT_TRUE(data);
  ASSERT_EQ(data->rows.size(), 5u);
  EXPECT_EQ(data->rows[0].record, RecordKind::kProfile);
  EXPECT_EQ(data->rows[0].flank, Flank::kRight);
  EXPECT_EQ(data->rows[1].fraction, 0.5);
  EXPECT_EQ(data->rows[1].diameter_to_mm, 182.8);
  EXPECT_EQ(data->rows[3].z_mm, 21.0);
  EXPECT_EQ(data->rows[4].tooth, 12);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(Mka, ReadsPitchTablesCountedClockwise) {
  Notes notes;
  const std::string text =
      "  21 :Normalmodul mn........[mm]..:  1.859\n"
      "  22 :Z\xE4hnezahl..............:  4\n"
      "        linke Zahnflanke\n        Zahn-Nr.  fp  Fp  Fr\n\n  1  0.0 0.0 0.3\n  2  1.5 1.5 0.1\n"
      "  3  0.5 2.0 0.2\n  4  -1.0 1.0 0\n\n"
      "        rechte Zahnflanke\n        Zahn-Nr.  fp  Fp  Fr\n  1  0.1 0.1 0.3\n  2 0 -2147483.648 0\n"
      "Teilung:\n";
  const auto data = read_mka("a.mka", text, notes);
  ASSERT_TRUE(data);
  ASSERT_EQ(data->rows.size(), 5u);
  EXPECT_EQ(data->rows[0].tooth, 1);
  EXPECT_EQ(data->rows[1].tooth, 4);  // the second clockwise is the last counter-clockwise
  EXPECT_EQ(data->rows[3].tooth, 2);
  EXPECT_EQ(data->rows[1].record, RecordKind::kIndex);
  EXPECT_TRUE(data->rows[1].along_circle);
  EXPECT_EQ(data->rows[1].deviation_um, -1.5);
  EXPECT_EQ(data->rows[4].flank, Flank::kRight);
  EXPECT_EQ(notes.size(), 1u);
}

TEST(Gde, ReadsPointsByLocalNamesAndListsTheRest) {
  Notes notes;
  const std::string text =
      "<?xml version=\"1.0\"?><g:gear xmlns:g=\"x\"><g:curve_profile tooth_number=\"2\" flank=\"left\">"
      "<g:point><g:diameter>24.0</g:diameter><g:deviation>1.5</g:deviation></g:point>"
      "<g:operator>someone</g:operator></g:curve_profile></g:gear>";
  const auto data = read_gde("a.xml", text, notes);
  ASSERT_TRUE(data);
  ASSERT_EQ(data->rows.size(), 1u);
  EXPECT_EQ(data->rows[0].tooth, 2);
  EXPECT_EQ(data->rows[0].deviation_um, 1.5);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("operator"), std::string::npos);
  EXPECT_FALSE(read_gde("b.xml", "<a/>", notes));
}

TEST(Mka, ATraceOfAnImpossibleToothIsLeftOut) {
  for (const char* tooth : {"99999999999999999999", "0", "2000000000"}) {
    Notes notes;
    const std::string text =
        " 40 :Start Messbereich.....da  [mm]..:  174.2\n 43 :Ende Messbereich......de  [mm]..:  182.8\n"
        "Profil:  Zahn-Nr.: " + std::string(tooth) + " rechts / 2 Werte  / z= 21.0\n  1.0  2.0\n"
        "Profil:  Zahn-Nr.: 3 rechts / 2 Werte  / z= 21.0\n  1.0  2.0\n";
    const auto data = read_mka("a.mka", text, notes);
    ASSERT_TRUE(data) << tooth;
    ASSERT_EQ(data->rows.size(), 2u) << tooth;
    EXPECT_EQ(data->rows[0].tooth, 3);
    EXPECT_NE(std::find_if(notes.begin(), notes.end(), [](const std::string& note) {
                return note.find("tooth number that can be") != std::string::npos;
              }), notes.end());
  }
}

TEST(Gde, APointOfAnImpossibleToothIsLeftOut) {
  for (const char* tooth : {"1e30", "-3", "2.5", "rubbish", "nan"}) {
    Notes notes;
    const std::string point =
        "<point><diameter>24.0</diameter><deviation>1.5</deviation></point></curve_profile>";
    const auto data = read_gde("a.xml",
                               "<gear><curve_profile tooth=\"" + std::string(tooth) + "\">" + point +
                                   "<curve_profile tooth=\"7\" tooth_width=\"12.5\">" + point + "</gear>",
                               notes);
    ASSERT_TRUE(data) << tooth;
    ASSERT_EQ(data->rows.size(), 1u) << tooth;
    EXPECT_EQ(data->rows[0].tooth, 7);
  }
}

TEST(Gde, ATagOfManyEqualSignsIsReadAtOnce) {
  Notes notes;
  std::string tag = "<a x";
  for (int i = 0; i < 300'000; ++i) tag += "==y";
  EXPECT_FALSE(read_gde("a.xml", tag + ">", notes));
}

TEST(MeasuredFiles, WhatNeverEndsIsRefused) {
  const auto data = read_measured_files({"/dev/zero"});
  ASSERT_FALSE(data);
  EXPECT_EQ(exit_code(data.error().front().code), 2);
  EXPECT_EQ(data.error().front().file, "/dev/zero");
}

TEST(MeasuredFiles, MissingFileIsAnErrorOfTheEnvironment) {
  const auto data = read_measured_files({"/nowhere/a.csv"});
  ASSERT_FALSE(data);
  EXPECT_EQ(exit_code(data.error().front().code), 3);
}

TEST(BenchFile, WhatCannotBeReadIsNoFileOfAGear) {
  const auto missing = is_bench_file("/nowhere/a.csv");
  ASSERT_FALSE(missing);
  EXPECT_EQ(exit_code(missing.error().code), 3);
  const auto device = is_bench_file("/dev/null");
  ASSERT_FALSE(device);
  EXPECT_EQ(exit_code(device.error().code), 2);
}

}  // namespace
}  // namespace trueflank::loop
