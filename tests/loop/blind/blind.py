# SPDX-License-Identifier: GPL-3.0-or-later
"""The blind trial: data with nothing in them, with effects the program has names for and with forms it has none
for, drawn anew for every seed; the program's answers are judged and counted.
Usage: blind.py PROGRAM DIRECTORY [--seed N] [--nulls N] [--named N] [--unnamed N] [--strange N] [--only TEXT] [--list]
An answer is right where: nothing hidden: no_effect. A named effect: its name (or that of what the data cannot
tell from it, said so) and no other. A form without a name: seen, no name given, and the error on held-out
data within 1.2 of the true noise or said to be more. A strange one (strange.py): as a form without a name, in data as
people have them."""
import collections
import json
import subprocess
import time

import numpy

import hidden
import made
import strange
import trial

NOISES = ("white", "ar", "smooth", "heavy")


def draw_gear(r):
    teeth = int(r.choice([12, 17, 21, 24, 29, 33, 39, 47, 62, 83]))
    return made.Gear(teeth, float(r.choice([1.0, 1.5, 2.0, 3.0])), float(round(r.uniform(0.0, 0.3) + (0.3 if teeth < 17 else 0), 3)),
                     float(r.choice([8.0, 12.0, 20.0])))


def draw_plan(r, gear, ways):
    """Which teeth are traced, and what else is measured. ways: as in hidden.SEEN_IN; a: traces of all teeth."""
    way = str(r.choice(list(ways)))
    if way == "s":
        return {"scan": int(r.choice([4000, 8000, 16000]))}
    fewest = 12 if way in "ca" else 3
    counts = [k for k in (3, 4, 6, 8, 12, 16) if fewest <= k <= gear.teeth] + [gear.teeth]
    count = gear.teeth if way in "ca" else int(r.choice(counts))
    teeth = sorted({1 + round(i * gear.teeth / count) % gear.teeth for i in range(count)})
    return {"scan": 0, "teeth": teeth, "records": ("profile", "helix"), "points": int(r.choice([50, 80, 120])),
            "index": bool(way == "c" or r.integers(0, 2)), "common_zero": bool(way == "c" and r.integers(0, 2))}


class Case:
    def __init__(self, kind, number, seed, only):
        # A seed a case: leaving some out changes no other.
        r = numpy.random.default_rng([seed, {"null": 1, "named": 2, "unnamed": 3, "strange": 4}[kind], number])
        self.kind, self.number, self.random = kind, number, r
        self.gear = draw_gear(r)
        self.hidden = []
        forms = []
        noise_kind = NOISES[number % len(NOISES)] if kind == "null" else str(r.choice(["white", "white", "ar", "heavy"]))
        if kind == "null":
            self.plan = draw_plan(r, self.gear, "tttas")
        elif kind == "named":
            name = list(hidden.NAMED)[number % len(hidden.NAMED)]
            self.hidden.append(name)
            self.plan = draw_plan(r, self.gear, "s" if name in hidden.IN_SCANS_ONLY else
                                  "cs" if name in ("eccentricity", "lobing", "pitch_wave", "axis_tilt") else "tcs")
        elif kind == "strange":
            name = list(strange.STRANGE)[number % len(strange.STRANGE)]
            self.hidden.append(name)
            self.plan = draw_plan(r, self.gear, strange.SEEN_IN[name])
            strange.disturb(r, self.gear, self.plan)
        else:
            name = list(hidden.UNNAMED)[number % len(hidden.UNNAMED)]
            self.hidden.append(name)
            self.plan = draw_plan(r, self.gear, hidden.SEEN_IN[name])
            if number // len(hidden.UNNAMED) % 3 == 2:  # every third round something with a name beside it
                self.hidden.insert(0, "crowning")
        self.noise = made.Noise(float(r.uniform(2.0, 6.0) if self.plan["scan"] else r.uniform(0.4, 1.2)), noise_kind)
        for name in self.hidden:
            forms.append({**hidden.NAMED, **hidden.UNNAMED, **strange.STRANGE}[name](self.gear, r, self.noise.sigma))
        self.form = lambda k, side, u, v: sum((f(k, side, u, v) for f in forms), 0.0 * u)
        self.skipped = bool(only) and only not in self.label()

    def label(self):
        p = self.plan
        data = f"scan {p['scan']}" if p["scan"] else (f"{len(p['teeth'])}/{self.gear.teeth} teeth x {p['points']}" +
               (" index" if p["index"] else "") + (" common" if p["common_zero"] else ""))
        data += "".join(f" {word}" for word in ("rounding_um", "wild", "hole", "sides") if word in p)
        return f"{self.kind}{self.number:03d} {'+'.join(self.hidden) or '-'} [{data}, {self.noise.kind}]"

    def run(self, program, folder):
        where = folder / f"{self.kind}{self.number:03d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.design())
        data = (made.scan(self.gear, self.random, self.noise, self.form, self.plan) if self.plan["scan"] else
                made.spots(self.gear, self.random, self.noise, self.form, self.plan))
        (where / "data.csv").write_text(data)
        start = time.time()
        command = [program, "loop", "part.toml", "data.csv", "-o", "."] + (["--aligned"] if self.plan["scan"] else [])
        done = subprocess.run(command, cwd=where, capture_output=True, text=True, timeout=300)
        self.seconds = time.time() - start
        if done.returncode != 0:
            self.answer, self.verdict, self.right, self.why = None, f"exit {done.returncode}", False, done.stderr[:200]
            return self
        self.answer = json.loads((where / "loop.json").read_text())
        self.right, self.why = self.judge()
        return self

    def judge(self):
        a = self.answer
        names = [e["id"] for e in a["effects"] if e["named"]]
        alike = {e["id"]: set(e["confounded_with"]) | {e["id"]} for e in a["effects"] if e["named"]}
        self.verdict = a["verdict"]
        noise, after, before = self.noise.sigma, a["after"]["held_out_rms_um"], a["before"]["held_out_rms_um"]
        if self.kind == "null":
            return (True, "") if a["verdict"] == "no_effect" else (False, "alarm")
        if a["verdict"] == "no_effect":
            return False, "missed"
        if after is not None and before is not None and after > 1.02 * before:
            return False, "worse"
        wanted = [h for h in self.hidden if h in hidden.NAMED]
        right = set().union(*(strange.NAMES.get(h, set()) for h in self.hidden))
        for name in names:
            if name in right:
                continue
            if not any(w in alike[name] or name in hidden.ALIKE.get(w, ()) for w in wanted):
                return False, "misnamed " + name
        fits = after is None or after <= 1.2 * noise
        if self.kind in ("unnamed", "strange"):
            return (True, "") if fits or a["verdict"] == "partly_explained" else (False, "called explained")
        if not names and "unnamed" not in hidden.ALIKE.get(wanted[0], ()):
            return False, "no name"
        return (True, "") if fits or a["verdict"] == "partly_explained" else (False, "called explained")

    def line(self):
        if self.answer is None:
            return f"{'WRONG':6s}{self.label()}: {self.verdict} {self.why}"
        a = self.answer
        effects = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) +
                            ("" if e["named"] else " {" + e["description"][:70] + "}") for e in a["effects"])
        held = [a[k]["held_out_rms_um"] or float("nan") for k in ("before", "after")]
        return (f"{'' if self.right else 'WRONG':6s}{self.label()}: {self.why or self.verdict}; noise {self.noise.sigma:.2f} told "
                f"{a['data']['noise_um']:.2f}, held {held[0]:.2f} -> {held[1]:.2f} ({a['verdict']}) {effects} | "
                f"{a['structure_left']['description'][:110]} p {a['structure_left']['p_value']:.3g} {self.seconds:.1f}s")


def tables(cases):
    rows = collections.defaultdict(lambda: [0, 0])
    for case in cases:
        name = case.noise.kind if case.kind == "null" else "+".join(case.hidden)
        for key in ((case.kind, name), (case.kind, "all")):
            rows[key][0] += case.right
            rows[key][1] += 1
    return rows


def main():
    o = trial.words(each=0, nulls=(40, "without an effect"), named=(22, "with one that has a name"),
                    unnamed=(26, "with a form without a name"), strange=(0, "of kinds the trial lacked"))
    counts = {"null": o.nulls, "named": o.named, "unnamed": o.unnamed, "strange": o.strange}
    cases = [Case(kind, i, o.seed, o.only) for kind, count in counts.items() for i in range(count)]
    cases = [case for case in cases if not case.skipped]
    trial.run_all(cases, o.program, o.folder, lambda c: print(c.line(), flush=True) if o.list or not c.right else None)
    print("\n| kind | hidden | right | of |\n| --- | --- | --- | --- |")
    for (kind, name), (right, count) in sorted(tables(cases).items()):
        print(f"| {kind} | {name} | {right} | {count} |")
    told = [c.answer["data"]["noise_um"] / c.noise.sigma for c in cases if c.answer]
    print(f"noise told / true: median {numpy.median(told):.3f}, 5 % {numpy.quantile(told, .05):.3f}, 95 % {numpy.quantile(told, .95):.3f}; "
          f"{sum(c.seconds for c in cases):.0f} s in the program")


if __name__ == "__main__":
    main()
