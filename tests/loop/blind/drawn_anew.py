# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears drawn from first principles: the involute as a thread that is unwound, normals as the cross product of two
differences, parts moved in space as the process moves them; external and internal, spur and helical, 9 to 95 teeth;
scans in the gear's frame or any other, traces of all teeth or a few, index, runout, and mixtures of them. Alone or
two or three names at once, forms that no other trial lists, and nothing.
Usage: drawn_anew.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: nothing: no_effect. names: every one told (or among those it cannot be told from) and no other. forms: seen, no
name but those that are part of it, what is left within 1.2 of the noise or said to be more. Never: an error on
held-out data that rises. Intervals are counted apart: those that hold, and how many standard errors the truth is off."""
import json
import math

import numpy

import trial

TAU = 2.0 * math.pi


class Body:
    """side +1: the counter-clockwise flank. Deviations grow out of the material."""

    def __init__(self, r):
        self.z = int(r.choice([9, 12, 15, 17, 21, 26, 33, 40, 55, 70, 95], p=[.05, .08, .1, .12, .15, .15, .1, .1, .06, .05, .04]))
        self.inner = bool(r.uniform() < 0.25) and self.z >= 26
        self.mn = float(r.choice([0.7, 1.0, 1.6, 2.2, 3.0]))
        self.beta = math.radians(float(r.choice([0, 0, 0, 9, -13, 21])))
        self.x = round(float(r.uniform(0.0, 0.3) + (0.3 if self.z < 15 else 0.12 if self.z < 18 else 0.0)), 3)
        self.b = float(r.choice([6.0, 9.0, 14.0, 22.0]))
        self.r = 0.5 * self.mn / math.cos(self.beta) * self.z
        self.at = math.atan(math.tan(math.radians(20)) / math.cos(self.beta))
        self.rb = self.r * math.cos(self.at)
        self.psi = (0.5 * math.pi + 2 * self.x * math.tan(math.radians(20))) * self.mn / math.cos(self.beta) / (2 * self.r) + math.tan(self.at) - self.at
        if self.inner:
            ends = self.r - self.mn * (0.95 - self.x), self.r + self.mn * (self.x + 0.75)
            self.ends = sorted(math.sqrt(max(q * q - self.rb**2, 1e-4)) for q in (max(ends[0], 1.002 * self.rb), ends[1]))
        else:  # from where the rack's rounding begins to cut to the tip
            straight = self.mn * (1.25 - 0.38 * (1 - math.sin(math.radians(20))) - self.x)
            self.ends = [max(self.r * math.sin(self.at) - straight / math.sin(self.at), 0.02 * self.r), math.sqrt((self.r + self.mn * (1 + self.x))**2 - self.rb**2)]
        self.u_ref = 2 * (self.rb * math.tan(self.at) - self.ends[0]) / (self.ends[1] - self.ends[0]) - 1

    def theta(self, k):
        return TAU * (k - 1) / self.z

    def up(self, u):
        """u -1 ... 1 from the root to the tip, as roll length."""
        a, b = self.ends[::-1] if self.inner else self.ends
        return a + 0.5 * (u + 1) * (b - a)

    def radius(self, u):
        return numpy.hypot(self.rb, self.up(u))

    def xyz(self, k, side, u, v):
        roll = self.up(u)
        hand = -side if self.inner else side  # a ring's flank is the opposite side of the gap's outline
        middle = self.theta(k) + (side * math.pi / self.z if self.inner else 0.0)
        z = 0.5 * (v + 1) * self.b
        a = middle + hand * self.psi + z * math.tan(self.beta) / self.r
        # The thread leaves the base circle at the angle a - hand * roll / rb.
        t = a - hand * roll / self.rb
        return self.rb * numpy.cos(t) - hand * roll * numpy.sin(t), self.rb * numpy.sin(t) + hand * roll * numpy.cos(t), z + 0.0 * u

    def normal(self, k, side, u, v):
        h = 1e-4
        p = [numpy.array(self.xyz(k, side, u + i * h, v + j * h)) for i, j in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        n = numpy.cross((p[0] - p[1]).T, (p[2] - p[3]).T).T
        x, y, _ = self.xyz(k, side, u, v)
        n = n / numpy.linalg.norm(n, axis=0)
        return n * numpy.sign(side * (n[1] * x - n[0] * y))

    def toml(self):
        return (f'format = 1\nname = "part"\n[gearbox]\nkind = "gear"\nmodule_mm = {self.mn}\nhelix_angle_deg = {math.degrees(self.beta):.6f}\n'
                f"[gear]\nteeth = {self.z}\nshift = {self.x}\nface_width_mm = {self.b}\n" + ("internal = true\n" if self.inner else ""))


class Thing:
    """moved(x, y, z): um in space; off(k, side, u, v): um along the normal; truth: parameters of the names."""

    def __init__(self, names=(), moved=None, off=None, truth=None, also=()):
        self.names, self.moved, self.off, self.truth, self.also = set(names), moved, off, truth or {}, set(also)


def pm(r):
    return float(r.choice([-1.0, 1.0]))


def turn(r):
    return float(r.uniform(0, TAU))


def polar(e, a):
    return e * math.cos(a), e * math.sin(a)


# ---- names; s: the noise in um
def eccentricity(g, r, s):
    e, a = s * r.uniform(3, 15), turn(r)
    return Thing({"eccentricity"}, moved=lambda x, y, z: (*polar(e, a), 0), truth={"amplitude_um": e, "phase_deg": math.degrees(a)})


def axis_tilt(g, r, s):
    e, a = s * r.uniform(5, 18), turn(r)
    c, d = polar(2 * e / g.b, a)
    return Thing({"axis_tilt"}, moved=lambda x, y, z: (c * (z - 0.5 * g.b), d * (z - 0.5 * g.b), -(c * x + d * y)), truth={"slope_um_per_mm": 2 * e / g.b, "phase_deg": math.degrees(a)})


def pressure_angle_error(g, r, s):
    p = s * r.uniform(4, 14) * pm(r)
    return Thing({"pressure_angle_error"}, off=lambda k, side, u, v: 0.5 * p * u, truth={} if g.inner else {"slope_um": p})


def profile_crowning(g, r, s):
    p = s * r.uniform(5, 14)
    return Thing({"profile_crowning"}, off=lambda k, side, u, v: -p * u * u, truth={} if g.inner else {"amount_um": p}, also={"pressure_angle_error"} if g.inner else ())


def tip_relief(g, r, s):
    p, a = s * r.uniform(10, 25), r.uniform(0.2, 0.5)
    truth = {} if g.inner else {"amount_um": p, "start_diameter_mm": 2 * float(g.radius(numpy.array(a)))}
    return Thing({"tip_relief"}, off=lambda k, side, u, v: -p * (numpy.clip(u - a, 0, None) / (1 - a))**2, truth=truth)


def helix_error(g, r, s):
    p = s * r.uniform(4, 14) * pm(r)
    return Thing({"helix_error"}, off=lambda k, side, u, v: side * 0.5 * p * v, truth={"slope_um": p})


def taper(g, r, s):
    p = s * r.uniform(4, 14) * pm(r)
    return Thing({"taper"}, off=lambda k, side, u, v: 0.5 * p * v, truth={"slope_um": p})


def crowning(g, r, s):
    p = s * r.uniform(4, 14)
    return Thing({"crowning"}, off=lambda k, side, u, v: -p * v * v, truth={"amount_um": p})


def lobing(g, r, s):
    n, p, a = int(r.integers(2, 5)), s * r.uniform(8, 20), turn(r)

    def moved(x, y, z):
        t = numpy.arctan2(y, x)
        q = p * numpy.cos(n * t - a)
        return q * numpy.cos(t), q * numpy.sin(t), 0
    return Thing({"lobing"}, moved=moved, truth={"order": n, "amplitude_um": p, "phase_deg": math.degrees(a)}, also={"scale_xy"} if n == 2 else ())


def pitch_wave(g, r, s):
    n, p, a = int(r.integers(2, 6)), s * r.uniform(5, 15), turn(r)
    c = math.cos(g.at) * math.cos(math.asin(math.sin(g.beta) * math.cos(math.radians(20))))
    return Thing({"pitch_wave"}, off=lambda k, side, u, v: side * c * p * math.cos(n * g.theta(k) - a) + 0 * u, truth={} if g.beta else {"order": n, "amplitude_um": p, "phase_deg": math.degrees(a)})


def single_tooth(g, r, s):
    k0, p = int(r.integers(1, g.z + 1)), s * r.uniform(9, 25) * pm(r)
    return Thing({"single_tooth"}, off=lambda k, side, u, v: p * (k == k0) + 0 * u, truth={"tooth": k0, "amount_um": p})


def elephant_foot(g, r, s):
    p, h = s * r.uniform(12, 35), g.b * r.uniform(0.05, 0.14)
    return Thing({"elephant_foot"}, off=lambda k, side, u, v: p * numpy.exp(-0.5 * (v + 1) * g.b / h), truth={"amount_um": p, "height_mm": h})


def layer_shift(g, r, s):
    at, p, q = g.b * r.uniform(0.25, 0.75), s * r.uniform(5, 15) * pm(r), s * r.uniform(5, 15) * pm(r)
    return Thing({"layer_shift"}, moved=lambda x, y, z: (p * (z > at), q * (z > at), 0), truth={"height_mm": at, "dx_um": p, "dy_um": q})


def flank_wear(g, r, s):
    p, a, w = s * r.uniform(10, 22), r.uniform(-0.35, 0.35), r.uniform(0.25, 0.4)
    half = 0.5 * abs(g.ends[1] - g.ends[0])
    truth = {} if g.inner else {"depth_um": p, "centre_diameter_mm": 2 * float(g.radius(numpy.array(a))), "width_mm": w * half}
    return Thing({"flank_wear"}, off=lambda k, side, u, v: -p * numpy.exp(-((u - a) / w)**2), truth=truth)


# ---- forms without a name
def sagging(g, r, s):
    """An arm of the rim sags: the teeth over it lean inwards more at mid face."""
    p, a, w = s * r.uniform(8, 18), turn(r), r.uniform(0.4, 0.9)
    return Thing(also={"single_tooth"}, off=lambda k, side, u, v: -p * (1 - v * v) * math.exp(-(((g.theta(k) - a + math.pi) % TAU - math.pi) / w)**2) + 0 * u)


def helical_scallop(g, r, s):
    """Scallops that climb with the tooth number: the cutter's feed a turn of the blank."""
    p, n, a = s * r.uniform(3, 7), r.uniform(4, 11), turn(r)
    return Thing(also={"ghost_order"}, off=lambda k, side, u, v: p * numpy.cos(math.pi * n * v + g.theta(k) + a) + 0 * u)


def double_bow(g, r, s):
    """A lead of two bows, as a bending arbor leaves it."""
    p, a = s * r.uniform(5, 12), r.uniform(-0.5, 0.5)
    return Thing(also={"helix_error", "taper", "crowning"}, off=lambda k, side, u, v: p * numpy.sin(math.pi * (v - a)) * v)


def folded_profile(g, r, s):
    """Two straight lines that meet."""
    p, a = s * r.uniform(7, 15) * pm(r), r.uniform(-0.4, 0.4)
    return Thing(also={"pressure_angle_error", "profile_crowning"}, off=lambda k, side, u, v: p * numpy.abs(u - a))


def wedge(g, r, s):
    """Thin towards one corner of the flank: both ways at once and more than a twist."""
    p = s * r.uniform(7, 14) * pm(r)
    return Thing(also={"flank_twist", "taper", "pressure_angle_error"}, off=lambda k, side, u, v: p * numpy.clip(u + v, 0, None))


def saw_pitch(g, r, s):
    """The dividing head was cranked anew every so many teeth."""
    p, n = s * r.uniform(5, 11) * pm(r), int(r.integers(4, max(5, g.z // 2)))
    return Thing(also={"pitch_wave", "eccentricity"}, off=lambda k, side, u, v: side * p * (((k - 1) % n) / (n - 1) - 0.5) * 2 + 0 * u)


def one_quadrant(g, r, s):
    """A quarter was struck by another clamp: it stands out, more at its middle."""
    p, a = s * r.uniform(6, 14) * pm(r), turn(r)
    return Thing(also={"lobing", "pitch_wave", "eccentricity", "scale_xy", "skew"}, off=lambda k, side, u, v: p * max(0.0, math.cos(2 * ((g.theta(k) - a + math.pi) % TAU - math.pi)) if abs((g.theta(k) - a + math.pi) % TAU - math.pi) < math.pi / 4 else 0.0) + 0 * u)


def fading_wave(g, r, s):
    """A machine's vibration that dies out over the face."""
    p, n, a = s * r.uniform(6, 12), int(r.integers(3, 7)), turn(r)
    return Thing(also={"lobing", "pitch_wave"}, off=lambda k, side, u, v: p * numpy.exp(-(v + 1) / 0.5) * math.cos(n * g.theta(k) - a))


def nicked_ends(g, r, s):
    """Every tooth was nicked at the upper end by the next machine's gripper, one flank."""
    p, side0, w = s * r.uniform(10, 25), int(r.choice([-1, 1])), r.uniform(0.05, 0.15)
    return Thing(off=lambda k, side, u, v: -p * (side == side0) * numpy.clip((v - 1 + 2 * w) / (2 * w), 0, None)**2, also={"crowning"})


def slopes_by_tooth(g, r, s):
    """Each tooth's lead leans by its own amount."""
    q = s * r.uniform(4, 8) * r.normal(size=g.z + 1)
    return Thing(off=lambda k, side, u, v: side * 0.5 * q[k] * v * 2)


def rough_half(g, r, s):
    """A wave along the profile in the lower half of the face."""
    p, n, a = s * r.uniform(5, 10), r.uniform(3, 6), turn(r)
    return Thing(off=lambda k, side, u, v: p * numpy.sin(math.pi * n * u + a) * (v < 0))


NAMES = [eccentricity, axis_tilt, pressure_angle_error, profile_crowning, tip_relief, helix_error, taper, crowning, lobing, pitch_wave, single_tooth,
         elephant_foot, layer_shift, flank_wear]
# s: scan in its frame, f: scan anywhere, t: traces of few teeth, a: of all, i: of all with index, q: of few with index, o: index, r: runout
SEEN = {"eccentricity": "sioqr", "axis_tilt": "sai", "pressure_angle_error": "sfatiq", "profile_crowning": "sfatiq", "tip_relief": "sfatiq", "helix_error": "sfatiq",
        "taper": "sfatiq", "crowning": "sfatiq", "lobing": "sio", "pitch_wave": "sio", "single_tooth": "sio", "elephant_foot": "sfatiq", "layer_shift": "sf", "flank_wear": "sfatiq"}
FORMS = [(sagging, "sfa"), (helical_scallop, "sfa"), (double_bow, "sfatq"), (folded_profile, "sfatq"), (wedge, "sf"), (saw_pitch, "sio"), (one_quadrant, "si"),
         (fading_wave, "sf"), (nicked_ends, "sfatq"), (slopes_by_tooth, "ai"), (rough_half, "sf")]
ERRORS = ["white", "white", "white", "near", "far", "tails"]


class Errors:
    def __init__(self, r, um, kind):
        self.r, self.um, self.kind = r, um, kind

    def draw(self, n, alone=False):
        r = self.r
        e = r.standard_normal(n)
        if self.kind == "tails":
            e = r.standard_t(5, n) / math.sqrt(5 / 3)
        elif self.kind in ("near", "far") and not alone:
            q = 0.5 if self.kind == "near" else 0.8
            for i in range(1, n):
                e[i] = q * e[i - 1] + math.sqrt(1 - q * q) * e[i]
        return self.um * e


class Case:
    def __init__(self, kind, number, seed):
        self.kind, self.number = kind, number
        r = self.r = numpy.random.default_rng([seed, 20011, *kind.encode(), number])
        self.g = g = Body(r)
        if kind.startswith("form"):
            maker, ways = dict((f.__name__, (f, w)) for f, w in FORMS)[kind[5:]]
            self.makers, self.way = [maker], str(r.choice(list(ways)))
        elif kind.startswith("name"):
            self.makers = [next(f for f in NAMES if f.__name__ == kind[5:])]
            self.way = str(r.choice(list(SEEN[kind[5:]])))
        elif kind.startswith("sum"):
            self.way = str(r.choice(list("sfaiqt")))
            able = [f for f in NAMES if self.way in SEEN[f.__name__]]
            self.makers = list(r.choice(able, int(kind[3:]), replace=False))
        else:
            self.makers, self.way = [], str(r.choice(list("sfatiqo")))
        if self.way in "tq":
            count = min(g.z, int(r.choice([3, 4, 6, 8, 12])))
            self.teeth = sorted({1 + (i * g.z) // count for i in range(count)}) if r.uniform() < 0.6 else sorted(int(k) for k in 1 + r.choice(g.z, count, replace=False))
        else:
            self.teeth = list(range(1, g.z + 1))
        noise = float(r.uniform(1.5, 5) if self.way in "sf" else r.uniform(0.3, 1.2))
        self.errors = Errors(r, noise, str(r.choice(ERRORS)) if self.way not in "or" else "white")
        self.points = int(r.choice([4000, 8000, 12000])) if self.way in "sf" else int(r.choice([40, 64, 110]))
        self.things = [m(g, r, noise) for m in self.makers]

    def value(self, k, side, u, v):
        g = self.g
        y = numpy.zeros(numpy.broadcast(u, v).shape)
        n = g.normal(k, side, u, v)
        x = g.xyz(k, side, u, v)
        for t in self.things:
            if t.off:
                y = y + t.off(k, side, u, v)
            if t.moved:
                y = y + sum(n[i] * m for i, m in enumerate(t.moved(*x)))
        return y

    def scan(self):
        g, r, rows = self.g, self.r, ["x_mm,y_mm,z_mm"]
        n, clouds = max(30, self.points // (2 * g.z)), []
        for k in range(1, g.z + 1):
            for side in (1, -1):
                u, v = r.uniform(-0.9 if g.inner else -0.96, 0.96, n), r.uniform(-0.98, 0.98, n)
                line = numpy.lexsort((v, numpy.floor(5 * (u + 1))))
                u, v = u[line], v[line]
                p = numpy.array(g.xyz(k, side, u, v))
                e = self.errors.draw(n)
                for t in self.things:
                    e = e + (t.off(k, side, u, v) if t.off else 0.0)
                moved = numpy.zeros_like(p)
                for t in self.things:
                    if t.moved:
                        moved = moved + numpy.array(numpy.broadcast_arrays(*t.moved(*p), 0 * u)[:3])
                clouds.append(p + 1e-3 * (moved + e * g.normal(k, side, u, v)))
        p = numpy.concatenate(clouds, axis=1)
        if self.way == "f":
            # A spur gear that lies upside down is another gear as good: the axis leans by less than 40 degrees.
            a, t, d = turn(r), math.radians(r.uniform(0, 40)), turn(r)
            spin = numpy.array([[math.cos(a), -math.sin(a), 0], [math.sin(a), math.cos(a), 0], [0, 0, 1]])
            axis = numpy.array([[0, 0, math.cos(d)], [0, 0, math.sin(d)], [-math.cos(d), -math.sin(d), 0]])
            lean = numpy.eye(3) + math.sin(t) * axis + (1 - math.cos(t)) * axis @ axis
            p = lean @ spin @ p + 20 * r.standard_normal((3, 1))
        return rows + [f"{a:.6f},{b:.6f},{c:.6f}" for a, b, c in p.T]

    def records(self):
        g, r, rows = self.g, self.r, ["record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        left = {1: "right", -1: "left"} if g.inner else {1: "left", -1: "right"}
        along = numpy.linspace(-0.94, 0.95, self.points)
        for k in self.teeth if self.way in "taiq" else ():
            for side in (1, -1):
                for record in ("profile", "helix"):
                    u, v = (along, 0 * along) if record == "profile" else (0 * along + g.u_ref, along)
                    y = self.value(k, side, u, v) + self.errors.draw(self.points) + 6 * r.normal()
                    rows += [f"{record},{k},{left[side]},{2 * d:.6f},{z:.5f},{e:.4f}" for d, z, e in zip(g.radius(u), 0.5 * (v + 1) * g.b, y)]
        for side in (1, -1) if self.way in "iqo" else ():
            o = numpy.array([0.0])
            y = numpy.array([float(self.value(k, side, o + g.u_ref, o)[0]) for k in range(1, g.z + 1)]) + self.errors.draw(g.z, True)
            rows += [f"index,{k + 1},{left[side]},{2 * g.r:.6f},{0.5 * g.b:.5f},{y[k] - y[0]:.4f}" for k in range(g.z)]
        if self.way == "r":
            e, a = self.things[0].truth["amplitude_um"], math.radians(self.things[0].truth["phase_deg"])
            rows += [f"radial,{k},left,{2 * g.r:.5f},{0.5 * g.b:.5f},{(-1 if g.inner else 1) * e * math.cos(g.theta(k + 0.5) + 0.5 * g.b * math.tan(g.beta) / g.r - a) + float(self.errors.draw(1)[0]):.4f}" for k in range(1, g.z + 1)]
        return rows

    def label(self):
        g = self.g
        data = f"{self.points}" if self.way in "sf" else f"{len(self.teeth)} x {self.points}"
        return f"{self.kind}-{self.number:02d} {'ring ' if g.inner else ''}z{g.z} {math.degrees(g.beta):.0f}deg [{self.way} {data}, {self.errors.kind} {self.errors.um:.2f}] {'+'.join(m.__name__ for m in self.makers) if self.kind[:3] == 'sum' else ''}"

    def run(self, program, folder):
        where = folder / f"{self.kind}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.g.toml())
        (where / "data.csv").write_text("\n".join(self.scan() if self.way in "sf" else self.records()) + "\n")
        return trial.close_loop(self, program, where, "part.toml", "data.csv", *["--aligned"] * (self.way == "s"))

    def judge(self):
        a = self.answer
        before, after = (a[when]["held_out_rms_um"] for when in ("before", "after"))
        if after is not None and after > 1.0001 * before:
            return "worse"
        if not self.makers:
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        named = [e for e in a["effects"] if e["named"]]
        want, also = set().union(*(t.names for t in self.things)), set().union(*(t.also for t in self.things))
        wrong = [e["id"] for e in named if not {e["id"], *e["confounded_with"]} & (want | also)]
        if wrong:
            return f"misnamed {wrong}"
        lost = [n for n in want if not any(n in {e["id"], *e["confounded_with"]} for e in named)]
        if lost:
            return f"not named: {lost}"
        few = 1 + 2 / math.sqrt(2 * max(1, a["data"]["held_out"]))  # what chance makes of few values
        if a["verdict"] == "explained" and after is not None and after > max(1.2, few) * self.errors.um:
            return "called explained"
        if not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def off(self):
        """Of every interval: parameter, errors of the truth in half widths."""
        for t in self.things if self.answer else ():
            for e in self.answer["effects"]:
                # Of a helix error and a taper, told as helix errors of either flank, neither is the one hidden.
                if e["id"] not in t.names or e["flank"] != "both" or sum(o["id"] == e["id"] for o in self.answer["effects"]) > 1:
                    continue
                if "tooth" in t.truth and e["parameters"]["tooth"]["value"] != t.truth["tooth"] or "order" in t.truth and e["parameters"]["order"]["value"] != t.truth["order"]:
                    continue
                for name, value in t.truth.items():
                    if name in ("tooth", "order") or self.way == "f" and name in ("phase_deg", "dx_um", "dy_um", "height_mm"):
                        continue
                    p = e["parameters"][name]
                    low, high = p["ci95"]
                    if name == "phase_deg":
                        value += 360 * round((p["value"] - value) / 360)
                    if high > low:
                        yield e["id"], name, (p["value"] - value) / (0.5 * (high - low)), 0.5 * (high - low), low <= value <= high

    def held(self):
        off = list(self.off())
        return sum(o[4] for o in off), len(off)

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        told = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:110] + "}") for e in a["effects"])
        held = [(a[k]["held_out_rms_um"] or float("nan")) / self.errors.um for k in ("before", "after")]
        misses = " ".join(f"{i}.{n} off {z:.2f} of {half:.3g}" for i, n, z, half, ok in self.off() if not ok)
        return (f"{'' if self.right else 'WRONG '}{self.label()}: {self.why} | {a['verdict']} noise {a['data']['noise_um'] / self.errors.um:.2f} held {held[0]:.2f} -> {held[1]:.2f} | "
                f"{told} | {a['structure_left']['description'][:140]} p {a['structure_left']['p_value']:.2g} | {misses} {self.seconds:.1f}s")


def told_last(cases):
    rows = {}
    for c in cases:
        for i, n, z, half, ok in c.off():
            for key in (f"{i}.{n}", f"way {c.way}", f"errors {c.errors.kind}", f"of {len(c.things)}", "right" if c.right else "wrong", "all"):
                rows.setdefault(key, []).append((z, ok, half / c.errors.um))
    print("\n| intervals | hold | of | rms of errors in half widths (0.51) |\n| --- | --- | --- | --- |")
    for key, values in sorted(rows.items()):
        z = numpy.array([v[0] for v in values])
        print(f"| {key} | {sum(v[1] for v in values)} | {len(values)} | {math.sqrt(numpy.mean(z**2)):.2f} |")
    print(f"{sum(c.seconds for c in cases):.0f} s in the program")


def main():
    o = trial.words(each=1)
    kinds = ["nothing"] + [f"name_{f.__name__}" for f in NAMES] + ["sum2", "sum3"] + [f"form_{f.__name__}" for f, _ in FORMS]
    more = {"nothing": 4, "sum2": 6, "sum3": 6}
    cases = [Case(k, i, o.seed) for k in kinds if o.only in k for i in range(o.each * more.get(k, 1))]
    trial.campaign(cases, o, keys=lambda c: (c.kind, "all " + c.kind.split("_")[0]), counts=lambda c: c.held(), worth_a_line=lambda c: c.held()[0] < c.held()[1],
                   columns="| made | right | of | intervals that hold | of |", after=told_last)


if __name__ == "__main__":
    main()
