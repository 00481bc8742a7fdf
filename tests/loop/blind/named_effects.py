# SPDX-License-Identifier: GPL-3.0-or-later
"""Every effect the loop has a name for, alone on a spur gear of its own making: is it named, and do its 95 %
intervals hold the truth? Involute, root form circle, deviations and noise are computed here, apart from the
library; the program is run as people run it.
Usage: named_effects.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right is an answer with the hidden name, or with one that names it among what these data cannot tell it from, and
with no other effect."""
import json
import math
import subprocess

import numpy

import trial

ALPHA = math.radians(20.0)


class Gear:
    def __init__(self, random):
        self.teeth = int(random.choice([18, 21, 24, 29, 37, 53]))
        self.module = float(random.choice([1.0, 1.5, 2.5]))
        self.shift = float(round(random.uniform(-0.05, 0.25), 3))
        self.face = float(random.choice([8.0, 12.0, 20.0]))
        m, x = self.module, self.shift
        self.reference = 0.5 * m * self.teeth
        self.base = self.reference * math.cos(ALPHA)
        self.tip = self.reference + m * (1.0 + x)
        # The rack's straight flank ends where its tip rounding begins: what it cuts below is no involute.
        straight = m * (1.25 - 0.38 * (1.0 - math.sin(ALPHA))) - m * x
        self.low = self.reference * math.sin(ALPHA) - straight / math.sin(ALPHA)
        self.high = math.sqrt(self.tip**2 - self.base**2)
        thick = m * (0.5 * math.pi + 2.0 * x * math.tan(ALPHA)) / self.reference
        self.half = 0.5 * thick + math.tan(ALPHA) - ALPHA  # half angle of the tooth on the base circle

    def design(self):
        return (f'format = 1\nname = "part"\n[gearbox]\nkind = "gear"\nmodule_mm = {self.module}\n[gear]\n'
                f"teeth = {self.teeth}\nshift = {self.shift}\nface_width_mm = {self.face}\n")


class Spots:
    """Places on flanks: arrays of tooth, side (+1 counter-clockwise), u and v (-1 ... 1)."""

    def __init__(self, gear, tooth, side, u, v):
        self.tooth, self.side, self.u, self.v = numpy.broadcast_arrays(tooth, side, u, v)
        self.roll = gear.low + 0.5 * (self.u + 1.0) * (gear.high - gear.low)
        self.z = 0.5 * (self.v + 1.0) * gear.face
        self.radius = numpy.hypot(gear.base, self.roll)
        self.centre = 2.0 * math.pi * (self.tooth - 1) / gear.teeth
        unwound = self.roll / gear.base
        self.polar = self.centre + self.side * (gear.half - unwound + numpy.arctan(unwound))
        self.x, self.y = self.radius * numpy.cos(self.polar), self.radius * numpy.sin(self.polar)
        # The thread that unwinds is the flank's normal: it leaves the base circle a quarter turn on.
        self.normal = self.centre + self.side * (gear.half - unwound + 0.5 * math.pi)
        self.generated = self.centre - self.side * unwound

    def towards(self, x, y):
        return x * numpy.cos(self.normal) + y * numpy.sin(self.normal)


def either(r):
    return float(r.choice([-1.0, 1.0]))


def angle(r):
    return float(r.uniform(-170.0, 170.0))


def wave(gear, s, a, phase, order, over):
    return a * numpy.cos(order * over - math.radians(phase))


class Moved:
    """The teeth are displaced in space [um], to any size; along a flank's normal that is a deviation."""

    def __init__(self, field):
        self.field = field

    def __call__(self, s):
        return s.towards(*self.field(s))


# maker(gear, random, noise) -> deviation(spots), truth
def eccentricity(g, r, n):
    a, p = n * r.uniform(6, 20), angle(r)
    c, d = math.cos(math.radians(p)), math.sin(math.radians(p))
    return Moved(lambda s: (a * c, a * d)), {"amplitude_um": a, "phase_deg": p}


def axis_tilt(g, r, n):
    a, p = n * r.uniform(8, 20) / g.face, angle(r)
    c, d = math.cos(math.radians(p)), math.sin(math.radians(p))
    return (Moved(lambda s: (a * c * (s.z - 0.5 * g.face), a * d * (s.z - 0.5 * g.face))),
            {"slope_um_per_mm": a, "phase_deg": p})


def scale(g, r, n):
    p = either(r) * n * r.uniform(6, 15) / (10.0 * g.high)
    return Moved(lambda s: (10.0 * p * s.x, 10.0 * p * s.y)), {"percent": p}


def scale_xy(g, r, n):
    p, a = n * r.uniform(8, 20) / (5.0 * g.reference), float(r.uniform(-80, 80))
    c, d = math.cos(math.radians(2 * a)), math.sin(math.radians(2 * a))
    return (Moved(lambda s: (5.0 * p * (c * s.x + d * s.y), 5.0 * p * (d * s.x - c * s.y))),
            {"percent": p, "phase_deg": a})


def skew(g, r, n):
    p = either(r) * n * r.uniform(8, 20) / (5.0 * g.reference)
    return Moved(lambda s: (5.0 * p * s.y, 5.0 * p * s.x)), {"percent": p}


def contour_offset(g, r, n):
    a = either(r) * n * r.uniform(6, 15)
    return lambda s: a + 0.0 * s.u, {"offset_um": a}


def tooth_thickness(g, r, n):
    a = either(r) * n * r.uniform(10, 25)
    return lambda s: 0.5 * a * math.cos(ALPHA) + 0.0 * s.u, {"amount_um": a}


def pressure_angle_error(g, r, n):
    a = either(r) * n * r.uniform(6, 15)
    return lambda s: 0.5 * a * s.u, {"slope_um": a}


def profile_crowning(g, r, n):
    a = n * r.uniform(6, 15)
    return lambda s: -a * s.u**2, {"amount_um": a}


def tip_relief(g, r, n):
    a, start = n * r.uniform(12, 30), g.low + r.uniform(0.55, 0.75) * (g.high - g.low)
    return (lambda s: -a * (numpy.maximum(s.roll - start, 0.0) / (g.high - start)) ** 2,
            {"amount_um": a, "start_diameter_mm": 2.0 * math.hypot(g.base, start)})


def helix_error(g, r, n):
    a = either(r) * n * r.uniform(6, 15)
    return lambda s: 0.5 * a * s.v * s.side, {"slope_um": a}


def taper(g, r, n):
    a = either(r) * n * r.uniform(6, 15)
    return lambda s: 0.5 * a * s.v, {"slope_um": a}


def crowning(g, r, n):
    a = n * r.uniform(6, 15)
    return lambda s: -a * s.v**2, {"amount_um": a}


def elephant_foot(g, r, n):
    a, h = n * r.uniform(15, 40), g.face * r.uniform(0.04, 0.12)
    return lambda s: a * numpy.exp(-s.z / h), {"amount_um": a, "height_mm": h}


def layer_shift(g, r, n):
    at, x, y = g.face * r.uniform(0.2, 0.8), either(r) * n * r.uniform(6, 15), either(r) * n * r.uniform(6, 15)
    return Moved(lambda s: ((s.z > at) * x, (s.z > at) * y)), {"height_mm": at, "dx_um": x, "dy_um": y}


def pitch_wave(g, r, n):
    order, a, p = int(r.integers(2, 7)), n * r.uniform(8, 20), angle(r)
    return (lambda s: s.side * math.cos(ALPHA) * wave(g, s, a, p, order, s.centre),
            {"order": order, "amplitude_um": a, "phase_deg": p})


def lobing(g, r, n):
    order, a, p = int(r.integers(2, 6)), n * r.uniform(15, 30), angle(r)
    return (Moved(lambda s: (wave(g, s, a, p, order, s.polar) * numpy.cos(s.polar),
                             wave(g, s, a, p, order, s.polar) * numpy.sin(s.polar))),
            {"order": order, "amplitude_um": a, "phase_deg": p})


def single_tooth(g, r, n):
    k, a = int(r.integers(1, g.teeth + 1)), either(r) * n * r.uniform(10, 25)
    return lambda s: a * (s.tooth == k), {"tooth": k, "amount_um": a}


def flank_wear(g, r, n):
    length = g.high - g.low
    a, at, w = n * r.uniform(12, 25), g.low + r.uniform(0.3, 0.7) * length, r.uniform(0.12, 0.2) * length
    return (lambda s: -a * numpy.exp(-(((s.roll - at) / w) ** 2)),
            {"depth_um": a, "centre_diameter_mm": 2.0 * math.hypot(g.base, at), "width_mm": w})


def ghost_order(g, r, n):
    order, a, p = int(r.integers(g.teeth + 2, 3 * g.teeth - 2)), n * r.uniform(4, 10), angle(r)
    while order % g.teeth == 0:
        order += 1
    return (lambda s: wave(g, s, a, p, order, s.generated), {"order": order, "amplitude_um": a, "phase_deg": p})


# Where each can be seen: scan in its frame, traces of all teeth with an index, runout.
SEEN = {eccentricity: "str", axis_tilt: "st", scale: "z", scale_xy: "st", skew: "s", contour_offset: "z",
        tooth_thickness: "z", pressure_angle_error: "st", profile_crowning: "st", tip_relief: "st",
        helix_error: "st", taper: "st", crowning: "st", elephant_foot: "s", layer_shift: "s", pitch_wave: "st",
        lobing: "st", single_tooth: "st", flank_wear: "st", ghost_order: "t"}
MADE_BY = {elephant_foot: "fdm-0.4", layer_shift: "sla", ghost_order: "grinding", flank_wear: "hobbing",
           contour_offset: "wire-edm", tooth_thickness: "hobbing", skew: "fdm-0.4", scale_xy: "sls"}


class Case:
    def __init__(self, number, seed, kind):
        # A seed a case: leaving some out changes no other.
        r = numpy.random.default_rng([seed, list(SEEN).index(kind), number])
        self.kind, self.number, self.random, self.gear = kind, number, r, Gear(r)
        self.way = str(r.choice(list(SEEN[kind])))
        self.noise = float(r.uniform(2.0, 5.0) if self.way in "sz" else r.uniform(0.4, 1.2))
        self.form, self.truth = kind(self.gear, r, self.noise)
        self.process = MADE_BY.get(kind) if number % 2 else None

    def error(self, count):
        return self.noise * self.random.standard_normal(count)

    def head(self):
        return [f"# process = {self.process}"] if self.process else []

    def scan(self, folder):
        r, g, rows = self.random, self.gear, [*self.head(), "x_mm,y_mm,z_mm"]
        count = max(60, 6000 // (2 * g.teeth))
        for tooth in range(1, g.teeth + 1):
            for side in (1, -1):
                s = Spots(g, tooth, side, r.uniform(-0.97, 0.97, count), r.uniform(-0.97, 0.97, count))
                out = 1e-3 * (self.error(count) + (0.0 if isinstance(self.form, Moved) else self.form(s)))
                x, y = s.x + out * numpy.cos(s.normal), s.y + out * numpy.sin(s.normal)
                if isinstance(self.form, Moved):
                    dx, dy = self.form.field(s)
                    x, y = x + 1e-3 * dx, y + 1e-3 * dy
                rows += [f"{a:.6f},{b:.6f},{c:.6f}" for a, b, c in zip(x, y, s.z)]
        (folder / "data.csv").write_text("\n".join(rows) + "\n")
        files = ["data.csv", "--aligned"]
        if self.way == "z":  # what a micrometer says of the tips
            off = {"offset_um": 2e-3, "percent": 20e-3 * self.gear.tip}
            grown = sum(off.get(name, 0.0) * value for name, value in self.truth.items())
            tip = 2.0 * self.gear.tip + grown + 1e-3 * r.standard_normal()
            (folder / "sizes.csv").write_text(f"quantity,value_mm,detail,sigma_um\ntip_diameter,{tip:.6f},,1\n")
            files.append("sizes.csv")
        return files

    def traces(self, folder):
        r, g = self.random, self.gear
        rows = [*self.head(), "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        middle = 2.0 * (g.base * math.tan(ALPHA) - g.low) / (g.high - g.low) - 1.0
        along = numpy.linspace(-0.96, 0.96, 80)
        for tooth in range(1, g.teeth + 1):
            for side in (1, -1):
                flank = "left" if side > 0 else "right"
                for record, u, v in (("profile", along, 0.0), ("helix", middle, along)):
                    s = Spots(g, tooth, side, u, v)
                    value = self.form(s) + self.error(80) + 5.0 * r.standard_normal()
                    rows += [f"{record},{tooth},{flank},{2 * a:.6f},{b:.5f},{c:.4f}" for a, b, c in zip(s.radius, s.z, value)]
        for side in (1, -1):
            s = Spots(g, numpy.arange(1, g.teeth + 1), side, middle, 0.0)
            value = self.form(s) + self.error(g.teeth)
            rows += [f"index,{k},{'left' if side > 0 else 'right'},{2 * g.reference:.5f},{0.5 * g.face},{v - value[0]:.4f}"
                     for k, v in enumerate(value, 1)]
        (folder / "data.csv").write_text("\n".join(rows) + "\n")
        return ["data.csv"]

    def runout(self, folder):
        """A ball in the gap after each tooth goes out as the gear's middle comes towards it."""
        g = self.gear
        rows = [*self.head(), "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        a, p = self.truth["amplitude_um"], math.radians(self.truth["phase_deg"])
        for tooth in range(1, g.teeth + 1):
            value = a * math.cos(2.0 * math.pi * (tooth - 0.5) / g.teeth - p) + float(self.error(1)[0])
            rows.append(f"radial,{tooth},left,{2 * g.reference:.4f},{0.5 * g.face},{value:.4f}")
        (folder / "data.csv").write_text("\n".join(rows) + "\n")
        return ["data.csv"]

    def label(self):
        way = {"s": "scan", "z": "scan and tip", "t": "traces", "r": "runout"}[self.way]
        return f"{self.kind.__name__}-{self.number:02d} z {self.gear.teeth}, {way}, {self.process or 'no process'}"

    def run(self, program, folder):
        where = folder / f"{self.kind.__name__}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.design())
        files = {"s": self.scan, "z": self.scan, "t": self.traces, "r": self.runout}[self.way](where)
        done = subprocess.run([program, "loop", "part.toml", *files, "-o", "."], cwd=where, capture_output=True,
                              text=True, timeout=300)
        self.answer, self.right, self.why = None, False, done.stderr[:200]
        if done.returncode == 0:
            self.answer = json.loads((where / "loop.json").read_text())
            self.right, self.why = self.judge()
        return self

    def judge(self):
        effects = self.answer["effects"]
        if not effects:
            return False, "missed"
        if len(effects) > 1:
            return False, f"{len(effects)} effects"
        name = self.kind.__name__
        if effects[0]["id"] == name:
            return True, ""
        return name in effects[0]["confounded_with"], "named " + effects[0]["id"]

    def held(self):
        """Of the parameters of the hidden name: intervals that hold the truth, and all."""
        held = asked = 0
        for e in self.answer["effects"] if self.answer else []:
            if e["id"] != self.kind.__name__:
                continue
            for name, value in self.truth.items():
                p = e["parameters"][name]
                low, high = p["ci95"]
                if not high > low:
                    continue
                if name == "phase_deg":  # to the turn, or half turn, nearest the interval
                    turn = 180.0 if self.kind is scale_xy else 360.0
                    value += turn * round((p["value"] - value) / turn)
                asked += 1
                held += low <= value <= high
        return held, asked

    def line(self):
        told = "; ".join(e["id"] + (" " + e["flank"] if e["flank"] != "both" else "") +
                         (" {" + e["description"][:60] + "}" if not e["named"] else "") + " " +
                         " ".join(f"{k} {p['value']:.4g} [{p['ci95'][0]:.4g}, {p['ci95'][1]:.4g}]"
                                  for k, p in e["parameters"].items()) for e in (self.answer or {"effects": []})["effects"])
        return f"{'' if self.right else 'WRONG '}{self.label()}: {self.why} {told} | truth {self.truth}, noise {self.noise:.2f}"


def main():
    o = trial.words()
    cases = [Case(i, o.seed, kind) for kind in SEEN if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: [c.kind.__name__], counts=lambda c: c.held(),
                   columns="| hidden | rightly named | of | intervals that hold | of |")


if __name__ == "__main__":
    main()
