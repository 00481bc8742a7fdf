# SPDX-License-Identifier: GPL-3.0-or-later
"""Tooth sets a second of `trueflank search`, alone and on all cores, against a plain scipy program.

The peer does for one tooth set what a careful user writes in an afternoon: the paper's efficiency and
limits from closed formulas, scipy's SLSQP from a handful of starts. It knows no root fillets, no
undercut and no exact clearance. Usage: search.py TRUEFLANK [SETS_FOR_THE_PEER]
"""
import csv
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy
from scipy.optimize import minimize

ALPHA = math.radians(20.0)
NEEDS = """format = 1
[gearbox]
kind = "3k"
[ratio]
min = {low}
max = {high}
[teeth]
sun_min = 11
sun_max = 14
"""


def involute(a):
    return math.tan(a) - a


def mesh(z1, z2, internal, tip1, tip2, a_w, friction):
    sign = -1.0 if internal else 1.0
    tangent = lambda tip, z: math.tan(math.acos(min(1.0, z * math.cos(ALPHA) / tip)))
    e1 = sign * z2 / (2 * math.pi) * (tangent(tip2, z2) - math.tan(a_w))
    e2 = z1 / (2 * math.pi) * (tangent(tip1, z1) - math.tan(a_w))
    loss = friction * math.pi * (1 / z1 + sign / z2) * (e1 * e1 + e2 * e2 - e1 - e2 + 1)
    return 1 - loss, e1 + e2


def evaluate(z, v, friction=0.1):
    """Forward efficiency of the paper and the margins of its limits at (a, x_r1, x_r2)."""
    z_s, z_p1, z_r1, z_p2, z_r2 = z
    a, x_r1, x_r2 = v

    def working(teeth):
        cosine = teeth / 2 * math.cos(ALPHA) / a
        return math.acos(min(0.999999, cosine))

    def shift_sum(teeth):
        return teeth / (2 * math.tan(ALPHA)) * (involute(working(teeth)) - involute(ALPHA))

    x_p1 = x_r1 - shift_sum(z_r1 - z_p1)
    x_s = shift_sum(z_s + z_p1) - x_p1
    x_p2 = x_r2 - shift_sum(z_r2 - z_p2)
    y = a - (z_s + z_p1) / 2
    d_s, d_p1 = z_s + 2 * (1 + y - x_p1), z_p1 + 2 * (1 + min(y - x_s, x_p1))
    d_r1, d_p2, d_r2 = z_r1 - 2 * (1 - x_r1), z_p2 + 2 * (1 + x_p2), z_r2 - 2 * (1 - x_r2)
    n_a, e_a = mesh(z_s, z_p1, False, d_s, d_p1, working(z_s + z_p1), friction)
    n_b, e_b = mesh(z_p1, z_r1, True, d_p1, d_r1, working(z_r1 - z_p1), friction)
    n_c, e_c = mesh(z_p2, z_r2, True, d_p2, d_r2, working(z_r2 - z_p2), friction)
    i1, i2 = z_r1 / z_s, z_r1 * z_p2 / (z_p1 * z_r2)
    ka, kb, kc = (n_a, n_b, 1 / n_c) if i2 < 1 else (n_a, 1 / n_b, n_c)
    eta = (1 - i2) / (1 + i1) * (1 + i1 * ka * kb) / (1 - i2 * kb / kc)
    margins = [2 - abs(x) for x in (x_s, x_p1, x_p2)]
    margins += [e - 1 for e in (e_a, e_b, e_c)] + [2 - e for e in (e_a, e_b, e_c)]
    return eta, numpy.array(margins)


def peer(z):
    centre = (z[0] + z[1]) / 2
    best = 0.0
    for start in ((centre * 1.005, 0.2, 0.5), (centre * 1.01, 0.5, 1.5), (centre * 1.02, 1.0, 0.0)):
        found = minimize(lambda v: -evaluate(z, v)[0], start, method="SLSQP",
                         bounds=[(centre * 0.96, centre * 1.06), (-2, 2), (-2, 2)],
                         constraints={"type": "ineq", "fun": lambda v: evaluate(z, v)[1]})
        eta, margins = evaluate(z, found.x)
        if margins.min() > -1e-6:
            best = max(best, eta)
    return best


def ours(program, folder, threads, low, high):
    needs = pathlib.Path(folder) / "needs.toml"
    needs.write_text(NEEDS.format(low=low, high=high))
    begun = time.perf_counter()
    subprocess.run([program, "search", needs, "-o", folder, "-q", "--threads", str(threads)],
                   check=True)
    seconds = time.perf_counter() - begun
    sets = len((pathlib.Path(folder) / "search.journal").read_text().splitlines()) - 1
    return sets, seconds


def main():
    program = sys.argv[1]
    peers = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    with tempfile.TemporaryDirectory() as folder:
        before = os.times()
        sets, one = ours(program, folder, 1, 95, 97)
        after = os.times()
        processor = after.children_user - before.children_user
        print(f"trueflank, 1 thread : {sets} sets, {sets / one:.1f} sets/s by the clock, "
              f"{sets / processor:.1f} sets/s of processor time")
        cores = os.cpu_count()
        _, all_cores = ours(program, folder, cores, 95, 97)
        print(f"trueflank, {cores} threads: {sets / all_cores:.1f} sets/s by the clock, "
              f"{one / all_cores / cores:.2f} of the speed of one a core")
        with open(pathlib.Path(folder) / "search.csv", newline="") as table:
            rows = list(csv.DictReader(table))[:peers]
    names = ("sun", "planet1", "ring1", "planet2", "ring2")
    begun = time.process_time()
    found = [peer([int(row[name]) for name in names]) for row in rows]
    seconds = time.process_time() - begun
    print(f"plain scipy, 1 core : {len(rows) / seconds:.1f} sets/s of processor time, without root "
          "fillets, interference or clearances")
    for row, eta in list(zip(rows, found))[:5]:
        print("  " + "/".join(row[name] for name in names) +
              f": trueflank {100 * float(row['forward']):.2f} % free of interference, "
              f"scipy {100 * eta:.2f} % whatever the geometry")


if __name__ == "__main__":
    main()
