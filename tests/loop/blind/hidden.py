# SPDX-License-Identifier: GPL-3.0-or-later
"""What is hidden in the blind trial: forms with a name, forms without. Each maker returns form(tooth, side, u, v)
in um; sizes are in multiples of the noise, drawn anew for every case."""
import math

import numpy


def moved(gear, um, phase, tooth, side, u):
    return um * numpy.cos(gear.normal_angle(tooth, side, u) - phase)


def eccentricity(gear, r, s):
    um, phase = s * r.uniform(3, 12), r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: moved(gear, um, phase, k, side, u)


def axis_tilt(gear, r, s):
    um, phase = s * r.uniform(4, 12), r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: v * moved(gear, um, phase, k, side, u)


def lobing(gear, r, s):
    um, phase, order = s * r.uniform(5, 12), r.uniform(0, 2 * math.pi), int(r.integers(2, 5))

    def form(k, side, u, v):
        _, angle = gear.point(k, side, u)
        return um * numpy.cos(order * angle - phase) * numpy.cos(gear.normal_angle(k, side, u) - angle)
    return form


def pitch_wave(gear, r, s):
    um, phase, order = s * r.uniform(4, 10), r.uniform(0, 2 * math.pi), int(r.integers(2, 6))
    return lambda k, side, u, v: side * um * math.cos(order * gear.centre(k) - phase) + 0.0 * u


def some_flank(r):
    """Both flanks, or one of them."""
    pick = r.integers(0, 3)
    return (lambda side: 1.0) if pick == 0 else (lambda side: float(side > 0)) if pick == 1 else (lambda side: float(side < 0))


def pressure_angle_error(gear, r, s):
    um, on = s * r.uniform(3, 10) * r.choice([-1, 1]), some_flank(r)
    return lambda k, side, u, v: 0.5 * um * u * on(side)


def profile_crowning(gear, r, s):
    um, on = s * r.uniform(4, 10), some_flank(r)
    return lambda k, side, u, v: -um * u**2 * on(side)


def tip_relief(gear, r, s):
    um, start = s * r.uniform(8, 20), r.uniform(0.2, 0.5)
    return lambda k, side, u, v: -um * (numpy.maximum(u - start, 0.0) / (1.0 - start)) ** 2


def helix_error(gear, r, s):
    um, on = s * r.uniform(4, 12) * r.choice([-1, 1]), some_flank(r)
    return lambda k, side, u, v: 0.5 * um * v * side * on(side)


def taper(gear, r, s):
    um = s * r.uniform(4, 12) * r.choice([-1, 1])
    return lambda k, side, u, v: 0.5 * um * v


def crowning(gear, r, s):
    um, on = s * r.uniform(4, 12), some_flank(r)
    return lambda k, side, u, v: -um * v**2 * on(side)


def single_tooth(gear, r, s):
    um, tooth = s * r.uniform(9, 20) * r.choice([-1, 1]), int(r.integers(1, gear.teeth + 1))
    return lambda k, side, u, v: um * (k == tooth) + 0.0 * u


NAMED = {f.__name__: f for f in (eccentricity, axis_tilt, lobing, pitch_wave, pressure_angle_error,
                                 profile_crowning, tip_relief, helix_error, taper, crowning, single_tooth)}
# What shows in traces with zeros of their own beside an index, and what needs a scan.
IN_SCANS_ONLY = {"single_tooth"}
# Other words for the same: told instead of the true one they are no error.
ALIKE = {"pressure_angle_error": {"scale", "contour_offset"}, "helix_error": {"taper"}, "taper": {"helix_error"},
         "lobing": {"scale_xy", "pitch_wave"},
         # The middle of the measured flank is not that of the whole one: about that a parabola has a slope.
         "profile_crowning": {"pressure_angle_error", "scale", "contour_offset"}, "single_tooth": {"unnamed"}}


# ---- without a name

def feed_marks(gear, r, s):
    um, waves, on = s * r.uniform(2.5, 9), r.uniform(6, 16), some_flank(r)
    phases = r.uniform(0, 2 * math.pi, gear.teeth + 1) * r.integers(0, 2)  # alike on all teeth, or not
    return lambda k, side, u, v: um * numpy.sin(math.pi * waves * v + phases[k]) * on(side)


def waviness(gear, r, s):
    um, waves, on = s * r.uniform(2.5, 6), r.uniform(3.2, 7), some_flank(r)
    phase = r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: um * numpy.sin(math.pi * waves * u + phase) * on(side)


def profile_step(gear, r, s):
    um, at = s * r.uniform(4, 12) * r.choice([-1, 1]), r.uniform(-0.5, 0.5)
    return lambda k, side, u, v: um * (u > at)


def lead_step(gear, r, s):
    um, at, on = s * r.uniform(4, 12) * r.choice([-1, 1]), r.uniform(-0.5, 0.5), some_flank(r)
    return lambda k, side, u, v: um * (v > at) * on(side) + 0.0 * u


def sector(gear, r, s):
    um, first = s * r.uniform(6, 15) * r.choice([-1, 1]), int(r.integers(1, gear.teeth + 1))
    count = int(r.integers(max(3, gear.teeth // 8), max(4, gear.teeth // 3)))
    return lambda k, side, u, v: um * ((k - first) % gear.teeth < count) + 0.0 * u


def groove(gear, r, s):
    um, at, wide = s * r.uniform(6, 20), r.uniform(-0.7, 0.7), r.uniform(0.05, 0.15)
    return lambda k, side, u, v: -um * numpy.exp(-((v - at) / wide) ** 2) + 0.0 * u


def odd_lead(gear, r, s):
    um, pick, at = s * r.uniform(6, 14), int(r.integers(0, 3)), r.uniform(-0.3, 0.3)

    def form(k, side, u, v):
        if pick == 0:
            return um * numpy.abs(v - at)
        if pick == 1:
            return um * numpy.sin(2.2 * math.pi * v + at) * numpy.exp(v)
        return um * numpy.tanh((v - at) / 0.12)
    return form


def alternating(gear, r, s):
    um = s * r.uniform(4, 10)
    return lambda k, side, u, v: um * (1 if k % 2 else -1) * (k <= gear.teeth - gear.teeth % 2) + 0.0 * u


def tooth_shape(gear, r, s):
    um, tooth, flank = s * r.uniform(9, 20), int(r.integers(1, gear.teeth + 1)), int(r.choice([-1, 1]))
    return lambda k, side, u, v: um * (v**3 - 0.4 * v + 0.5 * u * u) * (k == tooth) * (side == flank) * 2.0


def spot(gear, r, s):
    um, tooth, flank = s * r.uniform(15, 60), int(r.integers(1, gear.teeth + 1)), int(r.choice([-1, 1]))
    a, b, wide = r.uniform(-0.6, 0.6), r.uniform(-0.6, 0.6), r.uniform(0.15, 0.3)
    return lambda k, side, u, v: um * numpy.exp(-((u - a) ** 2 + (v - b) ** 2) / wide**2) * (k == tooth) * (side == flank)


def burr(gear, r, s):
    um, tooth, flank, end = s * r.uniform(15, 60), int(r.integers(1, gear.teeth + 1)), int(r.choice([-1, 1])), r.choice([-1, 1])
    return lambda k, side, u, v: um * numpy.exp(-(1.0 - end * v) / 0.08) * (k == tooth) * (side == flank) + 0.0 * u


def dent(gear, r, s):
    um, at, high, wide = s * r.uniform(5, 12), r.uniform(1, gear.teeth), r.uniform(-0.5, 0.5), r.uniform(1.0, 2.0)

    def form(k, side, u, v):
        off = abs((k - at + gear.teeth / 2) % gear.teeth - gear.teeth / 2) / wide
        return -um * numpy.exp(-off * off - ((v - high) / 0.4) ** 2) + 0.0 * u
    return form


def growing_wave(gear, r, s):
    um, order, phase = s * r.uniform(5, 12), int(r.integers(4, 8)), r.uniform(0, 2 * math.pi)
    return lambda k, side, u, v: um * (v + 1.0) ** 2 / 2.0 * math.cos(order * gear.centre(k) - phase) + 0.0 * u


UNNAMED = {f.__name__: f for f in (feed_marks, waviness, profile_step, lead_step, sector, groove, odd_lead,
                                   alternating, growing_wave, tooth_shape, spot, burr, dent)}
# How each can be seen: t traces, c traces with a common zero or an index, s scans.
SEEN_IN = {"feed_marks": "ts", "waviness": "ts", "profile_step": "ts", "lead_step": "ts", "sector": "cs",
           "groove": "ts", "odd_lead": "ts", "alternating": "cs", "growing_wave": "as", "tooth_shape": "as",
           "spot": "s", "burr": "s", "dent": "s"}
