#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every step of the CI recipe, and every line of the Makefile, asks for a target, preset, script or variable that exists.

Usage: check_recipe.py [ROOT]
"""
import json
import os
import re
import sys

from complaints import root_of_sources, told

STEP = re.compile(r"^\s*- run: (.*)$", re.MULTILINE)
TARGET = re.compile(r"\b(?:add_executable|add_library|add_custom_target)\(\s*([\w-]+)")
OF_THE_SYSTEM = {"apt-get", "cd", "exit"}


def presets(root):
    """Names of the presets that may be asked for, by the command that does."""
    lists = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
    return {command: {p["name"] for p in lists[kind] if not p.get("hidden")}
            for command, kind in (("cmake", "configurePresets"), ("cmake --build", "buildPresets"), ("ctest", "testPresets"))}


def check(root):
    makefile = (root / "Makefile").read_text(encoding="utf-8").replace("\\\n", " ")
    targets = set(re.findall(r"^([a-z]+):", makefile, re.MULTILINE))
    variables = set(re.findall(r"^(\w+) [?:]=", makefile, re.MULTILINE))
    known = presets(root)
    built = {name for file in sorted(root.glob("*/CMakeLists.txt")) for name in TARGET.findall(file.read_text(encoding="utf-8"))}

    def of_command(command):
        words = command.split()
        if not words or words[0] in OF_THE_SYSTEM or "=" in words[0]:
            return
        if words[0] == "make":
            for word in words[1:]:
                name, is_variable, _ = word.partition("=")
                if name not in (variables if is_variable else targets):
                    yield f"the Makefile has no {name}"
        elif words[0] in ("cmake", "ctest"):
            asks = "cmake --build" if "--build" in words else words[0]
            for before, word in zip(words, words[1:]):
                if before == "--preset" and word not in known[asks]:
                    yield f"no preset {word} for {asks}"
                if before == "--target" and word not in built:
                    yield f"no target {word}"
        elif words[0].startswith("scripts/"):
            if not os.access(root / words[0], os.X_OK):
                yield f"no program {words[0]}"
            elif words[0] == "scripts/install-dependencies":
                yield from (f"no list scripts/packages-{word}.txt" for word in words[1:]
                            if not (root / f"scripts/packages-{word}.txt").is_file())
        else:
            yield f"what is {words[0]}?"

    recipe = root / "docs/ci/github-actions.yml"
    lines = [(recipe, step) for step in STEP.findall(recipe.read_text(encoding="utf-8"))]
    lines += [(root / "Makefile", line) for line in re.findall(r"^\t@?((?:cmake|ctest|cd|scripts/).*)$", makefile, re.MULTILINE)]
    return [f"{file.name}: {complaint}" for file, line in lines for command in re.split(r"&&|;|\|", line)
            for complaint in of_command(command.strip())]


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
