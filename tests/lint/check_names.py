#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A class has one definition: its qualified name stands in one file of the library, program and bindings.

Two structs of one name in one namespace are undefined behaviour where both are linked into one program: the
linker takes one destructor for both, and no compiler says so. Names in unnamed namespaces are a file's own.

Usage: check_names.py [ROOT]
"""
import re
import sys

import check_layers
from complaints import root_of_sources, told

NAMESPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*) \{(?!.*\})")
CLOSE = re.compile(r"^\}  ?// (?:inline )?namespace")
TYPE = re.compile(r"^(?:template ?<.*> ?)?(?:struct|class|enum class|enum|union) (\w+)(?: final)?(?: :(?!:)[^;]*)? ?(?:\{|$)")


def names(text):
    """Qualified names of the types a file defines at namespace scope; namespaces are not indented and their
    ends say so in a comment."""
    found, spaces = [], []
    for line in text.split("\n"):
        if match := NAMESPACE.match(line):
            spaces.append(match.group(1))
        elif CLOSE.match(line) and spaces:
            spaces.pop()
        elif (match := TYPE.match(line)) and "" not in spaces:
            found.append("::".join([*spaces, match.group(1)]))
    return found


def check(root):
    files = {}
    for top in [*check_layers.library_folders(root), root / "python"]:
        for path in sorted([*top.rglob("*.h"), *top.rglob("*.cpp")]):
            for name in set(names(path.read_text(encoding="utf-8"))):
                files.setdefault(name, []).append(path.relative_to(root).as_posix())
    return [f"{name} is defined in {' and in '.join(where)}: one of them needs another name"
            for name, where in sorted(files.items()) if len(where) > 1]


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
