# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample STEP files and the volumes that the exact curves give them."""
import os
import pathlib
import subprocess
import sys


def write_samples():
    """Runs the writer named on the command line; returns (path, volume in mm^3) of every file."""
    folder = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
    subprocess.run([sys.argv[1], str(folder)], check=True)
    samples = []
    for line in (folder / "samples.tsv").read_text(encoding="utf-8").splitlines():
        name, volume = line.split("\t")
        samples.append((folder / name, float(volume)))
    return samples
