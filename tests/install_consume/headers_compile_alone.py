#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every header compiles as the only include of a file."""
import argparse
import os
import subprocess
import sys

arguments = argparse.ArgumentParser()
arguments.add_argument("--cmake", required=True)
arguments = arguments.parse_args()
sys.exit(subprocess.run([arguments.cmake, "--build", os.environ["TRUEFLANK_BINARY_DIR"],
                         "--target", "all_verify_interface_header_sets"]).returncode)
