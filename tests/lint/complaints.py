# SPDX-License-Identifier: GPL-3.0-or-later
"""What the lint tests share: which sources they look at, and how they tell what they found."""
import os
import pathlib
import sys


def root_of_sources():
    """Of the sources: the argument, or what the environment names, or where this file lies."""
    default = os.environ.get("TRUEFLANK_SOURCE_DIR", pathlib.Path(__file__).resolve().parents[2])
    return pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else default)


def told(complaints):
    """A line each; the exit code."""
    for complaint in complaints:
        print(complaint)
    return 1 if complaints else 0
