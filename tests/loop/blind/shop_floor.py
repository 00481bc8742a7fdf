# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears from a shop floor: printed, cut, moulded, ground and knocked about, spur and helical, of 11 to 90 teeth.
Shares nothing with the other trials nor with the library: the flanks are rolled out point by point (an involute by
its parameter, normals by differences), parts are moved in space as the process moves them, noise is drawn by sums.
Usage: shop_floor.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: nothing: no_effect. known: every wanted name (or one said to be indistinguishable) and no other name, what is
left no larger than 1.2 of the noise or said to be. unknown: seen, no name but those allowed. Never: a rising error
on the hold-out; `explained` with a noise off by a third."""
import math

import numpy

import trial

TAU = 2.0 * math.pi


class Wheel:
    """Right-hand helix positive; the section at z = 0 has tooth 1 on the x axis."""

    def __init__(self, r, helical):
        self.z = int(r.choice([11, 13, 16, 19, 23, 27, 31, 36, 43, 54, 71, 90]))
        self.mn = float(r.choice([0.8, 1.25, 2.0, 2.5]))
        self.beta = math.radians(float(r.choice([-25, -14, 11, 20]))) if helical else 0.0
        self.x = round(float(r.uniform(0.35, 0.5) if self.z < 17 else r.uniform(0.0, 0.35)), 3)
        self.b = float(r.choice([6.0, 10.0, 16.0]))
        mt = self.mn / math.cos(self.beta)
        self.at = math.atan(math.tan(math.radians(20)) / math.cos(self.beta))
        self.r = 0.5 * mt * self.z
        self.rb = self.r * math.cos(self.at)
        half = (0.25 * math.pi + self.x * math.tan(math.radians(20))) * self.mn / math.cos(self.beta) / self.r
        self.half = half + math.tan(self.at) - self.at
        low = max(self.r + self.mn * (self.x - 0.7), 1.006 * self.rb)
        self.t0, self.t1 = (math.sqrt((q / self.rb) ** 2 - 1.0) for q in (low, self.r + self.mn * (self.x + 0.9)))
        self.u_ref = 2.0 * (math.tan(self.at) - self.t0) / (self.t1 - self.t0) - 1.0

    def roll(self, u):
        return self.t0 + 0.5 * (numpy.asarray(u, float) + 1.0) * (self.t1 - self.t0)

    def turn(self, v):
        return 0.5 * (numpy.asarray(v, float) + 1.0) * self.b * math.tan(self.beta) / self.r

    def theta(self, k):
        return TAU * (k - 1) / self.z

    def xy(self, k, side, u, v):
        t = self.roll(u)
        # unrolled clockwise for the counter-clockwise flank
        px, py = self.rb * (numpy.cos(t) + t * numpy.sin(t)), self.rb * (numpy.sin(t) - t * numpy.cos(t))
        a = self.theta(k) + self.turn(v) + side * self.half
        return px * numpy.cos(a) + side * py * numpy.sin(a), px * numpy.sin(a) - side * py * numpy.cos(a)

    def normal(self, k, side, u, v):
        """Outward, in the section: across the direction in which the curve runs."""
        (x0, y0), (x1, y1) = self.xy(k, side, numpy.asarray(u) - 1e-4, v), self.xy(k, side, numpy.asarray(u) + 1e-4, v)
        length = numpy.hypot(x1 - x0, y1 - y0)
        return -side * (y1 - y0) / length, side * (x1 - x0) / length

    def radius(self, u):
        return self.rb * numpy.sqrt(1.0 + self.roll(u) ** 2)

    def toml(self):
        return (f'format = 1\nname = "part"\n\n[gearbox]\nkind = "gear"\nmodule_mm = {self.mn}\n'
                f"helix_angle_deg = {math.degrees(self.beta):.6f}\n\n[gear]\nteeth = {self.z}\nshift = {self.x}\nface_width_mm = {self.b}\n")


class Errors:
    def __init__(self, r, um, kind):
        self.r, self.um, self.kind = r, um, kind

    def draw(self, n, apart=False):
        """Errors of values in a row; `apart`: of teeth, whose errors have nothing to do with each other."""
        r = self.r
        if self.kind == "slow" and apart:
            return self.um * r.normal(size=n)
        if self.kind == "even":
            e = r.uniform(-1, 1, n) * math.sqrt(3.0)
        elif self.kind == "spiky":
            e = r.laplace(0, math.sqrt(0.5), n)
        elif self.kind == "slow":  # a moving mean of five beside as much white
            e = math.sqrt(0.5) * (r.normal(size=n) + numpy.convolve(r.normal(size=n + 4), numpy.ones(5) / math.sqrt(5), "valid"))
        else:
            e = r.normal(size=n)
        return self.um * e


class Made:
    """What was done to the gear. moved(x, y, z): displacement in um; off(k, side, u, v): um along the normal."""

    each_by_itself = False

    def __init__(self, how, names=(), also=(), moved=None, off=None, truth=None):
        self.how, self.names, self.also = how, set(names), set(also)
        self.moved, self.off, self.truth = moved, off, truth or {}

    def value(self, w, k, side, u, v):
        u, v = numpy.broadcast_arrays(numpy.asarray(u, float), numpy.asarray(v, float))
        value = numpy.zeros(u.shape)
        if self.off:
            value = value + self.off(k, side, u, v)
        if self.moved:
            x, y = w.xy(k, side, u, v)
            nx, ny = w.normal(k, side, u, v)
            dx, dy = self.moved(x, y, 0.5 * (v + 1) * w.b)
            value = value + dx * nx + dy * ny
        return value


def sign(r):
    return float(r.choice([-1.0, 1.0]))


def phase(r):
    return float(r.uniform(0, TAU))


# ---- nothing
def nothing(w, r, s):
    return Made("nothing")


# ---- with names
def off_centre(w, r, s):
    e, a = s * r.uniform(4, 12), phase(r)
    return Made("known", {"eccentricity"}, moved=lambda x, y, z: (e * math.cos(a), e * math.sin(a)),
                truth={"eccentricity.amplitude_um": e})


def mandrel(w, r, s):
    """Cut on a bent mandrel: off centre and askew."""
    e, t, a, b = s * r.uniform(5, 10), s * r.uniform(5, 10), phase(r), phase(r)
    return Made("known", {"eccentricity", "axis_tilt"}, moved=lambda x, y, z: (
        e * math.cos(a) + t * (2 * z / w.b - 1) * math.cos(b), e * math.sin(a) + t * (2 * z / w.b - 1) * math.sin(b)))


def shrunk(w, r, s):
    """Printed parts shrink more along one axis of the machine, and the walls are thick."""
    f, g = s * r.uniform(6, 12) / w.r * sign(r), s * r.uniform(6, 12) / w.r
    return Made("known", {"scale_xy", "scale"}, {"contour_offset", "tooth_thickness"}, moved=lambda x, y, z: ((f + g) * x, (f - g) * y))


def squeezed_first_layers(w, r, s):
    foot, off, high = s * r.uniform(12, 30), s * r.uniform(5, 10), r.uniform(0.06, 0.15) * w.b
    return Made("known", {"elephant_foot", "contour_offset"}, {"tooth_thickness"},
                off=lambda k, side, u, v: off + foot * numpy.exp(-0.5 * (v + 1) * w.b / high))


def all_reliefs(w, r, s):
    """Ground as the drawing says, which the design does not hold."""
    c, h, t, a = s * r.uniform(6, 12), s * r.uniform(5, 12) * sign(r), s * r.uniform(12, 24), r.uniform(0.3, 0.5)
    return Made("known", {"crowning", "helix_error", "tip_relief"},
                off=lambda k, side, u, v: -c * v * v + side * h * 0.5 * v - t * numpy.clip((u - a) / (1 - a), 0, 1) ** 2)


def wrong_angle_and_runout(w, r, s):
    p, e, a = s * r.uniform(5, 10) * sign(r), s * r.uniform(5, 10), phase(r)
    return Made("known", {"pressure_angle_error", "eccentricity"}, {"pitch_wave"}, off=lambda k, side, u, v: p * u,
                moved=lambda x, y, z: (e * math.cos(a), e * math.sin(a)))


def lost_steps(w, r, s):
    um, a, at = s * r.uniform(8, 20), phase(r), w.b * r.uniform(0.3, 0.7)
    return Made("known", {"layer_shift"}, moved=lambda x, y, z: (um * math.cos(a) * (z > at), um * math.sin(a) * (z > at)))


def three_jaws(w, r, s):
    """Pressed out of round by the chuck; bored so, and let go."""
    um, a = s * r.uniform(6, 14), phase(r)

    def moved(x, y, z):
        t = numpy.arctan2(y, x)
        q = um * numpy.cos(3 * t - a)
        return q * numpy.cos(t), q * numpy.sin(t)
    return Made("known", {"lobing"}, {"pitch_wave"}, moved=moved)


def sheared(w, r, s):
    """The machine's axes are not square."""
    q = s * r.uniform(5, 12) / w.r * sign(r)
    return Made("known", {"skew"}, moved=lambda x, y, z: (q * y, q * 0.0 * x))


def proud_tooth(w, r, s):
    k0, um, e, a = int(r.integers(1, w.z + 1)), s * r.uniform(10, 25), s * r.uniform(4, 9), phase(r)
    return Made("known", {"single_tooth", "eccentricity"}, {"pitch_wave"}, off=lambda k, side, u, v: um * (k == k0) + 0.0 * u,
                moved=lambda x, y, z: (e * math.cos(a), e * math.sin(a)))


def tapered_and_tilted(w, r, s):
    t, c, b = s * r.uniform(5, 10) * sign(r), s * r.uniform(5, 10), phase(r)
    return Made("known", {"taper", "axis_tilt"}, off=lambda k, side, u, v: t * v,
                moved=lambda x, y, z: (c * (2 * z / w.b - 1) * math.cos(b), c * (2 * z / w.b - 1) * math.sin(b)))


def wheel_of_table(w, r, s):
    """Ghost of the machine's worm wheel: a wave over the generating turn."""
    um, a = s * r.uniform(4, 9), phase(r)
    n = int(r.integers(2, 5)) * w.z + int(r.integers(1, max(2, w.z // 2)))
    return Made("known", {"ghost_order"}, off=lambda k, side, u, v: um * numpy.cos(n * (w.theta(k) + side * (w.half - w.roll(u))) - a))


def chucked(w, r, s):
    """Off centre in three jaws, and shrunk more one way: waves of the first three orders, of like size."""
    e, o, j, a, b, c = s * r.uniform(6, 10), s * r.uniform(6, 10), s * r.uniform(6, 10), phase(r), phase(r), phase(r)

    def moved(x, y, z):
        t = numpy.arctan2(y, x)
        q = o * numpy.cos(2 * t - b) + j * numpy.cos(3 * t - c)
        return e * math.cos(a) + q * numpy.cos(t), e * math.sin(a) + q * numpy.sin(t)
    return Made("known", {"eccentricity", "lobing"}, {"scale_xy", "skew", "pitch_wave"}, moved=moved)


# ---- without
def feed_marks(w, r, s):
    """The hob's feed: scallops over the face, slanting with the helix, alike on all teeth."""
    um, n, a, on = s * r.uniform(2.0, 5), r.uniform(6, 14), phase(r), r.choice([0, 1, -1])
    return Made("unknown", also={"pressure_angle_error", "profile_crowning"},  # what one height shows of them
                off=lambda k, side, u, v: um * numpy.cos(math.pi * n * v + 0.6 * u + a) * (on in (0, side)))


def s_profile(w, r, s):
    um, a = s * r.uniform(6, 12) * sign(r), r.uniform(-0.4, 0.4)
    return Made("unknown", also={"pressure_angle_error"}, off=lambda k, side, u, v: um * numpy.sin(math.pi * u + a))


def random_pitch(w, r, s):
    off = s * r.uniform(3, 7) * r.normal(size=w.z + 1)
    made = Made("unknown", also={"pitch_wave", "eccentricity", "single_tooth"}, off=lambda k, side, u, v: side * off[k] + 0.0 * u)
    made.each_by_itself = True
    return made


def belt(w, r, s):
    """A belt's pulley runs out: positions along x waver."""
    um, a, length = s * r.uniform(6, 14), phase(r), w.r * r.uniform(0.4, 0.8)
    return Made("unknown", also={"pitch_wave", "lobing", "eccentricity", "scale_xy", "scale", "skew"},
                moved=lambda x, y, z: (um * numpy.sin(TAU * x / length + a), 0.0 * x))


def lead_screw(w, r, s):
    """The printer's lead screw wobbles: layers wander round a circle."""
    um, a, length = s * r.uniform(6, 12), phase(r), w.b * r.uniform(0.15, 0.4)
    return Made("unknown", also={"axis_tilt", "eccentricity"},
                moved=lambda x, y, z: (um * numpy.cos(TAU * z / length + a), um * numpy.sin(TAU * z / length + a)))


def coarse_export(w, r, s):
    """The model was exported with few chords: every flank is a chain of straight lines."""
    n = int(r.integers(3, 6))
    um = s * r.uniform(4, 9)
    return Made("unknown", also={"tooth_thickness", "contour_offset", "scale"},
                off=lambda k, side, u, v: -um * 4 * (lambda q: q * (1 - q))((0.5 * n * (u + 1)) % 1.0))


def oval_above(w, r, s):
    """Round on the plate, oval at the top: residual heat."""
    um, a = s * r.uniform(6, 14), phase(r)

    def moved(x, y, z):
        t = numpy.arctan2(y, x)
        q = um * (z / w.b) ** 2 * numpy.cos(2 * t - a)
        return q * numpy.cos(t), q * numpy.sin(t)
    return Made("unknown", also={"scale_xy", "skew", "lobing", "pitch_wave"}, moved=moved)


def wrong_hole(w, r, s):
    """One hole of the dividing plate is off: one tooth stands aside."""
    k0, um = int(r.integers(2, w.z)), s * r.uniform(8, 16)
    return Made("unknown", also={"single_tooth"}, off=lambda k, side, u, v: side * um * (k == k0) + 0.0 * u)


def hob_shifted(w, r, s):
    """The hob was shifted in the middle of the face: another profile above."""
    um, at = s * r.uniform(6, 12) * sign(r), r.uniform(-0.4, 0.4)
    return Made("unknown", also={"pressure_angle_error"}, off=lambda k, side, u, v: um * u * (v > at))


def rolled_edges(w, r, s):
    """Brushed: the material is pushed up at both ends of the face."""
    um, wide = s * r.uniform(8, 20), r.uniform(0.08, 0.2)
    return Made("unknown", also={"elephant_foot", "crowning"}, off=lambda k, side, u, v: um * numpy.exp((numpy.abs(v) - 1) / wide))


def bent_hub(w, r, s):
    """Pressed on a shaft half-way: the lower half is wide, and less so towards its end."""
    um, at = s * r.uniform(6, 12), r.uniform(-0.3, 0.3)
    return Made("unknown", also={"taper", "crowning", "elephant_foot"}, off=lambda k, side, u, v: um * numpy.clip((at - v), 0, None))


def ribs(w, r, s):
    """Moulded over ribs: sinks, sharper than a sine."""
    um, n, a = s * r.uniform(8, 16), int(r.integers(3, 6)), phase(r)

    def moved(x, y, z):
        t = numpy.arctan2(y, x)
        q = -um * numpy.exp(4.0 * (numpy.cos(n * t - a) - 1))
        return q * numpy.cos(t), q * numpy.sin(t)
    return Made("unknown", also={"lobing", "pitch_wave", "scale", "contour_offset", "tooth_thickness"}, moved=moved)


def fallen(w, r, s):
    """Dropped on its edge: nicks on a few teeth side by side at one end."""
    um, k0, n, side0 = s * r.uniform(20, 40), int(r.integers(1, w.z + 1)), int(r.integers(2, 4)), sign(r)
    return Made("unknown", also={"single_tooth"}, off=lambda k, side, u, v: -um * ((k - k0) % w.z < n) * (side == side0) * numpy.exp(-((1 - v) / 0.3) ** 2) * (0.5 + 0.5 * u))


def dressed_again(w, r, s):
    """The wheel was dressed after some teeth: from then on the flanks lean over face and profile."""
    at, p, h = int(r.integers(w.z // 4, 3 * w.z // 4)), s * r.uniform(6, 12) * sign(r), s * r.uniform(6, 12) * sign(r)
    return Made("unknown", off=lambda k, side, u, v: (p * u + h * v) * (k >= at))


def worn_tool(w, r, s):
    """The tool wears as it goes round: the hollow grows from tooth to tooth."""
    um = s * r.uniform(10, 20)
    return Made("unknown", also={"flank_wear", "profile_crowning"}, off=lambda k, side, u, v: um * (k / w.z) * (u * u - 0.3))


def end_clamp(w, r, s):
    """Clamped on three pads: the leads bend three times a turn."""
    um, a = s * r.uniform(6, 12), phase(r)
    return Made("unknown", off=lambda k, side, u, v: um * v * v * math.cos(3 * w.theta(k) - a) + 0.0 * u)


def steep_waves(w, r, s):
    """Chatter of the grinding wheel: waves along the profile, of another phase on every tooth."""
    um, n = s * r.uniform(4, 8), r.uniform(4, 8)
    at = r.uniform(0, TAU, (w.z + 1, 2))
    return Made("unknown", off=lambda k, side, u, v: um * numpy.sin(math.pi * n * u + at[k, int(side > 0)]))


# t some teeth, a all teeth, q a quarter of them with an index of all, i index alone, s scan aligned, f scan in any pose,
# m scan and index, r readings in steps of 2.5 sigma, 2 every tooth traced twice; h: helical too
KINDS = [(nothing, "t"), (nothing, "rh"), (nothing, "2"), (nothing, "i"), (nothing, "sfh"), (nothing, "m"), (nothing, "qh"),
         (off_centre, "sm"), (off_centre, "q"), (off_centre, "i"), (mandrel, "sh"), (shrunk, "sf"), (squeezed_first_layers, "s"),
         (all_reliefs, "ath"), (all_reliefs, "sfh"), (wrong_angle_and_runout, "qs"), (lost_steps, "sh"), (three_jaws, "qh"),
         (three_jaws, "s"), (sheared, "s"), (proud_tooth, "qs"), (tapered_and_tilted, "s"), (wheel_of_table, "a"),
         (feed_marks, "th"), (feed_marks, "sh"), (s_profile, "ts"), (random_pitch, "i"), (random_pitch, "s"), (belt, "s"),
         (lead_screw, "s"), (coarse_export, "ts"), (oval_above, "s"), (wrong_hole, "is"), (hob_shifted, "s"), (rolled_edges, "ts"),
         (bent_hub, "ts"), (ribs, "s"), (fallen, "s"), (dressed_again, "as"), (worn_tool, "as"), (end_clamp, "as"), (steep_waves, "a"), (chucked, "s"), (chucked, "q")]


class Case:
    def __init__(self, at, number, seed):
        kind, ways = KINDS[at]
        r = self.r = numpy.random.default_rng([seed, 4711, at, number])
        self.way = str(r.choice([c for c in ways if c != "h"]))
        self.w = Wheel(r, "h" in ways and bool(r.integers(0, 2)))
        scan = self.way in "sfm"
        self.noise = Errors(r, float(r.uniform(1.5, 5) if scan else r.uniform(0.3, 1.2)), str(r.choice(["plain", "plain", "even", "spiky", "slow"])))
        self.made = kind(self.w, r, self.noise.um)
        self.points = int(r.choice([5000, 9000, 14000]))
        self.per_trace = int(r.choice([60, 100, 150]))
        count = int(r.choice([3, 4, 5, 7, 9, 12])) if self.way in "tr" else max(3, self.w.z // 4) if self.way == "q" else self.w.z
        self.teeth = sorted({1 + (i * self.w.z) // count for i in range(min(count, self.w.z))})
        self.name = f"{kind.__name__}-{at}-{number}"

    def label(self):
        return (f"{self.name} z{self.w.z}{' helical' if self.w.beta else ''} [{self.way} " + (f"{self.points}" if self.way in "sfm" else f"{len(self.teeth)} teeth x {self.per_trace}") +
                f", {self.noise.kind} {self.noise.um:.2f}]")

    def traces(self):
        w, rows, step = self.w, [], 2.5 * self.noise.um if self.way == "r" else 0.001
        for _ in range(2 if self.way == "2" else 1):
            for k in self.teeth:
                for side in (1, -1):
                    for record in ("profile", "helix"):
                        q = numpy.linspace(-0.95, 0.95, self.per_trace)
                        u, v = (q, 0 * q) if record == "profile" else (0 * q + w.u_ref, q)
                        y = self.made.value(w, k, side, u, v) + self.noise.draw(len(q)) + self.r.normal() * 8.0
                        y = step * numpy.round(y / step)
                        rows += [f"{record},{k},{'left' if side > 0 else 'right'},{2 * d:.6f},{z:.5f},{e:.4f}"
                                 for d, z, e in zip(w.radius(u), 0.5 * (v + 1) * w.b, y)]
        return rows

    def index(self):
        w, rows = self.w, []
        for side in (1, -1):
            y = numpy.array([float(self.made.value(w, k, side, w.u_ref, 0.0)) for k in range(1, w.z + 1)]) + self.noise.draw(w.z, True)
            rows += [f"index,{k + 1},{'left' if side > 0 else 'right'},{2 * float(w.radius(w.u_ref)):.6f},{0.5 * w.b:.5f},{y[k] - y[0]:.4f}" for k in range(w.z)]
        return rows

    def cloud(self):
        w, rows, n = self.w, ["x_mm,y_mm,z_mm"], max(24, self.points // (2 * self.w.z))
        turn, shift = (phase(self.r), self.r.normal(size=3) * 5) if self.way == "f" else (0.0, numpy.zeros(3))
        for k in range(1, w.z + 1):
            for side in (1, -1):
                u, v = self.r.uniform(-0.96, 0.96, n), numpy.sort(self.r.uniform(-0.98, 0.98, n))
                x, y = w.xy(k, side, u, v)
                z = 0.5 * (v + 1) * w.b
                nx, ny = w.normal(k, side, u, v)
                e = 1e-3 * (self.noise.draw(n) + (self.made.off(k, side, u, v) if self.made.off else 0.0))
                dx, dy = self.made.moved(x, y, z) if self.made.moved else (0.0, 0.0)
                x, y = x + e * nx + 1e-3 * dx, y + e * ny + 1e-3 * dy
                x, y = x * math.cos(turn) - y * math.sin(turn) + shift[0], x * math.sin(turn) + y * math.cos(turn) + shift[1]
                rows += [f"{a:.6f},{b:.6f},{c:.6f}" for a, b, c in zip(x, y, z + shift[2])]
        return rows

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.w.toml())
        files, head = {}, ["record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        if self.way in "sfm":
            files["cloud.csv"] = self.cloud()
        if self.way in "traq2":
            files["traces.csv"] = head + self.traces() + (self.index() if self.way == "q" else [])
        if self.way in "im":
            files["index.csv"] = head + self.index()
        for name, rows in files.items():
            (where / name).write_text("\n".join(rows) + "\n")
        return trial.close_loop(self, program, where, "part.toml", *sorted(files), *["--aligned"] * (self.way in "sm"))

    def judge(self):
        """What is wrong; empty: nothing."""
        a, m = self.answer, self.made
        named = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        after, before, noise = a["after"]["held_out_rms_um"], a["before"]["held_out_rms_um"], self.noise.um
        if after is not None and after > 1.0001 * before:
            return "worse"
        if m.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":  # single values that err each by itself are noise to everybody
            return "" if self.way == "i" and m.each_by_itself else "missed"
        if a["verdict"] == "explained" and not 0.75 <= a["data"]["noise_um"] / noise <= 1.34:
            return f"noise {a['data']['noise_um'] / noise:.2f} of the true one"
        if a["verdict"] == "explained" and after is not None and after > 1.25 * noise:
            return "called explained"
        wrong = [e["id"] for e, one in zip(named, alike) if not one & (m.names | m.also)]
        if wrong:
            return f"misnamed {wrong}"
        missing = [n for n in m.names if not any(n in one for one in alike)]
        if m.how == "known" and missing:
            return f"not named: {missing}"
        if a["verdict"] == "partly_explained" and not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def held(self):
        held = asked = 0
        for e in self.answer["effects"] if self.answer and self.right else []:
            for key, value in self.made.truth.items():
                name, parameter = key.split(".")
                if e["id"] == name and parameter in e["parameters"]:
                    low, high = e["parameters"][parameter]["ci95"]
                    held, asked = held + (low <= value <= high), asked + 1
        return held, asked

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        told = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:120] + "}") for e in a["effects"])
        held = [(a[k]["held_out_rms_um"] or float("nan")) / self.noise.um for k in ("before", "after")]
        return (f"{'' if self.right else 'WRONG '}{self.label()}: {self.why} | {a['verdict']} noise {a['data']['noise_um'] / self.noise.um:.2f} held {held[0]:.2f} -> {held[1]:.2f} | "
                f"{told} | {a['structure_left']['description'][:140]} p {a['structure_left']['p_value']:.2g} | {self.seconds:.1f}s")


def main():
    o = trial.words(each=1)
    cases = [Case(at, i, o.seed) for at in range(len(KINDS)) for i in range(o.each)]
    trial.campaign([c for c in cases if o.only in c.name], o, keys=lambda c: (c.name.split("-")[0], "all " + c.made.how),
                   columns="| made | right | of |", after=trial.tell_intervals)


if __name__ == "__main__":
    main()
