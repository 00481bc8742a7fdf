# SPDX-License-Identifier: GPL-3.0-or-later
"""Efficiency and self-locking of 3K sets by forces at the teeth: efficiency_by_forces.py [SETS] [SEED].

Every mesh is turned through a pitch. At each moment the tooth pairs in contact press with equal forces, as stated in
docs/efficiency.md; friction acts along the difference of the velocities that both surfaces have there. The planets'
and the carrier's balance is then solved from the lossless state on: which gear of a mesh drives follows from the
powers. What the root fillets leave of a path is known from teeth that are rolled from a rack (rolled_gears.py). Of the
program's answer only shifts, centre distance and tip circles are taken."""
import json
import math
import os
import pathlib
import random
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "check"))
from rolled_gears import External, Ring  # noqa: E402

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"])
COSINE = math.cos(math.radians(20.0))
BASE_PITCH = math.pi * COSINE
MOMENTS = 2000
NEAR = 2e-4  # of the power
GEARS = ("sun", "planet1", "ring1", "planet2", "ring2")


def path_of_contact(gear1, gear2, distance):
    """Frame: gear 1 at the origin, turning counter-clockwise, the pitch point above it; modules. Gives where the line
    of action leaves gear 1's base circle, its direction (gear 1 pushes along it), gear 2's axis, and both ends."""
    internal = isinstance(gear2, Ring)
    r1, r2 = gear1.teeth / 2 * COSINE, gear2.teeth / 2 * COSINE
    angle = math.acos((r2 - r1 if internal else r1 + r2) / distance)
    touch = np.array([r1 * math.sin(angle), r1 * math.cos(angle)])
    along = np.array([-math.cos(angle), math.sin(angle)])
    axis2 = np.array([0.0, -distance if internal else distance])

    def places(gear, axis, radius):
        """Where the line crosses a circle about an axis, the crossing on the side of contact."""
        middle = float(np.dot(axis - touch, along))
        off = float(np.dot(axis - touch - middle * along, axis - touch - middle * along))
        reach = math.sqrt(max(radius**2 - off, 0.0))
        towards_end = gear is gear1 or internal
        return middle + reach if towards_end else middle - reach

    zero = np.zeros(2)
    start = max(places(gear2, axis2, gear2.tip), places(gear1, zero, gear1.form))
    end = min(places(gear1, zero, gear1.tip), places(gear2, axis2, gear2.form))
    return touch, along, axis2, start, end


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def mesh_efficiency(gear1, gear2, distance, friction):
    """(gear 1 driving, gear 2 driving): constant torque on the driven gear, averaged over the pitch. None where contact
    is interrupted or friction blocks."""
    touch, along, axis2, start, end = path_of_contact(gear1, gear2, distance)
    if end - start < BASE_PITCH:
        return None
    sense2 = 1.0 if isinstance(gear2, Ring) else -1.0
    speed2 = sense2 * gear1.teeth / gear2.teeth
    across = np.array([-along[1], along[0]])
    found = []
    for driving in (1, 2):
        torque1, torque2 = np.zeros(MOMENTS), np.zeros(MOMENTS)
        place = start + (np.arange(MOMENTS) + 0.5) / MOMENTS * BASE_PITCH
        while (place < end).any():
            point = touch + place[:, None] * along
            arm2 = point - axis2
            turn = lambda arm, speed: speed * np.column_stack([-arm[:, 1], arm[:, 0]])
            # the flank on which gear 1 pushes gear 2 along the line; where gear 2 drives, all turns the other way
            slip = ((turn(point, 1.0) - turn(arm2, speed2)) @ across) * (1.0 if driving == 1 else -1.0)
            on2 = (along + friction * np.sign(slip)[:, None] * across) * (place < end)[:, None]
            torque1 -= cross(point, -on2)
            torque2 += sense2 * cross(arm2, on2)
            place = place + BASE_PITCH
        ideal = gear1.teeth / gear2.teeth
        into, out = (torque1 / ideal, torque2) if driving == 1 else (torque2, torque1 / ideal)
        if (out <= 0).any():
            return None
        found.append(1.0 / np.mean(into / out))
    return tuple(found)


def drive(teeth, meshes, backward):
    """Power out over power in of the set; 0 where no power comes out. `meshes`: (central drives, planet drives)."""
    s, p1, r1, p2, r2 = teeth
    seen = np.array([-p1 / s, p1 / r1, p2 / r2])  # speeds of sun, ring 1, ring 2 seen from the carrier
    speed = seen - p1 / r1  # ring 1 stands
    if backward:
        seen, speed = -seen, -speed
    given, taken = (2, 0) if backward else (0, 2)
    drives = np.array([True, True, True])
    gains = np.ones(3)
    for _ in range(50):
        # torques on the three gears: their sum is the carrier's, none; what reaches the planets is none in all
        matrix = np.array([np.ones(3), seen * gains, np.eye(3)[given]])
        torque = np.linalg.solve(matrix, [0.0, 0.0, math.copysign(1.0, speed[given])])
        power = torque * seen
        now = power > 0
        gains = np.array([meshes[i][0] if now[i] else 1.0 / meshes[i][1] for i in range(3)])
        if _ and (now == drives).all():
            out = -torque[taken] * speed[taken] / (torque[given] * speed[given])
            return max(out, 0.0)
        drives = now
    return 0.0


def drawn(rng):
    s, p1 = rng.randint(10, 18), rng.randint(26, 42)
    r1, k = s + 2 * p1, rng.randint(2, 9)
    return {"teeth": (s, p1, r1, p1 - k, r1 - k), "distance": round((s + p1) / 2 + rng.uniform(-0.1, 0.4), 3),
            "shifts": (round(rng.uniform(-0.1, 0.6), 3), round(rng.uniform(-0.1, 0.6), 3)),
            "friction": round(rng.choice([rng.uniform(0.02, 0.12), rng.uniform(0.15, 0.45)]), 3)}


def told(given):
    lines = ["format = 1", 'name = "set"', "[gearbox]", 'kind = "3k"', 'output = "ring2"', "planets = 3", "module_mm = 1",
             f"centre_distance_mm = {given['distance']}", f"friction = {given['friction']}"]
    for name, teeth in zip(GEARS, given["teeth"]):
        lines += [f"[{name}]", f"teeth = {teeth}", "face_width_mm = 5"]
        if name.startswith("ring"):
            lines.append(f"shift = {given['shifts'][name == 'ring2']}")
    design = OUTPUT / "set.toml"
    design.write_text("\n".join(lines) + "\n")
    done = subprocess.run([PROGRAM, "check", design, "-q", "--json", OUTPUT / "set.json"], capture_output=True, text=True)
    return json.loads((OUTPUT / "set.json").read_text()) if done.returncode in (0, 1) else None


def by_forces(given, report):
    """(forward, backward), or None where these teeth are none that are compared."""
    gears = {}
    for name in GEARS:
        g = report["gears"][name]
        try:
            make = Ring if name.startswith("ring") else External
            gears[name] = make(g["teeth"], g["shift"], g["tip_diameter_mm"] / 2)
        except AssertionError:
            return None
    found = [mesh_efficiency(gears[a], gears[b], given["distance"], given["friction"])
             for a, b in (("sun", "planet1"), ("planet1", "ring1"), ("planet2", "ring2"))]
    if None in found:
        return None
    central = [found[0], found[1][::-1], found[2][::-1]]  # the sun is gear 1 of its mesh, a ring gear 2
    return tuple(drive(given["teeth"], central, backward) for backward in (False, True))


def main():
    sets = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    rng = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 15)
    OUTPUT.mkdir(parents=True, exist_ok=True)
    # the set of which a formula outside its range said that it locks itself
    queue = [{"teeth": (12, 39, 90, 35, 84), "distance": 25.6, "shifts": (0.2, 0.2), "friction": 0.15}]
    compared, locking, worst, wrong = 0, 0, 0.0, 0
    while compared < sets:
        given = queue.pop() if queue else drawn(rng)
        report = told(given)
        if not report or report["efficiency"]["forward"] is None:
            continue
        mine = by_forces(given, report)
        if mine is None:
            continue
        theirs = (report["efficiency"]["forward"], report["efficiency"]["backward"])
        compared += 1
        locking += mine[1] == 0.0
        off = max(abs(a - b) for a, b in zip(mine, theirs))
        worst = max(worst, off)
        lock_agrees = report["efficiency"]["self_locking"] == (mine[1] == 0.0) or max(mine[1], theirs[1]) < NEAR
        if off > NEAR or not lock_agrees or os.environ.get("TELL"):
            print(given, "by forces", mine, "told", theirs, report["efficiency"]["self_locking"])
        wrong += off > NEAR or not lock_agrees
    print(f"{compared} sets, {locking} lock themselves; largest difference {worst:.2e} of the power; {wrong} wrong")
    sys.exit(1 if wrong or not 0 < locking < compared else 0)


main()
