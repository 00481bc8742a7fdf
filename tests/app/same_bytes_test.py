# SPDX-License-Identifier: GPL-3.0-or-later
"""A processor without AVX2 and fused multiply-add gives the same bytes: STL, 3MF, PLY, STEP, reports.

The C library is told to do without them (GLIBC_TUNABLES), which changes the last digits of its sin, cos, ...
"""
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
EXAMPLES = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"]) / "examples"
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])


def made(example, **more):
    folder = OUTPUT / "made"  # the same name, as reports may name it
    shutil.rmtree(folder, ignore_errors=True)
    command = [PROGRAM, "make", EXAMPLES / example / "design.toml", "-o", folder,
               "--formats", "stl,3mf,obj,ply,glb,step,dxf,svg,pdf", "--tolerance-um", "20"]
    done = subprocess.run(command, capture_output=True, env=dict(os.environ, **more), timeout=120)
    assert done.returncode == 0, done.stderr
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def main():
    for example in ("external_pair", "stepped", "helical_planetary", "split_ring"):
        with_them = made(example)
        without = made(example, GLIBC_TUNABLES="glibc.cpu.hwcaps=-AVX2,-FMA")
        assert set(with_them) == set(without)
        differing = sorted(str(p) for p in with_them if with_them[p] != without[p])
        assert not differing, (example, differing)
        assert any(p.suffix == ".step" for p in with_them) and pathlib.Path("report.json") in with_them
    return 0


if __name__ == "__main__":
    sys.exit(main())
