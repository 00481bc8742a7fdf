#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Who may include whom: keeps the table of CONTRIBUTING.md true.

CMake cannot: all folders share one include root. Also checked here, because it is the same walk
through the tree: the licence line, kernels kept out of headers, every file listed for the build.
Usage: check_layers.py [ROOT]
"""
import os
import pathlib
import re
import sys

# folder -> folders it may include besides itself
LAYERS = {
    "base": [],
    "geometry": ["base"],
    "train": ["base", "geometry"],
    "check": ["base", "geometry", "train"],
    "solid": ["base", "geometry", "train"],
    "export": ["base", "geometry", "train", "check", "solid"],
    "design": ["base", "geometry", "train"],
    "loop": ["base", "geometry", "train", "solid", "export"],
    "app": ["base", "geometry", "train", "check", "solid", "export", "design", "loop"],
}

# third party: how its includes begin, folders whose .cpp may have it, folders whose headers may
EVERY = list(LAYERS)
THIRD_PARTY = {
    "tl::expected": (r"tl/expected", ["base"], ["base"]),
    "Eigen": (r"Eigen/", [f for f in EVERY if f != "base"], [f for f in EVERY if f != "base"]),
    "CGAL": (r"CGAL/", ["check", "solid", "loop"], []),
    "assimp": (r"assimp/", [], []),  # tests only: an independent reader
    "isa-l": (r"isa-l\.h", ["export"], []),
    "zlib": (r"zlib\.h", ["export"], []),
    # linked into tests only (33 ms at every start): tests/programs
    "OpenCASCADE": (r"(Standard|TopoDS|TopExp|BRep\w*|STEP\w*|XCAF\w*|gp)(_\w+)?\.hxx|opencascade/",
                    [], []),
    "Ceres": (r"ceres/", ["loop"], []),
    "NLopt": (r"nlopt", ["train"], []),
    "nlohmann_json": (r"nlohmann/", ["export", "loop", "app"], []),
    "CLI11": (r"CLI/", ["app"], []),
}

# folders at the top level that hold no code of the library
OUTSIDE = ("bench", "build", "cmake", "docs", "examples", "python", "scripts", "templates", "tests")

SPDX = "SPDX-License-Identifier: GPL-3.0-or-later"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
LINES = {".h": 300, ".cpp": 600}  # beyond: a warning, is it still one thing?


def check_includes(path, folder, text):
    is_header = path.suffix == ".h"
    for match in INCLUDE.finditer(text):
        bracket, name = match.groups()
        line = text.count("\n", 0, match.start(1)) + 1
        where = f"{path}:{line}: "
        own = re.match(r"trueflank/(\w+)/", name)
        if own:
            other = own.group(1)
            if other not in LAYERS:
                yield where + f"there is no folder trueflank/{other}"
            elif other != folder and other not in LAYERS[folder]:
                allowed = ", ".join(LAYERS[folder]) or "nothing"
                yield where + f"{folder}/ may not include {other}/ (only {allowed})"
            continue
        if re.match(r"(tests|examples|bench|templates)/", name):
            yield where + f"nobody includes {name.split('/')[0]}/"
            continue
        for party, (pattern, sources, headers) in THIRD_PARTY.items():
            if re.match(pattern, name):
                if is_header and folder not in headers:
                    yield where + f"{party} never appears in a header of {folder}/"
                elif folder not in sources:
                    yield where + f"{folder}/ may not use {party}"
                break
        else:
            if bracket == '"':
                yield where + f'write the whole path: "trueflank/<folder>/{name}"'


def first_line_is_licence(text):
    lines = text.splitlines()
    if lines and lines[0].startswith("#!"):
        lines = lines[1:]
    return bool(lines) and SPDX in lines[0]


def listed_files(cmake_file):
    if not cmake_file.exists():
        return set()
    text = re.sub(r"#.*", "", cmake_file.read_text(encoding="utf-8"))
    return set(re.findall(r"[\w./-]+\.(?:cpp|h)\b", text))


def sources_below(top):
    return sorted(p for p in top.rglob("*") if p.suffix in (".h", ".cpp") and p.is_file())


def library_folders(root):
    """The folders at the top level that hold code of the library or the program."""
    return sorted(p for p in root.iterdir()
                  if p.is_dir() and p.name not in OUTSIDE and not p.name.startswith(".") and sources_below(p))


def check(root):
    """All complaints, then all warnings, about the tree at `root`."""
    complaints, warnings = [], []
    for path in (p for folder in library_folders(root) for p in sources_below(folder)):
        shown = path.relative_to(root)
        text = path.read_text(encoding="utf-8")
        folder = shown.parts[0]
        if folder not in LAYERS:
            complaints.append(f"{shown}: {folder}/ is in no row of the include table")
            continue
        complaints += check_includes(shown, folder, text)
        if path.suffix == ".h" and "#pragma once" not in text:
            complaints.append(f"{shown}: no #pragma once")
        if path.relative_to(root / folder).as_posix() not in listed_files(root / folder / "CMakeLists.txt"):
            complaints.append(f"{shown}: not listed in {folder}/CMakeLists.txt")
    for top in (*library_folders(root), *(root / folder for folder in ("tests", "examples", "bench"))):
        for path in sources_below(top):
            shown = path.relative_to(root)
            text = path.read_text(encoding="utf-8")
            if not first_line_is_licence(text):
                complaints.append(f"{shown}:1: the first line must be // {SPDX}")
            count = text.count("\n")
            if count > LINES[path.suffix]:
                warnings.append(f"{shown}: {count} lines; is it still one thing?")
    return complaints, warnings


def main():
    default = os.environ.get("TRUEFLANK_SOURCE_DIR", pathlib.Path(__file__).parents[2])
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else default)
    complaints, warnings = check(root)
    for warning in warnings:
        print("warning: " + warning)
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
