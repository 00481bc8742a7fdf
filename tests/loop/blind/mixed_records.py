# SPDX-License-Identifier: GPL-3.0-or-later
"""Several records of one gear in one call, as an inspection hands them over: profile and helix traces of three to
twelve teeth, an index of all, with or without radial runout and spans, each in a file of its own. Up to three named
effects at once. Gears, effects and errors are those of drawn_anew.py; what a ball in a gap and a caliper over some
teeth read is worked out here.
Usage: mixed_records.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE]
Right: as in drawn_anew.py; and the same loop.json, byte for byte, from the files in another order, and in them the
records: traces as they were measured, one after the other in any order."""
import math
import shutil

import numpy

import drawn_anew
import trial


def tooth_thickness(g, r, s):
    amount = s * r.uniform(8, 30) * drawn_anew.pm(r)  # of the arc on the reference circle
    along_normal = 0.5 * amount * math.cos(g.at) * math.cos(math.asin(math.sin(g.beta) * math.cos(math.radians(20))))
    return drawn_anew.Thing({"tooth_thickness"}, off=lambda k, side, u, v: along_normal + 0 * u, truth={"amount_um": amount})


NAMES = [drawn_anew.eccentricity, drawn_anew.pressure_angle_error, drawn_anew.profile_crowning, drawn_anew.tip_relief, drawn_anew.helix_error,
         drawn_anew.taper, drawn_anew.crowning, drawn_anew.pitch_wave, drawn_anew.single_tooth, drawn_anew.lobing]


def below(f, target, low, high):
    """Where the rising f takes the value `target`."""
    for _ in range(80):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < target else (low, middle)
    return low


def in_another_order(r, rows):
    """The traces in any order, the values within them as they were; what is no trace is a record of one row."""
    records = {}
    for i, row in enumerate(rows):
        trace = row.startswith(("profile", "helix"))
        records.setdefault(tuple(row.split(",")[:3]) if trace else i, []).append(row)
    keys = list(records)
    return [row for k in r.permutation(len(keys)) for row in records[keys[k]]]


class Case(drawn_anew.Case):
    def __init__(self, kind, number, seed):
        self.kind, self.number = kind, number
        r = self.r = numpy.random.default_rng([seed, 771, int(kind[-1]), number])
        self.g = g = drawn_anew.Body(r)
        while g.inner:  # a ring has no span
            self.g = g = drawn_anew.Body(r)
        self.way = "q"
        count = min(g.z, int(r.choice([3, 4, 6, 8, 12])))
        self.teeth = sorted({1 + (i * g.z) // count for i in range(count)}) if r.uniform() < 0.6 else sorted(int(k) for k in 1 + r.choice(g.z, count, replace=False))
        noise = float(r.uniform(0.3, 1.2))
        self.errors = drawn_anew.Errors(r, noise, str(r.choice(["white", "white", "near"])))
        self.points = int(r.choice([40, 64, 110]))
        self.parts = {part for part, share in (("radial", 0.5), ("sizes", 0.6)) if r.uniform() < share}
        able = NAMES + [tooth_thickness] * ("sizes" in self.parts)
        self.makers = list(r.choice(able, int(kind[-1]), replace=False))
        self.things = [maker(g, r, noise) for maker in self.makers]

    def reading(self, k, side, u):
        return float(self.value(k, side, numpy.array([u]), numpy.array([0.0]))[0])

    def coordinate(self, roll):
        return 2 * (roll - self.g.ends[0]) / (self.g.ends[1] - self.g.ends[0]) - 1

    def radial(self):
        """A ball in the gap after every tooth goes out by what both flanks push it."""
        g, normal = self.g, math.radians(20)
        ball = round(1.72 * g.mn, 3)
        base_helix = math.asin(math.sin(g.beta) * math.cos(normal))
        gap = ball / (g.mn * g.z * math.cos(normal)) - (0.5 * math.pi - 2 * g.x * math.tan(normal)) / g.z
        centre = below(lambda a: math.tan(a) - a, math.tan(g.at) - g.at + gap, 0.0, 1.2)
        u = self.coordinate(g.rb * math.tan(centre) - 0.5 * ball * math.cos(base_helix))
        rows = [f"# ball_diameter_mm = {ball}", "record,tooth,flank,diameter_mm,z_mm,deviation_um"]
        for k in range(1, g.z + 1):
            pushed = 0.5 * (self.reading(k, 1, u) + self.reading(k % g.z + 1, -1, u)) / (math.sin(centre) * math.cos(base_helix))
            rows.append(f"radial,{k},left,{2 * g.r:.5f},{0.5 * g.b:.5f},{pushed + float(self.errors.draw(1, True)[0]):.4f}")
        return rows

    def sizes(self):
        """Six spans, each over teeth that nobody wrote down."""
        g, r, normal = self.g, self.r, math.radians(20)
        over = max(2, round(g.z * math.degrees(g.at) / 180 + 0.5))
        length = g.mn * math.cos(normal) * ((over - 0.5) * math.pi + g.z * (math.tan(g.at) - g.at)) + 2 * g.x * g.mn * math.sin(normal)
        # The plates touch where the halves of the base tangent end.
        u = self.coordinate(0.5 * length * math.cos(math.asin(math.sin(g.beta) * math.cos(normal))))
        rows = ["quantity,value_mm,detail,sigma_um"]
        for first in r.integers(1, g.z + 1, 6):
            both = self.reading(int(first), -1, u) + self.reading((int(first) + over - 2) % g.z + 1, 1, u)
            rows.append(f"span,{length + 1e-3 * (both + r.normal()):.5f},{over},1.0")
        return rows

    def files(self):
        head, *rows = self.records()
        files = {"traces": [head, *(row for row in rows if not row.startswith("index"))], "index": [head, *(row for row in rows if row.startswith("index"))]}
        return files | {part: getattr(self, part)() for part in sorted(self.parts)}

    def run(self, program, folder):
        where = folder / f"{self.kind}-{self.number:02d}"
        again = where / "in_another_order"
        shutil.rmtree(where, ignore_errors=True)
        again.mkdir(parents=True)
        files = self.files()
        for folder_of, shuffled in ((where, False), (again, True)):
            (folder_of / "part.toml").write_text(self.g.toml())
            for name, rows in files.items():
                first = next(i for i, row in enumerate(rows) if row.startswith(("record", "quantity"))) + 1
                values = in_another_order(self.r, rows[first:]) if shuffled else rows[first:]
                (folder_of / f"{name}.csv").write_text("\n".join(rows[:first] + values) + "\n")
        trial.close_loop(self, program, where, "part.toml", *(f"{name}.csv" for name in files))
        first = self.answer, self.why, self.seconds
        trial.close_loop(self, program, again, "part.toml", *(f"{name}.csv" for name in self.r.permutation(list(files))))
        same = self.answer is not None and (where / "loop.json").read_bytes() == (again / "loop.json").read_bytes()
        self.answer, self.why, self.seconds = first
        if not same:
            self.why = "another answer in another order"
        self.right = not self.why
        return self

    def label(self):
        return super().label() + f" {'+'.join(m.__name__ for m in self.makers)} {{{', '.join(['traces', 'index', *sorted(self.parts)])}}}"


def main():
    o = trial.words(each=10)
    kinds = [kind for kind in ("names_0", "names_1", "names_2", "names_3") if o.only in kind]
    cases = [Case(kind, number, o.seed) for kind in kinds for number in range(o.each)]
    trial.campaign(cases, o, keys=lambda c: (f"{len(c.things)} at once",), counts=lambda c: c.held(), worth_a_line=lambda c: c.held()[0] < c.held()[1],
                   columns="| made | right | of | intervals that hold | of |", after=drawn_anew.told_last)


if __name__ == "__main__":
    main()
