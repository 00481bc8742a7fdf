# SPDX-License-Identifier: GPL-3.0-or-later
"""Benches that run in time: rows come at uneven moments of a duty, a ramp, dwells or stairs, warmth and zeros follow the
clock and not the row, a controller misses its set torque, errors hang together over seconds. Files as anyone may write
them: columns in any order, columns of their own, comments, other line ends. What a drive does as designed is asked of
`trueflank check`, at frictions of which the trial draws one: so every train can be on the bench, and no formula of an
efficiency, a loss or a sensor is the library's or another trial's.
Usage: runs_over_time.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--every N] [--list] [--least SHARE]
An answer is right where:
  nothing   no_effect
  known     every name (or one the program says it cannot be told from), and no other
  like      the same in another law: names that say so, or none
  unknown   seen, no name but those allowed, and described
  refused   exit code 2 and a message that names the line or the column; so it is of fewer than 8 rows
`explained` and `no_effect` are wrong in every kind where more than 1.2 of the true noise is left, on the rows held out
too (as far as so few can tell), or noise_nm is not 0.75 to 1.33 of it."""
import json
import math
import pathlib
import re
import subprocess
import threading
import time

import numpy

import trial

EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "examples"
FLANKS = {"friction_coefficient", "load_dependent_friction", "load_loss", "bearing_load_friction", "mesh_friction"}
SLOW = {"stribeck_friction", "mixed_friction"}
FAST = {"viscous_drag", "bearing_friction"}


class Train:
    """A drive as the program has it: efficiencies at a few frictions, between them a polynomial."""
    known, lock = {}, threading.Lock()

    def __init__(self, r, small=False):
        mu = self.mu = float(numpy.round(r.uniform(0.05, 0.1), 3))
        kind = str(r.choice(["pair", "ring", "simple"] if small else ["pair", "pair", "ring", "simple", "simple", "stepped", "3k", "two"]))
        self.name, gear = kind, lambda name, z, more="": f"[{name}]\nteeth = {z}\nshift = 0.0\nface_width_mm = 9\n{more}"
        z1 = int(r.integers(18, 27))
        if kind in ("stepped", "3k", "two"):
            text = (EXAMPLES / {"stepped": "stepped", "3k": "bilateral_drive", "two": "two_stage"}[kind] / "design.toml").read_text()
            self.text = re.sub(r"(?m)^friction = \S+", f"friction = {mu}", text)
        elif kind == "simple":
            z1, z2 = 2 * (z1 // 2), 2 * int(r.integers(10, 18)) + 1
            while (2 * z1 + 2 * z2) % 3:
                z2 += 1
            self.text = (f'format = 1\nname = "stand"\n[gearbox]\nkind = "simple"\nplanets = 3\nmodule_mm = 0.8\nfriction = {mu}\n' +
                         gear("sun", z1) + gear("planet", z2) + gear("ring", z1 + 2 * z2, f"outer_diameter_mm = {0.8 * (z1 + 2 * z2) + 14}\n"))
        else:
            z2 = int(r.integers(50, 95))
            ring = f"internal = true\nouter_diameter_mm = {1.25 * z2 + 20}\n" if kind == "ring" else ""
            self.text = (f'format = 1\nname = "stand"\n[gearbox]\nkind = "pair"\nmodule_mm = 1.25\nfriction = {mu}\n' + gear("pinion", z1) + gear("wheel", z2, ring))

    def ask(self, program, folder):
        """Its ratio and efficiencies, from the program."""
        nodes, of = numpy.array([0.4, 0.7, 1.0, 1.4, 1.9, 2.4, 3.0, 3.6]) * self.mu, []
        for number, mu in enumerate(nodes):
            text = re.sub(r"(?m)^friction = \S+", f"friction = {mu:.6f}", self.text)
            with self.lock:
                found = self.known.get(text)
            if found is None:
                (folder / f"asked{number}.toml").write_text(text)
                subprocess.run([program, "check", f"asked{number}.toml", "-q", "--json", "asked.json"], cwd=folder, capture_output=True, timeout=60)
                report = json.loads((folder / "asked.json").read_text())
                found = report["train"]["ratio"], report["efficiency"]["forward"], report["efficiency"]["backward"]
                with self.lock:
                    self.known[text] = found
            of.append(found)
        self.ratio = of[0][0]
        powers = numpy.linalg.inv(numpy.vander(nodes / self.mu, len(nodes), increasing=True))
        self.law = {True: powers @ [f[1] for f in of], False: powers @ [f[2] for f in of]}

    def eta(self, mu, forward):
        return float(sum(c * (mu / self.mu) ** k for k, c in enumerate(self.law[forward])))


class Moment:
    def __init__(self, t, forward, n, q, file=0):
        self.t, self.forward, self.n, self.q, self.file = t, forward, n, q, file


def duty(s, r):
    """What is asked of the drive, and when: a list of moments."""
    ways = [True] if s.one_way else [True, False]
    speeds, loads, t, list_of = s.speeds, s.loads, 0.0, []
    if s.style == "shuffled" or s.style == "stairs":
        for again in range(s.repeats):
            points = [(f, n, q) for f in ways for n in speeds for q in loads]
            if s.style == "shuffled":
                r.shuffle(points)
            elif again % 2:
                points = [(f, n, q) for f in ways for n in speeds[::-1] for q in loads[::-1]]
            for f, n, q in points:
                t += r.gamma(3.0, 20.0)
                list_of.append(Moment(t, bool(f), n, q, again if s.files else 0))
    elif s.style == "scattered":  # no two rows alike
        for k in range(s.rows):
            t += r.exponential(30.0)
            list_of.append(Moment(t, bool(r.choice(ways)), math.exp(r.uniform(math.log(speeds[0]), math.log(speeds[-1]))), r.uniform(loads[0], loads[-1])))
    elif s.style == "dwells":
        points = [(f, n, q) for f in ways for n in speeds for q in loads]
        if r.uniform() < 0.5:
            r.shuffle(points)
        for f, n, q in points:
            t += 15.0
            for k in range(int(r.integers(4, 14))):
                t += r.exponential(0.5)
                list_of.append(Moment(t, bool(f), n, q))
    else:  # ramps of the load at one speed after the other, sampled unevenly
        each = max(8, s.rows // (len(ways) * len(speeds)))
        for f in ways:
            for n in speeds:
                at = numpy.sort(r.uniform(0.0, 1.0, each))
                for x in at:
                    list_of.append(Moment(t + 60.0 * x, f, n, loads[0] + (loads[-1] - loads[0]) * (1 - abs(2 * x - 1))))
                t += 75.0
    return list_of


class Stand:
    def __init__(self, r, small=False):
        self.r, self.train = r, Train(r, small)
        self.full = float(numpy.exp(r.uniform(math.log(0.3), math.log(120.0))))  # N m at the input
        self.error = r.uniform(0.001, 0.003)
        self.law = str(r.choice(["white", "white", "slow", "reading", "tails", "box"]))
        self.style = str(r.choice(["shuffled", "shuffled", "stairs", "scattered", "dwells", "ramps"]))
        self.rows, self.repeats, self.files, self.one_way = int(r.integers(120, 500)), int(r.integers(2, 4)), False, False
        self.speeds = numpy.geomspace(r.uniform(40, 120), r.uniform(1500, 4000), int(r.integers(4, 8)))
        self.loads = numpy.linspace(r.uniform(0.08, 0.2), 1.0, int(r.integers(4, 7)))
        self.warm, self.angle, self.sigma = bool(r.integers(0, 2)), bool(r.integers(0, 2)), r.uniform() < 0.2
        self.miss, self.layout = 0.01 * r.uniform(0, 1), r.uniform() < 0.5
        self.mu, self.lost = (lambda m: self.train.mu), (lambda m: 0.0)
        self.out, self.inp = (lambda t, m: t), (lambda t, m: t)
        self.driving_error, self.digits, self.spoil = 0.0, 8, (lambda lines: lines)

    def errors(self, moments):
        r, n = self.r, len(moments)
        if self.law == "slow":  # hangs together over half a minute
            e = [r.normal()]
            for before, m in zip(moments, moments[1:]):
                k = 0.6 * math.exp(-max(0.0, m.t - before.t) / 40.0)
                e.append(k * e[-1] + math.sqrt(1 - k * k) * r.normal())
            return numpy.array(e)
        if self.law == "tails":
            return r.standard_t(6, n) / math.sqrt(1.5)
        if self.law == "box":
            return r.uniform(-1, 1, n) * math.sqrt(3)
        return r.normal(size=n)

    def write(self):
        """{file: text}; self.true_noise is the rms of the random error of the driven side."""
        s, r, i = self, self.r, self.train.ratio
        moments = duty(s, r)
        e, end, room, turns, last, square = s.errors(moments), moments[-1].t, 20 + 5 * r.uniform(), 0.0, 0.0, 0.0
        columns = ["direction", "input_speed_rpm", "input_torque_nm", "output_torque_nm"] + ["temperature_c"] * s.warm + ["input_angle_deg"] * s.angle
        columns += ["sigma_nm"] * s.sigma
        order = list(columns) + (["time_s", "remark"] if s.layout else [])
        if s.layout:
            r.shuffle(order)
        files = {}
        for k, m in enumerate(moments):
            m.done, m.row, m.room, m.last_forward = m.t / end, k, room, k and moments[k - 1].forward
            m.n *= 1 + 0.003 * r.normal()
            turns += max(0.3, (m.t - last) * m.n / 60.0) if m.t - last < 5 else r.uniform(7, 40)
            last, m.turns = m.t, turns
            m.celsius = room + 28 * (1 - math.exp(-3.0 * m.done)) + 0.3 * r.normal()
            m.q *= 1 + s.miss * r.normal()
            lever = 1.0 if m.forward else i
            m.in_nm = m.q * s.full
            lost, eta = s.lost(m), s.train.eta(s.mu(m), m.forward)
            driving = m.in_nm * lever
            driven = eta * i * (driving - lost) if m.forward else eta * driving / i - lost
            size = s.error * s.full * (i if m.forward else 1.0) * ((0.25 + 1.5 * m.q) if s.law == "reading" else 1.0)
            square += (size * e[k]) ** 2
            driven += size * e[k]
            if s.driving_error:
                driving *= 1 + s.driving_error * r.normal()
            ti, to = (driving, driven) if m.forward else (driven, driving)
            field = {"direction": "forward" if m.forward else "backward", "input_speed_rpm": f"{m.n:.2f}", "input_torque_nm": f"{s.inp(ti, m):.{s.digits}g}",
                     "output_torque_nm": f"{s.out(to, m):.{s.digits}g}", "temperature_c": f"{m.celsius:.1f}", "input_angle_deg": f"{360 * turns:.1f}",
                     "sigma_nm": f"{size:.4g}", "time_s": f"{m.t:.2f}", "remark": "ok"}
            head = (["# stand 4", "# operator = kb", ""] if s.layout else []) + [",".join(order)]
            files.setdefault(m.file, head).append(",".join(field[c] for c in order))
        self.true_noise, self.count = math.sqrt(square / len(moments)), len(moments)
        return {f"run{k}.csv": ("\r\n" if s.layout else "\n").join(s.spoil(lines)) + "\n" for k, lines in files.items()}


def few(s, r, speeds, loads, repeats):
    s.style, s.repeats, s.speeds, s.loads = "shuffled", repeats, numpy.geomspace(150, 2500, speeds), numpy.linspace(0.2, 1.0, loads)


# --- nothing there
def quiet(s, r):
    return "nothing", set(), {}


def quiet_small(s, r):
    few(s, r, int(r.integers(1, 4)), int(r.integers(2, 4)), int(r.integers(1, 4)))
    return "nothing", set(), {}


def quiet_long(s, r):
    s.style, s.rows = str(r.choice(["ramps", "scattered"])), 1500
    return "nothing", set(), {}


def quiet_one_load(s, r):
    s.style, s.loads, s.one_way, s.repeats = "shuffled", numpy.array([1.0]), bool(r.integers(0, 2)), 8
    return "nothing", set(), {}


def quiet_ramp_one_way(s, r):
    s.style, s.one_way = "ramps", True
    return "nothing", set(), {}


def quiet_driving_noise(s, r):
    s.driving_error, s.error = 0.002, 0.002
    return "nothing", set(), {}


def quiet_four_digits(s, r):
    s.digits = 4
    return "nothing", set(), {}


# --- known
def rough_flanks(s, r):
    mu = s.train.mu * r.uniform(1.4, 2.4)
    s.mu = lambda m: mu
    return "known", {"friction_coefficient"}, {"value": mu}


def smooth_flanks(s, r):
    mu, s.error = s.train.mu * r.uniform(0.45, 0.65), 0.001
    s.mu = lambda m: mu
    return "known", {"friction_coefficient"}, {"value": mu}


def rough_few(s, r):
    few(s, r, 2, 3, 2)
    mu, s.error = s.train.mu * r.uniform(1.7, 2.4), 0.001
    s.mu = lambda m: mu
    return "like", {"friction_coefficient", "bearing_load_friction"}, {"value": mu}


def seals(s, r):
    t = s.full * r.uniform(0.012, 0.03)
    s.lost = lambda m: t
    return "known", {"drag_torque"}, {"torque_nm": t}


def oil(s, r):
    c = s.full * r.uniform(0.02, 0.045) / s.speeds[-1]
    s.lost = lambda m: c * m.n
    return "known", {"viscous_drag"}, {"nm_per_rpm": c}


def flanks_and_seals(s, r):
    mu, t = s.train.mu * r.uniform(1.5, 2.2), s.full * r.uniform(0.012, 0.03)
    s.mu, s.lost = (lambda m: mu), (lambda m: t)
    return "known", {"friction_coefficient", "drag_torque"}, {"value": mu, "torque_nm": t}


def seals_and_oil(s, r):
    t, c = s.full * r.uniform(0.015, 0.03), s.full * r.uniform(0.02, 0.045) / s.speeds[-1]
    s.lost = lambda m: t + c * m.n
    return "known", {"drag_torque", "viscous_drag"}, {"torque_nm": t, "nm_per_rpm": c}


def output_gain(s, r):
    f = 1 + r.uniform(0.015, 0.05) * r.choice([-1, 1])
    s.out = lambda t, m: f * t
    return "known", {"torque_scale"}, {"factor": f}


def gain_and_flanks(s, r):
    f, mu = 1 + r.uniform(0.015, 0.04) * r.choice([-1, 1]), s.train.mu * r.uniform(1.5, 2.2)
    s.mu, s.out = (lambda m: mu), (lambda t, m: f * t)
    return "known", {"friction_coefficient", "torque_scale"}, {"value": mu, "factor": f}


def input_zero(s, r):
    d = s.full * r.uniform(0.01, 0.03) * r.choice([-1, 1])
    s.inp = lambda t, m: t + d
    return "known", {"torque_offset"}, {}


def output_zero_and_seals(s, r):
    d, t = s.full * s.train.ratio * r.uniform(0.012, 0.03) * r.choice([-1, 1]), s.full * r.uniform(0.012, 0.03)
    s.out, s.lost = (lambda to, m: to + d), (lambda m: t)
    return "known", {"torque_offset", "drag_torque"}, {"torque_nm": t}


def zero_drifts(s, r):
    """By the clock, in a run whose set points are shuffled."""
    d, s.style = s.full * s.train.ratio * r.uniform(0.02, 0.04) * r.choice([-1, 1]), str(r.choice(["shuffled", "scattered"]))
    s.out = lambda t, m: t + d * m.done
    return "known", {"torque_drift"}, {}


def zero_drifts_and_flanks(s, r):
    d, s.style, mu = s.full * s.train.ratio * r.uniform(0.02, 0.04) * r.choice([-1, 1]), "shuffled", s.train.mu * r.uniform(1.5, 2.2)
    s.out, s.mu = (lambda t, m: t + d * m.done), (lambda m: mu)
    return "known", {"torque_drift", "friction_coefficient"}, {"value": mu}


def turns_heavy(s, r):
    """Once a turn of the input, steady part included."""
    a, p, s.angle = s.full * r.uniform(0.01, 0.02), r.uniform(0, 6.3), True
    s.lost = lambda m: a * (1 + math.sin(2 * math.pi * m.turns + p))
    return "known", {"angle_periodic_friction", "drag_torque"}, {"amplitude_nm": a}


def swapped_files(s, r):
    """Input and output under each other's names."""
    s.train = Train(numpy.random.default_rng(int(r.integers(0, 999))), True)
    s.layout, s.sigma = False, False
    s.spoil = lambda lines: [lines[0]] + [",".join([*(f := line.split(","))[:2], f[3], f[2], *f[4:]]) for line in lines[1:]]
    return "known", {"swapped_side"}, {}


# --- the same in another law
def soft_grease(s, r):
    """A drag by a law of Vogel's kind, warmth logged."""
    a, s.warm = s.full * r.uniform(0.04, 0.08), True
    s.lost = lambda m: a * math.exp(700.0 / (m.celsius + 95) - 700.0 / (m.room + 95))
    return "like", {"drag_torque", "temperature_drag", "drag_drift", "torque_drift", "temperature_viscosity"}, {}


def thin_oil(s, r):
    a, s.warm = s.full * r.uniform(0.06, 0.1) / s.speeds[-1], True
    s.lost = lambda m: a * m.n * (1 + (m.celsius - m.room) / 20.0) ** -1.5
    return "like", FAST | {"temperature_viscosity", "drag_drift", "temperature_drag"}, {}


def lubricated_flanks(s, r):
    """The flanks' coefficient falls as a power of the speed."""
    a, k = s.train.mu * r.uniform(1.0, 2.0), r.uniform(0.3, 0.6)
    s.mu = lambda m: s.train.mu * 0.8 + a * (m.n / s.speeds[0]) ** -k
    return "like", SLOW | FLANKS, {}


def breakaway(s, r):
    """Seals that hold at creep: 1/(1 + (n/n0)^2)."""
    a, n0 = s.full * r.uniform(0.03, 0.06), r.uniform(150, 450)
    s.lost = lambda m: a / (1 + (m.n / n0) ** 2)
    return "like", SLOW | {"drag_torque"}, {}


def windage(s, r):
    a = s.full * r.uniform(0.03, 0.06)
    s.lost = lambda m: a * (m.n / s.speeds[-1]) ** 2.2
    return "like", FAST, {}


def bearings_bind(s, r):
    """Bearings under load: in proportion to the torque they carry."""
    a = r.uniform(0.015, 0.03)
    s.lost = lambda m: a * m.in_nm
    return "like", FLANKS, {}


def worm_of_load(s, r):
    a, k = s.full * r.uniform(0.02, 0.05), r.uniform(1.6, 2.4)
    s.lost = lambda m: a * m.q ** k
    return "like", FLANKS, {}


def zero_settles(s, r):
    """The amplifier warms in the first third: an exponential of the clock."""
    d, s.style = s.full * s.train.ratio * r.uniform(0.025, 0.05) * r.choice([-1, 1]), "shuffled"
    s.out = lambda t, m: t + d * (1 - math.exp(-4 * m.done))
    return "like", {"torque_drift", "torque_offset"}, {}


def warms_unseen(s, r):
    """Drag falls as the drive warms, temperature not logged."""
    a, s.style, s.warm = s.full * r.uniform(0.03, 0.06), str(r.choice(["shuffled", "scattered"])), False
    s.lost = lambda m: a * (0.25 + 0.75 * math.exp(-3 * m.done))
    return "like", {"drag_torque", "drag_drift", "torque_drift"}, {}


# --- what one log in one direction cannot tell: no name for certain
def log_of_gain(s, r):
    s.style, s.one_way, f = str(r.choice(["ramps", "dwells"])), True, 1 - r.uniform(0.02, 0.05)
    s.out = lambda t, m: f * t
    return "log", {"torque_scale"}, {}


def log_of_zero(s, r):
    s.style, s.one_way, d = str(r.choice(["ramps", "dwells"])), True, -s.full * s.train.ratio * r.uniform(0.015, 0.03)
    s.out = lambda t, m: t + d
    return "log", {"torque_offset"}, {}


def log_of_drift(s, r):
    s.style, s.one_way, d = "dwells", True, s.full * s.train.ratio * r.uniform(0.02, 0.04) * r.choice([-1, 1])
    s.out = lambda t, m: t + d * m.done
    return "log", {"torque_drift", "drag_drift", "torque_offset"}, {}


# --- nobody's
def play_of_the_cell(s, r):
    """Hysteresis as a play: the cell lags behind its load by a share of the range."""
    w, s.style, at = s.full * s.train.ratio * r.uniform(0.012, 0.025), "stairs", [0.0]

    def read(t, m):
        at[0] = min(max(at[0], t - w), t + w)
        return at[0]
    s.out = read
    return "unknown", {"torque_offset", "torque_drift", "torque_scale", "drag_torque", "direction_dependent_drag"}, {}


def creep_slips(s, r):
    """Below a speed the output sticks and slips: sometimes a loss."""
    a, below = s.full * r.uniform(0.08, 0.15), s.speeds[1] * 0.9
    s.lost = lambda m: a * (m.n < below) * float(r.uniform() < 0.5)
    return "unknown", SLOW | {"drag_torque"}, {}


def door_opened(s, r):
    """Cold air in the middle of the run: a loss that comes and goes with the clock."""
    a, at, s.style = s.full * r.uniform(0.03, 0.05), r.uniform(0.3, 0.7), "shuffled"
    s.lost = lambda m: a * math.exp(-((m.done - at) / 0.12) ** 2)
    return "unknown", {"drag_torque", "torque_drift", "drag_drift", "torque_offset"}, {}


def warm_after_fast(s, r):
    """What it lost in the last minutes: oil that is flung away at speed and runs back."""
    a, s.style, state = s.full * r.uniform(0.04, 0.08), "shuffled", [0.0, 0.0]

    def lost(m):
        k = math.exp(-(m.t - state[0]) / 150.0)
        state[0], state[1] = m.t, k * state[1] + (1 - k) * min(1.0, m.n / s.speeds[-1])
        return a * state[1]
    s.lost = lost
    return "unknown", {"drag_torque"} | FAST, {}


def clutch_slips(s, r):
    """A clutch behind the drive lets go at 80 % of the load."""
    end = r.uniform(0.75, 0.85) * s.full * s.train.ratio
    s.out = lambda t, m: min(t, end * (1 + 0.0005 * r.normal())) if m.forward else t
    return "unknown", set(), {}


def dead_band(s, r):
    """The input's amplifier reads nothing of the first part of its range."""
    d = s.full * r.uniform(0.04, 0.07)
    s.inp = lambda t, m: t - d * math.exp(-t / (0.25 * s.full))
    return "unknown", FLANKS | {"torque_offset", "drag_torque", "torque_scale"}, {}


def speed_in_torque(s, r):
    """The output's cell also feels the speed's square."""
    a = s.full * s.train.ratio * r.uniform(0.02, 0.04) * r.choice([-1, 1])
    s.out = lambda t, m: t + a * (m.n / s.speeds[-1]) ** 2
    return "unknown", FAST | {"torque_offset", "direction_dependent_drag"}, {}


def gain_of_warmth(s, r):
    k, s.warm, s.style = r.uniform(0.001, 0.002) * r.choice([-1, 1]), True, str(r.choice(["shuffled", "scattered"]))
    s.out = lambda t, m: t * (1 + k * (m.celsius - m.room))
    return "unknown", {"torque_scale", "torque_drift", "torque_offset"}, {}


def chip_in_the_ring(s, r):
    """More loss over a part of every turn of the input."""
    a, at, part = s.full * r.uniform(0.04, 0.08), r.uniform(), r.uniform(0.06, 0.2)
    s.angle, s.style = True, str(r.choice(["shuffled", "scattered", "dwells"]))
    s.lost = lambda m: a * ((m.turns - at) % 1.0 < part)
    return "unknown", {"angle_periodic_friction", "drag_torque"}, {}


def two_chips_of_the_output(s, r):
    a, at, part, apart = s.full * r.uniform(0.04, 0.08), r.uniform(), r.uniform(0.05, 0.1), r.uniform(0.25, 0.5)
    s.angle, s.style = True, "shuffled"
    s.lost = lambda m: a * (min((m.turns / s.train.ratio - at) % 1.0, (m.turns / s.train.ratio - at - apart) % 1.0) < part)
    return "unknown", {"angle_periodic_friction", "drag_torque"}, {}


def days(s, r):
    """Each day the cell was zeroed anew."""
    s.style, s.files, s.repeats = "shuffled", True, 3
    zero = [s.full * s.train.ratio * 0.012 * x for x in (r.normal(), r.normal() + 2, r.normal() - 2)]
    s.out = lambda t, m: t + zero[m.file]
    return "unknown", {"torque_offset", "torque_drift"}, {}


def one_speed_rings(s, r):
    at, a, s.style = int(r.integers(1, 3)), s.full * r.uniform(0.03, 0.06), str(r.choice(["shuffled", "stairs"]))
    s.lost = lambda m: a / (1 + ((m.n / s.speeds[at] - 1) / 0.05) ** 2)
    return "unknown", {"drag_torque"}, {}


def starts_dry(s, r):
    """The first rows after each change of direction lose more."""
    a, s.style, left = s.full * r.uniform(0.05, 0.08), "stairs", [0]

    def lost(m):
        left[0] = 6 if m.row == 0 or m.forward != m.last_forward else left[0] - 1
        return a * max(0, left[0]) / 6
    s.lost = lost
    return "unknown", {"drag_torque"} | SLOW, {}


def oil_changed(s, r):
    at, f, s.style = r.uniform(0.35, 0.65), r.uniform(1.5, 2.0), "shuffled"
    s.mu = lambda m: s.train.mu * (f if m.done > at else 1.0)
    return "unknown", {"friction_coefficient"}, {}


def jam_at_a_load_and_speed(s, r):
    a, s.style = s.full * r.uniform(0.05, 0.09), "shuffled"
    s.lost = lambda m: a * (m.q > 0.6) * (m.n < s.speeds[1] * 1.1)
    return "unknown", set(), {}


# --- refused
def millinewton(s, r):
    s.spoil = lambda lines: [line.replace("input_torque_nm", "input_torque_mnm") for line in lines]
    return "refused", {"input_torque_mnm"}, {}


def another_unit(s, r):
    s.inp = lambda t, m: 1000 * t
    return "refused", {"unit"}, {}


KINDS = [quiet, quiet_small, quiet_long, quiet_one_load, quiet_ramp_one_way, quiet_driving_noise, quiet_four_digits, rough_flanks,
         smooth_flanks, rough_few, seals, oil, flanks_and_seals, seals_and_oil, output_gain, gain_and_flanks, input_zero,
         output_zero_and_seals, zero_drifts, zero_drifts_and_flanks, turns_heavy, swapped_files, soft_grease, thin_oil,
         lubricated_flanks, breakaway, windage, bearings_bind, worm_of_load, zero_settles, warms_unseen, log_of_gain, log_of_zero,
         log_of_drift, play_of_the_cell, creep_slips, door_opened, warm_after_fast, clutch_slips, dead_band, speed_in_torque,
         gain_of_warmth, chip_in_the_ring, two_chips_of_the_output, days, one_speed_rings, starts_dry, oil_changed,
         jam_at_a_load_and_speed, millinewton, another_unit]


class Case:
    def __init__(self, kind, number, seed):
        self.seed = [seed, 4711, KINDS.index(kind), number]
        self.kind, self.name, self.answer, self.right, self.seconds = kind, f"{kind.__name__}-{number:02d}", None, False, 0.0

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        r = numpy.random.default_rng(self.seed)
        self.stand = Stand(r, self.kind is swapped_files)
        self.stand.train.ask(program, where)
        self.how, self.names, self.truth = self.kind(self.stand, r)
        self.stand.train.ask(program, where)
        (where / "stand.toml").write_text(self.stand.train.text)
        files = self.stand.write()
        for name, text in files.items():
            (where / name).write_text(text)
        start = time.time()
        done = subprocess.run([program, "loop", "stand.toml", *sorted(files), "-o", "."], cwd=where, capture_output=True, text=True, timeout=300)
        self.seconds = time.time() - start
        if self.how == "refused":
            self.why = "" if done.returncode == 2 and all(n in done.stderr for n in self.names) else f"exit {done.returncode}: {done.stderr[:200]}"
        elif self.stand.count < 8:  # said to be too few
            self.why = "" if done.returncode == 2 and "usable rows" in done.stderr else f"exit {done.returncode} of too few rows"
        elif done.returncode:
            self.why = f"exit {done.returncode}: {done.stderr[:300]}"
        else:
            self.answer = json.loads((where / "loop.json").read_text())
            self.why = self.judge()
        self.right = not self.why
        return self

    def too_much_left(self):
        """`explained` or `no_effect` beside more than the noise; empty: no."""
        a, s = self.answer, self.stand
        if a["verdict"] not in ("explained", "no_effect"):
            return ""
        for what, rows in (("rms_nm", s.count), ("held_out_rms_nm", a["data"]["held_out"])):
            # Errors of a reading's share and long tails scatter more than a normal law's.
            if (a["after"][what] or 0.0) > (1.2 + 2.0 / math.sqrt(max(1, rows))) * s.true_noise:
                return f"{a['verdict']} though {what} is {a['after'][what] / s.true_noise:.2f} of the noise"
        told = a["data"]["noise_nm"] / s.true_noise
        spread = 2.0 / math.sqrt(s.count)
        return "" if 0.75 - spread <= told <= 1.33 + spread else f"noise told {told:.2f} of the true one"

    def judge(self):
        a = self.answer
        named = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        if wrong := self.too_much_left():
            return wrong
        if self.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        if self.how == "log":  # a name for certain, without the one that is true
            sure = [e["id"] for e, one in zip(named, alike) if not one & self.names]
            return f"sure of {sure}" if sure else ""
        wrong = [e["id"] for e, one in zip(named, alike) if not one & self.names]
        if wrong:
            return f"misnamed {wrong}"
        if "no gearbox delivers more" in a["structure_left"]["description"]:
            return ""  # power is gained: no name is for certain, and that is what it says
        if self.how == "known":
            missing = [n for n in self.names if not any(n in one for one in alike)]
            return f"without {missing}" if missing else "one more without a name" if len(named) < len(a["effects"]) else ""
        told = not a["structure_left"]["description"].startswith("nothing")
        return "" if a["effects"] or told else "not described"

    def held(self):
        held = asked = 0
        for e in self.answer["effects"] if self.answer and self.right and self.how == "known" else []:
            for name, value in self.truth.items():
                # two sensors give only their ratio: a drift told of the other side is another number
                if e["id"] in self.names and name in e["parameters"] and e.get("side") in (None, "output"):
                    low, high = e["parameters"][name]["ci95"]
                    asked, held = asked + 1, held + (low <= value <= high)
        return held, asked

    def line(self):
        a, s = self.answer, self.stand
        label = f"{'' if self.right else 'WRONG '}{self.name} [{s.train.name} {s.style} {s.law}{' one way' if s.one_way else ''} {getattr(s, 'count', 0)} rows]: {self.why}"
        if a is None:
            return label
        told = "; ".join(e["id"] + (" ~" + ",".join(e["confounded_with"]) if e["confounded_with"] else "") +
                         (" " + " ".join(f"{k} {p['value']:.4g} [{p['ci95'][0]:.4g}, {p['ci95'][1]:.4g}]" for k, p in e["parameters"].items())
                          if e["named"] else " {" + e["description"][:130] + "}") for e in a["effects"])
        return (f"{label} | {a['verdict']} left {a['after']['rms_nm'] / s.true_noise:.2f} held {(a['after']['held_out_rms_nm'] or 0) / s.true_noise:.2f} noise "
                f"{a['data']['noise_nm'] / s.true_noise:.2f} | {told} | {a['structure_left']['description'][:200]} | truth {self.truth} {self.seconds:.1f}s")


def main():
    o = trial.words(every=(1, "of the kinds only every so many"))
    cases = [Case(kind, i, o.seed) for kind in KINDS[::o.every] if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind.__name__, "all " + c.how), counts=Case.held,
                   columns="| hidden | right | of | intervals that hold | of |",
                   after=lambda done: print(f"{sum(c.seconds for c in done):.0f} s in the program"))


if __name__ == "__main__":
    main()
