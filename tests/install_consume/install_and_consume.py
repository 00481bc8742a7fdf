#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Installs the library to an empty folder and builds a second project against it, and runs that."""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "lint"))
import check_layers

arguments = argparse.ArgumentParser()
arguments.add_argument("--cmake", required=True)
arguments.add_argument("--compiler", required=True)
arguments.add_argument("--flags", default="")
arguments.add_argument("--python-dir", default="", help="below the prefix; empty: not built")
arguments = arguments.parse_args()

here = pathlib.Path(__file__).parent
output = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
prefix, build = output / "prefix", output / "build"
for folder in (prefix, build):
    shutil.rmtree(folder, ignore_errors=True)


def run(*command):
    print("+", *command, flush=True)
    subprocess.run([str(c) for c in command], check=True)


source = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"])
public = check_layers.public_headers(source)
documented = output / "documented.cpp"
documented.write_text(re.search(r"```cpp\n(.*?)```", (source / "docs/api.md").read_text(), re.DOTALL)[1])

run(arguments.cmake, "--install", os.environ["TRUEFLANK_BINARY_DIR"], "--prefix", prefix)
run(arguments.cmake, "-G", "Ninja", "-S", here / "consumer", "-B", build, "-DCMAKE_BUILD_TYPE=Release",
    f"-DCMAKE_CXX_COMPILER={arguments.compiler}", f"-DCMAKE_CXX_FLAGS={arguments.flags}",
    f"-DCMAKE_PREFIX_PATH={prefix}", f"-DDOCUMENTED={documented}", "-DPUBLIC_HEADERS=" + ";".join(public))
installed_headers = {str(h.relative_to(prefix / "include/trueflank")) for h in prefix.rglob("include/**/*.h")}
if installed_headers != set(public):
    sys.exit(f"installed are not the public headers: {sorted(installed_headers ^ set(public))}")
run(arguments.cmake, "--build", build)
run(build / "consumer")
said = subprocess.run([build / "documented", source / "examples/external_pair/design.toml"], check=True,
                      cwd=output, capture_output=True, text=True).stdout
if "pinion.step: within" not in said:
    sys.exit(f"the program of docs/api.md said: {said}")

# the project of examples, as its first lines say
examples = source / "examples"
build_examples = output / "build_examples"
run(arguments.cmake, "-G", "Ninja", "-S", examples / "cpp", "-B", build_examples,
    f"-DCMAKE_CXX_COMPILER={arguments.compiler}", f"-DCMAKE_CXX_FLAGS={arguments.flags}",
    f"-DCMAKE_PREFIX_PATH={prefix}")
run(arguments.cmake, "--build", build_examples)
run(build_examples / "check_gearbox", examples / "bilateral_drive/design.toml")
for example in ("one_gear", "write_step", "search", "close_loop"):
    subprocess.run([build_examples / example], check=True, cwd=build_examples)

installed = {p.relative_to(prefix).parts[0] for p in prefix.rglob("*")}
if not installed <= {"bin", "include", "lib", "share"}:
    sys.exit(f"unexpected folders installed: {installed}")
if (prefix / "include").exists() and {p.name for p in (prefix / "include").iterdir()} != {"trueflank"}:
    sys.exit("only include/trueflank belongs into include/")

# the Python package, from where the documentation says it is, and nothing of the build folder
if arguments.python_dir:
    environment = {**os.environ, "PYTHONPATH": str(prefix / arguments.python_dir)}
    subprocess.run([sys.executable, "-B", "-c",
                    "import pathlib, trueflank\n"
                    f"assert str(pathlib.Path(trueflank.__file__)).startswith({str(prefix)!r})\n"
                    "assert trueflank.read_text(trueflank.new_design('pair')).report()['verdict'] != 'fail'"],
                   check=True, env=environment)
