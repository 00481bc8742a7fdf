# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears as a light scanner, a line laser or a tomograph sees them: tips, roots and faces in the data too, sectors that
were seen alone, meshes, any pose in space; external and internal, spur and helical, printed and ground. The involute is a
product of complex numbers, normals lie in space, errors are white, hang together over space, or have long tails. Shares
nothing with the other trials nor with the library.
Usage: light_and_tomograph.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE] [--every N]
Right: nothing: no_effect. known: every wanted name (or one said to be indistinguishable), no other. unknown: seen, no
name but those that are a part of it. Never: a rising error on the hold-out; `explained` with a noise off by a third or a
held-out error above 1.2 of it. `place`: what the answer must say of where it is, counted apart, as intervals are."""
import json
import math

import numpy

import trial

TAU = 2.0 * math.pi


class Wheel:
    """Tooth 1 on the x axis at z = 0; u -1 ... 1 from the root to the tip of the measured flank, v over the face."""

    def __init__(self, r, internal, helical, printed):
        self.ring = internal
        self.z = int(r.choice([48, 57, 64, 80] if internal else [14, 18, 22, 25, 29, 35, 40, 52, 66]))
        self.mn = float(r.choice([1.0, 1.5, 2.0] if printed else [0.7, 1.0, 1.75, 3.0]))
        self.x = round(float(r.uniform(0.0, 0.3) if self.z > 17 else r.uniform(0.3, 0.45)), 3)
        self.b = float(r.choice([5.0, 8.0, 14.0, 22.0]))
        self.beta = math.radians(float(r.choice([-28, -17, -8, 12, 22]))) if helical else 0.0
        at = math.atan(math.tan(math.radians(20)) / math.cos(self.beta))
        mt = self.mn / math.cos(self.beta)
        self.r = 0.5 * mt * self.z
        self.rb = self.r * math.cos(at)
        self.half = (0.25 * math.pi * mt + self.x * self.mn * math.tan(math.radians(20)) / math.cos(self.beta)) / self.r + math.tan(at) - at
        self.at, self.turns = at, math.tan(self.beta) / self.r
        self.lean = self.turns * self.rb  # tangent of the base helix
        if internal:  # from the root, outside, to the tip, inside
            low, high = self.r + self.mn * (self.x + 0.8), self.r - self.mn * (1.0 - self.x)
            self.tip, self.root = high, self.r + self.mn * (self.x + 1.25)
            high += 0.05 * self.mn
        else:
            low, high = max(self.r + self.mn * (self.x - 0.72), 1.007 * self.rb), self.r + self.mn * (self.x + 0.94)
            self.tip, self.root = self.r + self.mn * (1.0 + self.x), self.r - self.mn * (1.25 - self.x)
        self.t_low, self.t_high = (math.sqrt((q / self.rb) ** 2 - 1.0) for q in (low, high))
        self.edge = 0.04 * self.mn if not internal else 0.05 * self.mn

    def roll(self, u):
        return self.t_low + 0.5 * (u + 1.0) * (self.t_high - self.t_low)

    def height(self, v):
        return 0.5 * self.b * (v + 1.0)

    def theta(self, k):
        return TAU * (k - 1) / self.z

    def start(self, k, side, v):
        """Where the involute begins on the base circle, and the way it unrolls: +1 counter-clockwise."""
        turn = self.theta(k) + self.turns * self.height(v)
        return (turn + side * (math.pi / self.z - self.half), side) if self.ring else (turn + side * self.half, -side)

    def flank(self, k, side, u, v):
        """Points and outward normals in space. side +1: the counter-clockwise flank."""
        t, (a, way) = self.roll(u), self.start(k, side, v)
        p = self.rb * (1.0 - 1j * way * t) * numpy.exp(1j * (a + way * t))
        n = 1j * side * numpy.exp(1j * (a + way * t))
        long = math.sqrt(1.0 + self.lean**2)
        return (numpy.stack([p.real, p.imag, self.height(v) + 0.0 * t], -1),
                numpy.stack([n.real, n.imag, 0.0 * t - side * self.lean], -1) / long)

    def radius(self, u):
        return self.rb * numpy.hypot(1.0, self.roll(u))

    def u_at(self, radius):
        return 2.0 * (math.sqrt((radius / self.rb) ** 2 - 1.0) - self.t_low) / (self.t_high - self.t_low) - 1.0

    def side_name(self, side):
        return "left" if (side > 0) != self.ring else "right"

    @property
    def long(self):
        """Of the flank, over the profile, mm."""
        return 0.5 * self.rb * abs(self.t_high**2 - self.t_low**2)

    def toml(self, process):
        return ('format = 1\nname = "part"\n\n[gearbox]\nkind = "gear"\n' f"module_mm = {self.mn}\nhelix_angle_deg = {math.degrees(self.beta):.6f}\n\n"
                f"[gear]\nteeth = {self.z}\nshift = {self.x}\nface_width_mm = {self.b}\n" + ("internal = true\n" if self.ring else "") +
                (f'\n[made]\nprocess = "{process}"\n' if process else ""))


class Errors:
    """Of points in space, standard deviation um."""

    def __init__(self, r, um, kind):
        self.r, self.um, self.kind = r, um, kind
        length, waves = r.uniform(0.25, 0.5), 300  # mm over which they hang together
        self.k = r.normal(size=(waves, 3)) / length
        self.a = r.uniform(0, TAU, waves)

    def draw(self, p):
        r, n = self.r, len(p)
        if self.kind == "field":
            slow = numpy.zeros(n)
            for i in range(0, n, 4000):
                slow[i:i + 4000] = math.sqrt(2.0 / len(self.a)) * numpy.cos(p[i:i + 4000] @ self.k.T + self.a).sum(1)
            return self.um * math.sqrt(0.5) * (r.normal(size=n) + slow)
        if self.kind == "tails":
            return self.um * r.standard_t(5, n) / math.sqrt(5.0 / 3.0)
        if self.kind == "mixture":  # dull and shining spots
            return self.um * numpy.where(r.uniform(size=n) < 0.15, 2.0, 0.6856) * r.normal(size=n)
        return self.um * r.normal(size=n)


class Done:
    """What was done. off(k, side, u, v): um along the normal; moved(p): um in space, of n x 3 points."""

    def __init__(self, how, names=(), also=(), off=None, moved=None, truth=None, place=None):
        self.how, self.names, self.also = how, set(names), set(also)
        self.off, self.moved, self.truth, self.place = off, moved, truth or {}, place or {}


def pm(r):
    return float(r.choice([-1.0, 1.0]))


def turn(r):
    return float(r.uniform(0, TAU))


def aside(um, a):
    return lambda p: numpy.array([um * math.cos(a), um * math.sin(a), 0.0]) + 0.0 * p


def radially(f):
    """f(angle, z, p): um outwards."""
    def moved(p):
        t = numpy.arctan2(p[:, 1], p[:, 0])
        q = f(t, p[:, 2])
        return numpy.stack([q * numpy.cos(t), q * numpy.sin(t), 0.0 * q], -1)
    return moved


def away(w, k, at):
    return (k - at + 0.5 * w.z) % w.z - 0.5 * w.z


def some_side(r):
    return [(1, -1), (1,), (-1,)][int(r.integers(0, 3))]


# ---- nothing
def nothing(w, r, s):
    return Done("nothing")


# ---- with names
def runout(w, r, s):
    e, a = s * r.uniform(3, 12), turn(r)
    return Done("known", {"eccentricity"}, moved=aside(e, a), truth={"eccentricity.amplitude_um": e})


def leaning(w, r, s):
    """The bore was drilled askew: the whole gear leans, heights too."""
    q, a = s * r.uniform(5, 14) / w.b, turn(r)

    def moved(p):
        zc, along = p[:, 2] - 0.5 * w.b, p[:, 0] * math.cos(a) + p[:, 1] * math.sin(a)
        return numpy.stack([q * zc * math.cos(a), q * zc * math.sin(a), -q * along], -1)
    return Done("known", {"axis_tilt"}, moved=moved, truth={"axis_tilt.slope_um_per_mm": q})


def shrunk(w, r, s):
    q = s * r.uniform(4, 14) / w.r * pm(r)
    return Done("known", {"scale"}, moved=lambda p: p * q, truth={"scale.percent": 0.1 * q})


def squashed_foot(w, r, s):
    """The first layers are pressed wide."""
    um, h = s * r.uniform(10, 40), min(r.uniform(0.3, 1.5), 0.2 * w.b)
    return Done("known", {"elephant_foot"}, off=lambda k, side, u, v: um * numpy.exp(-w.height(v) / h) + 0.0 * u,
                truth={"elephant_foot.amount_um": um, "elephant_foot.height_mm": h})


def unequal_axes(w, r, s):
    q, a = s * r.uniform(8, 16) / w.r, turn(r)
    c, d = q * math.cos(2 * a), q * math.sin(2 * a)
    return Done("known", {"scale_xy"}, {"skew", "lobing"}, moved=lambda p: numpy.stack([c * p[:, 0] + d * p[:, 1], d * p[:, 0] - c * p[:, 1], 0 * p[:, 0]], -1),
                truth={"scale_xy.percent": 0.2 * q})


def squeezed(w, r, s):
    um, n, a = s * r.uniform(5, 14), int(r.integers(3, 6)), turn(r)
    return Done("known", {"lobing"}, {"pitch_wave"}, moved=radially(lambda t, z: um * numpy.cos(n * t - a)), truth={"lobing.amplitude_um": um})


def wrong_lead(w, r, s):
    um = s * r.uniform(4, 14) * pm(r)
    return Done("known", {"helix_error"}, off=lambda k, side, u, v: 0.5 * um * side * v + 0.0 * u, truth={"helix_error.slope_um": um})


def crowned(w, r, s):
    um = s * r.uniform(4, 14)
    return Done("known", {"crowning"}, off=lambda k, side, u, v: -um * v * v + 0.0 * u, truth={"crowning.amount_um": um})


def relieved(w, r, s):
    um, at = s * r.uniform(8, 20), r.uniform(0.0, 0.5)
    return Done("known", {"tip_relief"}, off=lambda k, side, u, v: -um * (numpy.clip(u - at, 0, None) / (1 - at)) ** 2 + 0.0 * v)


def wrong_angle(w, r, s):
    um, on = s * r.uniform(4, 12) * pm(r), some_side(r)
    return Done("known", {"pressure_angle_error"}, {"scale", "contour_offset", "tooth_thickness"}, off=lambda k, side, u, v: um * u * (side in on) + 0.0 * v)


def worn(w, r, s):
    um, at, wide = s * r.uniform(10, 25), r.uniform(-0.4, 0.4), r.uniform(0.25, 0.5)
    on = some_side(r)
    return Done("known", {"flank_wear"}, off=lambda k, side, u, v: -um * numpy.exp(-((u - at) / wide) ** 2) * (side in on) + 0.0 * v)


def lost_step(w, r, s):
    um, a, at = s * r.uniform(8, 25), turn(r), w.b * r.uniform(0.25, 0.75)
    return Done("known", {"layer_shift"}, moved=lambda p: numpy.outer(p[:, 2] > at, [um * math.cos(a), um * math.sin(a), 0.0]),
                truth={"layer_shift.height_mm": at, "layer_shift.dx_um": um * math.cos(a), "layer_shift.dy_um": um * math.sin(a)})


def proud_tooth(w, r, s):
    um, k0 = s * r.uniform(8, 25) * pm(r), int(r.integers(1, w.z + 1))
    return Done("known", {"single_tooth"}, off=lambda k, side, u, v: um * (k == k0) + 0.0 * u * v, truth={"single_tooth.amount_um": um},
                place={"tooth": (k0, 0)})


def conical(w, r, s):
    um = s * r.uniform(4, 14) * pm(r)
    return Done("known", {"taper"}, off=lambda k, side, u, v: 0.5 * um * v + 0.0 * u, truth={"taper.slope_um": um})


def dividing(w, r, s):
    um, n, a = s * r.uniform(5, 12), int(r.integers(2, 7)), turn(r)
    return Done("known", {"pitch_wave"}, off=lambda k, side, u, v: side * um * math.cos(n * w.theta(k) - a) + 0.0 * u * v,
                truth={"pitch_wave.amplitude_um": um * math.sqrt(1 + w.lean**2) / math.cos(w.at)})


def worm_wheel(w, r, s):
    um, a = s * r.uniform(4, 9), turn(r)
    n = int(r.integers(2, 4)) * w.z + int(r.integers(2, w.z - 2))

    def off(k, side, u, v):
        start, way = w.start(k, side, v)
        return um * numpy.cos(n * (start + way * w.roll(u)) - a)
    return Done("known", {"ghost_order"}, off=off)


def relieved_and_off_centre(w, r, s):
    um, at, e, a = s * r.uniform(10, 20), r.uniform(0.0, 0.4), s * r.uniform(4, 10), turn(r)
    return Done("known", {"tip_relief", "eccentricity"}, off=lambda k, side, u, v: -um * (numpy.clip(u - at, 0, None) / (1 - at)) ** 2 + 0.0 * v, moved=aside(e, a),
                truth={"eccentricity.amplitude_um": e})


def printed_plainly(w, r, s):
    """Shrinks, stands on a wide foot, and its axes differ."""
    q, p, um, h = s * r.uniform(6, 14) / w.r * pm(r), s * r.uniform(8, 14) / w.r, s * r.uniform(12, 30), min(r.uniform(0.4, 1.2), 0.2 * w.b)
    return Done("known", {"scale", "scale_xy", "elephant_foot"}, {"tooth_thickness", "contour_offset", "skew", "lobing"},
                off=lambda k, side, u, v: um * numpy.exp(-w.height(v) / h) + 0.0 * u, moved=lambda x: x * [q + p, q - p, q],
                truth={"elephant_foot.amount_um": um, "scale.percent": 0.1 * q})


# ---- without
def wire_mark(w, r, s):
    """Where the wire came in: a ridge over the whole face of one flank."""
    k0, side0, at, um, wide = int(r.integers(1, w.z + 1)), int(pm(r)), r.uniform(-0.5, 0.5), s * r.uniform(8, 25) * pm(r), r.uniform(0.08, 0.2)
    return Done("unknown", off=lambda k, side, u, v: um * numpy.exp(-((u - at) / wide) ** 2) * ((k == k0) and (side == side0)) + 0.0 * v,
                place={"tooth": (k0, 0), "flank": w.side_name(side0)})


def bands(w, r, s):
    """Layers that ooze in a rhythm: all walls swell and shrink over the height."""
    um, length, a = s * r.uniform(2.5, 7), w.b * r.uniform(0.08, 0.25), turn(r)
    return Done("unknown", off=lambda k, side, u, v: um * numpy.cos(TAU * w.height(v) / length + a) + 0.0 * u, place={"wavelength_mm": (length, 0.12)})


def infill_shows(w, r, s):
    """The infill's lines press through the walls: stripes in space."""
    um, length, a, turned = s * r.uniform(6, 14), w.mn * r.uniform(1.5, 3.0), turn(r), turn(r)

    def off(k, side, u, v):
        p, _ = w.flank(k, side, u, v)
        return um * numpy.clip(numpy.cos(TAU * (p[:, 0] * math.cos(turned) + p[:, 1] * math.sin(turned)) / length + a), 0, None) ** 2
    return Done("unknown", also={"contour_offset", "tooth_thickness"}, off=off)


def ringing(w, r, s):
    """The print's head swings after the tip's corner: waves that die out down one flank."""
    um, long, side0 = s * r.uniform(8, 18), w.long * r.uniform(0.22, 0.4), int(pm(r))
    return Done("unknown", also={"tip_relief"}, off=lambda k, side, u, v: um * numpy.exp(-0.5 * (1 - u) * w.long / (1.2 * long)) * numpy.cos(
        TAU * 0.5 * (1 - u) * w.long / long) * (side == side0) + 0.0 * v, place={"flank": w.side_name(side0)})


def drooping(w, r, s):
    """Over a hole in the web the first layers sag: some teeth's lower ends stand proud."""
    um, k0, n, h = s * r.uniform(12, 30), r.uniform(1, w.z), r.uniform(1.5, 4), r.uniform(0.15, 0.3)
    return Done("unknown", off=lambda k, side, u, v: um * numpy.exp(-(away(w, k, k0) / n) ** 2) * numpy.exp(-0.5 * (v + 1) / h) + 0.0 * u,
                place={"tooth": (k0, n + 1)})


def beam_hardening(w, r, s):
    """A tomograph's grey values fall inside: the wall is seen further out the nearer it is to the middle."""
    um = s * r.uniform(8, 18)
    return Done("unknown", also={"pressure_angle_error", "profile_crowning", "tip_relief", "contour_offset", "tooth_thickness", "scale", "crowning"},
                off=lambda k, side, u, v: um * (1.0 - (w.radius(u) / w.radius(numpy.array(-1.0 if w.ring else 1.0))) ** 6) * (1 - 0.6 * v * v))


def rings_of_tomograph(w, r, s):
    """Rings about the tomograph's axis, which is not the gear's."""
    um, length, cx, cy = s * r.uniform(5, 10), w.mn * r.uniform(1.2, 2.5), w.r * r.uniform(-0.5, 0.5), w.r * r.uniform(-0.5, 0.5)

    def off(k, side, u, v):
        p, _ = w.flank(k, side, u, v)
        return um * numpy.cos(TAU * numpy.hypot(p[:, 0] - cx, p[:, 1] - cy) / length)
    return Done("unknown", off=off)


def turned_layers(w, r, s):
    """The print slipped on its turntable: everything above a height is turned."""
    um, at = s * r.uniform(7, 16) * pm(r), r.uniform(-0.5, 0.5)
    return Done("unknown", also={"helix_error"}, off=lambda k, side, u, v: side * um * (v > at) + 0.0 * u, place={"height_mm": (w.height(at), 0.06 * w.b)})


def burned(w, r, s):
    """Ground too hot on a run of teeth of one flank: their middles have swollen."""
    um, k0, n, side0, a, b = s * r.uniform(8, 18), int(r.integers(1, w.z + 1)), int(r.integers(2, 6)), int(pm(r)), r.uniform(-0.4, 0.4), r.uniform(-0.4, 0.4)
    return Done("unknown", also={"single_tooth"} if n == 2 else (), off=lambda k, side, u, v: um * ((k - k0) % w.z < n) * (side == side0) * numpy.exp(
        -((u - a) / 0.6) ** 2 - ((v - b) / 0.5) ** 2), place={"tooth": (k0 + 0.5 * (n - 1), 0.5 * n + 1), "flank": w.side_name(side0)})


def gashes(w, r, s):
    """A hob of few gashes cuts flats: cusps over the profile, alike on all teeth."""
    um, n, a = s * r.uniform(5, 12), r.uniform(3, 7), r.uniform(0, 1)
    return Done("unknown", also={"ghost_order"}, off=lambda k, side, u, v: um * (4 * ((0.5 * n * (u + 1) + a) % 1.0 - 0.5) ** 2 - 1 / 3) + 0.0 * v)


def chipped(w, r, s):
    """Fell on its tips: edges of some neighbours broken at one height."""
    um, k0, n, b, side0 = s * r.uniform(15, 40), int(r.integers(1, w.z + 1)), int(r.integers(2, 4)), r.uniform(-0.6, 0.6), int(pm(r))
    return Done("unknown", also={"single_tooth"}, off=lambda k, side, u, v: -um * ((k - k0) % w.z < n) * (side == side0) * numpy.exp(-((1 - u) / 0.4) ** 2 - ((v - b) / 0.25) ** 2),
                place={"tooth": (k0 + 0.5 * (n - 1), 0.5 * n + 1), "flank": w.side_name(side0)})


def spatter(w, r, s):
    """Drops of solder on a few flanks."""
    where = [(int(r.integers(1, w.z + 1)), int(pm(r)), r.uniform(-0.6, 0.6), r.uniform(-0.7, 0.7), s * r.uniform(15, 40)) for _ in range(int(r.integers(2, 5)))]

    def off(k, side, u, v):
        return sum((um * numpy.exp(-((u - a) / 0.3) ** 2 - ((v - b) / (0.3 if w.b < 10 else 0.15)) ** 2) for k0, side0, a, b, um in where if (k, side) == (k0, side0)), 0.0 * u * v)
    return Done("unknown", off=off, place={"tooth": (where[0][0], 0)})


def pitting(w, r, s):
    """Pits near the pitch line of one flank, here and there on every tooth."""
    side0, at = int(pm(r)), r.uniform(-0.3, 0.2)
    pits = {k: [(at + 0.12 * r.normal(), r.uniform(-0.9, 0.9), s * r.uniform(10, 30)) for _ in range(int(r.integers(1, 5)))] for k in range(1, w.z + 1)}
    return Done("unknown", also={"flank_wear"}, off=lambda k, side, u, v: sum((-um * numpy.exp(-((u - a) / 0.15) ** 2 - ((v - b) / 0.12) ** 2) for a, b, um in pits[k]), 0.0 * u * v) * (side == side0),
                place={"flank": w.side_name(side0)})


def dished(w, r, s):
    """The web has bent like a propeller of three: rims roll, radially more towards the ends of the face."""
    um, n, a = s * r.uniform(6, 14), int(r.integers(2, 5)), turn(r)
    return Done("unknown", moved=radially(lambda t, z: um * (2 * z / w.b - 1) * numpy.cos(n * t - a)))


def slit(w, r, s):
    """The rim was slit and has sprung open: thickness stays, the angle runs off around the gear and jumps back."""
    k0, um = int(r.integers(1, w.z + 1)), s * r.uniform(8, 16) * pm(r)
    return Done("unknown", also={"eccentricity", "pitch_wave"}, off=lambda k, side, u, v: side * um * (((k - k0) % w.z) / w.z - 0.5) + 0.0 * u * v,
                place={"tooth": (k0, 1.5)})


def flash(w, r, s):
    """The mould's parting line stands out, and its halves do not meet."""
    um, at, e, a = s * r.uniform(10, 25), r.uniform(-0.4, 0.4), s * r.uniform(0, 6), turn(r)
    return Done("unknown", also={"layer_shift"}, off=lambda k, side, u, v: um * numpy.exp(-((v - at) / 0.06) ** 2) + 0.0 * u,
                moved=lambda p: numpy.outer(p[:, 2] > w.height(at), [e * math.cos(a), e * math.sin(a), 0.0]), place={"height_mm": (w.height(at), 0.08 * w.b)})


def ejectors(w, r, s):
    """Pins pushed the part out of the mould: its rim is bent outwards over each, at one end."""
    um, n, a, end = s * r.uniform(10, 22), int(r.integers(3, 7)), turn(r), pm(r)
    return Done("unknown", also={"lobing"}, moved=radially(lambda t, z: um * numpy.exp((end * (2 * z / w.b - 1) - 1) / 0.35) * numpy.exp(5 * (numpy.cos(n * t - a) - 1))))


def spokes(w, r, s):
    """Thick arms cool last: the rim is drawn in over each, sharper than a sine."""
    um, n, a, p = s * r.uniform(8, 18), int(r.integers(3, 7)), turn(r), r.uniform(2, 7)
    return Done("unknown", also={"lobing", "scale", "contour_offset", "tooth_thickness"}, moved=radially(lambda t, z: -um * numpy.exp(p * (numpy.cos(n * t - a) - 1))))


def caked_roots(w, r, s):
    """Powder left in the gaps of a part of the gear."""
    um, k0, n = s * r.uniform(12, 25), r.uniform(1, w.z), r.uniform(0.12, 0.3) * w.z
    return Done("unknown", off=lambda k, side, u, v: um * numpy.exp(-(u + 1) / 0.3) * (abs(away(w, k, k0)) < n) + 0.0 * v, place={"tooth": (k0, n)})


def sprayed(w, r, s):
    """Matting spray from one side: thicker on what looked at the can, tips and flanks alike."""
    um, a, n = s * r.uniform(8, 18), turn(r), r.uniform(1, 3)

    def off(k, side, u, v):
        _, normal = w.flank(k, side, u, v)
        return um * numpy.clip(normal[:, 0] * math.cos(a) + normal[:, 1] * math.sin(a), 0, None) ** n
    return Done("unknown", also={"eccentricity", "contour_offset", "tooth_thickness", "pitch_wave", "scale_xy", "lobing"}, off=off)


def marching_feed(w, r, s):
    """Feed marks whose phase marches from tooth to tooth, on one or both flanks."""
    um, n, m, a, on = s * r.uniform(2.5, 6), r.uniform(4, 11), r.uniform(0.1, 0.9), turn(r), some_side(r)
    return Done("unknown", off=lambda k, side, u, v: um * numpy.cos(math.pi * n * v + TAU * m * k + a) * (side in on) + 0.0 * u, place={"wavelength_mm": (2 * w.b / (2 * n) * 1.0, 0.12)})


def two_clampings(w, r, s):
    """Cut in two clampings: from a height on the profile has another angle and the tooth another place."""
    um, off1, at = s * r.uniform(6, 12) * pm(r), s * r.uniform(5, 10) * pm(r), r.uniform(-0.4, 0.4)
    return Done("unknown", also={"pressure_angle_error"}, off=lambda k, side, u, v: (um * u + off1) * (v > at))


def deep_line(w, r, s):
    """A groove right round the gear, across all flanks, at one height."""
    um, at, wide = s * r.uniform(8, 25) * pm(r), r.uniform(-0.8, 0.8), r.uniform(0.03, 0.12)
    return Done("unknown", off=lambda k, side, u, v: um * numpy.exp(-((v - at) / wide) ** 2) + 0.0 * u, place={"height_mm": (w.height(at), 0.06 * w.b)})


def handled(w, r, s):
    """Picked up hot with pliers: two dents across from each other, over a few teeth, tips and flanks."""
    um, k0, n, b = s * r.uniform(10, 22), r.uniform(1, w.z), r.uniform(1.0, 2.0), r.uniform(-0.4, 0.4)
    return Done("unknown", off=lambda k, side, u, v: -um * (numpy.exp(-(away(w, k, k0) / n) ** 2) + numpy.exp(-(away(w, k, k0 + 0.5 * w.z) / n) ** 2)) * numpy.exp(-((v - b) / 0.5) ** 2) + 0.0 * u,
                place={"tooth": (k0, n + 1)})


def scorched_start(w, r, s):
    """Every perimeter starts on the same tooth: a welt along its tip-near flank, and the tooth is thicker."""
    um, k0, side0 = s * r.uniform(15, 35), int(r.integers(1, w.z + 1)), int(pm(r))
    return Done("unknown", also={"single_tooth"}, off=lambda k, side, u, v: um * (k == k0) * (side == side0) * numpy.exp((u - 1) / 0.4) + 0.0 * v,
                place={"tooth": (k0, 0), "flank": w.side_name(side0)})


# f in the gear's frame, p in any pose, a a part of the turn alone (in its frame), m a mesh in its frame, q a mesh in any pose,
# c cloud of the whole part with tips, roots and faces; h helical too, i internal too, P printed
KINDS = [(nothing, "fhi"), (nothing, "phi"), (nothing, "ahi"), (nothing, "mP"), (nothing, "qhP"), (nothing, "chi"),
         (runout, "fcahi"), (leaning, "fcmh"), (shrunk, "fpqhi"), (squashed_foot, "fmpqP"), (unequal_axes, "fpqhi"), (squeezed, "fapchi"), (wrong_lead, "fpah"),
         (crowned, "fpahi"), (relieved, "fpahi"), (wrong_angle, "fpah"), (worn, "fpahi"), (lost_step, "fqmP"), (proud_tooth, "fpmhi"), (conical, "fpahi"),
         (dividing, "fphi"), (worm_wheel, "f"), (relieved_and_off_centre, "fcmhi"), (printed_plainly, "fmP"),
         (wire_mark, "fpm"), (bands, "fpmqP"), (infill_shows, "fmqP"), (ringing, "fmP"), (drooping, "fmqP"), (beam_hardening, "pqi"), (rings_of_tomograph, "fmi"),
         (turned_layers, "fmP"), (burned, "fahi"), (gashes, "fph"), (chipped, "fchi"), (spatter, "fcmhi"), (pitting, "fhi"), (dished, "fmi"), (slit, "fpi"),
         (flash, "fmq"), (ejectors, "fm"), (spokes, "fmi"), (caked_roots, "fmP"), (sprayed, "fmi"), (marching_feed, "fah"), (two_clampings, "fm"),
         (deep_line, "fpahi"), (handled, "fmi"), (scorched_start, "fmqP")]


class Case:
    def __init__(self, at, number, seed):
        kind, ways = KINDS[at]
        r = self.r = numpy.random.default_rng([seed, 90210, at, number])
        self.way, self.printed = str(r.choice([c for c in ways if c in "fpamqc"])), "P" in ways
        self.w = Wheel(r, "i" in ways and r.uniform() < 0.35, "h" in ways and r.uniform() < 0.5, self.printed)
        self.um = float(r.uniform(3, 4 + 5 * self.w.mn) if self.printed else r.uniform(0.8, 4))
        self.errors = Errors(r, self.um, str(r.choice(["white", "white", "field", "tails", "mixture"])))
        self.done = kind(self.w, r, self.um)
        self.points = int(r.choice([6000, 12000, 20000]))
        self.process = str(r.choice(["", "", "fdm-0.4" if self.printed else "grinding"])) if kind not in (flash, ejectors, spokes, leaning, lost_step, unequal_axes, worm_wheel, conical) else ""
        self.teeth = list(range(1, self.w.z + 1))
        if self.way == "a":
            first, count = int(r.integers(1, self.w.z + 1)), max(6, int(r.uniform(0.25, 0.6) * self.w.z))
            self.teeth = [(first + i - 1) % self.w.z + 1 for i in range(count)]
        self.name = f"{kind.__name__}-{at}-{number}"

    def label(self):
        w = self.w
        return (f"{self.name} z{w.z}{' ring' if w.ring else ''} m{w.mn} b{w.b:.0f} {math.degrees(w.beta):.0f}deg [{self.way} {self.points}"
                f"{f' {len(self.teeth)} teeth' * (self.way == 'a')}, {self.errors.kind} {self.um:.2f}{' ' + self.process if self.process else ''}]")

    def made(self, k, side, u, v):
        p, n = self.w.flank(k, side, u, v)
        e = self.errors.draw(p) + (self.done.off(k, side, u, v) if self.done.off else 0.0)
        return p + 1e-3 * (n * e[:, None] + (self.done.moved(p) if self.done.moved else 0.0))

    def beside(self, p, n):
        """Points off the flanks: the body's place and errors."""
        return p + 1e-3 * (n * self.errors.draw(p)[:, None] + (self.done.moved(p) if self.done.moved else 0.0))

    def arcs(self, k, v, places):
        """Tip land and root of tooth k at heights v: `places` 0 ... 1 along either."""
        w = self.w
        edge = [self.w.flank(k, side, numpy.array([1.0]), numpy.array([-1.0]))[0][0] for side in (1, -1)]
        a1, a0 = (math.atan2(q[1], q[0]) for q in edge)
        low = w.flank(k, 1, numpy.array([-1.0]), numpy.array([-1.0]))[0][0]
        b0 = math.atan2(low[1], low[0])
        nxt = w.flank(k + 1, -1, numpy.array([-1.0]), numpy.array([-1.0]))[0][0]
        b1 = math.atan2(nxt[1], nxt[0])
        a1, b1 = a0 + (a1 - a0) % TAU, b0 + (b1 - b0) % TAU
        turn = w.turns * w.height(v)
        out = []
        for c0, c1, radius, inset in ((a0, a1, w.tip, 0.06), (b0, b1, w.root, 0.3)):
            t = c0 + (inset + (1 - 2 * inset) * places) * (c1 - c0) + turn
            out.append((numpy.stack([radius * numpy.cos(t), radius * numpy.sin(t), w.height(v)], -1),
                        numpy.stack([numpy.cos(t), numpy.sin(t), 0 * t], -1) * (-1 if w.ring else 1)))
        return out

    def cloud(self):
        w, r, parts = self.w, self.r, []
        n = max(24, self.points // (2 * len(self.teeth)))
        for k in self.teeth:
            for side in (1, -1):
                u, v = r.uniform(-0.97, 0.97, n), r.uniform(-0.985, 0.985, n)
                if self.way == "a":  # a line laser: lines over the face
                    u = 0.97 * numpy.round(u * 7) / 7 + r.uniform(-0.01, 0.01, n)
                parts.append(self.made(k, side, u, v))
            if self.way == "c":
                m = max(6, n // 6)
                parts += [self.beside(p, q) for p, q in self.arcs(k, r.uniform(-0.98, 0.98, m), r.uniform(0, 1, m))]
                low, high = sorted((w.root, w.r + (2.0 if w.ring else -2.5) * w.mn))
                for face, up in ((0.0, -1.0), (w.b, 1.0)):
                    rho, t = r.uniform(low, high, m), w.theta(k) + r.uniform(0, TAU / w.z, m)
                    parts.append(self.beside(numpy.stack([rho * numpy.cos(t), rho * numpy.sin(t), face + 0 * t], -1), numpy.tile([0, 0, up], (m, 1))))
        return numpy.vstack(parts)

    def mesh(self):
        """Vertices n x 3 and triangles of the teeth's surface, open at both faces."""
        w, r = self.w, self.r
        columns = int(r.choice([7, 10, 14]))
        # Triangles neither long nor flat.
        rows = max(14, min(int(2 * self.points / (3 * columns * w.z)), int(2 * columns * w.b / w.long)), int(0.6 * columns * w.b / w.long))
        v = numpy.linspace(-1.0, 1.0, rows)
        arc = numpy.linspace(w.t_low**2, w.t_high**2, columns)  # evenly along the flank
        u = 2.0 * (numpy.sqrt(arc) - w.t_low) / (w.t_high - w.t_low) - 1.0
        grid = []
        for k in self.teeth:
            for part in ("cw", "tip", "ccw", "root"):
                if part in ("cw", "ccw"):
                    side = 1 if part == "ccw" else -1
                    for a in u[::-side]:
                        grid.append(self.made(k, side, numpy.full(rows, a), v))
                else:
                    for q in (numpy.linspace(0, 1, 4) if part == "tip" else numpy.linspace(0, 1, 5)):
                        grid.append(self.beside(*self.arcs(k, v, numpy.full(rows, q))[part == "root"]))
        n = len(grid)
        i, j = numpy.meshgrid(numpy.arange(n), numpy.arange(rows - 1), indexing="ij")
        a, b = i * rows + j, ((i + 1) % n) * rows + j
        tri = numpy.stack([numpy.stack([a, b, b + 1], -1), numpy.stack([a, b + 1, a + 1], -1)], 2).reshape(-1, 3)
        return numpy.vstack(grid), tri[:, ::-1] if w.ring else tri

    def posed(self, p):
        if self.way not in "pq":
            return p
        q, _ = numpy.linalg.qr(self.r.normal(size=(3, 3)))
        q[:, 0] *= numpy.sign(numpy.linalg.det(q))
        return p @ q.T + 20.0 * self.r.normal(size=3)

    def write(self, where):
        if self.way in "mq":
            p, tri = self.mesh()
            p = self.posed(p)
            if self.way == "m":
                record = numpy.zeros(len(tri), dtype=[("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")])
                record["v"] = p[tri]
                (where / "scan.stl").write_bytes(b"scan".ljust(80) + numpy.uint32(len(tri)).tobytes() + record.tobytes())
                return "scan.stl"
            face = numpy.zeros(len(tri), dtype=[("c", "u1"), ("i", "<i4", 3)])
            face["c"], face["i"] = 3, tri
            head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(p)}\nproperty double x\nproperty double y\nproperty double z\nelement face {len(tri)}\nproperty list uchar int vertex_indices\nend_header\n"
            (where / "scan.ply").write_bytes(head.encode() + p.astype("<f8").tobytes() + face.tobytes())
            return "scan.ply"
        numpy.savetxt(where / "scan.csv", self.posed(self.cloud()), fmt="%.6f", delimiter=",", header="x_mm,y_mm,z_mm", comments="")
        return "scan.csv"

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.w.toml(self.process))
        return trial.close_loop(self, program, where, "part.toml", self.write(where), *["--aligned"] * (self.way not in "pq"))

    def judge(self):
        """What is wrong; empty: nothing."""
        a, d, s = self.answer, self.done, self.um
        before, after = (a[when]["held_out_rms_um"] for when in ("before", "after"))
        if after is not None and after > 1.0001 * before:
            return "worse"
        if d.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        alike = [{e["id"], *e["confounded_with"]} for e in a["effects"] if e["named"]]
        wrong = [sorted(one) for one in alike if not one & (d.names | d.also)]
        if wrong:
            return f"misnamed {wrong}"
        missing = [n for n in d.names if not any(n in one for one in alike)]
        if d.how == "known" and missing:
            return f"not named: {missing}"
        if a["verdict"] == "explained":
            if not 0.75 <= a["data"]["noise_um"] / s <= 1.33:
                return f"noise told {a['data']['noise_um'] / s:.2f} of the true one"
            if after is not None and after > 1.2 * s:
                return "called explained"
        if not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def placed(self):
        """Whether the answer says the place; None: the form has none, or it was not seen."""
        if not self.right or not self.done.place or self.way in "pq":  # in any pose tooth one is any
            return None
        effects, z = self.answer["effects"], self.w.z
        terms = [t for e in effects for t in e.get("terms", [])]
        text = json.dumps([effects, self.answer["structure_left"]])
        for key, value in self.done.place.items():
            if key == "flank":
                if not any(e["flank"] == value for e in effects) and f"{value} flank" not in text:
                    return False
            elif key == "tooth":
                told = [e["parameters"]["tooth"]["value"] for e in effects if e["id"] == "single_tooth"]
                told += [t.get("tooth", t.get("first_tooth", 0) + 0.5 * (t.get("teeth", 1) - 1)) for t in terms if "tooth" in t or "first_tooth" in t]
                told += [t["first_tooth"] for t in terms if "first_tooth" in t]
                if not any(abs((t - value[0] + z / 2) % z - z / 2) <= value[1] for t in told) and f"tooth {round(value[0])}" not in text:
                    return False
            elif key == "wavelength_mm":
                if not any(abs(t.get(key, 0) / value[0] - 1) < value[1] for t in terms) and "mm long" not in text:
                    return False
            elif not any(abs(t.get(key, t.get("place_mm", -1e9)) - value[0]) <= value[1] for t in terms):
                return False
        return True

    def held(self):
        held, asked, why = 0, 0, []
        for e in self.answer["effects"] if self.answer and self.right else []:
            for key, value in self.done.truth.items():
                name, parameter = key.split(".")
                if name == "layer_shift" and self.way in "pq":  # in any pose directions and heights are any
                    continue
                if e["id"] == name and parameter in e["parameters"]:
                    low, high = e["parameters"][parameter]["ci95"]
                    held, asked = held + (low <= value <= high), asked + 1
                    if not low <= value <= high:
                        why.append(f"{key} {value:.4g} not in [{low:.4g}, {high:.4g}]")
        return held, asked, why

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        told = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:150] + "}") for e in a["effects"])
        held = [(a[k]["held_out_rms_um"] or float("nan")) / self.um for k in ("before", "after")]
        return (f"{'' if self.right else 'WRONG '}{'UNPLACED ' * (self.placed() is False)}{self.label()}: {self.why} | {a['verdict']} noise {a['data']['noise_um'] / self.um:.2f} "
                f"held {held[0]:.2f} -> {held[1]:.2f} | {told} | {a['structure_left']['description'][:180]} p {a['structure_left']['p_value']:.2g} | {self.done.place} {self.held()[2] or ''} {self.seconds:.1f}s")


def main():
    o = trial.words(each=1, every=(1, "only every n-th kind"))
    cases = [Case(at, i, o.seed) for at in range(0, len(KINDS), o.every) for i in range(o.each)]
    trial.campaign([c for c in cases if o.only in c.name], o, keys=lambda c: (c.name.split("-")[0], "all " + c.done.how), worth_a_line=lambda c: c.placed() is False or bool(c.held()[2]),
                   counts=lambda c: (int(c.placed() is True), int(c.placed() is not None)), columns="| done | right | of | place told | of |", after=trial.tell_intervals)


if __name__ == "__main__":
    main()
