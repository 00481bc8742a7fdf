# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms that made gears show and that the library was not written for: wear and breakage of tools, machines that
warm up, clamping, welding, printing; and data as people have them: one flank only, rounded values, wild points,
holes in a scan. Each maker returns form(tooth, side, u, v) in um, as in hidden.py."""
import math

import numpy

from hidden import some_flank


def end_relief(gear, r, s):
    """The lead falls off near one end only."""
    um, end, start, power = s * r.uniform(6, 16), r.choice([-1, 1]), r.uniform(0.3, 0.7), r.choice([1.0, 2.0])
    return lambda k, side, u, v: -um * (numpy.maximum(end * v - start, 0.0) / (1.0 - start)) ** power + 0.0 * u


def tool_drift(gear, r, s):
    """The tool wears or the machine warms up from the first tooth to the last: a ramp that does not close."""
    um, first, turned = s * r.uniform(6, 15), int(r.integers(0, gear.teeth)), r.integers(0, 2)
    return lambda k, side, u, v: um * (((k + first) % gear.teeth) / gear.teeth - 0.5) * (side if turned else 1) + 0.0 * u


def every_third(gear, r, s):
    """A cutter with three or four teeth, one of which stands out."""
    counts = [n for n in (3, 4, 5, 6) if gear.teeth % n == 0] or [3]
    um, n = s * r.uniform(6, 12), int(r.choice(counts))
    at = int(r.integers(0, n))
    return lambda k, side, u, v: um * (k % n == at) + 0.0 * u


def chatter(gear, r, s):
    """Waves over a part of the face."""
    um, waves, at, wide, on = s * r.uniform(4, 10), r.uniform(7, 14), r.uniform(-0.5, 0.5), r.uniform(0.2, 0.35), some_flank(r)
    phases = r.uniform(0, 2 * math.pi, gear.teeth + 1) * r.integers(0, 2)
    return lambda k, side, u, v: um * numpy.sin(math.pi * waves * v + phases[k]) * numpy.exp(-((v - at) / wide) ** 2) * on(side) + 0.0 * u


def rounded_ends(gear, r, s):
    """Brushing: both ends of the face and the tip are rounded."""
    um, wide = s * r.uniform(8, 20), r.uniform(0.05, 0.12)
    return lambda k, side, u, v: -um * (numpy.exp(-(1.0 - v) / wide) + numpy.exp(-(1.0 + v) / wide)) + 0.0 * u


def dented_tips(gear, r, s):
    """Some teeth were knocked at the tip edge."""
    um, teeth = s * r.uniform(12, 30), set(int(x) for x in r.choice(gear.teeth, max(2, gear.teeth // 8), replace=False) + 1)
    return lambda k, side, u, v: um * numpy.exp(-(1.0 - u) / 0.12) * (k in teeth) + 0.0 * v


def pitch_step(gear, r, s):
    """Random pitch errors and one double step: a tooth is shifted and all that follow half as much."""
    scatter, at = s * r.uniform(0.5, 1.5) * r.standard_normal(gear.teeth + 1), int(r.integers(2, gear.teeth))
    um = s * r.uniform(8, 16) * r.choice([-1, 1])
    return lambda k, side, u, v: side * (scatter[k] + um * ((k >= at) + (k == at)) - um * (k - 1) / gear.teeth) + 0.0 * u


def weld_pool(gear, r, s):
    """A weld on one tooth: a crater with a rim."""
    um, tooth, flank = s * r.uniform(20, 60), int(r.integers(1, gear.teeth + 1)), int(r.choice([-1, 1]))
    a, b, wide = r.uniform(-0.5, 0.5), r.uniform(-0.5, 0.5), r.uniform(0.2, 0.35)

    def form(k, side, u, v):
        d2 = ((u - a) ** 2 + (v - b) ** 2) / wide**2
        return um * (1.0 - d2) * numpy.exp(-d2) * (k == tooth) * (side == flank)
    return form


def seam(gear, r, s):
    """The layers of a print begin at one angle: a ridge along the face on one flank."""
    um, tooth, flank = s * r.uniform(12, 40), int(r.integers(1, gear.teeth + 1)), int(r.choice([-1, 1]))
    a, wide = r.uniform(-0.6, 0.6), r.uniform(0.15, 0.3)
    return lambda k, side, u, v: um * numpy.exp(-((u - a) / wide) ** 2) * (k == tooth) * (side == flank) + 0.0 * v


def jaws(gear, r, s):
    """Clamped in two or three jaws, off centre too."""
    um, e, jaw = s * r.uniform(5, 12), s * r.uniform(3, 10), int(r.choice([2, 3]))
    phase, to = r.uniform(0, 2 * math.pi, 2)

    def form(k, side, u, v):
        _, angle = gear.point(k, side, u)
        n = gear.normal_angle(k, side, u)
        return um * numpy.cos(jaw * angle - phase) * numpy.cos(n - angle) + e * numpy.cos(n - to)
    return form


def kinked_lead(gear, r, s):
    um, at, on = s * r.uniform(6, 16) * r.choice([-1, 1]), r.uniform(-0.4, 0.4), some_flank(r)
    return lambda k, side, u, v: um * numpy.maximum(v - at, 0.0) * side * on(side) + 0.0 * u


def own_slopes(gear, r, s):
    """Every tooth leans its own way: backlash of the indexing."""
    slope = s * r.uniform(3, 6) * r.standard_normal(gear.teeth + 1)
    return lambda k, side, u, v: slope[k] * v * side + 0.0 * u


def chirp(gear, r, s):
    """Waves over the face that grow shorter."""
    um, low, more, phase = s * r.uniform(4, 8), r.uniform(2.5, 4), r.uniform(1.5, 3), r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: um * numpy.sin(math.pi * (low * v + 0.5 * more * v * v) + phase) + 0.0 * u


def worn_edge(gear, r, s):
    """A chipped cutter: a ridge over the profile, on one flank."""
    um, at, wide, on = s * r.uniform(6, 15), r.uniform(-0.6, 0.6), r.uniform(0.08, 0.15), some_flank(r)
    return lambda k, side, u, v: um * numpy.exp(-((u - at) / wide) ** 2) * on(side) + 0.0 * v


def diagonal_marks(gear, r, s):
    """Grinding marks across the flank, neither along the profile nor the face."""
    um, a, b, phase = s * r.uniform(4, 8), r.uniform(2, 5), r.uniform(2, 5), r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: um * numpy.sin(math.pi * (a * u + b * v) + phase)


def sagging_sector(gear, r, s):
    """A web or a hole below: some teeth hang in the middle of the face."""
    um, first, count = s * r.uniform(8, 18), int(r.integers(0, gear.teeth)), max(3, gear.teeth // 4)
    return lambda k, side, u, v: -um * (1 - v * v) * ((k - first) % gear.teeth < count) + 0.0 * u


def missed_teeth(gear, r, s):
    """Two neighbours were cut again."""
    um, at = s * r.uniform(9, 18), int(r.integers(1, gear.teeth + 1))
    return lambda k, side, u, v: -um * ((k - at) % gear.teeth < 2) + 0.0 * u


STRANGE = {f.__name__: f for f in (end_relief, tool_drift, every_third, chatter, rounded_ends, dented_tips, pitch_step,
                                   weld_pool, seam, jaws, kinked_lead, own_slopes, chirp, worn_edge, diagonal_marks,
                                   sagging_sector, missed_teeth)}
# t traces, a traces of all teeth, c with an index or a common zero, s scans.
SEEN_IN = {"end_relief": "ts", "tool_drift": "cs", "every_third": "cs", "chatter": "ts", "rounded_ends": "ts", "dented_tips": "as",
           "pitch_step": "cs", "weld_pool": "s", "seam": "s", "jaws": "cs", "kinked_lead": "ts", "own_slopes": "as", "chirp": "ts",
           "worn_edge": "ts", "diagonal_marks": "ts", "sagging_sector": "as", "missed_teeth": "cs"}
# Names that are right, or the same in other words.
NAMES = {"jaws": {"eccentricity", "lobing", "scale_xy", "skew"}, "missed_teeth": {"single_tooth"}, "pitch_step": {"single_tooth"}}


def disturb(r, gear, plan):
    """Data as people have them. Changes the plan."""
    pick = int(r.integers(0, 6))
    if pick == 1 and not plan["scan"]:
        plan["rounding_um"] = 1.0 if r.integers(0, 2) else 0.5
    if pick == 2:
        plan["wild"] = float(r.uniform(0.005, 0.02))
    if pick == 3 and plan["scan"]:
        plan["hole"] = (int(r.integers(1, gear.teeth + 1)), max(2, gear.teeth // 6))
    if pick == 4 and not plan["scan"]:
        plan["sides"] = (int(r.choice([-1, 1])),)
