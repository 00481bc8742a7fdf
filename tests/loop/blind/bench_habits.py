# SPDX-License-Identifier: GPL-3.0-or-later
"""Habits of drives and test benches that nobody declared, of kinds the other trials lack: sensors that ask for the
sense of turn, grease that is pushed aside, mornings, ranges that switch, a fan, foam; and awkward nothing. The drives
are those of bench.py.
Usage: bench_habits.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: nothing: no_effect. A habit: seen, no name but those that are a part of it, and no `explained` or `no_effect`
with more than 1.2 of the true error left."""
import json
import math

import numpy

import bench
import trial

full_in = bench.input_full


class Habit(bench.Hidden):
    def __init__(self, names=(), **plan):
        super().__init__()
        self.names, self.plan, self.nothing = set(names), plan, False


def nothing_by_sense(d, r):
    """One sense is measured three times as badly: the readings of a worn coupling."""
    h = Habit()
    e = {True: 0.0, False: 0.006 * 20.0 * r.uniform(0.6, 1.2)}
    h.nothing, h.reads["output"] = True, lambda t, m: t + e[m.forward] * r.standard_normal()
    return h


def nothing_by_speed(d, r):
    """The faster, the noisier."""
    h, e = Habit(), 0.008 * 20.0 * r.uniform(0.6, 1.2)
    h.nothing, h.reads["output"] = True, lambda t, m: t + e * (m.speed / 3000.0) * r.standard_normal()
    return h


def reads_more_in_both_senses(d, r):
    """The output's sensor reads more by as much as the sense it turns in: the drive seems to give work."""
    h, t0 = Habit({"torque_offset"}), 20.0 * r.uniform(0.012, 0.025)
    h.reads["output"] = lambda t, m: t + (t0 if m.forward else -t0)
    return h


def grease_pushed_aside(d, r):
    """After every change of load grease must be pushed aside: more drag in the first rows of a new sense."""
    h, t, rows = Habit({"drag_torque"}, shuffled=True), full_in(d) * r.uniform(0.03, 0.06), r.uniform(1.5, 3.0)
    seen = {"at": -1.0, "forward": None, "since": 0}

    def loss(m):
        if m.progress != seen["at"]:
            seen["since"] = 0 if m.forward != seen["forward"] else seen["since"] + 1
            seen["at"], seen["forward"] = m.progress, m.forward
        return t * math.exp(-seen["since"] / rows)
    h.loss = loss
    return h


def two_mornings(d, r):
    """Two runs, each begun cold."""
    h, t, tau = Habit({"drag_torque", "drag_drift", "viscous_drag"}), full_in(d) * r.uniform(0.04, 0.08), r.uniform(0.06, 0.2)
    h.loss = lambda m: t * math.exp(-((2 * m.progress) % 1.0) / tau)
    return h


def range_switches(d, r):
    """The amplifier has two ranges, one of which is off."""
    h, g, at = Habit({"torque_scale"}), r.uniform(0.015, 0.03) * r.choice([-1, 1]), 20.0 * r.uniform(0.3, 0.6)
    h.reads["output"] = lambda t, m: t * (1.0 + g * (abs(t) > at))
    return h


def fan(d, r):
    """A fan on the shaft, with blades for one sense."""
    h, c = Habit({"viscous_drag", "direction_dependent_drag", "drag_torque"}), full_in(d) * r.uniform(0.03, 0.06)
    h.loss = lambda m: c * (m.speed / 3000.0) ** 2 * m.forward
    return h


def foam(d, r):
    """Above a speed the oil foams, and the drag falls."""
    h, t, n = Habit({"drag_torque"}), full_in(d) * r.uniform(0.03, 0.05), float(r.choice([350.0, 750.0, 1400.0]))
    h.loss = lambda m: t * (1.0 - 0.8 * (m.speed > n))
    return h


def brake_fades(d, r):
    """The lever of the brake creeps under high load, more and more."""
    h, g = Habit({"torque_scale"}, shuffled=True), r.uniform(0.02, 0.04) * r.choice([-1, 1])
    h.reads["output"] = lambda t, m: t * (1.0 + g * m.progress * (m.share > 0.6))
    return h


KINDS = [nothing_by_sense, nothing_by_speed, reads_more_in_both_senses, grease_pushed_aside, two_mornings, range_switches, fan, foam, brake_fades]


class Case(bench.Case):
    def __init__(self, number, seed, kind):
        self.random = r = numpy.random.default_rng([seed, 89, *kind.__name__.encode(), number])
        self.kind, self.number = kind, number
        self.drive = (bench.PairDrive, bench.PlanetDrive)[int(r.integers(0, 2))](r)
        self.hidden = kind(self.drive, r)
        self.plan, self.truth = bench.Plan(r, **self.hidden.plan), self.hidden.names
        side = [1.0 if f else 1.0 / self.drive.ratio for f in self.plan.directions]
        self.noise = self.plan.noise * 20.0 * math.sqrt(numpy.mean(numpy.square(side)))

    def judge(self):
        a = self.answer
        if self.hidden.nothing:
            return a["verdict"] == "no_effect", "alarm"
        if a["verdict"] == "no_effect":
            return False, "missed"
        named = [e for e in a["effects"] if e["named"]]
        wrong = [e["id"] for e in named if not {e["id"], *e["confounded_with"]} & self.hidden.names]
        if wrong:
            return False, f"misnamed {wrong}"
        left = a["after"]["rms_nm"] / self.noise
        if a["verdict"] == "explained" and left > 1.2:
            return False, f"explained with {left:.2f} of the noise left"
        if len(named) == len(a["effects"]) and a["verdict"] == "explained":
            return False, "named whole"
        return True, ""

    def held(self):
        return ()

    def line(self):
        a = self.answer
        if a is None:
            return super().line()
        told = json.dumps([e["description"][:110] for e in a["effects"] if not e["named"]])
        return f"{super().line()} | left {a['after']['rms_nm'] / self.noise:.2f} | {told} | {a['structure_left']['description'][:160]}"


def main():
    o = trial.words()
    cases = [Case(i, o.seed, kind) for kind in KINDS if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind.__name__,))


if __name__ == "__main__":
    main()
