# SPDX-License-Identifier: GPL-3.0-or-later
"""Benches as a test hall has them: converters with few steps, set torques that are exact or follow a controller, sensors
askew, oil that is changed, runs of days. Shares nothing with the other trials nor with the library: a pair of external
gears in static balance, moments taken about both axes contact by contact.
Usage: rigs.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: nothing: no_effect. known: the name (or one said to be indistinguishable) and no other. unknown: seen, no name but
those allowed. Never: `explained` or `no_effect` with more than 1.2 of the true error left."""
import math

import numpy

import trial

TAU = 2.0 * math.pi
DESIGNED = 0.07


class Pair:
    def __init__(self, r):
        self.z = int(r.integers(17, 29)), int(r.integers(40, 96))
        self.m = 2.0
        self.i = self.z[1] / self.z[0]
        a = math.radians(20)
        rp = [0.5 * self.m * z for z in self.z]
        self.rb = [q * math.cos(a) for q in rp]
        reach = [math.sqrt((q + self.m) ** 2 - (q * math.cos(a)) ** 2) - q * math.sin(a) for q in rp]
        self.lower, self.upper, self.pb = -reach[1], reach[0], math.pi * self.m * math.cos(a)
        self.foot = [q * math.sin(a) for q in rp]
        self.kept = {}

    def toml(self):
        return (f'format = 1\nname = "rig"\n[gearbox]\nkind = "pair"\nmodule_mm = {self.m}\ncentre_distance_mm = {0.5 * self.m * sum(self.z)}\n'
                f'friction = {DESIGNED}\ntips = "standard"\n[pinion]\nteeth = {self.z[0]}\nshift = 0.0\nface_width_mm = 20\n'
                f"[wheel]\nteeth = {self.z[1]}\nshift = 0.0\nface_width_mm = 20\n")

    def eta(self, mu, forward):
        """Normal forces alike on all contacts, their friction against the sliding: moments about both axes, mean of torque ratios."""
        key = round(mu, 5), forward
        if key not in self.kept:
            at = numpy.arange(600) / 600 * self.pb + self.lower
            pinion, wheel = numpy.zeros(600), numpy.zeros(600)
            while numpy.any(at <= self.upper):
                inside = at <= self.upper
                f = key[0] * numpy.sign(at) * (1 if forward else -1)
                pinion += inside * (self.rb[0] + f * (self.foot[0] + at))
                wheel += inside * (self.rb[1] + f * (self.foot[1] - at))
                at = at + self.pb
            ideal = self.rb[1] / self.rb[0]
            self.kept[key] = 1.0 / (numpy.mean(pinion / wheel) * ideal) if forward else 1.0 / (numpy.mean(wheel / pinion) / ideal)
        return self.kept[key]


class Rig:
    def __init__(self, r):
        self.r, self.pair = r, Pair(r)
        self.full = float(r.choice([8.0, 40.0, 150.0]))  # at the input
        self.error = r.uniform(0.001, 0.003)             # of the largest driven torque
        self.law = str(r.choice(["plain", "plain", "even", "spiky"]))
        self.order = str(r.choice(["shuffled", "stairs", "zigzag"]))
        self.repeats, self.exact, self.step, self.step_out = int(r.integers(2, 5)), False, 0.0, 0.0
        self.mu, self.lost = (lambda m: DESIGNED), (lambda m: 0.0)
        self.out, self.inp = (lambda t, m: t), (lambda t, m: t)
        self.angle = self.warm = False
        self.loads, self.speeds = numpy.linspace(0.12, 1.0, 6), numpy.geomspace(100, 2400, 6)

    def rows(self):
        r, points = self.r, []
        for again in range(self.repeats):
            one = [dict(f=f, n=n, q=q) for f in (True, False) for n in self.speeds for q in (self.loads if again % 2 == 0 or self.order != "zigzag" else self.loads[::-1])]
            if self.order == "shuffled":
                r.shuffle(one)
            points += one
        count, turns, square, text = len(points), 0.0, 0.0, []
        e = r.normal(size=count) if self.law == "plain" else r.uniform(-1, 1, count) * math.sqrt(3) if self.law == "even" else r.laplace(0, math.sqrt(0.5), count)
        for k, m in enumerate(points):
            m["done"], m["when"] = k / (count - 1), k
            m["n"] = m["n"] * (1 + 0.002 * r.normal())
            turns += r.uniform(3, 29)
            m["turns"], m["c"] = turns, 25 + 30 * (1 - math.exp(-3 * k / count)) + 0.3 * r.normal()
            scale = self.full * (1.0 if m["f"] else self.pair.i)
            driving = scale * (m["q"] if self.exact else m["q"] * (1 + 0.01 * r.normal()))
            lever = 1.0 if m["f"] else self.pair.i
            lost, eta = self.lost(m), self.pair.eta(self.mu(m), m["f"])
            driven = (driving - lost) * eta * self.pair.i if m["f"] else driving / lever * eta - lost
            size = self.error * self.full * (self.pair.i if m["f"] else 1.0)
            square += (size * e[k]) ** 2
            driven += size * e[k]
            ti, to = (driving, driven) if m["f"] else (driven, driving)
            ti, to = self.inp(ti, m), self.out(to, m)
            if self.step:
                si, so = self.step * self.error * self.full, self.step_out * self.error * self.full * self.pair.i
                ti, to = si * round(ti / si), so * round(to / so)
            text.append(f"{'forward' if m['f'] else 'backward'},{m['n']:.2f},{ti:.7f},{to:.7f}" + (f",{m['c']:.2f}" if self.warm else "") + (f",{360 * m['turns']:.2f}" if self.angle else ""))
        head = "direction,input_speed_rpm,input_torque_nm,output_torque_nm" + (",temperature_c" if self.warm else "") + (",input_angle_deg" if self.angle else "")
        return [head] + text, math.sqrt(square / count)


LOADS = {"friction_coefficient", "load_dependent_friction", "load_loss", "bearing_load_friction", "direction_dependent_friction", "torque_scale"}


def nothing(g, r):
    return "nothing", set()


def coarse(g, r):
    """Both converters read in steps, the set torques are exact."""
    g.exact, g.step, g.step_out, g.repeats = True, r.uniform(1.0, 3.0), r.uniform(1.0, 3.0), int(r.integers(4, 9))
    return "nothing", set()


def coarse_friction(g, r):
    g.exact, g.step, g.step_out, g.repeats = True, r.uniform(1.0, 2.5), r.uniform(1.0, 2.5), int(r.integers(4, 9))
    mu = DESIGNED * r.uniform(1.4, 2.0)
    g.mu = lambda m: mu
    return "known", {"friction_coefficient"}


def rubs_more(g, r):
    mu = DESIGNED * r.uniform(1.3, 2.0)
    g.mu = lambda m: mu
    return "known", {"friction_coefficient"}


def seal(g, r):
    t = g.full * r.uniform(0.01, 0.025)
    g.lost = lambda m: t
    return "known", {"drag_torque"}


def splash(g, r):
    c = g.full * r.uniform(0.02, 0.04) / 2400
    g.lost = lambda m: c * m["n"]
    return "known", {"viscous_drag"}


def gain(g, r):
    f = 1 + r.uniform(0.015, 0.04) * r.choice([-1, 1])
    g.out = lambda t, m: f * t
    return "known", {"torque_scale"}


def zero(g, r):
    d = g.full * g.pair.i * r.uniform(0.01, 0.025) * r.choice([-1, 1])
    g.out = lambda t, m: t + d
    return "known", {"torque_offset"}


def runs_in(g, r):
    """The flanks run in: their friction falls over the days."""
    a = DESIGNED * r.uniform(0.5, 1.0)
    g.mu = lambda m: DESIGNED + a * (1 - m["done"])
    return "unknown", {"friction_drift", "friction_coefficient"}


def other_oil(g, r):
    """The oil was changed half-way: from then on the flanks rub more or less."""
    at, a = r.uniform(0.35, 0.65), DESIGNED * r.uniform(0.4, 0.8) * r.choice([-1, 1])
    g.mu = lambda m: DESIGNED + a * (m["done"] > at)
    return "unknown", {"friction_coefficient"}


def other_seal(g, r):
    """The seal was changed half-way."""
    at, t = r.uniform(0.35, 0.65), g.full * r.uniform(0.012, 0.025)
    g.lost = lambda m: t * (m["done"] > at)
    return "unknown", {"drag_torque"}


def askew_output(g, r):
    """The output's sensor sits askew: it reads in a wave, once a turn of the output."""
    a, p = r.uniform(0.006, 0.015), r.uniform(0, TAU)
    g.angle = True
    g.out = lambda t, m: t * (1 + a * math.cos(TAU * m["turns"] / g.pair.i - p))
    return "known", {"torque_wave"}


def bent_output(g, r):
    """The output's sensor bends over its load."""
    a = g.full * g.pair.i * r.uniform(0.01, 0.02) * r.choice([-1, 1])
    g.out = lambda t, m: t + a * (t / (g.full * g.pair.i)) ** 2
    return "unknown", LOADS


def magnets(g, r):
    """A brake that drags once a turn of the input and adds a little of itself."""
    a, p = g.full * r.uniform(0.008, 0.02), r.uniform(0, TAU)
    g.angle = True
    g.lost = lambda m: a * (1 + math.cos(TAU * m["turns"] - p))
    return "known", {"angle_periodic_friction", "drag_torque"}


def cold_grease(g, r):
    """Grease that softens: its drag halves every fifteen degrees, temperature logged."""
    a = g.full * r.uniform(0.03, 0.06)
    g.warm = True
    g.lost = lambda m: a * 2 ** (-(m["c"] - 25) / 15)
    return "unknown", {"drag_torque", "viscous_drag", "temperature_viscosity", "temperature_drag", "drag_drift", "torque_drift"}


KINDS = [nothing, coarse, coarse_friction, rubs_more, seal, splash, gain, zero, runs_in, other_oil, other_seal, askew_output, bent_output, magnets, cold_grease]


class Case:
    def __init__(self, kind, number, seed):
        r = numpy.random.default_rng([seed, 815, KINDS.index(kind), number])
        self.name, self.rig = f"{kind.__name__}-{number:02d}", Rig(r)
        self.how, self.names = kind(self.rig, r)

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        (where / "rig.toml").write_text(self.rig.pair.toml())
        rows, self.error = self.rig.rows()
        if self.rig.step:  # what rounding adds
            self.error *= math.sqrt(1 + (self.rig.step ** 2 + self.rig.step_out ** 2) / 12)
        (where / "bench.csv").write_text("\n".join(rows) + "\n")
        return trial.close_loop(self, program, where, "rig.toml", "bench.csv")

    def judge(self):
        a = self.answer
        named = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        if a["verdict"] in ("explained", "no_effect") and a["after"]["rms_nm"] > 1.2 * self.error:
            return f"{a['verdict']} though {a['after']['rms_nm'] / self.error:.2f} of the error is left"
        if self.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        if self.how == "known" and not all(any(n in one for one in alike) for n in self.names):
            return "not named"
        wrong = [e["id"] for e, one in zip(named, alike) if not one & self.names]
        return f"misnamed {wrong}" if wrong else ""

    def line(self):
        a, g = self.answer, self.rig
        label = f"{'' if self.right else 'WRONG '}{self.name} [{g.order} {g.law} x{g.repeats} step {g.step:.1f}]: {self.why}"
        if a is None:
            return label
        told = "; ".join(e["id"] + ("" if e["named"] else " {" + e["description"][:110] + "}") for e in a["effects"])
        return f"{label} | {a['verdict']} left {a['after']['rms_nm'] / self.error:.2f} noise {a['data']['noise_nm'] / self.error:.2f} | {told} | {a['structure_left']['description'][:160]} | {self.seconds:.1f}s"


def main():
    o = trial.words()
    cases = [Case(kind, i, o.seed) for kind in KINDS if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: [c.name.split("-")[0]])


if __name__ == "__main__":
    main()
