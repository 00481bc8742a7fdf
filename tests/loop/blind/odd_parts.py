# SPDX-License-Identifier: GPL-3.0-or-later
"""What a workshop does to gears and a measuring room to data, other than in hidden.py and strange.py: warming up,
arbors, clamps, hobs, chatter that sets in, worn tools, knocks, quenching, supports, layers, machines and probes that
drift, noise that is not the same everywhere. Gear, noise and files are those of made.py.
Usage: odd_parts.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE] [--every N]
An answer is right where:
  nothing   no_effect
  known     each wanted name (or one the program says it cannot be told from) and no other; intervals are counted
  unknown   seen; no name but those allowed; a held-out error within 1.2 of the true noise or said to be more
  never     the held-out error rises, or `noise_um` is off the true one by more than a third
Where the form has a place (tooth, height, flank, wavelength) it is asked whether the answer says it (`place`)."""
import json
import math

import numpy

import blind
import made
import trial

FLANK = {1: "left", -1: "right"}


class Form:
    """form(tooth, side, u, v) in um; how it is judged, names wanted or allowed, truth of parameters, its place."""

    def __init__(self, form, how="unknown", names=(), truth=None, place=None, noise_of=None, flanks=None, also=()):
        self.form, self.how, self.names, self.truth = form, how, set(names), truth or {}
        self.place, self.noise_of, self.flanks = place or {}, noise_of, flanks
        # What is in it too: the middle of the measured flank is not that of the whole one; a form has a mean.
        self.also = set(also)


def one_or_both(r):
    return (1, -1) if r.integers(0, 3) == 0 else ((1,) if r.integers(0, 2) else (-1,))


def smooth_step(x, wide):
    return 0.5 * (1.0 + numpy.tanh(x / wide))


# ---- nothing
def quiet(g, r, s):
    return Form(lambda k, side, u, v: 0.0 * u, "nothing")


def noisier_flank(g, r, s):
    """The probe's arm bends on one flank: its noise is twice the other's."""
    loud = int(r.choice([-1, 1]))
    return Form(lambda k, side, u, v: 0.0 * u, "nothing", noise_of=lambda k, side, u, v: numpy.full(u.shape, 1.3 if side == loud else 0.65))


def noisier_tips(g, r, s):
    """Grazing light: more noise towards the tip."""
    return Form(lambda k, side, u, v: 0.0 * u, "nothing", noise_of=lambda k, side, u, v: 0.6 + 0.3 * (1.0 + u))


def noisier_teeth(g, r, s):
    """Seen from afar: some teeth are measured worse than others."""
    by = r.uniform(0.7, 1.4, g.teeth + 1)
    return Form(lambda k, side, u, v: 0.0 * u, "nothing", noise_of=lambda k, side, u, v: numpy.full(u.shape, by[k]))


# ---- with names
def wobbling_arbor(g, r, s):
    """The gear sat askew and off centre."""
    e, t, a, b = s * r.uniform(4, 10), s * r.uniform(4, 10), *r.uniform(0, 2 * math.pi, 2)
    return Form(lambda k, side, u, v: e * numpy.cos(g.normal_angle(k, side, u) - a) + t * v * numpy.cos(g.normal_angle(k, side, u) - b),
                "known", {"eccentricity", "axis_tilt"}, {"eccentricity.amplitude_um": e})


def three_jaws(g, r, s):
    """Bored in three jaws: out of round three times, and a little off centre."""
    um, e, a, b = s * r.uniform(5, 12), s * r.uniform(4, 8), *r.uniform(0, 2 * math.pi, 2)

    def form(k, side, u, v):
        _, angle = g.point(k, side, u)
        n = g.normal_angle(k, side, u)
        return um * numpy.cos(3 * angle - a) * numpy.cos(n - angle) + e * numpy.cos(n - b)
    return Form(form, "known", {"lobing", "eccentricity"}, {"eccentricity.amplitude_um": e})


def worm_of_table(g, r, s):
    """The table's worm: a pitch error many times a turn."""
    um, n, a = s * r.uniform(4, 9), int(r.integers(3, max(4, min(12, g.teeth // 3)))), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: side * um * math.cos(n * g.centre(k) - a) + 0.0 * u, "known", {"pitch_wave"}, {"pitch_wave.amplitude_um": um})


def twist_and_crown(g, r, s):
    """Ground with a crowning: the flank twists, as it does by nature."""
    c, t = s * r.uniform(5, 10), s * r.uniform(5, 10) * r.choice([-1, 1])
    return Form(lambda k, side, u, v: -c * v * v + t * u * v, "known", {"crowning", "flank_twist"}, {"crowning.amount_um": c}, also={"taper"})


def wrong_ball(g, r, s):
    """The ball's radius was entered wrong: every flank stands off by as much."""
    um = s * r.uniform(3, 10) * r.choice([-1, 1])
    return Form(lambda k, side, u, v: um + 0.0 * u, "known", {"tooth_thickness"})


def lead_and_relief(g, r, s):
    h, t, a = s * r.uniform(5, 12) * r.choice([-1, 1]), s * r.uniform(9, 18), r.uniform(0.25, 0.5)
    return Form(lambda k, side, u, v: 0.5 * h * v * side - t * (numpy.maximum(u - a, 0.0) / (1 - a)) ** 2, "known", {"helix_error", "tip_relief"})


# ---- without
def warming_blank(g, r, s):
    """The blank grows while it is cut, quickly at first."""
    um, first, tau = s * r.uniform(8, 16), int(r.integers(0, g.teeth)), r.uniform(0.15, 0.5)
    return Form(lambda k, side, u, v: um * (1 - math.exp(-((k + first) % g.teeth) / g.teeth / tau)) + 0.0 * u)


def wandering_machine(g, r, s):
    """The measuring room's air: all readings wander with the time of day."""
    um, a, turns = s * r.uniform(5, 10), r.uniform(0, 2 * math.pi), r.uniform(0.6, 1.7)
    return Form(lambda k, side, u, v: um * math.sin(2 * math.pi * turns * (k + 0.3 * side) / g.teeth + a) + 0.0 * u,
                names={"pitch_wave", "eccentricity", "lobing", "scale_xy", "skew", "tooth_thickness"})


def hob_lead(g, r, s):
    """The hob's lead wavers: waves over the roll, the wavelength near the base pitch."""
    um, a = s * r.uniform(6, 12), r.uniform(0, 2 * math.pi)
    wave = math.pi * g.module * math.cos(math.radians(20)) * r.uniform(0.5, 0.9)
    return Form(lambda k, side, u, v: um * numpy.sin(2 * math.pi * 0.5 * (u + 1) * (g.high - g.low) / wave + a), names={"profile_crowning", "pressure_angle_error"})


def marching_marks(g, r, s):
    """Feed marks of a hob: their phase marches from tooth to tooth, one feed a turn."""
    um, waves, a, on = s * r.uniform(3, 8), r.uniform(6, 14), r.uniform(0, 2 * math.pi), one_or_both(r)
    return Form(lambda k, side, u, v: um * numpy.sin(math.pi * waves * v + side * g.centre(k) + a + 0.0 * u) * (side in on),
                place={"wavelength_mm": (g.face / waves, 0.1)}, flanks=on,
                names={"eccentricity", "pitch_wave"})  # what the pitch shows of them


def late_chatter(g, r, s):
    """Chatter sets in at a tooth and stays."""
    um, waves, at, on = s * r.uniform(5, 10), r.uniform(7, 14), int(r.integers(g.teeth // 4, 3 * g.teeth // 4)), one_or_both(r)
    phases = r.uniform(0, 2 * math.pi, g.teeth + 1)
    return Form(lambda k, side, u, v: um * numpy.sin(math.pi * waves * v + phases[k] + 0.0 * u) * (k >= at) * (side in on))


def half_chatter(g, r, s):
    """Waves on the upper part of the face only."""
    um, waves, at, a = s * r.uniform(5, 10), r.uniform(8, 16), r.uniform(-0.2, 0.3), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: um * numpy.sin(math.pi * waves * v + a + 0.0 * u) * (v > at))


def broken_tool(g, r, s):
    """From one tooth on the tool has lost its edge: all flanks after it are hollow."""
    um, at = s * r.uniform(8, 16), int(r.integers(g.teeth // 4, 3 * g.teeth // 4))
    return Form(lambda k, side, u, v: -um * (1 - u * u) * (k >= at))


def scratch(g, r, s):
    """One flank was scratched from root to tip."""
    um, tooth, side0, at, wide = s * r.uniform(20, 60), int(r.integers(1, g.teeth + 1)), int(r.choice([-1, 1])), r.uniform(-0.6, 0.6), r.uniform(0.06, 0.12)
    return Form(lambda k, side, u, v: -um * numpy.exp(-((v - at) / wide) ** 2) * (k == tooth) * (side == side0) + 0.0 * u,
                place={"tooth": tooth, "height_mm": (0.5 * (at + 1) * g.face, 0.1 * g.face)}, flanks=(side0,))


def slanting_scratch(g, r, s):
    um, tooth, side0, at, lean = s * r.uniform(25, 60), int(r.integers(1, g.teeth + 1)), int(r.choice([-1, 1])), r.uniform(-0.4, 0.4), r.uniform(-0.6, 0.6)
    return Form(lambda k, side, u, v: -um * numpy.exp(-((v - at - lean * u) / 0.12) ** 2) * (k == tooth) * (side == side0),
                place={"tooth": tooth}, flanks=(side0,))


def potato_chip(g, r, s):
    """Quenched: the disc warps like a saddle, and the leads lean twice a turn."""
    um, a = s * r.uniform(6, 14), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: um * v * side * math.cos(2 * g.centre(k) - a) + 0.0 * u)


def hanging_web(g, r, s):
    """A thin web: the middle of the face gives way, twice a turn more."""
    um, a, order = s * r.uniform(6, 14), r.uniform(0, 2 * math.pi), int(r.integers(2, 5))
    return Form(lambda k, side, u, v: -um * (1 - v * v) * (1 + 0.8 * math.cos(order * g.centre(k) - a)) + 0.0 * u, names={"crowning", "tooth_thickness", "contour_offset"})


def support_scars(g, r, s):
    """Supports broken off below: rough lower ends on the teeth that hung over."""
    um, first, count = s * r.uniform(12, 30), int(r.integers(0, g.teeth)), max(3, g.teeth // 5)
    high = r.uniform(0.3, 1.0, (g.teeth + 1, 2))
    return Form(lambda k, side, u, v: um * high[k, (side + 1) // 2] * (v < -0.75) * ((k - first) % g.teeth < count) + 0.0 * u)


def layers(g, r, s):
    """Printed layers: teeth of a saw over the height."""
    um, n, a = s * r.uniform(4, 9), r.uniform(6, 14), r.uniform(0, 1)
    return Form(lambda k, side, u, v: um * (2 * ((n * 0.5 * (v + 1) + a) % 1.0) - 1) + 0.0 * u, place={"wavelength_mm": (g.face / n, 0.1)})


def jump_of_layers(g, r, s):
    """The print's head lost steps: everything above a height stands to one side."""
    um, at, a = s * r.uniform(8, 20), r.uniform(-0.5, 0.5), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: um * (v > at) * numpy.cos(g.normal_angle(k, side, u) - a), "known", {"layer_shift"},
                {"layer_shift.amplitude_um": um})


def melted_end(g, r, s):
    """Cooled too slowly at the end: the last tenth of the height sags on one side of the gear."""
    um, a = s * r.uniform(15, 30), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: -um * smooth_step(v - 0.75, 0.08) * max(0.0, math.cos(g.centre(k) - a)) + 0.0 * u)


def broken_corner(g, r, s):
    """One tooth has lost a corner."""
    um, tooth, side0, end = s * r.uniform(40, 120), int(r.integers(1, g.teeth + 1)), int(r.choice([-1, 1])), int(r.choice([-1, 1]))
    return Form(lambda k, side, u, v: -um * numpy.maximum(0.0, (u + end * v - 1.0)) * (k == tooth) * (side == side0), place={"tooth": tooth}, flanks=(side0,))


def keyway(g, r, s):
    """The wall over the keyway gave way under the cutter: a few teeth stand proud."""
    um, at, wide = s * r.uniform(8, 16), r.uniform(0, g.teeth), r.uniform(1.5, 3.0)

    def form(k, side, u, v):
        off = abs((k - at + g.teeth / 2) % g.teeth - g.teeth / 2) / wide
        return um * math.exp(-off * off) + 0.0 * u
    return Form(form, place={"near_tooth": (at, 3.0)}, names={"single_tooth"})


def worm_starts(g, r, s):
    """A grinding worm of several starts, one of which was dressed askew: every n-th tooth leans over the profile."""
    counts = [n for n in (2, 3, 4, 5, 6) if g.teeth % n == 0] or [3]
    um, n = s * r.uniform(8, 14), int(r.choice(counts))
    at = int(r.integers(0, n))
    return Form(lambda k, side, u, v: um * u * (k % n == at))


def random_walk(g, r, s):
    """Every pitch errs by itself, and the errors add up."""
    walk = numpy.cumsum(r.standard_normal(g.teeth + 1)) * s * 2.0
    walk -= numpy.linspace(walk[0], walk[-1], g.teeth + 1)
    return Form(lambda k, side, u, v: side * walk[k] + 0.0 * u, names={"pitch_wave", "eccentricity"})


def quenched_crowns(g, r, s):
    """Every tooth bows by itself."""
    bow = s * r.uniform(5, 9) * r.standard_normal(g.teeth + 1)
    return Form(lambda k, side, u, v: bow[k] * v * v + 0.0 * u, names={"crowning"})


def spiral_seam(g, r, s):
    """The layers' beginnings wander up one tooth."""
    um, tooth, side0, a, lean = s * r.uniform(20, 50), int(r.integers(1, g.teeth + 1)), int(r.choice([-1, 1])), r.uniform(-0.3, 0.3), r.uniform(-0.5, 0.5)
    return Form(lambda k, side, u, v: um * numpy.exp(-((u - a - lean * v) / 0.2) ** 2) * (k == tooth) * (side == side0), place={"tooth": tooth}, flanks=(side0,))


def one_flank_bow(g, r, s):
    """S over the face of the flanks that were ground last."""
    um, side0 = s * r.uniform(6, 12), int(r.choice([-1, 1]))
    return Form(lambda k, side, u, v: um * numpy.sin(math.pi * v) * (side == side0) + 0.0 * u, flanks=(side0,))


def two_waves(g, r, s):
    """Slopes once a turn over the profile, twice over the face: a gear cut and ground in different clamps."""
    p, f, a, b = s * r.uniform(5, 10), s * r.uniform(5, 10), *r.uniform(0, 2 * math.pi, 2)
    return Form(lambda k, side, u, v: p * u * math.cos(g.centre(k) - a) + f * v * math.cos(2 * g.centre(k) - b), names={"eccentricity", "axis_tilt"})


def drift_of_scanner(g, r, s):
    """The scanner warms up: values drift with the time of the scan."""
    um = s * r.uniform(5, 10) * r.choice([-1, 1])
    return Form(lambda k, side, u, v: um * (1 - math.exp(-3.0 * (k - 1 + 0.25 * (1 - side)) / g.teeth)) + 0.0 * u)


def shot_peened(g, r, s):
    """A stop of the peening: the lower half is rougher and stands lower."""
    um, at = s * r.uniform(5, 12), r.uniform(-0.4, 0.4)
    return Form(lambda k, side, u, v: -um * smooth_step(at - v, 0.04) + 0.0 * u, place={"place_mm": (0.5 * (at + 1) * g.face, 0.06 * g.face)})


def hob_marks(g, r, s):
    """A hob out of true: its feed marks run slanting over the flanks, the same on every tooth."""
    um, over, up, a = s * r.uniform(4, 10), r.uniform(1.0, 3.0) * r.choice([-1, 1]), r.uniform(4, 10), r.uniform(0, 2 * math.pi)
    return Form(lambda k, side, u, v: um * numpy.sin(math.pi * (over * (u + 1) + up * (v + 1)) + a))


def loose_belt(g, r, s):
    """A printer's belt or lead screw: a wave in one direction of space, some times over the gear."""
    um, a, per_turn = s * r.uniform(6, 15), r.uniform(0, 2 * math.pi), r.uniform(0.3, 0.7)

    def form(k, side, u, v):
        radius, angle = g.point(k, side, u)
        return um * numpy.sin(2 * math.pi * radius * numpy.cos(angle) / (per_turn * g.reference) + a) * numpy.cos(g.normal_angle(k, side, u))
    return Form(form, names={"pitch_wave", "lobing", "scale_xy", "eccentricity"})


def each_by_itself(g, r, s):
    """An indexing head with play: every flank stands by itself."""
    off = s * r.uniform(2, 6) * r.standard_normal((g.teeth + 1, 2))
    return Form(lambda k, side, u, v: off[k, (side + 1) // 2] + 0.0 * u, names={"single_tooth", "pitch_wave", "eccentricity"})


# n: t traces, a traces of all teeth, c those with an index or a common zero, s scans
KINDS = [(quiet, "tcs"), (noisier_flank, "ts"), (noisier_tips, "s"), (noisier_teeth, "as"), (wobbling_arbor, "s"), (three_jaws, "cs"), (worm_of_table, "cs"),
         (twist_and_crown, "s"), (wrong_ball, "s"), (lead_and_relief, "ts"), (jump_of_layers, "s"), (warming_blank, "cs"),
         (wandering_machine, "cs"), (hob_lead, "ts"), (marching_marks, "ts"), (late_chatter, "a"), (half_chatter, "ts"), (broken_tool, "as"), (scratch, "a"),
         (slanting_scratch, "s"), (potato_chip, "as"), (hanging_web, "as"), (support_scars, "as"), (layers, "ts"), (melted_end, "as"), (broken_corner, "s"),
         (keyway, "cs"), (worm_starts, "as"), (random_walk, "c"), (quenched_crowns, "as"), (spiral_seam, "s"), (one_flank_bow, "ts"), (two_waves, "s"),
         (drift_of_scanner, "s"), (shot_peened, "ts"), (hob_marks, "s"), (loose_belt, "s"), (each_by_itself, "s")]


class Case:
    def __init__(self, number, seed, kind, ways):
        r = numpy.random.default_rng([seed, 29, [k for k, _ in KINDS].index(kind), number])
        self.kind, self.number, self.random = kind, number, r
        self.gear = blind.draw_gear(r)
        self.plan = blind.draw_plan(r, self.gear, ways)
        if "c" in ways and not self.plan["scan"] and not self.plan["common_zero"]:
            self.plan["index"] = True
        self.noise = made.Noise(float(r.uniform(2.0, 6.0) if self.plan["scan"] else r.uniform(0.3, 1.5)),
                                str(r.choice(["white", "white", "ar", "heavy", "smooth"])))
        self.hidden = kind(self.gear, r, self.noise.sigma)
        if self.hidden.noise_of:
            self.noise.kind = "white"

    def label(self):
        p = self.plan
        data = f"scan {p['scan']}" if p["scan"] else (f"{len(p['teeth'])} teeth x {p['points']}" + " index" * p["index"] + " common" * p["common_zero"])
        return f"{self.kind.__name__}-{self.number:02d} z{self.gear.teeth} [{data}, {self.noise.kind} {self.noise.sigma:.2f}]"

    def form(self, k, side, u, v):
        value = self.hidden.form(k, side, u, v) + 0.0 * u
        if self.hidden.noise_of:  # what made.Noise adds is small beside it
            value = value + self.loud * self.hidden.noise_of(k, side, u, v) * self.random.standard_normal(numpy.shape(u))
        return value

    def run(self, program, folder):
        where = folder / f"{self.kind.__name__}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.design())
        if self.hidden.noise_of:
            self.loud, self.noise.sigma = self.noise.sigma, 1e-3 * self.noise.sigma
        data = (made.scan if self.plan["scan"] else made.spots)(self.gear, self.random, self.noise, self.form, self.plan)
        if self.hidden.noise_of:
            self.noise.sigma = self.loud
        (where / "data.csv").write_text(data)
        return trial.close_loop(self, program, where, "part.toml", "data.csv", *["--aligned"] * bool(self.plan["scan"]))

    def judge(self):
        """What is wrong; empty: nothing."""
        a, h = self.answer, self.hidden
        named = [e for e in a["effects"] if e["named"]]
        alike = [{e["id"], *e["confounded_with"]} for e in named]
        after, before = a["after"]["held_out_rms_um"], a["before"]["held_out_rms_um"]
        if after is not None and after > 1.0001 * before:
            return "worse"
        if h.how == "nothing":
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        if not 0.75 <= a["data"]["noise_um"] / self.noise.sigma <= 1.33 and a["verdict"] == "explained":
            return f"noise told {a['data']['noise_um'] / self.noise.sigma:.2f} of the true one"
        wrong = [e["id"] for e, one in zip(named, alike) if not one & (h.names | h.also)]
        if wrong:
            return f"misnamed {wrong}"
        missing = [n for n in h.names if not any(n in one for one in alike)]
        if h.how == "known" and (missing or len(named) != len(a["effects"])):
            return f"names {[e['id'] for e in a['effects']]}"
        if a["verdict"] == "explained" and after is not None and after > 1.2 * self.noise.sigma:
            return "called explained"
        if a["verdict"] == "partly_explained" and not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def placed(self):
        """Whether the answer says the place; None: the form has none, or it was not seen."""
        h = self.hidden
        if self.answer is None or not h.place or not self.right:
            return None
        terms = [t for e in self.answer["effects"] for t in e.get("terms", [])]
        found = [{**t, "flank": e["flank"]} for e in self.answer["effects"] for t in e.get("terms", [])]
        text = json.dumps([terms, self.answer["structure_left"]["description"], [e["parameters"] for e in self.answer["effects"]]])
        for key, value in h.place.items():
            if key == "tooth":
                if f'"tooth": {value}' not in text and f"tooth {value}" not in text and not any(
                        e["id"] == "single_tooth" and e["parameters"]["tooth"]["value"] == value for e in self.answer["effects"]):
                    return False
            elif key == "near_tooth":
                close = [t for t in terms if "tooth" in t or "first_tooth" in t]
                z = self.gear.teeth

                def off(t):
                    at = t.get("tooth", t.get("first_tooth", 0) + 0.5 * (t.get("teeth", 1) - 1))
                    return abs((at - value[0] + z / 2) % z - z / 2)
                if not any(off(t) <= value[1] for t in close):
                    return False
            elif key == "wavelength_mm":
                if not any(abs(t.get("wavelength_mm", 0) / value[0] - 1) < value[1] for t in terms) and "mm long" not in text:
                    return False
            elif not any(abs(t.get(key, t.get("place_mm", -1e9)) - value[0]) <= value[1] for t in terms):
                return False
        return True if not h.flanks or len(h.flanks) == 2 else any(
            t["flank"] in (FLANK[h.flanks[0]], "both") for t in found) or FLANK[h.flanks[0]] in text

    def intervals(self):
        held = asked = 0
        if self.answer is None or not self.right:
            return 0, 0
        for key, value in self.hidden.truth.items():
            name, parameter = key.split(".")
            for e in self.answer["effects"]:
                if e["id"] == name and parameter in e["parameters"]:
                    low, high = e["parameters"][parameter]["ci95"]
                    held, asked = held + (low <= value <= high), asked + 1
        return held, asked

    def line(self):
        a = self.answer
        if a is None:
            return f"WRONG {self.label()}: {self.why}"
        told = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:150] + "}") for e in a["effects"])
        held = [a[k]["held_out_rms_um"] or float("nan") for k in ("before", "after")]
        return (f"{'' if self.right else 'WRONG '}{'' if self.placed() in (None, True) else 'UNPLACED '}{self.label()}: {self.why} | {a['verdict']} "
                f"noise {a['data']['noise_um'] / self.noise.sigma:.2f} held {held[0] / self.noise.sigma:.2f} -> {held[1] / self.noise.sigma:.2f} | {told} | "
                f"{a['structure_left']['description'][:160]} p {a['structure_left']['p_value']:.3g} | place {self.hidden.place} {self.seconds:.1f}s")


def main():
    o = trial.words(every=(1, "only every n-th kind"))
    cases = [Case(i, o.seed, kind, ways) for kind, ways in KINDS[::o.every] if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind.__name__, "all " + c.hidden.how), worth_a_line=lambda c: c.placed() is False,
                   counts=lambda c: (int(c.placed() is True), int(c.placed() is not None)),
                   columns="| hidden | right | of | place told | of |", after=lambda done: trial.tell_intervals(done, lambda case: case.intervals()))


if __name__ == "__main__":
    main()
