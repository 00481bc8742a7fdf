#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every header compiles as the only include of a file.

A build that compiles each source alone (`dev`, the sanitizers) proves it of a header that is the first
thing a source includes, and of what is the first thing that such a header includes: nearly every one. The
others are compiled here, with the flags of a source of their folder.
"""
import concurrent.futures
import functools
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "lint"))
import check_layers

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["TRUEFLANK_BINARY_DIR"])


# To read the precompiled headers takes half a second of the processor: what reads little else than these is quicker without.
HEAVY = re.compile(r"Eigen/|boost/|nlohmann/|tl/|filesystem|functional|random|regex")


@functools.cache
def included(file):
    return re.findall(r'^#include [<"](.*)[">]', file.read_text(), re.M)


def ours(include):
    return SOURCE / include.removeprefix("trueflank/") if include.startswith("trueflank/") else None


def compiled_first(sources):
    """Headers of ours that some source compiles with nothing before them."""
    found = set()
    for file in sources:
        while file is not None and (first := included(file)[:1]):
            file = ours(first[0])
            if file is None or file in found:
                break
            found.add(file)
    return found


@functools.cache
def is_light(header):
    return all(is_light(ours(i)) if ours(i) else not HEAVY.match(i) for i in included(header))


def without_precompiled(command):
    return [w for w, before in zip(command, [""] + command) if "-include" not in (w, before)]


def flags_by_folder():
    flags = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        file = pathlib.Path(entry["directory"], entry["file"]).resolve()
        words = shlex.split(entry["command"])
        # without what names the input, the output and the files of dependencies
        kept = [w for i, w in enumerate(words)
                if w not in ("-c", "-o", "-MD", "-MF", "-MT") and words[i - 1] not in ("-o", "-MF", "-MT")
                and pathlib.Path(entry["directory"], w).resolve() != file]
        # sources that are compiled together are included by one in the build folder
        folders = {file.parent}
        if file.is_relative_to(BUILD) and file.exists():
            folders = {pathlib.Path(path).parent for path in re.findall(r'#include "(.*?)"', file.read_text())}
        for folder in folders:
            flags.setdefault(folder, (entry["directory"], kept))
    return flags


def main():
    headers = sorted(h for top in check_layers.library_folders(SOURCE) for h in top.rglob("*.h"))
    sources = [s for top in [*check_layers.library_folders(SOURCE), SOURCE / "tests"] for s in top.rglob("*.cpp")]
    first = compiled_first(sources)
    others = [h for h in headers if h not in first]
    flags = flags_by_folder()

    def compile_alone(header):
        # base has no source, hence no flags of its own
        directory, command = flags.get(header.parent) or flags[SOURCE / "geometry"]
        if is_light(header):
            command = without_precompiled(command)
        text = f'#include "trueflank/{header.relative_to(SOURCE)}"\n'
        return header, subprocess.run([*command, "-fsyntax-only", "-x", "c++", "-"], input=text, text=True,
                                      cwd=directory, capture_output=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        broken = [(h, run.stderr) for h, run in pool.map(compile_alone, others) if run.returncode != 0]
    for header, message in broken:
        print(f"{header.relative_to(SOURCE)} does not compile alone:\n{message}")
    print(f"{len(headers) - len(others)} headers are compiled first by a source, "
          f"{len(others)} compiled alone, {len(broken)} do not")
    if len(headers) < 100 or len(others) == len(headers):
        sys.exit("this looked at the wrong folders")
    sys.exit(1 if broken else 0)


main()
