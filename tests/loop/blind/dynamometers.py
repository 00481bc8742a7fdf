# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives between two torque meters: 3K, stepped and simple planetary sets, external and internal pairs. What a mesh
passes on is summed from forces as vectors on the contacts of two involutes; a set is balanced by the powers that its
members feed the planets, seen from the carrier. Nothing is asked of the program and no formula is another trial's.
Rows are grids, stairs, dwells or sweeps of the load, in both directions or one; both meters scatter, by a normal law, with
tails, in proportion to the reading or hanging together a little.
Usage: dynamometers.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE] [--hold SHARE]
An answer is right where:
  nothing   no_effect
  known     every name (or one the program says it cannot be told from), no other, and nothing without a name
  log       one direction, one log: no name for certain that leaves the true one out
  unknown   seen, described, and no name but those that are a part of it
and never `explained` or `no_effect` with more than 1.2 of the true noise left, on the rows held out too.
`--hold`: the share of all 95 % intervals of right names that must hold the truth; exit 1 below."""
import math
import sys

import numpy

import trial

TAU = 2 * math.pi


def mesh_efficiency(z1, z2, module, tip1, tip2, centre, internal, mu, first_drives):
    """Power out over power in. Gear 1 about (0, 0), the pitch point on +x, contacts share the load evenly, each with its
    friction against the sliding of the two surfaces."""
    base = [0.5 * module * z * math.cos(math.radians(20)) for z in (z1, z2)]
    angle = math.acos((base[1] - base[0] if internal else base[0] + base[1]) / centre)
    rolls = numpy.array([base[0] / math.cos(angle), 0.0])
    other = numpy.array([-centre if internal else centre, 0.0])
    along = numpy.array([math.sin(angle), math.cos(angle)])
    pitch, steps = TAU * base[0] / z1, 4000
    s = (numpy.arange(-6 * steps, 6 * steps) + 0.5) * pitch / steps
    at = rolls + s[:, None] * along
    r1, r2 = numpy.hypot(*at.T), numpy.hypot(*(at - other).T)
    touches = (r1 <= tip1) & ((r2 >= tip2) if internal else (r2 <= tip2)) & (s > -rolls[0] * math.sin(angle))
    if not internal:
        touches &= s < (centre - rolls[0]) * math.sin(angle)
    turn = lambda r: numpy.stack([-r[:, 1], r[:, 0]], 1)
    speed = 1.0 if first_drives else -1.0
    slides = speed * (turn(at) - (z1 / z2 if internal else -z1 / z2) * turn(at - other))
    friction = mu * slides / numpy.maximum(numpy.hypot(*slides.T), 1e-12)[:, None]
    force = (along + friction) * touches[:, None]     # on gear 2, of a unit normal force
    moment = lambda r: (r[:, 0] * force[:, 1] - r[:, 1] * force[:, 0]).reshape(12, steps).sum(0)
    on1, on2 = moment(at), moment(at - other)
    lost = numpy.mean(on1 / on2) if first_drives else numpy.mean(on2 / on1)
    ideal = abs(base[0] / base[1])
    return ideal / abs(lost) if first_drives else 1.0 / ideal / abs(lost)


class Drive:
    """kind: 3k, stepped, simple, pair, ring. efficiency(mu of every mesh, forward), ratio and the design's text."""

    def __init__(self, r, kind):
        self.kind, self.mu, h = kind, float(numpy.round(r.uniform(0.04, 0.08), 3)), float(r.choice([0.75, 0.8, 0.85]))
        pick = lambda *rows: rows[int(r.integers(0, len(rows)))]
        self.kept, self.fixed_carrier = {}, False
        if kind == "3k":
            s, p, q, p2, q2 = pick((18, 36, 90, 33, 87), (21, 36, 93, 33, 90), (24, 30, 84, 27, 81), (24, 33, 90, 36, 93), (27, 39, 105, 33, 99))
            gears, meshes = [("sun", s), ("planet1", p), ("ring1", q), ("planet2", p2), ("ring2", q2)], [(0, 1), (1, 2), (3, 4)]
        elif kind == "stepped":
            s, p, p2, q = pick((18, 45, 21, 84), (21, 42, 24, 87), (24, 36, 24, 84), (20, 40, 21, 81))
            gears, meshes = [("sun", s), ("planet1", p), ("planet2", p2), ("ring", q)], [(0, 1), (2, 3)]
        elif kind == "simple":
            s, p = pick((18, 27), (20, 31), (24, 24), (21, 33), (30, 21), (22, 29))
            gears, meshes = [("sun", s), ("planet", p), ("ring", s + 2 * p)], [(0, 1), (1, 2)]
            self.fixed_carrier = r.uniform() < 0.3
        else:
            gears, meshes = [("pinion", int(r.integers(19, 30))), ("wheel", int(r.integers(60, 100)))], [(0, 1)]
        module, self.z = float(r.choice([0.8, 1.0, 1.5])), [z for name, z in gears]
        inside = [name.startswith("ring") or (kind == "ring" and name == "wheel") for name, z in gears]
        tips = [module * (0.5 * z - h if ring else 0.5 * z + h) for ring, (name, z) in zip(inside, gears)]
        centre = 0.5 * module * (gears[1][1] - gears[0][1] if inside[1] else gears[0][1] + gears[1][1])
        self.meshes = [(self.z[a], self.z[b], module, tips[a], tips[b], centre, inside[b]) for a, b in meshes]
        box = "pair" if kind == "ring" else kind
        self.text = (f'format = 1\nname = "between"\n[gearbox]\nkind = "{box}"\nmodule_mm = {module}\ncentre_distance_mm = {centre}\nfriction = {self.mu}\n' +
                     ("" if len(gears) == 2 else "planets = 3\n") + ('output = "ring2"\n' if kind == "3k" else 'output = "ring"\n' if self.fixed_carrier else "") + f"[rack]\naddendum = {h}\n")
        for ring, tip, (name, z) in zip(inside, tips, gears):
            self.text += f"[{name}]\nteeth = {z}\nshift = 0.0\nface_width_mm = 8\ntip_diameter_mm = {2 * tip}\n"
            self.text += f"outer_diameter_mm = {module * (z + 14)}\n" * ring + "internal = true\n" * (ring and name == "wheel")
        self.speeds()
        self.ratio = abs(self.turns(True))

    def speeds(self):
        """Of the members that meet the planets, against the carrier: sun 1."""
        z, planet = self.z, -self.z[0] / self.z[1]
        if self.kind in ("pair", "ring"):
            self.against = [1.0, (1 if self.kind == "ring" else -1) * z[0] / z[1]]
        elif self.kind == "simple":
            self.against = [1.0, planet * z[1] / z[2]]
        elif self.kind == "stepped":
            self.against = [1.0, planet * z[2] / z[3]]
        else:
            self.against = [1.0, planet * z[1] / z[2], planet * z[3] / z[4]]

    def turns(self, forward):
        """Input turns per turn of the output, signed."""
        w = self.against
        if self.kind in ("pair", "ring") or self.fixed_carrier:
            return w[0] / w[1]
        carrier = -w[1]  # the first ring stands still
        return (w[0] + carrier) / (w[2] + carrier if self.kind == "3k" else carrier)

    def torque_ratio(self, feeds):
        """Output's torque over the sun's where member k feeds the planets `feeds[k]` of what it puts in."""
        w = self.against
        if self.kind == "3k":  # the carrier is free: t0 + t1 + t2 = 0 and what is fed in adds up to nothing
            t1, t2 = numpy.linalg.solve([[1.0, 1.0], [feeds[1] * w[1], feeds[2] * w[2]]], [-1.0, -feeds[0] * w[0]])
            return t1, t2, t2
        t1 = -feeds[0] * w[0] / (feeds[1] * w[1])
        return t1, 0.0, t1 if self.kind in ("pair", "ring") or self.fixed_carrier else -1.0 - t1

    def efficiency(self, mu, forward):
        mu = mu if isinstance(mu, tuple) else (mu,) * len(self.meshes)
        key = tuple(round(m, 5) for m in mu), forward
        if key not in self.kept:
            pairs = self.kind in ("pair", "ring")
            both = [[mesh_efficiency(*mesh, m, first) for first in (True, False)] for mesh, m in zip(self.meshes, key[0])]
            into = [1.0] * len(self.against)
            for _ in range(4):
                t1, t2, out = self.torque_ratio(into)
                sense = 1.0 if forward else -1.0
                feeds = []
                for k, (torque, w) in enumerate(zip((1.0, t1, t2), self.against)):
                    gives = sense * torque * w > 0
                    if pairs:  # one mesh: its whole loss is the wheel's
                        e = 1.0 if k == 0 else both[0][0 if forward else 1]
                        feeds.append(1.0 if k == 0 else (1.0 / e if forward else e))
                        continue
                    # of a sun's mesh the sun is gear 1, of a ring's the planet
                    e = both[k][0 if gives == (k == 0) else 1]
                    feeds.append(e if gives else 1.0 / e)
                into = feeds
            self.kept[key] = abs(out) / self.ratio if forward else self.ratio / abs(out)
        return self.kept[key]


class Moment:
    pass


class Bench:
    def __init__(self, r, kind=None):
        self.r = r
        self.drive = Drive(r, kind or str(r.choice(["3k", "3k", "stepped", "simple", "simple", "pair", "ring"])))
        self.full = float(math.exp(r.uniform(math.log(0.2), math.log(80.0))))   # at the input
        self.scatter, self.of_driving = math.exp(r.uniform(math.log(0.0007), math.log(0.0025))), r.uniform(0.0, 0.5)
        self.law = str(r.choice(["normal", "normal", "tails", "reading", "hangs"]))
        self.layout = str(r.choice(["grid", "grid", "stairs", "dwells", "sweeps"]))
        self.directions, self.rounds = (True, False), 2
        self.speeds = numpy.geomspace(r.uniform(40, 150), r.uniform(1200, 3500), int(r.integers(5, 8)))
        self.loads = numpy.linspace(r.uniform(0.0, 0.15), 1.0, int(r.integers(5, 8)))
        self.warmth = self.angle = False
        mu = self.drive.mu
        self.mu, self.losses, self.reads_in, self.reads_out = [lambda m: mu], [], [], []

    def moments(self):
        r, all_of = self.r, []
        grid = [(f, n, q) for f in self.directions for n in self.speeds for q in self.loads]
        if self.layout == "sweeps":
            each = int(r.integers(10, 20))
            for f in self.directions:
                for n in self.speeds:
                    up = numpy.linspace(self.loads[0], 1.0, each)
                    all_of += [(f, n, q) for q in (*up, *up[::-1])]
        elif self.layout == "dwells":
            if r.uniform() < 0.5:
                r.shuffle(grid)
            for f, n, q in grid:
                all_of += [(f, n, q)] * int(r.integers(5, 11))
        else:
            for k in range(self.rounds):
                if self.layout == "grid":
                    r.shuffle(grid)
                all_of += grid if k % 2 == 0 or self.layout == "grid" else grid[::-1]
        return all_of

    def scatters(self, n):
        if self.law == "tails":
            return self.r.standard_t(5, n) / math.sqrt(5 / 3)
        e = self.r.normal(size=n)
        if self.law == "hangs":
            for k in range(1, n):
                e[k] = 0.3 * e[k - 1] + math.sqrt(0.91) * e[k]
        return e

    def write(self):
        """The lines of the file; `noise` is the rms of the true random error as it shows on the driven side."""
        r, i, points = self.r, self.drive.ratio, self.moments()
        n, turns, squares = len(points), 0.0, 0.0
        driven_error, driving_error = self.scatters(n), r.normal(size=n)
        head = ["direction", "input_speed_rpm", "input_torque_nm", "output_torque_nm"] + ["temperature_c"] * self.warmth + ["input_angle_deg"] * self.angle
        lines, last = [",".join(head)], None
        for k, (forward, speed, q) in enumerate(points):
            m = Moment()
            m.forward, m.n, m.q, m.part, m.row = bool(forward), speed * (1 + 0.002 * r.normal()), q * (1 + 0.004 * r.normal()), k / (n - 1), k
            m.last, last = last, m
            turns += r.uniform(0.6, 3.0) if self.layout in ("dwells", "sweeps") else r.uniform(5, 60)
            m.turns, m.c = turns, 24 + 30 * (1 - math.exp(-2.5 * m.part)) + 0.2 * r.normal()
            m.torque = 0.01 * self.full + m.q * self.full     # at the input's side of the teeth
            mu, lost = self.mu[0](m), 0.0
            for loss in self.losses:
                lost += loss(m)
            eta, lever = self.drive.efficiency(mu, m.forward), i if m.forward else 1.0
            driving = m.torque * (1.0 if m.forward else i)
            driven = i * eta * (driving - lost) if m.forward else eta * driving / i - lost
            size = self.scatter * self.full * lever * ((0.3 + 1.2 * m.q) if self.law == "reading" else 1.0)
            off, of_driving = size * driven_error[k], self.of_driving * self.scatter * driving_error[k] * self.full * (1.0 if m.forward else i)
            squares += off ** 2 + (of_driving * eta * (i if m.forward else 1 / i)) ** 2
            driven, driving = driven + off, driving + of_driving
            ti, to = (driving, driven) if m.forward else (driven, driving)
            for read in self.reads_in:
                ti = read(ti, m)
            for read in self.reads_out:
                to = read(to, m)
            lines.append(f"{'forward' if m.forward else 'backward'},{m.n:.2f},{ti:.7g},{to:.7g}" + (f",{m.c:.2f}" if self.warmth else "") + (f",{360 * turns:.1f}" if self.angle else ""))
        self.noise, self.rows = math.sqrt(squares / n), n
        return lines


# --- causes with a name: (names, truth) and what they do to the bench
def way(r, low, high):
    return r.uniform(low, high) * r.choice([-1, 1])


def flanks(b, r):
    mu = b.drive.mu * r.uniform(1.35, 1.9)
    b.mu = [lambda m: mu]
    return "friction_coefficient", {"value": mu}


def seal(b, r):
    t = b.full * r.uniform(0.01, 0.03)
    b.losses.append(lambda m: t)
    return "drag_torque", {"torque_nm": t}


def churning(b, r):
    c = b.full * r.uniform(0.015, 0.04) / b.speeds[-1]
    b.losses.append(lambda m: c * m.n)
    return "viscous_drag", {"nm_per_rpm": c}


def rolling(b, r):
    t = b.full * r.uniform(0.008, 0.02)
    b.losses.append(lambda m: t * (m.n / 1000) ** (2 / 3))
    return "bearing_friction", {"nm_at_1000_rpm": t}


def boundary(b, r):
    t, n0 = b.full * r.uniform(0.025, 0.05), b.speeds[-1] * r.uniform(0.1, 0.3)
    b.losses.append(lambda m: t * math.exp(-(m.n / n0) ** 2))
    return "stribeck_friction", {"torque_nm": t, "speed_rpm": n0}


def bends(b, r):
    t, p = b.full * r.uniform(0.025, 0.05), r.uniform(1.5, 2.5)
    b.losses.append(lambda m: t * (m.torque / b.full) ** p)
    return "load_loss", {"exponent": p}


def gain(b, r):
    f = 1 + way(r, 0.012, 0.04)
    b.reads_out.append(lambda t, m: f * t)
    return "torque_scale", {"factor": f}


def zero(b, r):
    d = b.full * b.drive.ratio * way(r, 0.01, 0.03)
    b.reads_out.append(lambda t, m: t + d)
    return "torque_offset", {"offset_nm": d}


def zero_in(b, r):
    d = b.full * way(r, 0.01, 0.03)
    b.reads_in.append(lambda t, m: t + d)
    return "torque_offset", {"offset_nm": d}


def drift(b, r):
    d, b.layout = b.full * b.drive.ratio * way(r, 0.015, 0.035), "grid"
    b.reads_out.append(lambda t, m: t + d * m.part)
    return "torque_drift", {"drift_nm": d}


def wave(b, r):
    a, p, b.angle = b.full * r.uniform(0.008, 0.02), r.uniform(0, TAU), True
    b.losses.append(lambda m: a * math.cos(TAU * m.turns - p))
    return "angle_periodic_friction", {"amplitude_nm": a}


def thinning(b, r):
    c, k, b.warmth = b.full * r.uniform(0.05, 0.09) / b.speeds[-1], r.uniform(0.02, 0.04), True
    b.losses.append(lambda m: c * m.n * math.exp(-k * (m.c - 24)))
    return "temperature_viscosity", {"per_c": k}


def by_direction(b, r):
    low, high = b.drive.mu * r.uniform(1.1, 1.3), b.drive.mu * r.uniform(1.7, 2.2)
    b.mu = [lambda m: low if m.forward else high]
    return "direction_dependent_friction", {"difference": high - low}


def alone(cause):
    def kind(b, r):
        name, truth = cause(b, r)
        return "known", {name} | ({"friction_coefficient"} if cause is by_direction else set()), truth
    kind.__name__ = cause.__name__
    return kind


OF_LOAD, OF_SPEED, OF_METER = [flanks, bends], [seal, churning, rolling, boundary], [gain, zero, drift]


def together(first, second):
    def kind(b, r):
        names, truth = set(), {}
        for causes in (first, second):
            name, more = causes[int(r.integers(0, len(causes)))](b, r)
            names, truth = names | {name}, truth | more
        return "known", names, truth
    return kind


flanks_and_speed, load_and_meter, speed_and_meter, wave_and_load = (together(*two) for two in (
    ([flanks], OF_SPEED), (OF_LOAD, OF_METER), (OF_SPEED, [zero, gain]), ([wave], OF_LOAD)))
for name in ("flanks_and_speed", "load_and_meter", "speed_and_meter", "wave_and_load"):
    globals()[name].__name__ = name


# --- nothing
def still(b, r):
    return "nothing", set(), {}


def still_one_way(b, r):
    b.directions, b.layout = (True,), str(r.choice(["sweeps", "dwells"]))
    return "nothing", set(), {}


def still_with_columns(b, r):
    b.warmth = b.angle = True
    return "nothing", set(), {}


# --- one log, one direction
def log(cause):
    def kind(b, r):
        b.directions, b.layout = (bool(r.integers(0, 2)),), str(r.choice(["sweeps", "dwells"]))
        name, truth = cause(b, r)
        return "log", {name}, {}
    kind.__name__ = "log_of_" + cause.__name__
    return kind


# --- nobody's
def one_mesh(b, r):
    """One mesh of a 3K rubs more: two shafts cannot tell which."""
    which, f = int(r.integers(0, 3)), r.uniform(1.6, 2.4)
    mu = tuple(b.drive.mu * (f if k == which else 1.0) for k in range(3))
    b.mu = [lambda m: mu]
    return "unknown", {"mesh_friction"}, {}


def remembers(b, r):
    """Oil that fast running flings away and that comes back over some set points."""
    t, keep, b.layout, at = b.full * r.uniform(0.03, 0.06), r.uniform(0.6, 0.85), "grid", [0.5]

    def loss(m):
        at[0] = keep * at[0] + (1 - keep) * m.n / b.speeds[-1]
        return t * at[0]
    b.losses.append(loss)
    return "unknown", {"drag_torque", "viscous_drag"}, {}


def belt(b, r):
    """A belt before the input's meter's far side: bends at every turn, creeps with its load, hums with its own length."""
    t, c, a, order, p, b.angle = b.full * r.uniform(0.015, 0.03), r.uniform(0.008, 0.02), b.full * r.uniform(0.008, 0.015), r.uniform(0.23, 0.44), r.uniform(0, TAU), True
    b.losses.append(lambda m: t + c * m.torque + a * math.cos(TAU * order * m.turns - p))
    return "unknown", {"drag_torque", "friction_coefficient", "bearing_load_friction", "torque_scale"}, {}


def resonance(b, r):
    at, t = b.speeds[int(r.integers(1, len(b.speeds) - 1))], b.full * r.uniform(0.03, 0.05)
    b.losses.append(lambda m: t * math.exp(-((m.n - at) / (0.15 * at)) ** 2))
    return "unknown", {"drag_torque"}, {}


def stop_touches(b, r):
    """From a load on the carrier touches the housing."""
    t, at = b.full * r.uniform(0.025, 0.045), r.uniform(0.5, 0.75)
    b.losses.append(lambda m: t * (m.q > at))
    return "unknown", {"drag_torque"}, {}


def cell_lags(b, r):
    """The output's cell shows a part of the load before."""
    b.layout, part, before = "grid", r.uniform(0.02, 0.04), [None]

    def read(t, m):
        was, before[0] = before[0], t
        return t if was is None else t + part * (was - t)
    b.reads_out.append(read)
    return "unknown", {"torque_scale", "torque_offset"}, {}


def warms_up(b, r):
    """Drag that fades with the hour, no thermometer."""
    t, b.layout = b.full * r.uniform(0.03, 0.05), "grid"
    b.losses.append(lambda m: t * (0.3 + 0.7 * math.exp(-4 * m.part)))
    return "unknown", {"drag_torque", "drag_drift", "torque_drift"}, {}


def wanders(b, r):
    d, p, b.layout = b.full * b.drive.ratio * r.uniform(0.012, 0.025), r.uniform(0, TAU), "grid"
    b.reads_out.append(lambda t, m: t + d * math.sin(TAU * 1.4 * m.part + p))
    return "unknown", {"torque_drift", "torque_offset"}, {}


def bent_meter(b, r):
    k = way(r, 0.015, 0.03)
    b.reads_out.append(lambda t, m: t + k * t * t / (b.full * b.drive.ratio))
    return "unknown", {"torque_scale", "load_loss", "load_dependent_friction", "friction_coefficient", "direction_dependent_friction"}, {}


KINDS = [still, still_one_way, still_with_columns, *map(alone, [flanks, seal, churning, rolling, boundary, bends, gain, zero, zero_in, drift, wave, thinning, by_direction]),
         flanks_and_speed, load_and_meter, speed_and_meter, wave_and_load, *map(log, [gain, zero, seal, bends]),
         one_mesh, remembers, belt, resonance, stop_touches, cell_lags, warms_up, wanders, bent_meter]


class Case:
    def __init__(self, kind, number, seed):
        r = numpy.random.default_rng([seed, *kind.__name__.encode(), number])
        self.name, self.bench = f"{kind.__name__}-{number:02d}", Bench(r, "3k" if kind is one_mesh else None)
        self.how, self.names, self.truth = kind(self.bench, r)

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        (where / "drive.toml").write_text(self.bench.drive.text)
        (where / "bench.csv").write_text("\n".join(self.bench.write()) + "\n")
        return trial.close_loop(self, program, where, "drive.toml", "bench.csv")

    def judge(self):
        a, b = self.answer, self.bench
        named = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        for what, rows in (("rms_nm", b.rows), ("held_out_rms_nm", a["data"]["held_out"])):
            left = (a["after"][what] or 0.0) / b.noise
            if a["verdict"] in ("explained", "no_effect") and left > 1.2 + 2.5 / math.sqrt(max(1, rows)):
                return f"{a['verdict']} though {what} is {left:.2f} of the noise"
        if self.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        wrong = [e["id"] for e, one in zip(named, alike) if not one & self.names]
        if wrong and not (self.how == "log" and any(one & self.names for one in alike)):
            return f"misnamed {wrong}"
        if self.how == "known":
            if missing := [n for n in self.names if not any(n in one for one in alike)]:
                return f"without {missing}"
            if len(named) < len(a["effects"]):
                return "one more without a name"
        if self.how == "unknown" and not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def intervals(self):
        """(name, low, high, truth) of the right names."""
        if self.answer is None or self.how != "known" or not self.right:
            return
        for e in self.answer["effects"]:
            if not e["named"] or e["id"] not in self.names:
                continue
            if e["id"] in ("torque_offset", "torque_drift") and e["side"] != ("input" if self.name.startswith("zero_in") else "output"):
                continue  # two meters show only their ratio: the other side's figure is another
            for name in set(self.truth) & set(e["parameters"]):
                if name == "torque_nm" and e["id"] == "load_loss":
                    continue  # of its own reference
                yield name, *e["parameters"][name]["ci95"], self.truth[name]

    def held(self):
        of = list(self.intervals())
        return sum(low <= truth <= high for _, low, high, truth in of), len(of)

    def line(self):
        a, b = self.answer, self.bench
        label = f"{'' if self.right else 'WRONG '}{self.name} [{b.drive.kind} {b.layout} {b.law}{' one way' if len(b.directions) == 1 else ''}]: {self.why}"
        if a is None:
            return label
        off = ["%s %+.1f" % (name, (truth - 0.5 * (low + high)) / max(0.5 * (high - low), 1e-300)) for name, low, high, truth in self.intervals()]
        told = "; ".join(e["id"] + (" ~" + ",".join(e["confounded_with"]) if e["confounded_with"] else "") + (
            "" if e["named"] else " {" + e["description"][:120] + "}") for e in a["effects"])
        return (f"{label} | {a['verdict']} left {a['after']['rms_nm'] / b.noise:.2f} held {(a['after']['held_out_rms_nm'] or 0) / b.noise:.2f} noise {a['data']['noise_nm'] / b.noise:.2f} of {b.rows} "
                f"| {told} | {a['structure_left']['description'][:150]} | wants {sorted(self.names)} off {off} {self.seconds:.1f}s")


def main():
    o = trial.words(hold=(0.0, "the share of intervals that must hold; exit 1 below"))
    cases = [Case(kind, i, o.seed) for kind in KINDS if o.only in kind.__name__ for i in range(o.each)]

    def held_enough(done):
        held, asked = (sum(n) for n in zip(*(c.held() for c in done)))
        if held < o.hold * asked:
            print(f"only {held} of {asked} intervals hold")
            sys.exit(1)
    trial.campaign(cases, o, keys=lambda c: [c.name.split("-")[0], "all " + c.how], counts=Case.held, worth_a_line=lambda c: c.held()[0] < c.held()[1],
                   columns="| hidden | right | of | intervals that hold | of |", after=held_enough)


if __name__ == "__main__":
    main()
