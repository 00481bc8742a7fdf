# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks that machines, moulds, printers and gauges leave on gears and in their records, of kinds the other trials
lack, and pure nothing with awkward errors. The gear is rolled out here: a flank is a curve turned along its helix.
Usage: makers_marks.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE] [--every N]
Right: nothing: no_effect. A mark: seen, no name but those that are a part of it, what is left on held-out data within
1.2 of the true error or said to be more. Never: an error on held-out data that rises; `explained` or `no_effect` with
a noise off by a third. `place`: what the answer must say of where it is, counted apart."""
import json
import math

import numpy

import trial

TAU = 2.0 * math.pi
SIDE = {1: "left", -1: "right"}


class Wheel:
    """External; a flank is given by u over the roll length and v over the face, both -1 ... 1."""

    def __init__(self, r):
        self.z = int(r.choice([11, 14, 18, 20, 25, 30, 37, 45, 58, 72]))
        self.m = float(r.choice([1.0, 1.5, 2.0, 3.0]))
        self.lean = math.radians(float(r.choice([0, 0, 0, 12, -18])))
        self.x = round(float(r.uniform(0.0, 0.25) + 0.3 * (self.z < 18)), 3)
        self.b = float(r.choice([7.0, 11.0, 18.0]))
        self.r = 0.5 * self.m * self.z / math.cos(self.lean)
        at = math.atan(math.tan(math.radians(20)) / math.cos(self.lean))
        self.rb = self.r * math.cos(at)
        self.cos_base = math.cos(math.asin(math.sin(self.lean) * math.cos(math.radians(20))))
        self.half = self.m * (0.5 * math.pi + 2 * self.x * math.tan(math.radians(20))) / (2 * self.r * math.cos(self.lean)) + math.tan(at) - at
        ends = max(self.r + self.m * (self.x - 0.72), 1.005 * self.rb), self.r + self.m * (self.x + 0.92)
        self.roll = [math.sqrt(e * e - self.rb**2) for e in ends]
        self.u_mid = 2 * (self.rb * math.tan(at) - self.roll[0]) / (self.roll[1] - self.roll[0]) - 1

    def at(self, k):
        return TAU * (k - 1) / self.z

    def length(self, u):
        return self.roll[0] + 0.5 * (u + 1) * (self.roll[1] - self.roll[0])

    def radius(self, u):
        return numpy.hypot(self.rb, self.length(u))

    def height(self, v):
        return 0.5 * (v + 1) * self.b

    def foot(self, k, side, u, v):
        """Angle at which the line of action leaves the base circle."""
        return self.at(k) + self.height(v) * math.tan(self.lean) / self.r + side * (self.half - self.length(u) / self.rb)

    def place(self, k, side, u, v, um):
        """Points that stand `um` along the normal off the flank."""
        a, l = self.foot(k, side, u, v), self.length(u) + 1e-3 * um / self.cos_base
        return self.rb * numpy.cos(a) - side * l * numpy.sin(a), self.rb * numpy.sin(a) + side * l * numpy.cos(a), self.height(v)

    def normal(self, k, side, u, v):
        return self.foot(k, side, u, v) + side * 0.5 * math.pi

    def toml(self):
        return (f'format = 1\nname = "part"\n\n[gearbox]\nkind = "gear"\nmodule_mm = {self.m}\nhelix_angle_deg = {math.degrees(self.lean):.6f}\n'
                f"\n[gear]\nteeth = {self.z}\nshift = {self.x}\nface_width_mm = {self.b}\n")


class Mark:
    """off(k, side, u, v) in um; names that are a part of it; of where it must be told."""

    def __init__(self, off=None, names=(), place=None, errors=None, loud=None):
        self.off = off or (lambda k, side, u, v: 0.0 * u)
        self.nothing, self.names, self.place = off is None, set(names), place or {}
        self.errors, self.loud = errors, loud or (lambda k, side, u, v: 1.0)


def sign(r):
    return float(r.choice([-1.0, 1.0]))


def phase(r):
    return float(r.uniform(0, TAU))


def apart(w, k, at):
    """Angle from `at` to tooth k, -pi ... pi."""
    return (w.at(k) - at + math.pi) % TAU - math.pi


# ---- chucks and machines
def jaws_at_one_face(w, r, s):
    """Three jaws squeezed the lower end of the blank alone."""
    um, a, reach = s * r.uniform(10, 22), phase(r), r.uniform(0.3, 0.7)
    return Mark(lambda k, side, u, v: um * numpy.exp(-(v + 1) / reach) * numpy.cos(3 * w.at(k) - a) * numpy.cos(w.normal(k, side, u, v) - w.at(k)),
                {"lobing"})


def loose_table(w, r, s):
    """The table's play was taken up at one tooth: from there on all stand to one side, until the first."""
    um, at = s * r.uniform(7, 14) * sign(r), int(r.integers(w.z // 4, 3 * w.z // 4))
    return Mark(lambda k, side, u, v: side * um * (k >= at) + 0.0 * u)


def grows_while_read(w, r, s):
    """The gear warms up in the room while its pitch is read, one flank after the other."""
    um, tau = s * r.uniform(9, 18), r.uniform(0.2, 0.6)

    def off(k, side, u, v):
        t = (k - 1) / w.z + (side < 0)
        return side * um * (1 - math.exp(-t / tau)) + 0.0 * u
    return Mark(off)


def modulated_table(w, r, s):
    """The worm of the table errs once its turn, and it runs out of true against its wheel: the error swells once a turn."""
    um, n, a, b = s * r.uniform(6, 12), int(r.integers(4, max(5, w.z // 3))), phase(r), phase(r)
    return Mark(lambda k, side, u, v: side * um * (1 + 0.8 * math.cos(w.at(k) - b)) * math.cos(n * w.at(k) - a) + 0.0 * u, {"pitch_wave"})


def worn_ball(w, r, s):
    """The probe's ball wears along the record: the later a tooth is read, the more its tip seems to fall back."""
    um = s * r.uniform(10, 20)
    return Mark(lambda k, side, u, v: -um * ((k - 1) / (w.z - 1)) * 0.5 * (1 + u), {"pressure_angle_error"})


def kinked_dresser(w, r, s):
    """The dresser was set anew at one roll: from there the flank stands up straight to the tip."""
    um, a = s * r.uniform(8, 15), r.uniform(-0.3, 0.35)
    return Mark(lambda k, side, u, v: um * numpy.maximum(u - a, 0.0) / (1 - a), {"pressure_angle_error", "profile_crowning"})


def burned_ends(w, r, s):
    """Ground too hot where the wheel enters and leaves: both ends of the face have swollen."""
    um, reach = s * r.uniform(9, 18), r.uniform(0.07, 0.16)
    return Mark(lambda k, side, u, v: um * (numpy.exp(-(1 - v) / reach) + numpy.exp(-(1 + v) / reach)), {"crowning"})


def two_hobs(w, r, s):
    """Part of the teeth were finished with another tool: their profiles lean."""
    um, at, count = s * r.uniform(8, 15) * sign(r), int(r.integers(0, w.z)), int(r.integers(max(3, w.z // 4), 2 * w.z // 3))
    return Mark(lambda k, side, u, v: um * u * ((k - 1 - at) % w.z < count), {"pressure_angle_error"})


def swelling_feed(w, r, s):
    """Feed marks that grow towards the end of the cut."""
    um, waves, a = s * r.uniform(6, 12), r.uniform(7, 13), phase(r)
    return Mark(lambda k, side, u, v: um * 0.5 * (1 + v) * numpy.sin(math.pi * waves * v + a + 0.0 * u),
                place={"wavelength_mm": (w.b / waves, 0.12)})


# ---- printers and moulds
def spiral_seam(w, r, s):
    """Every layer's seam lies a little further round: a ridge that climbs around the gear from flank to flank."""
    um, a, turns, wide = s * r.uniform(14, 30), phase(r), r.uniform(0.15, 0.5) * sign(r), r.uniform(0.6, 1.2) * TAU / w.z
    return Mark(lambda k, side, u, v: um * numpy.exp(-((((w.at(k) - a - TAU * turns * 0.5 * (v + 1)) + math.pi) % TAU - math.pi) / wide) ** 2) + 0.0 * u,
                {"single_tooth"})


def lifted_corner(w, r, s):
    """A corner of the print came off the plate: over some teeth the lower end curls inwards."""
    um, a, wide, reach = s * r.uniform(14, 26), phase(r), r.uniform(0.5, 0.9), r.uniform(0.2, 0.4)
    return Mark(lambda k, side, u, v: -um * numpy.exp(-(v + 1) / reach) * math.exp(-(apart(w, k, a) / wide) ** 2) + 0.0 * u, {"elephant_foot"})


def weld_line(w, r, s):
    """Where the melt's fronts met the rim has sunk: a narrow notch over two or three teeth."""
    um, a, wide = s * r.uniform(12, 24), phase(r), r.uniform(0.9, 1.6) * TAU / w.z
    return Mark(lambda k, side, u, v: -um * math.exp(-(apart(w, k, a) / wide) ** 2) * numpy.cos(w.normal(k, side, u, v) - w.at(k)),
                {"single_tooth"}, {"near_tooth": (a / TAU * w.z + 1, 2.5)})


def sink_mark(w, r, s):
    """Opposite the gate the flanks' middles have sunk."""
    um, a, wide, h = s * r.uniform(10, 20), phase(r), r.uniform(0.5, 1.0), r.uniform(0.3, 0.5)
    return Mark(lambda k, side, u, v: -um * numpy.exp(-(u * u + v * v) / h**2) * math.exp(-(apart(w, k, a) / wide) ** 2), {"flank_wear"})


def burred_tips(w, r, s):
    """The cutter left a burr along the tips of the flanks where it came out."""
    um, side0, reach = s * r.uniform(14, 28), int(r.choice([-1, 1])), r.uniform(0.05, 0.10)
    return Mark(lambda k, side, u, v: um * numpy.exp((u - 1) / reach) * (side == side0), place={"flank": SIDE[side0]})


def mate_with_a_chip(w, r, s):
    """The mate has a chip: it dents every n-th tooth at the same spot."""
    ways = [n for n in (2, 3, 4, 5, 6) if w.z % n == 0] or [w.z]
    n, u0, v0, side0 = int(r.choice(ways)), r.uniform(-0.4, 0.4), r.uniform(-0.5, 0.5), int(r.choice([-1, 1]))
    um, first = s * r.uniform(15, 30), int(r.integers(0, n))
    return Mark(lambda k, side, u, v: -um * numpy.exp(-((u - u0) / 0.3) ** 2 - ((v - v0) / 0.25) ** 2) * (k % n == first) * (side == side0), {"flank_wear", "single_tooth"})


def two_views(w, r, s):
    """A scan put together of two views: one half of the gear stands beside the other."""
    um, a, d = s * r.uniform(5, 10), phase(r), phase(r)
    return Mark(lambda k, side, u, v: um * numpy.cos(w.normal(k, side, u, v) - d) * (abs(apart(w, k, a)) < 0.5 * math.pi), {"eccentricity"})


# ---- nothing, with awkward errors
def nothing(w, r, s):
    return Mark()


def nothing_grazing(w, r, s):
    """A light from one side: the errors of one half of the gear are three times those of the other."""
    a = phase(r)
    return Mark(loud=lambda k, side, u, v: (1 + 0.5 * math.cos(w.at(k) - a)) / math.sqrt(1.125))


def nothing_each_loud(w, r, s):
    """Every tooth's errors have a size of their own."""
    by = numpy.exp(0.4 * r.standard_normal(w.z + 1))
    by /= math.sqrt(numpy.mean(by[1:] ** 2))
    return Mark(loud=lambda k, side, u, v: by[k])


def nothing_bursts(w, r, s):
    return Mark(errors="bursts")


def nothing_flicker(w, r, s):
    return Mark(errors="flicker")


def nothing_filtered(w, r, s):
    """The gauge's own filter: a mean of three, of five, or a bell over seven values."""
    return Mark(errors=str(r.choice(["pairs", "fives", "bell"])))


def nothing_steps(w, r, s):
    return Mark(errors="steps")


def nothing_specks(w, r, s):
    return Mark(errors="specks")


def draw(r, kind, n):
    """Errors of values in a row, standard deviation 1."""
    e = r.standard_normal(n)
    if kind == "pairs":  # a filter of the gauge over three values
        return numpy.convolve(r.standard_normal(n + 2), numpy.array([1, 2, 1]) / math.sqrt(6), "valid")
    if kind == "fives":
        return numpy.convolve(r.standard_normal(n + 4), numpy.ones(5) / math.sqrt(5), "valid")
    if kind == "bell":
        bell = numpy.exp(-0.5 * (numpy.arange(-3, 4) / 1.3) ** 2)
        return numpy.convolve(r.standard_normal(n + 6), bell / math.sqrt(numpy.sum(bell**2)), "valid")
    if kind == "tails":
        return r.standard_t(5, n) / math.sqrt(5 / 3)
    if kind == "bursts":
        size = numpy.exp(0.7 * numpy.convolve(r.standard_normal(n + 14), numpy.ones(15) / math.sqrt(15), "valid"))
        return e * size / math.sqrt(math.exp(2 * 0.49))
    if kind == "flicker":  # as much in every octave, down to the row's length
        f = numpy.fft.rfftfreq(4 * n, 1.0)
        f[0] = f[1]
        y = numpy.fft.irfft(numpy.fft.rfft(r.standard_normal(4 * n)) / numpy.sqrt(f + 0.01))[:n]
        return y / math.sqrt(numpy.mean(1 / (f + 0.01)))
    if kind == "specks":
        return numpy.where(r.uniform(size=n) < 0.004, r.uniform(-25, 25, n), e)
    if kind == "steps":
        return 1.5 * numpy.round((e + r.uniform(-1, 1)) / 1.5)
    return e


# t: traces of some teeth, a: of all, i: all with an index, o: index alone, s: scan
KINDS = [(jaws_at_one_face, "ias"), (loose_table, "io"), (grows_while_read, "io"), (modulated_table, "ois"), (worn_ball, "ai"), (kinked_dresser, "tas"),
         (burned_ends, "tas"), (two_hobs, "as"), (swelling_feed, "tas"), (spiral_seam, "s"), (lifted_corner, "as"), (weld_line, "ois"), (sink_mark, "as"),
         (burred_tips, "tas"), (mate_with_a_chip, "s"), (two_views, "s"),
         (nothing, "taos"), (nothing_grazing, "as"), (nothing_each_loud, "tas"), (nothing_bursts, "tas"),
         (nothing_filtered, "tas"), (nothing_flicker, "ta"), (nothing_steps, "tao"), (nothing_specks, "as")]


class Case:
    def __init__(self, number, seed, kind, ways):
        self.kind, self.number = kind, number
        self.random = r = numpy.random.default_rng([seed, 83, *kind.__name__.encode(), number])
        self.wheel = w = Wheel(r)
        self.way = ways[number % len(ways)] if number < len(ways) else str(r.choice(list(ways)))
        self.sigma = float(r.uniform(2, 6) if self.way == "s" else r.uniform(0.3, 1.3))
        self.hidden = kind(w, r, self.sigma)
        self.errors = self.hidden.errors or ("white" if self.hidden.nothing else str(r.choice(["white", "white", "pairs", "tails"])))
        self.points = int(r.choice([5000, 9000, 15000])) if self.way == "s" else int(r.choice([48, 75, 120]))
        some = sorted(int(k) for k in 1 + r.choice(w.z, int(r.choice([4, 6, 9, 12 if w.z > 12 else 8])), replace=False))
        self.teeth = some if self.way == "t" else list(range(1, w.z + 1))

    def value(self, k, side, u, v, n):
        h = self.hidden
        return h.off(k, side, u, v) + h.loud(k, side, u, v) * self.sigma * draw(self.random, self.errors, n)

    def scan(self):
        w, r, rows = self.wheel, self.random, ["x_mm,y_mm,z_mm"]
        each = max(24, self.points // (2 * w.z))
        for k in range(1, w.z + 1):
            for side in (1, -1):
                u, v = r.uniform(-0.97, 0.97, each), r.uniform(-0.98, 0.98, each)
                line = numpy.lexsort((v, numpy.floor(4 * (u + 1))))
                u, v = u[line], v[line]
                rows += [f"{a:.6f},{b:.6f},{c:.6f}" for a, b, c in zip(*w.place(k, side, u, v, self.value(k, side, u, v, each)))]
        return rows

    def traced(self):
        w, r, n = self.wheel, self.random, self.points
        rows = ["record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        along = numpy.linspace(-0.95, 0.95, n)
        for record in ("profile", "helix") if self.way != "o" else ():
            for k in self.teeth:
                for side in (1, -1):
                    u, v = (along, 0.0 * along) if record == "profile" else (w.u_mid + 0.0 * along, along)
                    value = self.value(k, side, u, v, n) + 7 * r.standard_normal()
                    rows += [f"{record},{k},{SIDE[side]},{2 * a:.6f},{b:.5f},{c:.4f}" for a, b, c in zip(w.radius(u), w.height(v), value)]
        for side in (1, -1) if self.way in "io" else ():
            e = draw(r, self.errors if self.errors in ("tails", "steps") else "white", w.z)
            u = numpy.array([w.u_mid])
            value = [float((self.hidden.off(k, side, u, 0 * u) + self.sigma * e[k - 1])[0]) for k in range(1, w.z + 1)]
            rows += [f"index,{k},{SIDE[side]},{2 * w.radius(w.u_mid):.6f},{0.5 * w.b:.5f},{value[k - 1] - value[0]:.4f}" for k in range(1, w.z + 1)]
        return rows

    def label(self):
        data = {"s": f"scan {self.points}", "t": f"{len(self.teeth)} teeth x {self.points}", "a": f"all x {self.points}", "i": f"all x {self.points} index", "o": "index"}
        return f"{self.kind.__name__}-{self.number:02d} z{self.wheel.z} {math.degrees(self.wheel.lean):.0f}deg [{data[self.way]}, {self.errors} {self.sigma:.2f}]"

    def run(self, program, folder):
        where = folder / f"{self.kind.__name__}-{self.number:02d}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.wheel.toml())
        (where / "data.csv").write_text("\n".join(self.scan() if self.way == "s" else self.traced()) + "\n")
        return trial.close_loop(self, program, where, "part.toml", "data.csv", *["--aligned"] * (self.way == "s"))

    def judge(self):
        """What is wrong; empty: nothing."""
        a, h = self.answer, self.hidden
        before, after = (a[when]["held_out_rms_um"] for when in ("before", "after"))
        if after is not None and after > 1.0001 * before:
            return "worse"
        if h.nothing:
            return "" if a["verdict"] == "no_effect" else "alarm"
        if a["verdict"] == "no_effect":
            return "missed"
        wrong = [e["id"] for e in a["effects"] if e["named"] and not {e["id"], *e["confounded_with"]} & h.names]
        if wrong:
            return f"misnamed {wrong}"
        if a["verdict"] == "explained":
            if not 0.75 <= a["data"]["noise_um"] / self.sigma <= 1.33:
                return f"noise told {a['data']['noise_um'] / self.sigma:.2f} of the true one"
            if after is not None and after > 1.2 * self.sigma:
                return "called explained"
        if not a["effects"] and a["structure_left"]["description"].startswith("nothing"):
            return "not described"
        return ""

    def placed(self):
        """Whether the answer says the place; None: the form has none, or it was not seen."""
        if not self.right or not self.hidden.place:
            return None
        terms = [t for e in self.answer["effects"] for t in e.get("terms", [])]
        text, z = json.dumps([self.answer["effects"], self.answer["structure_left"]]), self.wheel.z
        key, value = next(iter(self.hidden.place.items()))
        if key == "flank":
            return any(e["flank"] == value for e in self.answer["effects"])
        if key == "wavelength_mm":
            return any(abs(t.get(key, 0) / value[0] - 1) < value[1] for t in terms) or "mm long" in text
        teeth = [e["parameters"]["tooth"]["value"] for e in self.answer["effects"] if e["id"] == "single_tooth"]
        teeth += [t.get("tooth", t.get("first_tooth", 0) + 0.5 * (t.get("teeth", 1) - 1)) for t in terms if "tooth" in t or "first_tooth" in t]
        return any(abs((t - value[0] + z / 2) % z - z / 2) <= value[1] for t in teeth)

    def line(self):
        a, head = self.answer, "" if self.right else "WRONG "
        if a is None:
            return f"{head}{self.label()}: {self.why}"
        told = "; ".join(e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:170] + "}") for e in a["effects"])
        held = [(a[k]["held_out_rms_um"] or float("nan")) / self.sigma for k in ("before", "after")]
        return (f"{head}{'UNPLACED ' * (self.placed() is False)}{self.label()}: {self.why} | {a['verdict']} noise {a['data']['noise_um'] / self.sigma:.2f} "
                f"held {held[0]:.2f} -> {held[1]:.2f} | {told} | {a['structure_left']['description'][:200]} p {a['structure_left']['p_value']:.3g} | "
                f"{self.hidden.place} {self.seconds:.1f}s")


def main():
    o = trial.words(every=(1, "only every n-th kind"))
    cases = [Case(i, o.seed, kind, ways) for kind, ways in KINDS[::o.every] if o.only in kind.__name__ for i in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (c.kind.__name__, "all nothing" if c.hidden.nothing else "all marks"), worth_a_line=lambda c: c.placed() is False,
                   counts=lambda c: (int(c.placed() is True), int(c.placed() is not None)), columns="| hidden | right | of | place told | of |")


if __name__ == "__main__":
    main()
