#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every function of a header that returns Result, ResultAll or Status says [[nodiscard]].

tl::expected itself does not say it.

Usage: check_nodiscard.py [ROOT]
"""
import re
import sys

import check_layers
from complaints import root_of_sources, told

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
# A declaration begins after one of ; { } : or a preprocessor line. What stands before the return
# type (attributes, static, inline, a template head) is group 1.
DECLARATION = re.compile(
    r"(?:^|[;{}]|\b(?:public|private|protected):)\s*"
    r"((?:template\s*<[^;{}]*?>\s*|\[\[[^\]]*\]\]\s*|\b(?:static|inline|constexpr|virtual|friend)\s+)*)"
    r"(?:trueflank::)?(?:Result(?:All)?\s*<[^;{}()]*(?:\([^;{}()]*\)[^;{}()]*)?>|Status)\s+"
    r"(?:\w+::)*(\w+|operator\s*\S+?)\s*\(")


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def check(root):
    complaints = []
    for path in sorted(p for top in check_layers.library_folders(root) for p in top.rglob("*.h")):
        text = COMMENT.sub(blank, path.read_text(encoding="utf-8"))
        # a preprocessor line ends what went before
        text = re.sub(r"^[ \t]*#[^\n]*", lambda m: ";" + " " * (len(m.group(0)) - 1), text,
                      flags=re.MULTILINE)
        position = 0
        while match := DECLARATION.search(text, position):
            position = match.end()
            if "nodiscard" not in match.group(1):
                line = text.count("\n", 0, match.start(2)) + 1
                complaints.append(f"{path.relative_to(root)}:{line}: {match.group(2)} returns a "
                                  "Result: declare it [[nodiscard]]")
    return complaints


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
