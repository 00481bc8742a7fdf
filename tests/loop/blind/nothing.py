# SPDX-License-Identifier: GPL-3.0-or-later
"""Data in which nothing is hidden, a kind at a time: how often the program sees something all the same. Gears of
made.py; ways of measuring and errors that its trial draws seldom or not at all: errors that hang together far along a
thin scan, long tails in an index, coarse readings, teeth, a flank or edges measured worse, traces of uneven teeth, scans
whose points stand thin at the ends, in lines over the profile or over the face.
Usage: nothing.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--least SHARE] [--list]"""
import json
import math
import subprocess

import numpy

import made
import trial


def errors(kind, r, n):
    """Of one row of values, with standard deviation 1."""
    white = r.standard_normal(n)
    if kind.startswith("ar"):
        rho = {"ar": 0.7, "ar9": 0.9}[kind]
        out, state = numpy.empty(n), r.standard_normal()
        for i in range(n):
            state = rho * state + math.sqrt(1.0 - rho * rho) * white[i]
            out[i] = state
        return out
    if kind == "smooth":
        return made.Noise(1.0, "smooth").draw(r, n)
    if kind == "heavy":
        return r.standard_t(4.0, n) / math.sqrt(2.0)
    if kind == "laplace":
        return r.laplace(0.0, math.sqrt(0.5), n)
    return white


def louder(gear, r, how):
    """How much larger the errors of a tooth and side are."""
    some = set(int(k) for k in r.integers(1, gear.teeth + 1, max(1, gear.teeth // 10)))
    if how == "teeth":
        return lambda k, side: 2.5 if k in some else 1.0
    if how == "flank":
        return lambda k, side: 2.0 if side > 0 else 1.0
    return lambda k, side: 1.0


def louder_by_place(edge, u, v, tooth):
    """How much larger the errors of a scanner are at the edges that it sees worse."""
    return {"tips": 1.0 + 2.0 * (u > 0.6), "ends": 1.0 + 2.0 * (numpy.abs(v) > 0.75),
            "shade": 1.5 + math.cos(tooth)}.get(edge, numpy.ones_like(u))


def scanned(gear, r, s, noise, count, lines, loud, thin, edge):
    """Points of all flanks, in lines over the profile ("u"), over the face ("v") or in no order ("")."""
    rows, each = ["x_mm,y_mm,z_mm"], max(20, count // (2 * gear.teeth))
    for tooth in range(1, gear.teeth + 1):
        for side in (1, -1):
            u, v = r.uniform(-0.97, 0.97, each), r.uniform(-0.985, 0.985, each)
            if thin:  # few points near the ends: a probe that comes in askew
                u, v = 0.97 * numpy.sign(u) * numpy.abs(u) ** 1.7, 0.985 * numpy.sign(v) * numpy.abs(v) ** 1.5
            if lines:
                along, across = (u, v) if lines == "u" else (v, u)
                order = numpy.lexsort((along, numpy.floor((across + 1.0) * 0.5 * max(3.0, round(math.sqrt(each))))))
                u, v = u[order], v[order]
            value = 1e-3 * s * loud(tooth, side) * louder_by_place(edge, u, v, tooth) * errors(noise, r, each)
            radius, angle = gear.point(tooth, side, u)
            normal = gear.normal_angle(tooth, side, u)
            for a, b, c in zip(radius * numpy.cos(angle) + value * numpy.cos(normal),
                               radius * numpy.sin(angle) + value * numpy.sin(normal), 0.5 * (v + 1.0) * gear.face):
                rows.append(f"{a:.6f},{b:.6f},{c:.6f}")
    return rows


def traced(gear, r, s, noise, teeth, records, loud, step):
    """Rows of an inspection; the values one a tooth have errors that do not hang together."""
    rows, u_ref, points = ["record,tooth,flank,diameter_mm,z_mm,deviation_um"], gear.u_reference(), int(r.choice([40, 80, 120]))

    def add(record, tooth, side, u, v, value):
        if step:
            value = step * numpy.round(value / step)
        for radius, height, um in zip(gear.radius(u), 0.5 * (v + 1.0) * gear.face, value):
            rows.append(f"{record},{tooth},{'left' if side > 0 else 'right'},{2.0 * radius:.6f},{height:.5f},{um:.4f}")

    for record in records:
        for side in (1, -1):
            if record == "index":
                of = errors(noise if noise in ("heavy", "laplace") else "white", r, gear.teeth)
                for tooth in range(1, gear.teeth + 1):
                    add(record, tooth, side, numpy.array([u_ref]), numpy.zeros(1), s * loud(tooth, side) * (of[tooth - 1:tooth] - of[0]))
                continue
            for tooth in teeth:
                along = numpy.linspace(-0.96, 0.96, points)
                value = s * loud(tooth, side) * errors(noise, r, points) + 9.0 * r.standard_normal()
                add(record, tooth, side, along if record == "profile" else numpy.full(points, u_ref),
                    along if record == "helix" else numpy.zeros(points), value)
    return rows


def kinds():
    """name -> what is measured, the errors, and the rest."""
    of = {}
    for noise in ("white", "ar", "ar9", "smooth", "heavy"):
        for points in (4000, 16000):
            of[f"scan {points} {noise}"] = {"scan": points, "noise": noise, "lines": "u"}
        of[f"all teeth {noise}"] = {"noise": noise, "teeth": "all", "records": ("profile", "helix", "index")}
        of[f"uneven teeth {noise}"] = {"noise": noise, "teeth": "some", "records": ("profile", "helix")}
    of["scan 6000 face lines smooth"] = {"scan": 6000, "noise": "smooth", "lines": "v"}
    of["scan 6000 face lines ar9"] = {"scan": 6000, "noise": "ar9", "lines": "v"}
    of["scan 8000 thin ends heavy"] = {"scan": 8000, "noise": "heavy", "lines": "", "thin": True}
    of["scan 8000 thin ends ar"] = {"scan": 8000, "noise": "ar", "lines": "u", "thin": True}
    of["scan 8000 loud teeth"] = {"scan": 8000, "noise": "white", "lines": "u", "loud": "teeth"}
    of["scan 8000 loud flank"] = {"scan": 8000, "noise": "white", "lines": "u", "loud": "flank"}
    for edge in ("tips", "ends", "shade"):
        of[f"scan 8000 loud {edge}"] = {"scan": 8000, "noise": "white", "lines": "", "edge": edge}
    of["all teeth loud teeth"] = {"noise": "white", "teeth": "all", "records": ("profile", "helix"), "loud": "teeth"}
    of["all teeth coarse"] = {"noise": "white", "teeth": "all", "records": ("profile", "helix"), "step": 2.5}
    of["uneven teeth coarse"] = {"noise": "white", "teeth": "some", "records": ("profile", "helix", "index"), "step": 2.5}
    for noise in ("white", "heavy", "laplace"):
        of[f"index {noise}"] = {"noise": noise, "teeth": "none", "records": ("index",)}
    return of


class Case:
    def __init__(self, number, seed, name, plan):
        self.name, self.number, self.plan = name, number, plan
        self.random = r = numpy.random.default_rng([seed, 61, *name.encode(), number])
        teeth = int(r.choice([12, 16, 19, 23, 28, 34, 41, 53, 67, 84]))
        self.gear = made.Gear(teeth, float(r.choice([1.0, 1.5, 2.5])), float(round(r.uniform(0.0, 0.3) + (0.3 if teeth < 17 else 0), 3)),
                              float(r.choice([8.0, 14.0, 24.0])))
        self.sigma = float(r.uniform(1.5, 6.0) if plan.get("scan") else r.uniform(0.3, 1.2))

    def rows(self):
        p, r = self.plan, self.random
        loud = louder(self.gear, r, p.get("loud", ""))
        if p.get("scan"):
            return scanned(self.gear, r, self.sigma, p["noise"], p["scan"], p["lines"], loud, p.get("thin", False),
                           p.get("edge", ""))
        teeth = list(range(1, self.gear.teeth + 1))
        if p["teeth"] == "some":
            teeth = sorted(int(k) for k in r.choice(teeth, int(r.choice([3, 4, 6, 8, 9, 12])), replace=False))
        return traced(self.gear, r, self.sigma, p["noise"], teeth, p["records"], loud, p.get("step", 0.0) * self.sigma)

    def run(self, program, folder):
        where = folder / f"{self.name.replace(' ', '_')}_{self.number:03d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.design())
        (where / "data.csv").write_text("\n".join(self.rows()) + "\n")
        command = [program, "loop", "part.toml", "data.csv", "-o", "."] + (["--aligned"] if self.plan.get("scan") else [])
        done = subprocess.run(command, cwd=where, capture_output=True, text=True, timeout=300)
        self.answer = json.loads((where / "loop.json").read_text()) if done.returncode == 0 else None
        self.right = self.answer is not None and self.answer["verdict"] == "no_effect"
        self.why = "" if self.answer else f"exit {done.returncode} {done.stderr[:200]}"
        return self

    def line(self):
        head = f"{'' if self.right else 'WRONG':6s}{self.name} {self.number:03d} [{self.gear.teeth} teeth, {self.sigma:.2f} um]: "
        if self.answer is None:
            return head + self.why
        a = self.answer
        told = "; ".join(f"{e['id']} {e['description'][:80]}" for e in a["effects"])
        return (f"{head}{a['verdict']}, noise told {a['data']['noise_um']:.2f}, {told} | {a['structure_left']['description'][:130]} "
                f"p {a['structure_left']['p_value']:.3g}")


def main():
    o = trial.words(each=5)
    cases = [Case(i, o.seed, name, plan) for name, plan in kinds().items() if o.only in name for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda case: (case.name,), columns="| kind | no alarm in | of |")


if __name__ == "__main__":
    main()
