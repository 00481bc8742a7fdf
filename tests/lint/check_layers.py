#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Who may include whom: keeps the table of CONTRIBUTING.md true.

CMake cannot: all folders share one include root. Also checked here, because it is the same walk
through the tree: the licence line, kernels kept out of headers, Eigen's headers, every file listed for the build.
Usage: check_layers.py [ROOT]
"""
import re
import sys

from complaints import root_of_sources, told

# folder -> folders it may include besides itself. A room of a folder may have a row of its own.
LAYERS = {
    "base": [],
    "geometry": ["base"],
    "train": ["base", "geometry"],
    "design/kinds": ["base", "train"],
    "search": ["base", "geometry", "train", "design/kinds"],
    "check": ["base", "geometry", "train"],
    "solid": ["base", "geometry", "train"],
    "check/machine": ["base", "geometry", "train", "check", "solid"],  # of the parts around the gears
    "export": ["base", "geometry", "train", "solid"],
    "design": ["base", "geometry", "train", "search"],
    "loop": ["base", "geometry", "train", "solid", "export"],
    "loop/measured": ["base", "geometry", "train", "solid", "export"],
    "loop/discovery": ["base", "geometry"],  # the engine knows no gears
    "loop/result": ["base"],  # what gears and drives have in common
    "loop/gear": ["base", "geometry", "train", "solid", "export", "loop/measured", "loop/discovery", "loop/result"],
    "loop/gear/effects": ["base", "geometry", "loop/gear", "loop/result"],
    "loop/drive": ["base", "geometry", "train", "loop/measured", "loop/discovery", "loop/result"],
    "loop/drive/effects": ["base", "loop/drive", "loop/result"],
    "loop/drive/effects/parts": ["base", "loop/drive", "loop/result"],
    "report": ["base", "geometry", "train", "search", "check", "solid", "export", "loop"],
    "session": ["base", "geometry", "train", "search", "check", "solid", "export", "design", "loop",
                "report"],
    "app": ["base", "export", "design/kinds", "session"],  # words and options; of export files, format names
}

# third party: how its includes begin, folders whose .cpp may have it, folders whose headers may
EVERY = [name for name in LAYERS if "/" not in name]
THIRD_PARTY = {
    "tl::expected": (r"tl/expected", ["base"], ["base"]),
    "Eigen": (r"Eigen/", [f for f in EVERY if f != "base"], [f for f in EVERY if f != "base"]),
    "CGAL": (r"CGAL/", ["check", "solid"], []),
    "assimp": (r"assimp/", ["export"], []),  # loaded when a file asks for it
    "libdeflate": (r"libdeflate\.h", ["export"], []),
    "libharu": (r"hpdf", ["report"], []),
    # linked into tests only (33 ms at every start): tests/programs
    "OpenCASCADE": (r"(Standard|TopoDS|TopExp|BRep\w*|STEP\w*|XCAF\w*|gp)(_\w+)?\.hxx|opencascade/",
                    [], []),
    "Boost.Math": (r"boost/math/", ["loop"], []),
    "NLopt": (r"nlopt", ["search"], []),
    "nlohmann_json, declared only": (r"nlohmann/json_fwd\.hpp", ["report"], ["report"]),
    "nlohmann_json": (r"nlohmann/", ["export", "loop", "report", "session"], []),
    "CLI11": (r"CLI/", ["app"], []),
}

# What Eigen/Core declares and another of its headers defines. Without that header a source compiles, and links only
# where a precompiled header has it: the sanitizers' builds have none.
EIGEN_PARTS = {
    "Cholesky": re.compile(r"\.(?:ldlt|llt)\(\)"),
    "Geometry": re.compile(r"\.(?:cross|cross3)\("),
    "LU": re.compile(r"\.(?:determinant|inverse|lu|partialPivLu|fullPivLu)\(\)"),
    "QR": re.compile(r"\.(?:householderQr|colPivHouseholderQr|fullPivHouseholderQr)\(\)"),
    "SVD": re.compile(r"\.(?:jacobiSvd|bdcSvd)\("),
}

# top-level folders that nobody includes
OUTSIDE = ["tests", "examples", "bench", "fuzz", "python", "docs", "cmake", "scripts", "templates",
           "build"]

SPDX = "SPDX-License-Identifier: GPL-3.0-or-later"
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)
LINES = {".h": 300, ".cpp": 600}  # beyond: a warning, is it still one thing?


def check_includes(path, folder, text):
    is_header = path.suffix == ".h"
    for match in INCLUDE.finditer(text):
        bracket, name = match.groups()
        line = text.count("\n", 0, match.start(1)) + 1
        where = f"{path}:{line}: "
        own = re.match(r"trueflank/(\w+)/(?:(\w+)/)?", name)
        if own:
            other = own.group(1)
            row = path.parent.as_posix() if path.parent.as_posix() in LAYERS else folder
            room = f"{other}/{own.group(2)}"
            named = room if own.group(2) and (other == folder or room in LAYERS) else other
            if other not in LAYERS:
                yield where + f"there is no folder {other}/"
            elif named != path.parent.as_posix() and other not in LAYERS[row] and named not in LAYERS[row] \
                    and (row != folder or other != folder):
                allowed = ", ".join(LAYERS[row]) or "nothing"
                yield where + f"{row}/ may not include {named}/ (only {allowed})"
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


def check_eigen(path, text):
    for part, call in EIGEN_PARTS.items():
        match = call.search(text)
        if match and f"<Eigen/{part}>" not in text and "<Eigen/Dense>" not in text:
            line = text.count("\n", 0, match.start()) + 1
            yield f"{path}:{line}: {match.group().strip('.()')}() of Eigen needs <Eigen/{part}>"


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
                  if p.is_dir() and p.name not in OUTSIDE and not p.name.startswith(".")
                  and (p.name in LAYERS or sources_below(p)))


def public_headers(root):
    text = re.sub(r"#.*", "", (root / "cmake/public_headers.cmake").read_text(encoding="utf-8"))
    return re.findall(r"[\w/]+\.h\b", text)


def trueflank_includes(path):
    """(name, line) of what a file includes of this project."""
    text = path.read_text(encoding="utf-8")
    return [(m.group(2).removeprefix("trueflank/"), text.count("\n", 0, m.start(1)) + 1)
            for m in INCLUDE.finditer(text) if m.group(2).startswith("trueflank/")]


def check_public(root):
    """What is installed stands on itself, serves the examples, and is described."""
    if not (root / "cmake/public_headers.cmake").exists():
        return
    public = public_headers(root)
    for header in public:
        if not (root / header).is_file():
            yield f"cmake/public_headers.cmake: there is no {header}"
            continue
        for name, line in trueflank_includes(root / header):
            if name not in public:
                yield f"{header}:{line}: a public header includes {name}, which is not installed"
    for path in sorted((root / "examples/cpp").glob("*.cpp")):
        for name, line in trueflank_includes(path):
            if name not in public:
                yield f"{path.relative_to(root)}:{line}: {name} is not public (cmake/public_headers.cmake)"
    page = (root / "docs/api.md").read_text(encoding="utf-8")
    named = set(re.findall(r"`(\w+(?:/\w+)+\.h)`", page))
    for header in sorted(set(public) - named):
        yield f"docs/api.md does not describe {header}"
    for header in sorted(named - set(public)):
        yield f"docs/api.md describes {header}, which is not public"


def check(root):
    """All complaints, then all warnings, about the tree at `root`."""
    complaints, warnings = [], []
    folders = library_folders(root)
    for path in (p for top in folders for p in sources_below(top)):
        shown = path.relative_to(root)
        text = path.read_text(encoding="utf-8")
        folder = shown.parts[0]
        if folder not in LAYERS:
            complaints.append(f"{shown}: {folder}/ is in no row of the include table")
            continue
        complaints += check_includes(shown, folder, text)
        complaints += check_eigen(shown, text)
        if path.suffix == ".h" and "#pragma once" not in text:
            complaints.append(f"{shown}: no #pragma once")
        # in the CMakeLists.txt of its room, where that has one, or of its folder
        builder = path.parent if (path.parent / "CMakeLists.txt").exists() else root / folder
        if path.relative_to(builder).as_posix() not in listed_files(builder / "CMakeLists.txt"):
            complaints.append(f"{shown}: not listed in {builder.relative_to(root)}/CMakeLists.txt")
    for top in (*folders, *(root / name for name in ("tests", "examples", "bench"))):
        for path in sources_below(top):
            shown = path.relative_to(root)
            text = path.read_text(encoding="utf-8")
            if not first_line_is_licence(text):
                complaints.append(f"{shown}:1: the first line must be // {SPDX}")
            count = text.count("\n")
            if count > LINES[path.suffix]:
                warnings.append(f"{shown}: {count} lines; is it still one thing?")
    complaints += check_public(root)
    return complaints, warnings


def main():
    complaints, warnings = check(root_of_sources())
    for warning in warnings:
        print("warning: " + warning)
    return told(complaints)


if __name__ == "__main__":
    sys.exit(main())
