# SPDX-License-Identifier: GPL-3.0-or-later
"""Traces of a few teeth or many in which nothing is hidden, whose errors are not alike: of another size on every trace, on
some teeth, on one flank, along one direction, towards the tip, the root or the ends; that hang together a little; that are
read in steps; with a wild value; and mixtures of all that. Gears are those of drawn_anew.py.
Usage: quiet_traces.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: no_effect."""
import math

import numpy

import drawn_anew
import trial

ALIKE = {"trace": 0.0, "tooth": 1.0, "flank": 1.0, "record": 1.0, "tip": 0.0, "root": 0.0, "ends": 0.0, "middle": 0.0, "near": 0.0,
         "step": 0.0, "wild": 0, "tails": 0.0, "burst": 0.0}


def kinds():
    """Name -> what is not alike: a number of ALIKE, or what draws it."""
    return {
        "white": {},
        "another size on every trace": {"trace": lambda r: r.uniform(0.2, 0.6)},
        "rougher teeth": {"tooth": lambda r: r.uniform(1.5, 4.0)},
        "rougher flank": {"flank": lambda r: r.uniform(1.3, 3.0)},
        "rougher record": {"record": lambda r: r.uniform(1.3, 4.0)},
        "rougher towards the tip": {"tip": lambda r: r.uniform(0.5, 3.0)},
        "rougher towards the root": {"root": lambda r: r.uniform(0.5, 3.0)},
        "rougher towards the ends": {"ends": lambda r: r.uniform(0.5, 3.0)},
        "rougher in the middle": {"middle": lambda r: r.uniform(0.5, 3.0)},
        "a little together": {"near": lambda r: r.uniform(0.2, 0.5)},
        "more together": {"near": lambda r: r.uniform(0.5, 0.8)},
        "steps": {"step": lambda r: r.choice([0.3, 0.6, 1.0, 1.5, 2.0, 3.0])},
        "a wild value": {"wild": 1},
        "three wild values": {"wild": 3},
        "tails": {"tails": lambda r: r.choice([4.0, 6.0])},
        "rough stretches": {"burst": lambda r: r.uniform(1.5, 3.0)},
        "mixed": None,
    }


class Case(drawn_anew.Case):
    def __init__(self, kind, number, seed):
        self.kind, self.number = kind, number
        r = self.r = numpy.random.default_rng([seed, 50211, *kind.encode(), number])
        self.g = g = drawn_anew.Body(r)
        while g.inner:
            self.g = g = drawn_anew.Body(r)
        self.way, self.makers, self.things = "t", [], []
        count = min(g.z, int(r.choice([1, 2, 3, 4, 4, 6, 8, 12, g.z])))
        self.teeth = sorted({1 + (i * g.z) // count for i in range(count)}) if r.uniform() < 0.6 else sorted(int(k) for k in 1 + r.choice(g.z, count, replace=False))
        self.errors = drawn_anew.Errors(r, float(r.uniform(0.3, 1.2)), kind)
        self.points = int(r.choice([40, 64, 110, 240]))
        self.sides = (1, -1) if r.uniform() < 0.8 else (1,)
        self.kinds = ("profile", "helix") if r.uniform() < 0.7 else (str(r.choice(["profile", "helix"])),)
        plan = kinds()[kind]
        if plan is None:
            plan = {}
            for some in r.choice([k for k, v in kinds().items() if v], 2, replace=False):
                plan |= kinds()[str(some)]
        self.plan = ALIKE | {k: (v(r) if callable(v) else v) for k, v in plan.items()}
        self.rough = set(int(k) for k in r.choice(self.teeth, max(1, len(self.teeth) // int(r.integers(2, 6))), replace=False))

    def size(self, record, k, side, along):
        p, r = self.plan, self.r
        s = self.errors.um * math.exp(p["trace"] * r.standard_normal()) * numpy.ones_like(along)
        s = s * (p["tooth"] if k in self.rough else 1.0) * (p["flank"] if side > 0 else 1.0) * (p["record"] if record == "helix" else 1.0)
        s = s * (1 + p["ends"] * numpy.clip(numpy.abs(along) - 0.6, 0, None) / 0.4) * (1 + p["middle"] * numpy.exp(-(along / 0.3)**2))
        if record == "profile":
            s = s * (1 + p["tip"] * numpy.clip(along, 0, None)**2) * (1 + p["root"] * numpy.clip(-along, 0, None)**2)
        if p["burst"]:
            s = s * (1 + (p["burst"] - 1) * (numpy.abs(along - r.uniform(-1, 1)) < r.uniform(0.05, 0.3)))
        return s

    def trace(self, record, k, side, along):
        p, r, n = self.plan, self.r, len(along)
        e = r.standard_normal(n) if not p["tails"] else r.standard_t(p["tails"], n) / math.sqrt(p["tails"] / (p["tails"] - 2))
        for i in range(1, n):
            e[i] = p["near"] * e[i - 1] + math.sqrt(1 - p["near"]**2) * e[i]
        return e * self.size(record, k, side, along)

    def records(self):
        g, r, p = self.g, self.r, self.plan
        rows, traces = ["record,tooth,flank,diameter_mm,z_mm,deviation_um"], []
        along = numpy.linspace(-0.94, 0.95, self.points)
        for k in self.teeth:
            for side in self.sides:
                for record in self.kinds:
                    u, v = (along, 0 * along) if record == "profile" else (0 * along + g.u_ref, along)
                    traces.append((record, k, side, u, v, self.trace(record, k, side, along)))
        for _ in range(p["wild"]):
            e = traces[int(r.integers(len(traces)))][5]
            e[int(r.integers(len(e)))] += self.errors.um * r.uniform(6, 60) * drawn_anew.pm(r)
        for record, k, side, u, v, e in traces:
            e = e + 6 * r.normal()
            if p["step"]:
                step = p["step"] * self.errors.um
                e = step * numpy.round(e / step)
            rows += [f"{record},{k},{'left' if side > 0 else 'right'},{2 * d:.6f},{z:.5f},{y:.4f}" for d, z, y in zip(g.radius(u), 0.5 * (v + 1) * g.b, e)]
        return rows

    def label(self):
        g = self.g
        plan = ", ".join(f"{k} {v:.2f}" for k, v in self.plan.items() if v != ALIKE[k])
        return f"{self.kind}-{self.number:02d} z{g.z} {math.degrees(g.beta):.0f}deg [{'+'.join(self.kinds)} of {len(self.teeth)} teeth, {len(self.sides)} flanks, {self.points} values; {plan}]"


def main():
    o = trial.words(each=3)
    cases = [Case(k, i, o.seed) for k in kinds() if o.only in k for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind, f"{len(c.teeth)} teeth" if len(c.teeth) in (1, 2, 3, 4, 6, 8, 12) else "more teeth"), columns="| kind | no alarm in | of |")


if __name__ == "__main__":
    main()
