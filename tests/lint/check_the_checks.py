#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The lint tests themselves: each rule broken once in a small tree must be found, and nothing else."""
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import check_bindings
import check_documents
import check_layers
import check_locale
import check_names
import check_nodiscard
import check_recipe
import check_surveys

LICENCE = "// SPDX-License-Identifier: GPL-3.0-or-later\n"
HEADER = LICENCE + "#pragma once\n"


class Tree(unittest.TestCase):
    def setUp(self):
        self.holder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.holder.name)

    def tearDown(self):
        self.holder.cleanup()

    def write(self, path, text, listed=True):
        file = self.root / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text, encoding="utf-8")
        if listed:
            with open(file.parent / "CMakeLists.txt", "a", encoding="utf-8") as build:
                build.write(file.name + "\n")


class Layers(Tree):
    def assert_one(self, part):
        complaints, _ = check_layers.check(self.root)
        self.assertEqual(len(complaints), 1, complaints)
        self.assertIn(part, complaints[0])

    def test_a_good_tree_has_no_complaint(self):
        self.write("geometry/gear.h", HEADER + '#include <Eigen/Core>\n#include <vector>\n')
        self.write("check/cut.cpp", LICENCE + '#include "trueflank/check/cut.h"\n'
                   '#include <CGAL/Surface_mesh.h>\n#include "trueflank/geometry/gear.h"\n')
        self.assertEqual(check_layers.check(self.root), ([], []))

    def test_a_wrong_folder(self):
        self.write("geometry/gear.h", HEADER + '#include "trueflank/train/train.h"\n')
        self.assert_one("gear.h:3: geometry/ may not include train/")

    def test_a_room_that_includes_its_neighbour(self):
        self.write("loop/discovery/engine.cpp", LICENCE + '#include "trueflank/loop/gear/pose/pose.h"\n', listed=False)
        self.write("loop/CMakeLists.txt", "discovery/engine.cpp\n", listed=False)
        self.assert_one("engine.cpp:2: loop/discovery/ may not include loop/gear/")

    def test_an_unknown_folder(self):
        self.write("utils/text.h", HEADER)
        self.assert_one("no row")

    def test_an_include_of_an_unknown_folder(self):
        self.write("base/text.h", HEADER + '#include "trueflank/utils/text.h"\n')
        self.assert_one("no folder utils/")

    def test_a_kernel_in_a_header(self):
        self.write("solid/cut.h", HEADER + "#include <CGAL/Surface_mesh.h>\n")
        self.assert_one("CGAL never appears in a header")

    def test_a_kernel_in_a_folder_without_it(self):
        self.write("train/cut.cpp", LICENCE + "#include <CGAL/Surface_mesh.h>\n")
        self.assert_one("train/ may not use CGAL")

    def test_what_another_header_of_eigen_defines(self):
        self.write("geometry/area.cpp", LICENCE + "#include <Eigen/Core>\n"
                   "double area(const Eigen::Matrix2d& m) { return m.determinant(); }\n")
        self.assert_one("area.cpp:3: determinant() of Eigen needs <Eigen/LU>")

    def test_opencascade_anywhere(self):
        self.write("export/step.cpp", LICENCE + "#include <STEPControl_Writer.hxx>\n")
        self.assert_one("may not use OpenCASCADE")

    def test_an_include_of_tests(self):
        self.write("base/text.cpp", LICENCE + '#include "tests/support/text.h"\n')
        self.assert_one("nobody includes tests/")

    def test_a_short_path(self):
        self.write("base/text.cpp", LICENCE + '#include "text.h"\n')
        self.assert_one("whole path")

    def test_no_licence(self):
        self.write("tests/base/text_test.cpp", "#include <vector>\n")
        self.assert_one("first line must be")

    def test_no_pragma_once(self):
        self.write("base/text.h", LICENCE)
        self.assert_one("#pragma once")

    def test_a_file_nobody_builds(self):
        self.write("base/text.cpp", LICENCE, listed=False)
        self.assert_one("not listed")

    def test_a_long_file_is_only_a_warning(self):
        self.write("base/text.h", HEADER + "\n" * 400)
        complaints, warnings = check_layers.check(self.root)
        self.assertEqual((complaints, len(warnings)), ([], 1))


class Names(Tree):
    def complaints(self, first, second):
        self.write("base/x.h", LICENCE + first)
        self.write("geometry/y.cpp", LICENCE + second)
        return [c.split()[0] for c in check_names.check(self.root)]

    def test_one_name_for_two_types_is_found(self):
        self.assertEqual(self.complaints("namespace a::b {\nstruct S {\n};\n}  // namespace a::b\n",
                                         "namespace a::b {\nclass S : public T {\n};\n}  // namespace a::b\n"), ["a::b::S"])

    def test_what_is_not_one_name_passes(self):
        self.assertEqual(self.complaints(
            "namespace a {\nclass S;\nstruct T {\n};\nnamespace {\nstruct U {\n};\n}  // namespace\n}  // namespace a\n",
            "namespace a {\nclass S {\n};\nstruct T::Part {\n};\n}  // namespace a\nnamespace c {\nstruct T {\n};\n"
            "struct U {\n};\n}  // namespace c\n"), [])


class Nodiscard(Tree):
    def names(self, declarations):
        self.write("base/x.h", HEADER + declarations)
        return [c.split(": ")[1].split()[0] for c in check_nodiscard.check(self.root)]

    def test_declarations_without_it_are_found(self):
        self.assertEqual(self.names(
            "Result<int> plain();\n"
            "/// Says [[nodiscard]] in words only.\n"
            "Result<std::vector<double>> commented(int a);\n"
            "class A {\n public:\n  static Result<A> make(const S& s);\n  Result<void> write() const;\n};\n"
            "inline Result<int> defined() { return 1; }\n"
            "template <typename T>\nResult<T> read(const std::string& s);\n"
            "Status done(\n    int a);\n"
            "ResultAll<Gear> everything(int a);\n"
            "Result<std::pair<int, std::function<double(double)>>> nested();\n"),
            ["plain", "commented", "make", "write", "defined", "read", "done", "everything",
             "nested"])

    def test_declarations_with_it_pass(self):
        self.assertEqual(self.names(
            "[[nodiscard]] Result<int> plain();\n"
            "[[nodiscard]]\nResult<std::vector<double>> broken_line(int a);\n"
            "class A {\n public:\n  [[nodiscard]] static Result<A> make(const S& s);\n};\n"
            "template <typename T>\n[[nodiscard]] inline Result<T> read(const std::string& s);\n"), [])

    def test_uses_are_no_declarations(self):
        self.assertEqual(self.names(
            "template <class T>\nusing Result = tl::expected<T, Error>;\n"
            "void take(const Result<int>& r, Result<double> other);\n"
            "struct S {\n  Result<int> member;\n  std::function<Result<int>(int)> call;\n};\n"
            "inline int f() {\n  const Result<int> r = g();\n  return *r;\n}\n"), [])


class Locale(unittest.TestCase):
    def test_what_hangs_on_the_locale_is_found(self):
        for asked in ("vsnprintf", "__vsnprintf_chk", "tolower", "isalpha", "__isoc99_sscanf", "setlocale"):
            complaints = check_locale.check(f"a.a:u.o:                 U {asked}\na.a:u.o:                 U memcpy\n")
            self.assertEqual(len(complaints), 1, asked)
            self.assertIn("a.a:u.o asks for", complaints[0])

    def test_other_names_are_none(self):
        self.assertEqual(check_locale.check("a.a:u.o:     U snprintf\na.a:u.o:     U _ZN1a7tolowerEv\n"
                                            "a.a:u.o:     T tolower\na.a:u.o:     U strtod\n"), [])


class Surveys(Tree):
    SOURCE = (LICENCE + "const int kRuns = survey_size(4, 200);\nvoid ask(int seed) {\n  seed += kRuns;\n}\n"
              "TEST(Places, AreFound) {\n  ask(1);\n}\nTEST(Places, AreFew) {\n  ask_once();\n}\n")

    def complaints(self, campaign):
        self.write("tests/loop/places_test.cpp", self.SOURCE, listed=False)
        self.write("tests/loop/CMakeLists.txt", campaign + "\n", listed=False)
        return check_surveys.check(self.root)

    def test_a_survey_that_no_campaign_asks_is_found(self):
        for campaign in ("", "trueflank_campaign(loop Others.*)", "trueflank_campaign(loop Places.AreFew)"):
            self.assertEqual(self.complaints(campaign),
                             ["tests/loop/places_test.cpp: Places.AreFound is shorter in the gate and in no campaign"])

    def test_one_that_a_campaign_asks_passes(self):
        for campaign in ("trueflank_campaign(loop Others.*:Places.*)",
                         "set(surveys\n  Others\n  Places)\ntrueflank_campaign(loop ${surveys})"):
            self.assertEqual(self.complaints(campaign), [])


class Documents(Tree):
    def complaints(self, readme, page="# 0001: Folders\n", index="- [0001](0001-folders.md): Folders\n"):
        self.write("README.md", readme, listed=False)
        self.write("docs/loop.md", "# The loop\n## What is *told*, and how\n## Files\n## Files\n", listed=False)
        self.write("docs/decisions/0001-folders.md", page, listed=False)
        self.write("docs/decisions/README.md", "# Decisions\n" + index, listed=False)
        return check_documents.check(self.root)

    def test_links_that_lead_somewhere_pass(self):
        self.assertEqual(self.complaints("# Gears\n[a](docs/loop.md) [b](docs/loop.md#what-is-told-and-how) [c](#gears)\n"
                                         "[d](docs/loop.md#files-1) [e](https://example.org/x) `[f](no.md)`\n"
                                         "```\n[g](no.md)\n```\n"), [])

    def test_links_that_lead_nowhere_are_found(self):
        self.assertEqual(self.complaints("[a](docs/lop.md)"), ["README.md: the link docs/lop.md leads to no file"])
        self.assertEqual(self.complaints("[a](docs/loop.md#told)"), ["README.md: the link docs/loop.md#told leads to no heading"])

    def test_a_decision_that_is_not_listed_is_found(self):
        self.assertEqual(self.complaints("", index=""), ["docs/decisions/README.md: 0001-folders.md is listed 0 times"])

    def test_a_decision_under_another_heading_is_found(self):
        self.assertEqual(self.complaints("", page="# 0001 Folders\n"),
                         ['docs/decisions/0001-folders.md: its heading is "# 0001 Folders", the index has "0001: Folders"'])


class Bindings(Tree):
    def complaints(self, body):
        self.write("base/x.cpp", LICENCE + "void f() {\n" + body + "}\n", listed=False)
        return [c.split(": ")[0] + " " + c.split()[-1] for c in check_bindings.check(self.root)]

    def test_what_a_lambda_takes_is_found(self):
        self.assertEqual(self.complaints("const auto [low, high] = ends();\nask([&](double x) { return x > low; });\n"), ["base/x.cpp:4 low"])
        self.assertEqual(self.complaints("for (const auto& [key, of] : all)\n  ask([=] { return of.size(); });\n"), ["base/x.cpp:4 of"])
        self.assertEqual(self.complaints("for (auto& [key, of] : all) {\n  return [&] { return key; };\n}\n"), ["base/x.cpp:4 key"])

    def test_what_it_does_not_take_passes(self):
        for body in ("const auto [a, b] = g();\nask([&, b = b] { return b; });\n",
                     "ask([&] {\n  const auto [a, b] = g();\n  return a;\n});\n",
                     "const auto [a, b] = g();\nask([&](int a) { return a; });\nrow[a] = 1;\n",
                     "const auto [a, b] = g();\nask([&] { return of.a + b::c; });\n",
                     "const auto [a, b] = g();\nask([&] {\n  const auto& [a, c] = h;\n  return a;\n});\n",
                     "for (const auto& [a, b] : all) h(a);\nfor (double a : more) ask([&] { return a; });\n"):
            self.assertEqual(self.complaints(body), [], body)


class Recipe(Tree):
    MAKEFILE = ("JOBS ?= 2\ntest:\n\t@scripts/install-dependencies build\n\t@cmake --preset release -DX=ON\n"
                "\t@cmake --build --preset release -j $(JOBS) --target fuzzers\n\t@ctest --preset release; days=$$?; \\\n\t  exit $$days\n")

    def complaints(self, *steps, makefile=MAKEFILE):
        preset = [{"name": "release"}, {"name": "base", "hidden": True}]
        self.write("CMakePresets.json", json.dumps({"configurePresets": preset, "buildPresets": preset, "testPresets": preset}), listed=False)
        self.write("fuzz/CMakeLists.txt", "add_custom_target(fuzzers)\n", listed=False)
        self.write("scripts/packages-build.txt", "make\n", listed=False)
        self.write("scripts/install-dependencies", "#!/bin/sh\n", listed=False)
        (self.root / "scripts/install-dependencies").chmod(0o755)
        self.write("Makefile", makefile, listed=False)
        self.write("docs/ci/github-actions.yml", "".join(f"      - run: {step}\n" for step in steps), listed=False)
        return check_recipe.check(self.root)

    def test_steps_that_exist_pass(self):
        self.assertEqual(self.complaints("scripts/install-dependencies build && apt-get install -y clang-14", "make test JOBS=4",
                                         "cmake --preset release -B b && cmake --build b --target fuzzers"), [])

    def test_steps_that_do_not_are_found(self):
        for step, part in (("make tset", "no tset"), ("make test MINUTES=1", "no MINUTES"), ("cmake --preset relaese", "no preset relaese"),
                           ("ctest --preset base", "no preset base"), ("cmake --build b --target fuzzer", "no target fuzzer"),
                           ("scripts/instal-dependencies", "no program"), ("scripts/install-dependencies test", "no list"),
                           ("mkae test", "what is mkae")):
            found = self.complaints(step)
            self.assertEqual(len(found), 1, (step, found))
            self.assertIn(part, found[0])

    def test_lines_of_the_makefile_are_looked_at(self):
        found = self.complaints(makefile=self.MAKEFILE.replace("ctest --preset release", "ctest --preset asan"))
        self.assertEqual(found, ["Makefile: no preset asan for ctest"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "-v"])
