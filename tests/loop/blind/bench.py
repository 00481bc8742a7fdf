# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives on a bench, for the blind trial of the loop on bench data: a pair or a planetary set whose flanks rub,
with losses and sensor errors the program is not told of. Shares no code and no formula with the library: the
work of friction is added up along the path of contact, the planetary set is turned by its own relation.
Usage: bench.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list]
An answer is right where: nothing hidden: no_effect. A hidden effect with a name: that name (or one the program
says it cannot be told from), and no other. One without a name: seen, and no name given beside those allowed.
The table also counts how often the 95 % intervals of the right effects held the truth."""
import json
import math
import subprocess

import numpy

import trial

RUBBING = 0.06  # of the design


class Pair:
    """Two gears, z2 < 0 for a ring: path of contact from the tips, friction against the sliding."""

    def __init__(self, z1, z2, module, addendum):
        alpha, self.ring = math.radians(20.0), z2 < 0
        r1, r2 = 0.5 * module * z1, 0.5 * module * abs(z2)
        self.base = r1 * math.cos(alpha), r2 * math.cos(alpha)
        self.to_pitch = r1 * math.sin(alpha), r2 * math.sin(alpha)
        self.pitch = math.pi * module * math.cos(alpha)
        tip1, tip2 = r1 + addendum * module, r2 + (-addendum if self.ring else addendum) * module
        self.last = math.sqrt(tip1**2 - self.base[0] ** 2) - self.to_pitch[0]
        at_tip2 = math.sqrt(tip2**2 - self.base[1] ** 2) - self.to_pitch[1]
        self.first = at_tip2 if self.ring else -at_tip2

    def efficiency(self, mu, first_drives, moments=400):
        """Power out over power in at constant load, pairs in contact sharing it evenly. Places from the pitch
        point, where the sliding and with it the friction turn round."""
        start = self.first + (numpy.arange(moments) + 0.5) / moments * self.pitch
        torque = [numpy.zeros(moments), numpy.zeros(moments)]
        for k in range(4):
            s = start + k * self.pitch
            on = s <= self.last
            rub = mu * numpy.sign(s) * (1.0 if first_drives else -1.0)
            torque[0] += on * (self.base[0] + rub * (self.to_pitch[0] + s))
            torque[1] += on * (self.base[1] + rub * (self.to_pitch[1] + (s if self.ring else -s)))
        of_driving, of_driven = (0, 1) if first_drives else (1, 0)
        needed = numpy.mean(torque[of_driving] / torque[of_driven])
        return self.base[of_driving] / self.base[of_driven] / needed


class PairDrive:
    name = "pair"

    def __init__(self, random):
        self.z = (int(random.integers(19, 31)), int(random.integers(45, 90)))
        self.pair = Pair(self.z[0], self.z[1], 1.5, 1.0)
        self.ratio = self.z[1] / self.z[0]

    def design(self):
        a = 0.5 * 1.5 * sum(self.z)
        return (f'format = 1\nname = "bench"\n[gearbox]\nkind = "pair"\nmodule_mm = 1.5\ncentre_distance_mm = {a}\n'
                f'friction = {RUBBING}\ntips = "standard"\n[pinion]\nteeth = {self.z[0]}\nshift = 0.0\nface_width_mm = 12\n'
                f"[wheel]\nteeth = {self.z[1]}\nshift = 0.0\nface_width_mm = 12\n")

    def efficiency(self, mu, forward):
        return self.pair.efficiency(mu, forward)


class PlanetDrive:
    """Sun drives, ring stands, carrier is driven: ideal torque on the ring is as many times the sun's as their
    teeth; each mesh's loss is of the power that rolls in it."""
    name = "planet"

    def __init__(self, random):
        s = int(random.integers(8, 13)) * 2 + 2
        p = int(random.integers(10, 16)) * 2 - 3
        r = s + 2 * p
        while (s + r) % 3:
            p += 1
            r = s + 2 * p
        self.z = (s, p, r)
        self.outer, self.inner = Pair(s, p, 1.0, 0.8), Pair(p, -r, 1.0, 0.8)
        self.k = r / s
        self.ratio = 1.0 + self.k

    def design(self):
        s, p, r = self.z
        return (f'format = 1\nname = "bench"\n[gearbox]\nkind = "simple"\nplanets = 3\nmodule_mm = 1.0\n'
                f'centre_distance_mm = {0.5 * (s + p)}\nfriction = {RUBBING}\ntips = "standard"\n'
                f"[rack]\naddendum = 0.8\n[sun]\nteeth = {s}\nshift = 0.0\nface_width_mm = 10\n"
                f"[planet]\nteeth = {p}\nshift = 0.0\nface_width_mm = 10\n[ring]\nteeth = {r}\nshift = 0.0\nface_width_mm = 10\n")

    def efficiency(self, mu, forward):
        if forward:
            rolls = self.outer.efficiency(mu, True) * self.inner.efficiency(mu, True)
            return (1.0 + self.k * rolls) / (1.0 + self.k)
        rolls = self.outer.efficiency(mu, False) * self.inner.efficiency(mu, False)
        return (1.0 + self.k) / (1.0 + self.k / rolls)


class Plan:
    """What is run: set points in shuffled or rising order, how noisy, which columns."""

    def __init__(self, random, **given):
        self.loads = numpy.array(given.get("loads", [0, 2, 5, 9, 14, 20]), float)
        self.speeds = numpy.array(given.get("speeds", [80, 200, 500, 1000, 1800, 3000]), float)
        self.repeats = given.get("repeats", 2)
        self.directions = given.get("directions", (True, False))
        self.celsius = given.get("celsius")       # (from, to), drawn for every set point
        self.angles = given.get("angles", False)
        self.shuffled = given.get("shuffled", bool(random.integers(0, 4)))
        self.noise = given.get("noise", 0.002) * random.uniform(0.6, 1.6)   # of the largest driven torque


class Hidden:
    """What the bench does beside the design. loss: N m at the input, from a Moment."""

    def __init__(self):
        self.mu = lambda m: RUBBING
        self.loss = lambda m: 0.0
        self.reads = {"input": lambda t, m: t, "output": lambda t, m: t}
        self.truth = {}


class Moment:
    pass


def run(drive, plan, hidden, random):
    """The text of a bench file."""
    points = []
    for _ in range(plan.repeats):
        one = [(f, n, t) for f in plan.directions for n in plan.speeds for t in plan.loads]
        if plan.shuffled:
            random.shuffle(one)
        points += one
    full = plan.loads.max()
    columns = ["direction", "input_speed_rpm", "input_torque_nm", "output_torque_nm"]
    columns += ["temperature_c"] if plan.celsius else []
    columns += ["input_angle_deg"] if plan.angles else []
    rows, turns = [",".join(columns)], 0.0
    tables = {}
    for i, (forward, speed, load) in enumerate(points):
        m = Moment()
        m.forward, m.speed = bool(forward), speed * (1.0 + 0.004 * random.standard_normal())
        m.progress = i / (len(points) - 1.0)
        m.celsius = random.uniform(*plan.celsius) if plan.celsius else 25.0
        turns += random.uniform(11.0, 53.0)
        m.turns = turns
        m.share = load / full
        # The brake or motor sets one side's torque; a little is there without load.
        driving = (1.08 * load + 0.02 * full) / (drive.ratio if forward else 1.0)
        m.load = driving if forward else driving / drive.ratio   # at the input
        lost = hidden.loss(m)
        driving += max(0.0, 1.1 * lost) * (1.0 if forward else drive.ratio)
        m.load = driving if forward else driving / drive.ratio
        lost, mu = hidden.loss(m), hidden.mu(m)
        key = (m.forward, round(mu, 7))
        if key not in tables:
            tables[key] = drive.efficiency(mu, m.forward)
        eta = tables[key]
        driven = drive.ratio * eta * (driving - lost) if forward else eta * driving / drive.ratio - lost
        driven += plan.noise * full / (1.0 if forward else drive.ratio) * random.standard_normal()
        torque = {"input": driving if forward else driven, "output": driven if forward else driving}
        read = {side: hidden.reads[side](torque[side], m) for side in torque}
        row = ["forward" if forward else "backward", f"{m.speed:.3f}", f"{read['input']:.8f}", f"{read['output']:.8f}"]
        row += [f"{m.celsius:.3f}"] if plan.celsius else []
        row += [f"{360.0 * m.turns:.3f}"] if plan.angles else []
        rows.append(",".join(row))
    return "\n".join(rows) + "\n"


# What is hidden: maker(drive, random) -> hidden, plan arguments, names that are right (all of a set, or one of
# the tuples), parameters of the first name with their truth.
def input_full(drive):
    return 20.0 / drive.ratio


def nothing(drive, r):
    return Hidden(), {}, None, {}


def friction(drive, r):
    h, mu = Hidden(), RUBBING * r.uniform(1.3, 2.0)
    h.mu = lambda m: mu
    return h, {}, {"friction_coefficient"}, {"value": mu}


def drag(drive, r):
    h, t = Hidden(), input_full(drive) * r.uniform(0.01, 0.03)
    h.loss = lambda m: t
    return h, {}, {"drag_torque"}, {"torque_nm": t}


def viscous(drive, r):
    h, c = Hidden(), input_full(drive) * r.uniform(0.02, 0.04) / 3000.0
    h.loss = lambda m: c * m.speed
    return h, {}, {"viscous_drag"}, {"nm_per_rpm": c}


def stribeck(drive, r):
    h, t, n = Hidden(), input_full(drive) * r.uniform(0.025, 0.05), r.uniform(250.0, 500.0)
    h.loss = lambda m: t * math.exp(-((m.speed / n) ** 2))
    return h, {}, {"stribeck_friction"}, {"torque_nm": t, "speed_rpm": n}


def load_power(drive, r):
    """A loss at the input that grows faster than the load."""
    h, share, p = Hidden(), r.uniform(0.02, 0.05), r.uniform(1.35, 2.2)
    full = input_full(drive)
    h.loss = lambda m: share * full * (max(m.load, 0.0) / full) ** p
    return h, {}, ({"load_dependent_friction"}, {"load_loss"}), {}


def load_friction(drive, r):
    h, v, p = Hidden(), r.uniform(0.03, 0.06), r.uniform(0.5, 1.5)
    full = input_full(drive)
    h.mu = lambda m: RUBBING + v * min(1.2, max(m.load, 0.0) / full) ** p
    return h, {}, ({"load_dependent_friction"}, {"load_loss"}), {}


def bearing(drive, r):
    h, t = Hidden(), input_full(drive) * r.uniform(0.01, 0.02)
    h.loss = lambda m: t * (m.speed / 1000.0) ** (2.0 / 3.0)
    return h, {}, {"bearing_friction"}, {"nm_at_1000_rpm": t}


def thinning(drive, r):
    h, c, k = Hidden(), input_full(drive) * r.uniform(0.05, 0.09) / 3000.0, r.uniform(0.025, 0.05)
    h.loss = lambda m: c * m.speed * math.exp(-k * (m.celsius - 40.0))
    return h, {"celsius": (20.0, 60.0)}, {"temperature_viscosity"}, {"per_c": k}


def scale(drive, r):
    h, f = Hidden(), 1.0 + r.choice([-1, 1]) * r.uniform(0.015, 0.04)
    h.reads["output"] = lambda t, m: f * t
    return h, {}, {"torque_scale"}, {"factor": f}


def offset(side):
    def maker(drive, r):
        size = (20.0 if side == "output" else input_full(drive)) * r.uniform(0.008, 0.02) * r.choice([-1, 1])
        h = Hidden()
        h.reads[side] = lambda t, m: t + size
        return h, {}, {"torque_offset"}, {"offset_nm": size}
    maker.__name__ = f"offset_{side}"
    return maker


def drift(side):
    def maker(drive, r):
        size = (20.0 if side == "output" else input_full(drive)) * r.uniform(0.015, 0.03) * r.choice([-1, 1])
        h = Hidden()
        h.reads[side] = lambda t, m: t + size * m.progress
        return h, {"shuffled": True}, {"torque_drift"}, {"drift_nm": size}
    maker.__name__ = f"drift_{side}"
    return maker


def warming(drive, r):
    h, t = Hidden(), input_full(drive) * r.uniform(0.02, 0.04)
    h.loss = lambda m: t * (1.0 - 0.8 * m.progress)
    return h, {"shuffled": True}, {"drag_torque", "drag_drift"}, {}


def wave(drive, r):
    h, a, phase = Hidden(), input_full(drive) * r.uniform(0.01, 0.02), r.uniform(0, 6.28)
    h.loss = lambda m: a * (1.0 + math.cos(2 * math.pi * m.turns - phase))
    return h, {"angles": True}, {"drag_torque", "angle_periodic_friction"}, {}


def directions(drive, r):
    h, a, b = Hidden(), RUBBING * r.uniform(1.3, 1.6), RUBBING * r.uniform(1.9, 2.4)
    h.mu = lambda m: a if m.forward else b
    return h, {}, {"friction_coefficient", "direction_dependent_friction"}, {}


def friction_and_drag(drive, r):
    h, mu, t = Hidden(), RUBBING * r.uniform(1.3, 2.0), input_full(drive) * r.uniform(0.01, 0.03)
    h.mu, h.loss = (lambda m: mu), (lambda m: t)
    return h, {}, {"friction_coefficient", "drag_torque"}, {"value": mu}


def jump(drive, r):
    """Without a name: a loss that jumps at a temperature."""
    h, t, at = Hidden(), input_full(drive) * r.uniform(0.015, 0.03), r.uniform(34.0, 46.0)
    h.loss = lambda m: t * (m.celsius > at)
    return h, {"celsius": (20.0, 60.0)}, "unnamed", {"drag_torque"}


def hump(drive, r):
    """Without a name: a hump over the speed."""
    h, t, at = Hidden(), input_full(drive) * r.uniform(0.02, 0.04), r.uniform(700.0, 1300.0)
    h.loss = lambda m: t * math.exp(-(((m.speed - at) / 350.0) ** 2))
    return h, {"speeds": [100, 300, 500, 700, 900, 1100, 1300, 1600, 2000, 3000], "loads": [0, 4, 10, 20]}, "unnamed", {"drag_torque"}


def one_way_scale(drive, r):
    """One direction only, the output reads too little: looks like friction, and must be said to."""
    h, f = Hidden(), 1.0 - r.uniform(0.03, 0.06)
    h.reads["output"] = lambda t, m: f * t
    return h, {"directions": (True,)}, "either", {"torque_scale"}


KINDS = [nothing, friction, drag, viscous, stribeck, load_power, load_friction, bearing, thinning, scale,
         offset("input"), offset("output"), drift("input"), drift("output"), warming, wave, directions,
         friction_and_drag, jump, hump, one_way_scale]


class Case:
    def __init__(self, number, seed, kind):
        # A seed a case: leaving some out changes no other.
        r = numpy.random.default_rng([seed, KINDS.index(kind), number])
        self.kind, self.number, self.random = kind, number, r
        self.drive = (PairDrive, PlanetDrive)[int(r.integers(0, 2))](r)
        self.hidden, arguments, self.right_names, self.truth = kind(self.drive, r)
        self.plan = Plan(r, **arguments)

    def label(self):
        return f"{self.kind.__name__}-{self.number:02d} {self.drive.name} {'shuffled' if self.plan.shuffled else 'swept'}"

    def run(self, program, folder):
        where = folder / f"{self.kind.__name__}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "bench.toml").write_text(self.drive.design())
        (where / "bench.csv").write_text(run(self.drive, self.plan, self.hidden, self.random))
        done = subprocess.run([program, "loop", "bench.toml", "bench.csv", "-o", "."], cwd=where,
                              capture_output=True, text=True, timeout=300)
        self.answer, self.right, self.why = None, False, done.stderr[:200]
        if done.returncode == 0:
            self.answer = json.loads((where / "loop.json").read_text())
            self.right, self.why = self.judge()
        return self

    def judge(self):
        a, wanted = self.answer, self.right_names
        effects = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in effects]
        if wanted is None:
            return a["verdict"] == "no_effect", "alarm"
        if a["verdict"] == "no_effect":
            return False, "missed"
        if wanted == "either":
            said = any(self.truth <= names for names in alike) or not effects
            return said, "friction for certain"
        if wanted == "unnamed":
            wrong = [e["id"] for e in effects if e["id"] not in self.truth]
            return not wrong and (len(effects) < len(a["effects"]) or a["verdict"] == "partly_explained"), \
                f"misnamed {wrong}"
        sets = wanted if isinstance(wanted, tuple) else (wanted,)
        if len(effects) < len(a["effects"]):
            return False, "an unnamed one beside it"
        for names in sets:
            if len(effects) == len(names) and all(any(n in one for one in alike) for n in names):
                return True, ""
        return False, "names " + ", ".join(e["id"] for e in effects)

    def held(self):
        """(intervals that held the truth, intervals) where the first right name was given alone."""
        held = asked = 0
        if not isinstance(self.truth, dict) or self.answer is None or not self.right:
            return 0, 0
        for e in self.answer["effects"]:
            for name, value in self.truth.items():
                p = e["parameters"].get(name)
                if p is None or e["id"] not in self.right_names:
                    continue
                if e.get("side") and not self.kind.__name__.endswith(e["side"]) and self.kind is not scale:
                    continue  # two sensors show only their ratio: the other side's reading says the same
                asked += 1
                held += p["ci95"][0] <= value <= p["ci95"][1]
        return held, asked

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        return (f"{'' if self.right else 'WRONG '}{self.label()}: {self.why} {a['verdict']} {found_text(a)}; "
                f"truth {self.truth}")


def found_text(answer):
    """The effects of a loop.json with their figures, in one line."""
    return "; ".join(e["id"] + (" ~" + ",".join(e["confounded_with"]) if e["confounded_with"] else "") + " " +
                     " ".join(f"{k} {p['value']:.4g} [{p['ci95'][0]:.4g}, {p['ci95'][1]:.4g}]"
                              for k, p in e["parameters"].items()) for e in answer["effects"])


def campaign(kinds, case_of):
    """Benches of every kind through the program, what was wrong, and a table; ends with the exit code."""
    o = trial.words()
    cases = [case_of(i, o.seed, kind) for kind in kinds if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: [c.kind.__name__], counts=lambda c: c.held(),
                   columns="| hidden | right | of | intervals that hold | of |")


if __name__ == "__main__":
    campaign(KINDS, Case)
