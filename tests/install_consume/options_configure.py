#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Configures the project with parts of it left out: a test or an installation must not ask for what is not built."""
import argparse
import itertools
import os
import pathlib
import shutil
import subprocess
import sys

parser = argparse.ArgumentParser()
parser.add_argument("--cmake", required=True)
parser.add_argument("--compiler", required=True)
options = parser.parse_args()
build = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "build"
source = os.environ["TRUEFLANK_SOURCE_DIR"]
shutil.rmtree(build, ignore_errors=True)

for program, tests in itertools.product(("OFF", "ON"), repeat=2):
    done = subprocess.run([options.cmake, "-G", "Ninja", "-S", source, "-B", build, "-DCMAKE_CXX_COMPILER=" + options.compiler,
                           f"-DTRUEFLANK_BUILD_PROGRAM={program}", f"-DTRUEFLANK_BUILD_TESTS={tests}"],
                          capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"program {program}, tests {tests}: {done.stderr}")
