# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears with what makers leave on them and no library names: burns, scores, stitches, seams, ribs, nicks, sinks, plating,
lagging axes, wires and clamps; beside them plain names and nothing. Ground, hobbed, milled, printed, moulded and wire-cut,
external, internal and helical. Shares nothing with the other trials nor with the library: an involute and normals of its
own, deviations along the normal, errors that are white, in pairs of a kind, uneven or long-tailed.
Usage: left_by_making.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: nothing: no_effect. A name: told, and no other name. A form: an effect or structure that is left, no name but those
that are fair, and its words where it has some. Never `explained` with a held-out error above 1.2 of the true noise."""
import json
import re

import numpy
from numpy import cos, exp, sin

import trial

PI, TAU = numpy.pi, 2.0 * numpy.pi


def involute(a):
    return numpy.tan(a) - a


def bell(x):
    return exp(-x * x)


class Gear:
    def __init__(self, z, m, b, x=0.0, beta=0.0, ring=False, process=None):
        self.z, self.m, self.b, self.x, self.deg, self.ring, self.process = z, m, b, x, beta, ring, process
        alpha, self.beta = numpy.radians(20), numpy.radians(beta)
        transverse = numpy.arctan(numpy.tan(alpha) / cos(self.beta))
        self.r = 0.5 * z * m / cos(self.beta)
        self.rb, self.lean = self.r * cos(transverse), numpy.arctan(numpy.tan(self.beta) * cos(transverse))
        sign = -1.0 if ring else 1.0
        self.psi = PI / (2 * z) + sign * (2 * x * numpy.tan(alpha) / z + involute(transverse))
        if ring:
            low, high = max(self.r - m * (0.98 - x), 1.003 * self.rb), self.r + m * (0.95 + x)
        else:
            low, high = max(self.r - m * (0.8 - x), 1.012 * self.rb), self.r + m * (0.98 + x)
        self.low, self.high = (numpy.sqrt(q * q - self.rb**2) for q in (low, high))
        self.middle = numpy.hypot(0.5 * (self.low + self.high), self.rb)

    def toml(self):
        made = f'\n[made]\nprocess = "{self.process}"\n' if self.process else ""
        return (f'format = 1\nname = "part"\n\n[gearbox]\nkind = "gear"\nmodule_mm = {self.m}\nhelix_angle_deg = {self.deg}\n{made}\n'
                f"[gear]\nteeth = {self.z}\nshift = {self.x}\nface_width_mm = {self.b}\n" + ("internal = true\n" if self.ring else ""))

    def side_name(self, side):
        return "right" if (side > 0) == self.ring else "left"

    def at(self, k, side, r, height):
        """Places on the flank of tooth k (from 0) on one side (+1: counter-clockwise)."""
        k, r, height = (numpy.asarray(q, float) for q in numpy.broadcast_arrays(*numpy.atleast_1d(k, r, height)))
        turned = TAU * k / self.z + height * numpy.tan(self.beta) / self.r
        a = numpy.arccos(self.rb / r)
        roll = numpy.tan(a)
        if self.ring:
            phi, nu = turned + side * (self.psi + involute(a)), turned + side * (0.5 * PI + self.psi + roll)
        else:
            phi, nu = turned + side * (self.psi - involute(a)), turned + side * (0.5 * PI + self.psi - roll)
        length, c = self.rb * roll, cos(self.lean)
        u = (length - self.low) / (self.high - self.low)
        right = (side > 0) == self.ring
        return Places(k=k, s=float(side), z=height, v=height / self.b, u=1 - u if self.ring else u, length=length, phi=phi, theta=TAU * k / self.z,
                      x=r * cos(phi), y=r * sin(phi), nx=c * cos(nu), ny=c * sin(nu), nz=-side * sin(self.lean), right=float(right), left=float(not right))


class Places:
    def __init__(self, **values):
        self.__dict__.update(values)

    def out(self, a):
        """Moved outwards from the axis."""
        return a * (cos(self.phi) * self.nx + sin(self.phi) * self.ny)

    def aside(self, a, direction):
        return a * (cos(direction) * self.nx + sin(direction) * self.ny)


GEARS = {"ground": lambda: Gear(26, 2.0, 20, 0.1, process="grinding"), "fine": lambda: Gear(83, 1.25, 30, 0.0, 24, process="grinding"),
         "hobbed": lambda: Gear(31, 1.5, 22, 0.2, 18, process="hobbing"), "printed": lambda: Gear(17, 1.5, 10, 0.3, process="fdm-0.4"),
         "printed_ring": lambda: Gear(72, 1.0, 12, 0.3, ring=True, process="fdm-0.4"), "moulded": lambda: Gear(40, 0.8, 8, process="moulding"),
         "wire": lambda: Gear(24, 1.25, 12, 0.1, process="wire-edm"), "milled": lambda: Gear(19, 3.0, 25, 0.2, process="milling"),
         "resin_ring": lambda: Gear(45, 1.5, 10, 0.2, ring=True, process="sla"), "skived_ring": lambda: Gear(60, 1.5, 18, 0.1, -14, True)}


class Drawn:
    """What one case draws for its form: a tooth, places, directions, flanks."""

    def __init__(self, r, g, a):
        self.g, self.a, self.r = g, a, r
        self.tooth, self.at_z, self.at_u, self.phase, self.order = int(r.integers(0, g.z)), g.b * r.uniform(0.3, 0.7), r.uniform(0.3, 0.7), r.uniform(0, TAU), int(r.integers(2, 4))
        self.flank = str(r.choice(["left", "right", "both"]))

    def on(self, p):
        return {"left": p.left, "right": p.right, "both": 1.0}[self.flank]

    def off(self, p):
        """Teeth from the drawn one, to both sides."""
        return (p.k - self.tooth + 0.5 * self.g.z) % self.g.z - 0.5 * self.g.z

    def turned(self, p, angle):
        return (p.phi - angle + PI) % TAU - PI


# The form (of places and what was drawn), gears, data, words that its description must hold, names that are fair.
# Data: s scan aligned, f scan in any pose, t four teeth and an index, a all teeth, c all teeth with one zero, p profiles of four, h helices of four.
FORMS = {
    "grinding_burn": (lambda p, d: d.a * p.right * bell((p.v - 0.6) / 0.2) * bell((p.u - 0.5) / 0.3) * (abs(d.off(p)) < 2.6), "ground fine", "sc", (), ""),
    "honing": (lambda p, d: 0.6 * d.a * cos(TAU * (p.z / 1.3 + p.length / 1.7)), "ground skived_ring", "sta", (), "ghost_order"),
    "scored_hob": (lambda p, d: -d.a * bell(((p.z - p.k * 2.4 / d.g.z + 0.9) % 2.4 - 1.2) / 0.25) * d.on(p), "hobbed", "tah", (), "ghost_order"),
    "broken_out_end": (lambda p, d: -1.5 * d.a * exp((p.z - d.g.b) / (0.08 * d.g.b)) * p.left, "hobbed ground", "stah", ("left",), ""),
    "jaws_above": (lambda p, d: p.out(2 * d.a * cos(3 * p.phi - d.phase) * p.v), "skived_ring resin_ring", "sa", ("3|three",), "lobing"),
    "warming_table": (lambda p, d: p.s * 1.5 * d.a * (1 - exp(-4 * p.k / d.g.z)), "hobbed ground milled", "ac", (), ""),
    "lagging_axis": (lambda p, d: d.a * p.nx * numpy.sign(sin(d.phase - p.phi)), "printed milled printed_ring", "sac", (), ""),
    "gate": (lambda p, d: p.out(3 * d.a * bell(d.turned(p, d.phase) / 0.25) * exp((p.z - d.g.b) / (0.25 * d.g.b))), "moulded", "sc", (), "single_tooth"),
    "saddle": (lambda p, d: p.out(2 * d.a * cos(2 * p.phi - d.phase) * (2 * p.v - 1)), "moulded", "sa", ("twice|2",), ""),
    "infill": (lambda p, d: 0.7 * d.a * cos(TAU * (p.x + p.y) / 4.4), "printed printed_ring", "sc", (), ""),
    "seam_on_a_flank": (lambda p, d: 1.5 * d.a * (p.k == d.tooth) * p.right * bell((p.u - d.at_u) / 0.12), "printed printed_ring", "sc", ("right",), ""),
    "support_scars": (lambda p, d: d.a * exp(-10 * p.v) * numpy.maximum(0, cos(TAU * p.x / 2.2)), "resin_ring printed", "sa", (), "elephant_foot"),
    "stitched_fields": (lambda p, d: d.a * (p.x > 0.4 * d.g.r * cos(d.phase)) * (0.6 * p.nx - 0.8 * p.ny), "resin_ring wire", "sc", (), ""),
    "whipping_wire": (lambda p, d: 0.7 * d.a * sin(3 * PI * p.v), "wire", "sth", (), ""),
    "nicked_skiving_tool": (lambda p, d: d.a * d.on(p) * bell((p.u - 0.3 - 0.5 * ((p.k * 7) % 23) / 23) / 0.06), "skived_ring", "a", (), ""),
    "pressed_bush": (lambda p, d: p.out(2.5 * d.a / (1 + exp((d.at_z - p.z) / (0.06 * d.g.b)))), "ground milled", "sh", (), "contour_offset"),
    "plating": (lambda p, d: d.a * exp((p.u - 1) / 0.2), "hobbed wire", "sp", (), ""),
    "scuffed_band": (lambda p, d: -d.a * p.left * (abs(p.u - d.at_u) < 0.13) * (abs(p.v - 0.5) < 0.3), "ground fine", "sca", ("left",), "flank_wear"),
    "pitted_thirds": (lambda p, d: -d.a * (p.k % 3 == d.tooth % 3) * d.on(p) * bell((p.u - d.at_u) / 0.15) * bell((p.v - 0.5) / 0.25), "ground hobbed", "sca", (), ""),
    "dents_of_the_mate": (lambda p, d: -1.2 * d.a * ((p.k - d.tooth) % 4 == 0) * p.right * bell((p.u - d.at_u) / 0.08), "milled ground", "ca", (), ""),
    "bent_teeth": (lambda p, d: 1.5 * d.a * p.u * (p.k % 9 == d.tooth % 9) * (d.off(p) ** 2 < 90) * p.s, "milled hobbed", "sc", (), "single_tooth"),
    "other_angle_on_half": (lambda p, d: d.a * (2 * p.u - 1) * (d.off(p) >= 0), "hobbed", "sac", (), "pressure_angle_error"),
    "step_on_one_flank": (lambda p, d: d.a * p.right * (p.z > d.at_z), "fine skived_ring", "sth", ("step", "right"), ""),
    "s_lead": (lambda p, d: 0.8 * d.a * p.left * sin(TAU * p.v), "fine hobbed", "tha", ("left",), "helix_error"),
    "four_thick": (lambda p, d: d.a * cos(4 * p.theta - d.phase) + 0 * p.z, "moulded milled", "sac", ("4|four",), "lobing"),
    "flash_of_the_mould": (lambda p, d: 1.5 * d.a * bell((p.v - 0.5) / 0.04), "moulded", "sth", (), ""),
    "sink_marks": (lambda p, d: -1.2 * d.a * bell((p.u - 0.5) / 0.3) * bell((p.v - 0.5) / 0.25), "moulded", "sa", (), "crowning profile_crowning"),
    "beating_chatter": (lambda p, d: 0.8 * d.a * cos(37 * p.phi + 2 * p.v) * (1 + 0.7 * cos(p.phi - d.phase)), "ground", "cs", (), "ghost_order pitch_wave lobing"),
    "resin_layers": (lambda p, d: d.a * (9 * p.v % 1 - 0.5), "resin_ring", "hta", (), ""),
    "lit_from_one_side": (lambda p, d: d.a * cos(p.phi - d.phase), "resin_ring wire", "sc", ("once|1",), "eccentricity"),
    "bleeding_light": (lambda p, d: 1.5 * d.a * (1 - p.u) ** 4, "resin_ring wire", "spt", (), ""),
    "wheel_that_wears": (lambda p, d: 2 * d.a * (p.u - 0.5) * p.k / d.g.z, "ground fine", "ac", (), "pressure_angle_error"),
    "brushed_edges": (lambda p, d: -1.3 * d.a * (exp(-20 * p.v) + exp(20 * (p.v - 1))), "hobbed milled", "ths", (), "crowning"),
    "ringing_fixture": (lambda p, d: 0.7 * d.a * cos(TAU * p.v / 0.21 + 2.1 * p.k) * d.on(p), "hobbed milled", "ah", (), "ghost_order"),
    "ridge_of_the_dresser": (lambda p, d: d.a * p.right * bell((p.u - d.at_u) / 0.06), "ground fine", "pta", ("right",), ""),
    "kink": (lambda p, d: 1.6 * d.a * numpy.maximum(0, p.u - d.at_u) / (1 - d.at_u) * d.on(p), "ground hobbed milled", "pta", ("kink|curved|more and more",), ""),
    "straight_root_relief": (lambda p, d: -1.6 * d.a * numpy.maximum(0, 0.35 - p.u) / 0.35 * d.on(p), "ground hobbed", "pta", ("root",), ""),
    "weld_line": (lambda p, d: p.out(2.2 * d.a * bell(d.turned(p, d.phase) * d.g.z / (1.3 * TAU))), "moulded milled", "scfa", (), ""),
    "bulge": (lambda p, d: 1.2 * d.a * bell((p.v - 0.68) / 0.2), "printed wire ground", "htf", (), "crowning"),
    "step_beside_lead": (lambda p, d: d.a * (p.z > d.at_z) + p.s * d.a * (2 * p.v - 1), "milled ground", "ths", (), "helix_error"),
    "ribs": (lambda p, d: p.out(2 * d.a * numpy.maximum(0, cos(5 * p.phi - d.phase)) ** 4), "moulded", "sfa", ("5|five",), "lobing"),
}
# The same; then the name, and its parameters.
NAMES = {
    "eccentricity": (lambda p, d: p.aside(2 * d.a, d.phase), "sac", lambda d: {"amplitude_um": 2 * d.a, "phase_deg": numpy.degrees(d.phase)}),
    "pressure_angle_error": (lambda p, d: 2 * d.a * (p.u - 0.5), "pt", lambda d: {}),
    "helix_error": (lambda p, d: 2 * d.a * p.s * (p.v - 0.5), "hts", lambda d: {"slope_um": 2 * d.a}),
    "taper": (lambda p, d: 2 * d.a * (p.v - 0.5), "hts", lambda d: {"slope_um": 2 * d.a}),
    "crowning": (lambda p, d: -2 * d.a * (2 * p.v - 1) ** 2, "hts", lambda d: {"amount_um": 2 * d.a}),
    "lobing": (lambda p, d: p.out(3 * d.a * cos(d.order * p.phi - d.phase)), "sc", lambda d: {"amplitude_um": 3 * d.a}),
    "single_tooth": (lambda p, d: 2 * d.a * (p.k == d.tooth) + 0 * p.z, "sc", lambda d: {"amount_um": 2 * d.a}),
    "flank_wear": (lambda p, d: -2 * d.a * p.right * bell((p.u - 0.5) / 0.2), "tas", lambda d: {"depth_um": 2 * d.a}),
    "scale": (lambda p, d: 1.4 * d.a * (p.x * p.nx + p.y * p.ny + p.z * p.nz) / d.g.r, "s", lambda d: {"percent": 0.14 * d.a / d.g.r}),
}


def errors(r, n, kind, sigma):
    if kind == "tails":
        return sigma * r.standard_t(4, n) / numpy.sqrt(2)
    if kind == "shared":
        weights = exp(-numpy.arange(6) / 1.2)
        return sigma * numpy.convolve(r.standard_normal(n + 5), weights, "valid") / numpy.sqrt((weights**2).sum())
    if kind == "uneven":
        return sigma * r.standard_normal(n) * numpy.where(numpy.arange(n) % 97 < 20, 1.6, 0.8)
    return sigma * r.standard_normal(n)


class Case:
    def __init__(self, number, seed, kind, what):
        self.kind, self.number, self.what = kind, number, what
        self.random = r = numpy.random.default_rng([seed, 131, *kind.encode(), number])
        gears, self.ways = (FORMS[kind][1].split(), FORMS[kind][2]) if what == "form" else (list(GEARS), NAMES[kind][1] if what == "name" else "sftacph")
        self.gear_name = str(r.choice(gears))
        self.gear, self.way = GEARS[self.gear_name](), str(r.choice(list(self.ways)))
        self.scanned = self.way in "sf"
        coarse = 3 if not self.scanned and self.gear.process in ("fdm-0.4", "sla", "moulding") else 1
        sigma = float(r.uniform(4, 8) if self.scanned else coarse * r.uniform(0.4, 1.0))
        self.sigma, self.errors = sigma, str(r.choice(["white", "white", "shared", "tails", "uneven"]))
        self.drawn = Drawn(r, self.gear, sigma * (r.uniform(3, 5) if self.scanned else r.uniform(5, 9)))
        form = FORMS[kind][0] if what == "form" else NAMES[kind][0] if what == "name" else lambda p, d: 0 * p.z
        self.off = lambda p: form(p, self.drawn) + 0 * p.z
        self.made = []

    def err(self, n, share=1.0):
        self.made.append(errors(self.random, n, self.errors, share * self.sigma))
        return self.made[-1]

    def traced(self):
        g, r, rows = self.gear, self.random, ["# zero = common"] if self.way == "c" else []
        rows += ["record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        all_teeth, records = self.way in "ac", {"p": ("profile",), "h": ("helix",)}.get(self.way, ("profile", "helix"))
        for k in range(g.z) if all_teeth else sorted({round(j * g.z / 4) for j in range(4)}):
            for side in (1, -1):
                for record in records:
                    n = (33 if all_teeth else 66)
                    radius = numpy.hypot(numpy.linspace(g.low, g.high, n), g.rb) if record == "profile" else numpy.full(n, g.middle)
                    height = numpy.full(n, 0.5 * g.b) if record == "profile" else numpy.linspace(0.02 * g.b, 0.98 * g.b, n)
                    value = self.off(g.at(k, side, radius, height)) + self.err(n) + (0 if self.way == "c" else r.normal(0, 15))
                    rows += [f"{record},{k + 1},{g.side_name(side)},{2 * a:.6f},{b:.5f},{c:.4f}" for a, b, c in zip(radius, height, value)]
        for side in (1, -1) if self.way in "tac" else ():
            value = self.off(g.at(numpy.arange(g.z), side, g.middle, 0.5 * g.b)) + self.err(g.z, 0.6)
            if self.way != "c":
                value = value - value[0]
            rows += [f"index,{k + 1},{g.side_name(side)},{2 * g.middle:.6f},{0.5 * g.b:.5f},{c:.4f}" for k, c in enumerate(value)]
        return rows

    def cloud(self):
        g, r, parts = self.gear, self.random, []
        each = 9000 // (2 * g.z)
        for k in range(g.z):
            for side in (1, -1):
                p = g.at(k, side, numpy.hypot(r.uniform(g.low, g.high, each), g.rb), numpy.sort(r.uniform(0.01, 0.99, each)) * g.b)
                d = 1e-3 * (self.off(p) + self.err(each))
                parts.append(numpy.array([p.x + p.nx * d, p.y + p.ny * d, p.z + p.nz * d]))
        points = numpy.concatenate(parts, axis=1)
        if self.way == "f":  # lies somewhere, a little askew, turned by any angle
            a, b, c = r.uniform(0, TAU), *r.normal(0, 0.2, 2)
            about = [numpy.array([[cos(a), -sin(a), 0], [sin(a), cos(a), 0], [0, 0, 1]]), numpy.array([[1, 0, 0], [0, cos(b), -sin(b)], [0, sin(b), cos(b)]]),
                     numpy.array([[cos(c), 0, sin(c)], [0, 1, 0], [-sin(c), 0, cos(c)]])]
            points = about[0] @ about[1] @ about[2] @ points + r.uniform(-200, 200, (3, 1))
        return ["x_mm,y_mm,z_mm", *(f"{a:.5f},{b:.5f},{c:.5f}" for a, b, c in points.T)]

    def label(self):
        return f"{self.kind}-{self.number} {self.gear_name} [{self.way}, {self.errors} {self.sigma:.2f}, {self.drawn.a:.1f} um, flank {self.drawn.flank}]"

    def run(self, program, folder):
        where = folder / f"{self.kind}-{self.number}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.toml())
        (where / "data.csv").write_text("\n".join(self.cloud() if self.scanned else self.traced()) + "\n")
        self.noise = float(numpy.sqrt(numpy.mean(numpy.concatenate(self.made) ** 2)))
        return trial.close_loop(self, program, where, "part.toml", "data.csv", *["--aligned"] * (self.way == "s"))

    def judge(self):
        """What is wrong; empty: nothing."""
        a = self.answer
        before, after = (a[when]["held_out_rms_um"] for when in ("before", "after"))
        if None not in (before, after) and after > 1.0001 * before:
            return "worse"
        if a["verdict"] == "explained" and after is not None and after > 1.2 * self.noise:
            return f"called explained at {after / self.noise:.2f} of the noise"
        if self.what == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        names = [{e["id"], *e["confounded_with"]} for e in a["effects"] if e["named"]]
        if self.what == "name":
            if not any(self.kind in ids for ids in names):
                return "not named"
            return "" if all(self.kind in ids for ids in names) else f"named too: {[sorted(ids) for ids in names if self.kind not in ids]}"
        fair = set(FORMS[self.kind][4].split())
        wrong = [e["id"] for e in a["effects"] if e["named"] and e["explained_fraction"] > 0.03 and not fair & {e["id"], *e["confounded_with"]}]
        if wrong:
            return f"misnamed {wrong}"
        if not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        # A scan in any pose may lie upside down: its flanks change sides.
        text = json.dumps([[e["sentence"], e["description"], e.get("terms", [])] for e in a["effects"]] + [a["structure_left"]["description"]])
        said = [word for word in FORMS[self.kind][3] if not re.search(word, text)]
        return f"does not say {said}" if said and self.way != "f" else ""

    def held(self):
        """How many intervals hold, and of how many."""
        hold = asked = 0
        if self.what != "name" or not self.right:
            return hold, asked
        for effect in (e for e in self.answer["effects"] if e["id"] == self.kind):
            for key, true in NAMES[self.kind][2](self.drawn).items():
                told = effect["parameters"][key]
                if key == "phase_deg":
                    true += 360 * round((told["value"] - true) / 360)
                asked += 1
                hold += told["ci95"][0] <= true <= told["ci95"][1]
        return hold, asked

    def line(self):
        head = "" if self.right else "WRONG "
        if self.answer is None:
            return f"{head}{self.label()}: {self.why}"
        a = self.answer
        told = "; ".join(f"{e['id']} {e['explained_fraction']:.2f}" + ("" if e["named"] else " {" + e["description"][:150] + "}") for e in a["effects"])
        return f"{head}{self.label()}: {self.why} | {a['verdict']} | {told} | {a['structure_left']['description'][:120]} | {self.seconds:.1f}s"


def main():
    o = trial.words(every=(1, "only every n-th kind"))
    kinds = [*((k, "form") for k in FORMS), *((k, "name") for k in NAMES), *((f"nothing_{i}", "nothing") for i in range(10))]
    cases = [Case(i, o.seed, kind, what) for kind, what in kinds[::o.every] if o.only in kind for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind, "all " + c.what), after=trial.tell_intervals)


if __name__ == "__main__":
    main()
