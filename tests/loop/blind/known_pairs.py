# SPDX-License-Identifier: GPL-3.0-or-later
"""Two effects with names at once in traces of three to twelve teeth, of both flanks, sizes of 3 to 30 times the noise:
two along the profile, two along the face, or one of each; each alone; forms without a name, alone or beside one. Gears,
effects and errors are those of drawn_anew.py; sizes go evenly over their logarithm.
Usage: known_pairs.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: both told, or said to be what the data cannot tell from what is told, and no other name. Counted beside: sizes told
whose interval holds nothing. Of wrong ones the line says what the hidden and the told names leave of the mean profile, as
fits of this generator's own formulas: chi-square, and how many values either needs."""
import itertools
import math

import numpy

import drawn_anew
import trial


def size(r, s):
    return s * math.exp(r.uniform(math.log(3.0), math.log(30.0)))


def pressure_angle_error(g, r, s):
    p = size(r, s) * drawn_anew.pm(r)
    return drawn_anew.Thing({"pressure_angle_error"}, off=lambda k, side, u, v: 0.5 * p * u, truth={"slope_um": p})


def profile_crowning(g, r, s):
    p = size(r, s)
    return drawn_anew.Thing({"profile_crowning"}, off=lambda k, side, u, v: -p * u * u, truth={"amount_um": p})


def tip_relief(g, r, s):
    p, a = size(r, s), r.uniform(0.1, 0.6)
    return drawn_anew.Thing({"tip_relief"}, off=lambda k, side, u, v: -p * (numpy.clip(u - a, 0, None) / (1 - a))**2,
                            truth={"amount_um": p, "start_diameter_mm": 2 * float(g.radius(numpy.array(a)))})


def flank_wear(g, r, s):
    p, a, w = size(r, s), r.uniform(-0.35, 0.35), r.uniform(0.25, 0.4)
    return drawn_anew.Thing({"flank_wear"}, off=lambda k, side, u, v: -p * numpy.exp(-((u - a) / w)**2), truth={"depth_um": p})


def helix_error(g, r, s):
    p = size(r, s) * drawn_anew.pm(r)
    return drawn_anew.Thing({"helix_error"}, off=lambda k, side, u, v: side * 0.5 * p * v, truth={"slope_um": p})


def taper(g, r, s):
    p = size(r, s) * drawn_anew.pm(r)
    return drawn_anew.Thing({"taper"}, off=lambda k, side, u, v: 0.5 * p * v, truth={"slope_um": p})


def crowning(g, r, s):
    p = size(r, s)
    return drawn_anew.Thing({"crowning"}, off=lambda k, side, u, v: -p * v * v, truth={"amount_um": p})


def root_relief(g, r, s):
    p, a = size(r, s), -r.uniform(0.2, 0.6)
    return drawn_anew.Thing(off=lambda k, side, u, v: -p * (numpy.clip(a - u, 0, None) / (1 + a))**2)


def kink(g, r, s):
    p, a = size(r, s) * drawn_anew.pm(r), r.uniform(-0.6, 0.6)
    return drawn_anew.Thing(also={"pressure_angle_error"}, off=lambda k, side, u, v: p * numpy.clip(u - a, 0, None) / (1 - a))


def bump(g, r, s):
    p, a, w = size(r, s), r.uniform(-0.7, 0.7), r.uniform(0.1, 0.5)
    return drawn_anew.Thing(off=lambda k, side, u, v: p * numpy.exp(-((u - a) / w)**2))


def rise(g, r, s):
    p, w, end = size(r, s) * drawn_anew.pm(r), r.uniform(0.1, 0.6), drawn_anew.pm(r)
    return drawn_anew.Thing(off=lambda k, side, u, v: p * numpy.exp((end * u - 1) / w))


def long_wave(g, r, s):
    p, n, a = size(r, s), r.uniform(0.8, 2.5), drawn_anew.turn(r)
    return drawn_anew.Thing(off=lambda k, side, u, v: 0.5 * p * numpy.sin(math.pi * n * u + a))


def fourth(g, r, s):
    p, n = size(r, s), r.uniform(2.7, 5)
    return drawn_anew.Thing(also={"profile_crowning"}, off=lambda k, side, u, v: -p * numpy.abs(u)**n)


def cubic(g, r, s):
    p = size(r, s) * drawn_anew.pm(r)
    return drawn_anew.Thing(also={"pressure_angle_error"}, off=lambda k, side, u, v: 0.5 * p * u**3)


def end_relief(g, r, s):
    p, a, end = size(r, s), r.uniform(0.4, 0.8), drawn_anew.pm(r)
    return drawn_anew.Thing(off=lambda k, side, u, v: -p * (numpy.clip(end * v - a, 0, None) / (1 - a))**2)


PROFILE = [pressure_angle_error, profile_crowning, tip_relief, flank_wear]
HELIX = [helix_error, taper, crowning]
FORMS = [root_relief, end_relief, kink, bump, rise, long_wave, fourth, cubic]


def chi_square(values, errors_um, names):
    """What the names leave of the mean profile of all traces (rows of values at `u`), as a chi-square; the zero of each is free."""
    u, traces = values
    mean = (traces - traces.mean(axis=1, keepdims=True)).mean(axis=0)
    plain = {"pressure_angle_error": [u], "profile_crowning": [u * u], "tip_relief": [numpy.clip(u - a, 0, None)**2 for a in numpy.linspace(-0.5, 0.9, 57)],
             "flank_wear": [numpy.exp(-((u - a) / w)**2) for a in numpy.linspace(-0.6, 0.6, 41) for w in numpy.linspace(0.15, 0.6, 19)]}
    least = math.inf
    for columns in itertools.product(*(plain[name] for name in names)):
        x = numpy.column_stack([numpy.ones_like(u), *columns])
        left = mean - x @ numpy.linalg.lstsq(x, mean, rcond=None)[0]
        least = min(least, len(traces) * float(left @ left) / errors_um**2)
    return least


class Case(drawn_anew.Case):
    def __init__(self, kind, number, seed):
        self.kind, self.number = kind, number
        r = self.r = numpy.random.default_rng([seed, 90417, *kind.encode(), number])
        self.g = g = drawn_anew.Body(r)
        while g.inner or g.z < 12:  # (of a ring, and beside undercut, a bow has its middle elsewhere)
            self.g = g = drawn_anew.Body(r)
        self.way = "t"
        count = min(g.z, int(r.choice([3, 4, 4, 6, 8, 12])))
        self.teeth = sorted({1 + (i * g.z) // count for i in range(count)}) if r.uniform() < 0.6 else sorted(int(k) for k in 1 + r.choice(g.z, count, replace=False))
        noise = float(r.uniform(0.3, 1.2))
        self.errors = drawn_anew.Errors(r, noise, str(r.choice(["white", "white", "white", "near"])))
        self.points = int(r.choice([40, 64, 110]))
        able = {f.__name__: f for f in PROFILE + HELIX + FORMS}
        self.makers = [able[word] for word in kind.removeprefix("form:").split("+")]
        self.things = [maker(g, r, noise) for maker in self.makers]

    def records(self):
        rows = super().records()
        um = numpy.array([float(row.split(",")[5]) for row in rows[1:] if row.startswith("profile")])
        self.profiles = numpy.linspace(-0.94, 0.95, self.points), um.reshape(-1, self.points)
        return rows

    def alike(self):
        """By how much more chi-square the hidden names leave than the told ones, and values more that those need; None: no such sets."""
        along = [f.__name__ for f in PROFILE]
        told = [e["id"] for e in self.answer["effects"] if e["named"] and e["id"] in along and e["flank"] == "both"]
        hidden = [n for n in (f.__name__ for f in self.makers) if n in along]
        if self.errors.kind != "white" or len(hidden) < len([f for f in self.makers if f not in HELIX]) or set(told) == set(hidden) or len(told) > 2:
            return None
        values = {"tip_relief": 2, "flank_wear": 3}
        return [chi_square(self.profiles, self.errors.um, names) for names in (hidden, told)], [sum(values.get(n, 1) for n in names) for names in (hidden, told)]

    def label(self):
        sizes = ", ".join(f"{abs(next(iter(t.truth.values()))) / self.errors.um:.1f}" if t.truth else "form" for t in self.things)
        return super().label() + f" ({sizes})"

    def sloppy(self):
        """Sizes told whose interval is as wide as they are."""
        count = 0
        for e in self.answer["effects"] if self.answer else ():
            for name in ("slope_um", "amount_um", "depth_um", "amplitude_um", "slope_um_per_mm"):
                p = e["parameters"].get(name) if e["named"] else None
                if p and p["ci95"] and not p["ci95"][0] * p["ci95"][1] > 0:
                    count += 1
            for t in () if e["named"] else e["terms"]:
                if t.get("ci95_half_um") is not None and t["ci95_half_um"] >= abs(t["amplitude_um"]):
                    count += 1
        return count

    def line(self):
        told = "; ".join(e["id"] + " " + " ".join(f"{n}={p['value']:.4g}[{p['ci95'][0]:.4g},{p['ci95'][1]:.4g}]" if p.get("ci95") else f"{n}={p['value']}" for n, p in e["parameters"].items()) + f" ~{e['confounded_with']}" for e in self.answer["effects"] if e["named"]) if self.answer else ""
        alike = self.alike() if self.answer and not self.right else None
        alike = f" chi-square of the hidden {alike[0][0]:.1f} of the told {alike[0][1]:.1f}, values {alike[1]}" if alike else ""
        return super().line() + alike + (f"\n      {told}" if not self.right or self.sloppy() else "") + (" SLOPPY" if self.sloppy() else "")


def main():
    o = trial.words(each=3)
    kinds = [f.__name__ for f in PROFILE + HELIX]
    for group in (PROFILE, HELIX):
        kinds += [f"{a.__name__}+{b.__name__}" for i, a in enumerate(group) for b in group[i + 1:]]
    kinds += [f"{a.__name__}+{b.__name__}" for a in PROFILE[:3] for b in HELIX]
    kinds += [f"form:{f.__name__}" for f in FORMS[:1] + FORMS[2:]]
    kinds += ["root_relief+pressure_angle_error", "root_relief+tip_relief", "end_relief+crowning", "end_relief+helix_error"]
    cases = [Case(k, i, o.seed) for k in kinds if o.only in k for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind, f"{len(c.things)} at once", f"{len(c.teeth)} teeth"), counts=lambda c: (*c.held(), c.sloppy()),
                   worth_a_line=lambda c: c.held()[0] < c.held()[1] or c.sloppy(),
                   columns="| made | right | of | intervals that hold | of | hold nothing |", after=drawn_anew.told_last)


if __name__ == "__main__":
    main()
