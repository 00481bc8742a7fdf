# SPDX-License-Identifier: GPL-3.0-or-later
"""`corner_contact` against teeth rolled from a rack and turned as points: corner_contact_rolled.py [PAIRS] [SEED].

Random external pairs and pinions in rings with tips of any height. Gear 2 is pushed against gear 1 until the flanks
touch, either way; how deep a corner or a fillet then stands in the mate is what the check must say."""
import json
import os
import pathlib
import random
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from rolled_gears import External, Mesh, Ring  # noqa: E402

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
STEPS = 60  # positions in a pitch; the depth changes by less than the tolerance between them
NEAR_UM, NEAR_SHARE = 0.5, 0.02  # of module 1: points, positions


def drawn(rng):
    """Numbers of a pair in modules; the centre distance follows from the play wanted."""
    internal = rng.random() < 0.5
    z1 = rng.randint(12, 30)
    z2 = rng.randint(z1 + 14, 80) if internal else rng.randint(12, 60)
    x1 = round(rng.uniform(-0.1, 0.5), 2)
    x2 = round(rng.uniform(-0.1, 0.5), 2)
    tip1 = round(z1 / 2 + x1 + rng.uniform(0.8, 1.1), 3)
    tip2 = round(z2 / 2 + x2 + (-1 if internal else 1) * rng.uniform(1.0, 1.22), 3)
    return internal, z1, z2, x1, x2, tip1, tip2


def meshing(rng):
    """A mesh with play, or None where these teeth do not make one."""
    internal, z1, z2, x1, x2, tip1, tip2 = numbers = drawn(rng)
    try:
        gear1 = External(z1, x1, tip1)
        gear2 = Ring(z2, x2, tip2) if internal else External(z2, x2, tip2)
    except AssertionError:
        return None
    if gear1.pointed or not internal and gear2.pointed:
        return None
    wanted = rng.uniform(0.02, 0.1)  # of the module, on gear 2's reference circle
    low, high = ((z2 - z1) / 2 - 1.0, (z2 - z1) / 2 + 1.0) if internal else ((z1 + z2) / 2 - 0.5, (z1 + z2) / 2 + 1.5)
    for _ in range(14):
        a = (low + high) / 2
        play = Mesh(gear1, gear2, a).conjugate_plays(12).sum() * z2 / 2
        too_much = play > wanted
        low, high = (a, high) if too_much == internal else (low, a)
    distance = round(a, 3)
    mesh = Mesh(gear1, gear2, distance)
    root_left = gear2.root - distance - tip1 if internal else min(distance - tip1 - gear2.root, distance - tip2 - gear1.root)
    if root_left < 0.02 or mesh.conjugate_plays(12).sum() * z2 / 2 < 0.01:
        return None
    return mesh, numbers, distance


def depth(mesh):
    plus, minus = mesh.conjugate_plays()
    turns = mesh.turns(STEPS)
    deepest = 0.0
    for side in (plus, -minus):
        for turned in turns:
            deepest = mesh.deepest(side, turned, deepest)
    return deepest


def told(numbers, distance):
    internal, z1, z2, x1, x2, tip1, tip2 = numbers
    design = OUTPUT / "pair.toml"
    design.write_text(f"""format = 1
name = "pair"
[gearbox]
kind = "pair"
module_mm = 1
centre_distance_mm = {distance}
[pinion]
teeth = {z1}
shift = {x1}
tip_diameter_mm = {2 * tip1}
face_width_mm = 5
[wheel]
teeth = {z2}
shift = {x2}
tip_diameter_mm = {2 * tip2}
face_width_mm = 5
{"internal = true" if internal else ""}
""")
    done = subprocess.run([PROGRAM, "check", design, "-q", "--json", OUTPUT / "pair.json"], capture_output=True, text=True)
    assert done.returncode in (0, 1), done.stderr
    checks = json.loads((OUTPUT / "pair.json").read_text())["checks"]
    return next(c for c in checks if c["id"] == "corner_contact")


def main():
    pairs = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 15)
    OUTPUT.mkdir(parents=True, exist_ok=True)
    compared, touching, wrong, worst = 0, 0, [], 0.0
    while compared < pairs:
        drawn_mesh = meshing(rng)
        if drawn_mesh is None:
            continue
        mesh, numbers, distance = drawn_mesh
        finding = told(numbers, distance)
        if finding["status"] == "not_applicable" or finding["value"] is None:
            continue
        mine = 1000 * depth(mesh)
        compared += 1
        touching += mine > 1
        off = abs(mine - finding["value"])
        worst = max(worst, off)
        if off > NEAR_UM + NEAR_SHARE * mine or os.environ.get("TELL"):
            print(f"{numbers} a {distance}: rolled {mine:.2f} um, told {finding['value']:.2f} um ({finding['message']})")
        if off > NEAR_UM + NEAR_SHARE * mine:
            wrong.append(numbers)
    print(f"{compared} pairs, {touching} touch ahead of their flanks; largest difference {worst:.2f} um; {len(wrong)} wrong")
    sys.exit(1 if wrong or touching < pairs / 6 or touching == compared else 0)


main()
