# SPDX-License-Identifier: GPL-3.0-or-later
"""Benches as they are: sensors that drift, saturate and bend, loads that leave a hysteresis, friction that rises at
low speed by another law than the library's, ripple of motor and meshes, wild rows, noise that hangs together, logs
and several files. The drives are those of bench.py; no formula of a loss or a sensor is the library's.
Usage: odd_benches.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
An answer is right where:
  nothing   no_effect
  known     the name (or one the program says it cannot be told from) and no other; the intervals are counted
  like      a name that says the same in another law, or none; never `explained` above 1.2 of the true noise
  unknown   seen; no name beside those allowed; an unnamed effect, or a verdict of partly_explained that says where
In every kind `explained` and `no_effect` are wrong where the error that is left is more than 1.2 of the true noise,
or noise_nm is not 0.75 to 1.3 of it."""
import collections
import math

import numpy

import bench
import trial

LOSSES_OVER_LOAD = {"friction_coefficient", "load_dependent_friction", "load_loss", "bearing_load_friction"}
LOSSES = LOSSES_OVER_LOAD | {"drag_torque", "viscous_drag", "bearing_friction", "stribeck_friction", "mixed_friction"}


class Row:
    """One moment: what the bench sets, and when."""

    def __init__(self, forward, speed, load, file):
        self.forward, self.speed, self.load, self.file = forward, speed, load, file
        self.rising = True


def grid_rows(r, style, one_way):
    """Set points in the order in which they are run."""
    loads = sorted(r.uniform(0.0, 0.12, 1).tolist() + (numpy.linspace(0.15, 1.0, 5) + r.uniform(-0.04, 0.0, 5)).tolist())
    speeds = sorted(numpy.geomspace(70.0, 3000.0, 6) * r.uniform(0.9, 1.1, 6))
    directions = (True,) if one_way else (True, False)
    rows = []
    if style == "log":  # every set point held for a while, sampled eight times
        for f in directions:
            for n in speeds[::1]:
                for t in (loads[0], loads[1], loads[3], loads[5]):
                    rows += [Row(f, n, t, 0) for _ in range(8)]
        return rows
    for repeat in range(3 if one_way else 2):
        # up and down again with the load, so that a hysteresis shows
        one = []
        for f in directions:
            for n in speeds:
                for t in loads if repeat % 2 == 0 else loads[::-1]:
                    one.append(Row(f, n, t, repeat if style == "files" else 0))
                    one[-1].rising = repeat % 2 == 0
        if style == "shuffled":
            r.shuffle(one)
        rows += one
    return rows


class Bench:
    """What it does beside the design; every hook may be replaced."""

    def __init__(self, drive, r):
        self.drive, self.r = drive, r
        self.full = 20.0                            # N m at the output
        self.full_in = self.full / drive.ratio
        self.mu = lambda m: bench.RUBBING
        self.loss = lambda m: 0.0                   # N m at the input
        self.reads_in = lambda t, m: t
        self.reads_out = lambda t, m: t
        self.noise_kind = str(r.choice(["white", "white", "correlated", "heavy", "with_load"]))
        self.noise = 0.0025 * r.uniform(0.5, 1.5)   # of the largest driven torque
        self.style = str(r.choice(["shuffled", "shuffled", "swept", "log", "files"]))
        self.one_way = False
        self.warm, self.angles = bool(r.integers(0, 2)), bool(r.integers(0, 2))
        self.wild = 0

    def errors(self, rows):
        n, r = len(rows), self.r
        if self.noise_kind == "correlated":
            e, rho = numpy.zeros(n), r.uniform(0.3, 0.6)
            e[0] = r.standard_normal()
            for i in range(1, n):
                e[i] = rho * e[i - 1] + math.sqrt(1 - rho * rho) * r.standard_normal()
            return e
        if self.noise_kind == "heavy":
            return r.standard_t(5, n) / math.sqrt(5.0 / 3.0)
        if self.noise_kind == "with_load":
            return r.standard_normal(n) * numpy.array([0.5 + m.share for m in rows])
        return r.standard_normal(n)

    def files(self):
        """{name: text} of the bench's files, and the rms of the random error on the driven side."""
        rows = grid_rows(self.r, self.style, self.one_way)
        turns, eta = 0.0, {}
        for i, m in enumerate(rows):
            m.progress = i / (len(rows) - 1.0)
            m.share = m.load
            m.speed *= 1.0 + 0.003 * self.r.standard_normal()
            turns += self.r.uniform(0.3, 2.7) if self.style == "log" else self.r.uniform(11.0, 53.0)
            m.turns = turns
            m.celsius = 30.0 + 25.0 * (1.0 - math.exp(-2.2 * m.progress)) + 0.5 * self.r.standard_normal()
        errors, square = self.errors(rows), 0.0
        wild = set(self.r.choice(len(rows), self.wild, replace=False).tolist())
        columns = ["direction", "input_speed_rpm", "input_torque_nm", "output_torque_nm"]
        columns += ["temperature_c"] * self.warm + ["input_angle_deg"] * self.angles
        texts = collections.defaultdict(lambda: [",".join(columns)])
        for i, m in enumerate(rows):
            lever = 1.0 if m.forward else self.drive.ratio       # input N m -> driving side
            driving = (0.02 + 1.05 * m.share) * self.full_in * lever
            m.at_input = driving / lever
            driving += max(0.0, 1.1 * self.loss(m)) * lever
            m.at_input = driving / lever
            lost, mu = self.loss(m), round(self.mu(m), 6)
            if (m.forward, mu) not in eta:
                eta[m.forward, mu] = self.drive.efficiency(mu, m.forward)
            e = eta[m.forward, mu]
            driven = self.drive.ratio * e * (driving - lost) if m.forward else e * driving / self.drive.ratio - lost
            error = self.noise * (self.full if m.forward else self.full_in) * errors[i]
            square += error * error
            if i in wild:
                error += self.noise * (self.full if m.forward else self.full_in) * self.r.choice([-1, 1]) * self.r.uniform(15, 60)
            torque_in, torque_out = (driving, driven + error) if m.forward else (driven + error, driving)
            row = ["forward" if m.forward else "backward", f"{m.speed:.3f}", f"{self.reads_in(torque_in, m):.8f}",
                   f"{self.reads_out(torque_out, m):.7f}"]
            row += [f"{m.celsius:.3f}"] * self.warm + [f"{360.0 * m.turns:.3f}"] * self.angles
            texts[m.file].append(",".join(row))
        return {f"bench{k}.csv": "\n".join(t) + "\n" for k, t in texts.items()}, math.sqrt(square / len(rows))


# Each sets a bench up and returns (how it is judged, names allowed or wanted, truth of parameters).
def nothing(b, r):
    return "nothing", set(), {}


def wild_rows(b, r):
    b.wild = 2
    return "nothing", set(), {}


def single_log(b, r):
    b.style, b.one_way = "log", True
    return "nothing", set(), {}


def friction(b, r):
    mu = bench.RUBBING * r.uniform(1.4, 2.2)
    b.mu = lambda m: mu
    return "known", {"friction_coefficient"}, {"value": mu}


def drag(b, r):
    t = b.full_in * r.uniform(0.012, 0.03)
    b.loss = lambda m: t
    return "known", {"drag_torque"}, {"torque_nm": t}


def viscous(b, r):
    c = b.full_in * r.uniform(0.02, 0.05) / 3000.0
    b.loss = lambda m: c * m.speed
    return "known", {"viscous_drag"}, {"nm_per_rpm": c}


def scale_out(b, r):
    f = 1.0 + r.choice([-1, 1]) * r.uniform(0.02, 0.05)
    b.reads_out = lambda t, m: f * t
    return "known", {"torque_scale"}, {"factor": f}


def scale_in(b, r):
    f = 1.0 + r.choice([-1, 1]) * r.uniform(0.02, 0.05)
    b.reads_in = lambda t, m: f * t
    return "known", {"torque_scale"}, {"factor": 1.0 / f}


def wrong_ratio(b, r):
    """The gearbox on the bench is not quite the design: its ratio is off, losses as designed."""
    f = 1.0 + r.choice([-1, 1]) * r.uniform(0.02, 0.05)
    b.reads_out = lambda t, m: f * t if m.forward else t
    b.reads_in = lambda t, m: t if m.forward else t / f
    return "known", {"torque_scale"}, {"factor": f}


def zero_off(b, r):
    size = b.full * r.uniform(0.012, 0.03) * r.choice([-1, 1])
    b.reads_out = lambda t, m: t + size
    return "known", {"torque_offset"}, {}


def zero_drifts(b, r):
    size = b.full * r.uniform(0.02, 0.04) * r.choice([-1, 1])
    b.style = "shuffled"
    b.reads_out = lambda t, m: t + size * m.progress
    return "known", {"torque_drift"}, {}


def ripple_of_carrier(b, r):
    b.angles, order = True, 1.0 / b.drive.ratio
    a, phase = b.full_in * r.uniform(0.012, 0.025), r.uniform(0, 6.28)
    b.loss = lambda m: a * math.cos(2 * math.pi * order * m.turns - phase)
    return "known", {"angle_periodic_friction"}, {"amplitude_nm": a}


def friction_at_low_speed(b, r):
    """The flanks' coefficient rises at low speed: by 1/(1 + n/n0), by exp(-n/n0) or by a power."""
    size, n0, law = bench.RUBBING * r.uniform(1.0, 2.0), r.uniform(120.0, 500.0), r.integers(0, 3)
    shape = (lambda n: 1.0 / (1.0 + n / n0), lambda n: math.exp(-n / n0), lambda n: (70.0 / max(n, 40.0)) ** 0.5)[law]
    b.mu = lambda m: bench.RUBBING + size * shape(m.speed)
    return "like", {"mixed_friction", "stribeck_friction", "friction_coefficient"}, {}


def drag_at_low_speed(b, r):
    """Seals that stick: a drag that falls with the speed as 1/(1 + n/n0) or exp(-n/n0)."""
    size, n0, law = b.full_in * r.uniform(0.03, 0.07), r.uniform(120.0, 500.0), r.integers(0, 2)
    shape = (lambda n: 1.0 / (1.0 + n / n0), lambda n: math.exp(-n / n0))[law]
    b.loss = lambda m: size * shape(m.speed)
    return "like", {"stribeck_friction", "mixed_friction", "drag_torque"}, {}


def bent_load_loss(b, r):
    """A loss over the load that is no power: it sets in at a load and grows from there."""
    size, at = b.full_in * r.uniform(0.06, 0.1), r.uniform(0.35, 0.55)
    b.loss = lambda m: size * max(0.0, m.share - at)
    return "like", {"load_loss", "load_dependent_friction", "friction_coefficient"}, {}


def churning(b, r):
    """A loss with the square of the speed."""
    size = b.full_in * r.uniform(0.03, 0.06)
    b.loss = lambda m: size * (m.speed / 3000.0) ** 2
    return "like", {"viscous_drag", "bearing_friction", "drag_torque"}, {}


def warms_up(b, r):
    """A drag that falls as the oil warms, the temperature not logged."""
    size = b.full_in * r.uniform(0.03, 0.06)
    b.style, b.warm = "shuffled", False
    b.loss = lambda m: size * math.exp(-0.05 * (m.celsius - 30.0))
    return "like", {"drag_torque", "drag_drift", "torque_drift"}, {}


def step_at_a_load(b, r):
    size, at = b.full_in * r.uniform(0.02, 0.04), r.uniform(0.3, 0.7)
    b.loss = lambda m: size * (m.share > at)
    return "unknown", {"drag_torque"}, {}


def saturates(b, r):
    """The output's amplifier ends at 80 to 90 % of the range."""
    end = b.full * r.uniform(0.78, 0.88)
    b.reads_out = lambda t, m: min(t, end) + 0.0005 * end * r.standard_normal()
    return "unknown", set(), {}


def bent_sensor(b, r):
    """The output's sensor is not straight: a bow between its ends."""
    size = b.full * r.uniform(0.012, 0.025) * r.choice([-1, 1])
    b.reads_out = lambda t, m: t + size * math.sin(math.pi * min(1.1, t / b.full))
    return "unknown", LOSSES_OVER_LOAD | {"torque_scale"}, {}


def hysteresis(b, r):
    """Read higher while the load rises than while it falls."""
    size = b.full * r.uniform(0.01, 0.02)
    b.style = str(r.choice(["swept", "files"]))
    b.reads_out = lambda t, m: t + (size if m.rising else -size)
    return "unknown", {"torque_drift", "torque_offset"}, {}


def resonance(b, r):
    """A loss at one speed alone."""
    size, at = b.full_in * r.uniform(0.03, 0.06), r.choice([150.0, 320.0, 680.0, 1450.0])
    b.loss = lambda m: size * math.exp(-((math.log(m.speed / at) / 0.25) ** 2))
    return "unknown", {"drag_torque"}, {}


def corner(b, r):
    """A loss where load and speed are both high."""
    size = b.full_in * r.uniform(0.03, 0.06)
    b.loss = lambda m: size * (m.share > 0.55) * (m.speed > 900.0)
    return "unknown", set(), {}


def zero_jumps(b, r):
    """Somebody touched the amplifier in the middle."""
    size, at = b.full * r.uniform(0.015, 0.03) * r.choice([-1, 1]), r.uniform(0.35, 0.65)
    b.style = "shuffled"
    b.reads_out = lambda t, m: t + size * (m.progress > at)
    return "unknown", {"torque_drift", "torque_offset"}, {}


def zero_wanders(b, r):
    size, phase = b.full * r.uniform(0.012, 0.025), r.uniform(0, 6.28)
    b.style = "shuffled"
    b.reads_out = lambda t, m: t + size * math.sin(2 * math.pi * 1.5 * m.progress + phase)
    return "unknown", {"torque_drift", "torque_offset"}, {}


def days_differ(b, r):
    """Two files of two days: the second reads higher."""
    size = b.full * r.uniform(0.01, 0.02) * r.choice([-1, 1])
    b.style = "files"
    b.reads_out = lambda t, m: t + size * m.file
    return "unknown", {"torque_offset", "torque_drift"}, {}


def ripple_of_motor(b, r):
    """Pole pairs and slots: a wave many times a turn."""
    b.angles, b.style, order = True, "shuffled", float(r.choice([6, 12, 18, 24, 36]))
    a, phase = b.full_in * r.uniform(0.012, 0.025), r.uniform(0, 6.28)
    b.loss = lambda m: a * math.cos(2 * math.pi * order * m.turns - phase)
    return "unknown", {"angle_periodic_friction"}, {}


def coarse_sensor(b, r):
    """The output's converter has few steps: they are as large as the noise."""
    step = b.noise * b.full * 1.5
    b.reads_out = lambda t, m: step * round(t / step)
    return "nothing", set(), {}


def jams_at_an_angle(b, r):
    """A chip in the ring: more loss over a tenth of every turn of the input."""
    size, at = b.full_in * r.uniform(0.03, 0.06), r.uniform(0.0, 1.0)
    b.angles = True
    b.loss = lambda m: size * ((m.turns - at) % 1.0 < 0.12)
    return "unknown", {"angle_periodic_friction"}, {}


def bearing_defect(b, r):
    """A wave of no whole order: a ball passes."""
    b.angles, b.style, order = True, "shuffled", r.uniform(2.2, 7.8)
    a, phase = b.full_in * r.uniform(0.015, 0.03), r.uniform(0, 6.28)
    b.loss = lambda m: a * math.cos(2 * math.pi * order * m.turns - phase)
    return "unknown", {"angle_periodic_friction"}, {}


def knocks(b, r):
    """Backlash: at low load and high speed the teeth knock, a loss that scatters."""
    size = b.full_in * r.uniform(0.05, 0.09)
    b.loss = lambda m: size * (m.share < 0.25) * (m.speed > 700.0) * (1.0 + 0.3 * r.standard_normal())
    return "unknown", {"drag_torque"}, {}


def stick_slip(b, r):
    """At creeping speed the output sticks and slips: a loss that scatters."""
    size = b.full_in * r.uniform(0.06, 0.1)
    b.loss = lambda m: size * (m.speed < 110.0) * (1.0 + 0.3 * r.standard_normal())
    return "unknown", {"stribeck_friction", "mixed_friction", "drag_torque"}, {}


def lubricant_regimes(b, r):
    """The flanks' coefficient over the speed as Stribeck drew it: it falls, and rises again."""
    low, rise, n0 = bench.RUBBING * r.uniform(0.8, 1.4), bench.RUBBING * r.uniform(0.6, 1.2), r.uniform(200.0, 400.0)
    b.mu = lambda m: bench.RUBBING + low * math.exp(-m.speed / n0) + rise * (m.speed / 3000.0) ** 1.3
    return "unknown", LOSSES, {}


def warm_sensor(b, r):
    """The output sensor's gain follows its temperature, which is logged."""
    k = r.uniform(0.001, 0.002) * r.choice([-1, 1])
    b.warm, b.style = True, "shuffled"
    b.reads_out = lambda t, m: t * (1.0 + k * (m.celsius - 30.0))
    return "unknown", {"torque_scale", "torque_drift", "temperature_drag"} | LOSSES_OVER_LOAD, {}


def one_way_drag(b, r):
    """A seal lip that rubs one way only."""
    size = b.full_in * r.uniform(0.03, 0.06)
    b.loss = lambda m: size * m.forward
    return "unknown", {"drag_torque", "torque_offset"}, {}


def one_way_gain(b, r):
    """The output cell reads too much under one sign of its bending."""
    f = 1.0 + r.choice([-1, 1]) * r.uniform(0.02, 0.04)
    b.reads_out = lambda t, m: f * t if m.forward else t
    return "unknown", {"torque_scale"} | LOSSES_OVER_LOAD, {}


KINDS = [nothing, wild_rows, single_log, friction, drag, viscous, scale_out, scale_in, wrong_ratio, zero_off, zero_drifts,
         ripple_of_carrier, friction_at_low_speed, drag_at_low_speed, bent_load_loss, churning, warms_up,
         step_at_a_load, saturates, bent_sensor, hysteresis, resonance, corner, zero_jumps, zero_wanders, days_differ,
         ripple_of_motor, coarse_sensor, jams_at_an_angle, bearing_defect, knocks, stick_slip, lubricant_regimes, warm_sensor,
         one_way_drag, one_way_gain]


class Case:
    def __init__(self, number, seed, kind):
        r = numpy.random.default_rng([seed, 7, KINDS.index(kind), number])
        self.kind, self.number = kind, number
        drive = (bench.PairDrive, bench.PlanetDrive)[int(r.integers(0, 2))](r)
        self.bench = Bench(drive, r)
        self.how, self.names, self.truth = kind(self.bench, r)

    def label(self):
        b = self.bench
        return f"{self.kind.__name__}-{self.number:02d} {b.drive.name} {b.style} {b.noise_kind}{' one way' if b.one_way else ''}"

    def run(self, program, folder):
        where = folder / f"{self.kind.__name__}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "bench.toml").write_text(self.bench.drive.design())
        files, self.noise = self.bench.files()
        for name, text in files.items():
            (where / name).write_text(text)
        return trial.close_loop(self, program, where, "bench.toml", *sorted(files))

    def judge(self):
        """What is wrong; empty: nothing."""
        a = self.answer
        named = [e for e in a["effects"] if e["named"]]
        unnamed = len(a["effects"]) - len(named)
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        quiet = a["verdict"] in ("no_effect", "explained")
        if quiet and a["after"]["rms_nm"] > 1.2 * self.noise:
            return f"{a['verdict']} though {a['after']['rms_nm'] / self.noise:.2f} of the noise is left"
        # A wild row is noise to nobody: only where none was hidden.
        if quiet and not 0.75 <= a["data"]["noise_nm"] / self.noise <= 1.3:
            return f"noise told {a['data']['noise_nm'] / self.noise:.2f} of the true one"
        if self.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        if self.how == "known":
            right = len(named) == len(self.names) and all(any(n in one for one in alike) for n in self.names)
            if right and not unnamed:
                return ""
            return "names " + ", ".join(e["id"] for e in a["effects"])
        wrong = [e["id"] for e, one in zip(named, alike) if not one & self.names]
        if wrong:
            return f"misnamed {wrong}"
        if self.how == "unknown" and not unnamed and a["verdict"] != "partly_explained" \
                and not any(len(one & self.names) for one in alike):
            return "not told"
        if a["verdict"] == "partly_explained" and not unnamed and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def held(self):
        held = asked = 0
        if self.answer is None or not self.right:
            return 0, 0
        for e in self.answer["effects"]:
            for name, value in self.truth.items():
                if e["id"] in self.names and name in e["parameters"]:
                    low, high = e["parameters"][name]["ci95"]
                    asked += 1
                    held += low <= value <= high
        return held, asked

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        return (f"{'' if self.right else 'WRONG '}{self.label()}: {self.why} | {a['verdict']} "
                f"left {a['after']['rms_nm'] / self.noise:.2f} noise {a['data']['noise_nm'] / self.noise:.2f} | {bench.found_text(a)} | "
                f"{a['structure_left']['description'][:200]} | truth {self.truth}")


if __name__ == "__main__":
    bench.campaign(KINDS, Case)
