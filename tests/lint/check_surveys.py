#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A test that makes fewer trials in the gate is asked whole by the campaign: what its `TEST` names of survey_size.h, or
a constant or function of the file that does, and the filters of `trueflank_campaign` in the folder's CMakeLists.txt.

Usage: check_surveys.py [ROOT]
"""
import fnmatch
import re
import sys

from complaints import root_of_sources, told

FEWER = {"survey_size", "survey_of", "is_surveyed", "surveys_are_whole", "seldom_fewer"}
TEST = re.compile(r"TEST(?:_F|_P)?\((\w+),\s*(\w+)\)")
DEFINED = re.compile(r"^(?!TEST|#|//)[^\n(=;]*?(\w+) ?(?:\(|=)")
CAMPAIGN = re.compile(r"trueflank_campaign\(\w+ ([^)]+)\)")
LIST = re.compile(r"set\((\w+)\s([^)]*)\)")


def surveys(text):
    """Suite.Test of all tests of a source that make fewer trials in the gate."""
    parts = re.split(r"\n(?=\S)", text)  # one a definition, as its inside is indented
    fewer, asked = set(FEWER), set()
    while True:
        told = re.compile(r"\b(?:" + "|".join(sorted(fewer)) + r")\b")
        found = {m[1] for part in parts if (m := DEFINED.match(part)) and told.search(part[m.end():])} - fewer
        if not found:
            break
        fewer |= found
    for part in parts:
        if (test := TEST.match(part)) and told.search(part[test.end():]):
            asked.add(f"{test[1]}.{test[2]}")
    return asked


def filters(build):
    """Patterns of the campaigns of a CMakeLists.txt; a list of suites stands for their tests."""
    lists = {name: [f"{suite}.*" for suite in words.split()] for name, words in LIST.findall(build)}
    found = []
    for of in CAMPAIGN.findall(build):
        variable = re.fullmatch(r"\$\{(\w+)\}", of)
        found += lists.get(variable[1], []) if variable else of.split(":")
    return found


def check(root):
    complaints = []
    for build in sorted((root / "tests").glob("*/CMakeLists.txt")):
        patterns = filters(build.read_text(encoding="utf-8"))
        for path in sorted(build.parent.glob("*_test.cpp")):
            for name in sorted(surveys(path.read_text(encoding="utf-8"))):
                # (a suite of parameters is called by its instance, too)
                if not any(fnmatch.fnmatch(full, p) for p in patterns for full in (name, "One/" + name + "/one")):
                    complaints.append(f"{path.relative_to(root).as_posix()}: {name} is shorter in the gate and in no campaign")
    return complaints


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
