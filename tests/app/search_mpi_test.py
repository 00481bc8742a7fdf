# SPDX-License-Identifier: GPL-3.0-or-later
"""The search over MPI gives, with several ranks on this machine, the bytes of the plain search."""
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = pathlib.Path(os.environ["TRUEFLANK_PROGRAM"])
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "mpi"
NEEDS = """format = 1
name = "small"
[gearbox]
kind = "3k"
[ratio]
min = 96
max = 97
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
ring1_min = 87
ring1_max = 93
planet2_max = 34
identical_planets = false
[search]
results = 2
"""


def main():
    ranks = PROGRAM.parent / "trueflank-search-mpi"
    launcher = shutil.which("mpirun")
    if not ranks.exists() or not launcher:
        print("skipped: no MPI here")
        return 0
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    needs = OUTPUT / "small.toml"
    needs.write_text(NEEDS)
    # a container may run as root and have fewer cores than ranks
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1")

    def mpi(*arguments):
        return subprocess.run([launcher, "-n", "3", ranks, *map(str, arguments)], env=environment,
                              capture_output=True, text=True, timeout=300)

    subprocess.run([PROGRAM, "search", needs, "-o", OUTPUT / "plain", "-q"], check=True)
    done = mpi(needs, "-o", OUTPUT / "ranks", "-q")
    assert done.returncode == 0, done.stderr
    for name in ("design-001.toml", "search.csv", "search.json", "search.svg"):
        assert (OUTPUT / "plain" / name).read_bytes() == (OUTPUT / "ranks" / name).read_bytes(), name
    resumed = mpi(needs, "-o", OUTPUT / "ranks", "-q", "--resume")
    assert resumed.returncode == 0, resumed.stderr
    wrong = mpi(OUTPUT / "none.toml", "-o", OUTPUT / "ranks")
    assert wrong.returncode == 3, wrong.returncode
    # one rank speaks for all; the others may say that the launcher stopped them
    assert wrong.stderr.count("cannot read") == 1, wrong.stderr
    return 0


if __name__ == "__main__":
    sys.exit(main())
