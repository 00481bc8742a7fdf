#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every header compiles as the only include of a file.

A build that compiles each source alone (`dev`, the sanitizers) proves it of a header that is the first
thing its own source includes, which is nearly every one; the others are compiled here, with the flags
of a source of their folder.
"""
import concurrent.futures
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


def is_first_of_its_source(header):
    source = header.with_suffix(".cpp")
    if not source.exists():
        return False
    first = re.search(r'^#include [<"](.*)[">]', source.read_text(), re.M)
    return first is not None and SOURCE / first.group(1).removeprefix("trueflank/") == header


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
    others = [h for h in headers if not is_first_of_its_source(h)]
    flags = flags_by_folder()

    def compile_alone(header):
        # base has no source, hence no flags of its own
        directory, command = flags.get(header.parent) or flags[SOURCE / "geometry"]
        text = f'#include "trueflank/{header.relative_to(SOURCE)}"\n'
        return header, subprocess.run([*command, "-fsyntax-only", "-x", "c++", "-"], input=text, text=True,
                                      cwd=directory, capture_output=True)

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        broken = [(h, run.stderr) for h, run in pool.map(compile_alone, others) if run.returncode != 0]
    for header, message in broken:
        print(f"{header.relative_to(SOURCE)} does not compile alone:\n{message}")
    print(f"{len(headers) - len(others)} headers are the first of their source, "
          f"{len(others)} compiled alone, {len(broken)} do not")
    if len(headers) < 100 or len(others) == len(headers):
        sys.exit("this looked at the wrong folders")
    sys.exit(1 if broken else 0)


main()
