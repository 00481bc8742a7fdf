# SPDX-License-Identifier: GPL-3.0-or-later
"""ISO 1328-1 figures of random traces: what `trueflank loop` writes to iso_1328 against an evaluation of its own.
The filter is a convolution on a grid four times as fine, ends made up to one; lines are fitted with polyfit; places of
profiles are roll lengths from the involute's own relation. Usage: inspected.py PROGRAM DIRECTORY [--seed N] [--gears N]
Exit 1 where a figure differs by more than 0.05 um and 1 % of it."""
import json
import math
import subprocess
import sys

import numpy

import trial

FLANKS = ("left", "right")


class Sheet:
    """A spur gear with random deviations: slopes, bows, waves and noise of every trace, random pitch."""

    def __init__(self, r):
        self.z, self.m, self.b = int(r.integers(17, 61)), float(r.choice([1.5, 2.0, 3.0, 5.0])), float(r.uniform(12, 45))
        self.pitch = 0.5 * self.m * self.z
        self.base = self.pitch * math.cos(math.radians(20.0))
        tip = self.pitch + self.m
        self.rows, self.traces = [], {"profile": [], "helix": []}
        roll = lambda d: math.sqrt((0.5 * d) ** 2 - self.base**2)
        low, high = 2 * (self.pitch - 0.6 * self.m), 2 * (tip - 0.02 * self.m)
        low = max(low, 2.002 * self.base)
        self.index = {f: r.normal(0, 3, self.z) + 4 * numpy.cos(2 * math.pi * numpy.arange(self.z) / self.z + r.uniform(0, 6)) for f in FLANKS}
        for flank in FLANKS:
            self.index[flank] -= self.index[flank][0]
            for tooth in range(1, self.z + 1):
                self.rows.append(f"index,{tooth},{flank},{2 * self.pitch:.6f},{0.5 * self.b:.6f},{self.index[flank][tooth - 1]:.5f}")
                if tooth % max(1, self.z // 4) != 1:
                    continue
                diameters = numpy.linspace(low, high, 480)
                places = numpy.array([roll(d) for d in diameters])
                values = self.course(places, r)
                self.traces["profile"].append((flank, places, values))
                self.rows += [f"profile,{tooth},{flank},{d:.6f},{0.5 * self.b:.6f},{v:.5f}" for d, v in zip(diameters, values)]
                heights = numpy.linspace(0.02 * self.b, 0.98 * self.b, 480)
                values = self.course(heights, r)
                self.traces["helix"].append((flank, heights, values))
                self.rows += [f"helix,{tooth},{flank},{2 * self.pitch:.6f},{h:.6f},{v:.5f}" for h, v in zip(heights, values)]

    @staticmethod
    def course(at, r):
        x = (at - at[0]) / (at[-1] - at[0])
        value = r.normal(0, 5) * x + r.normal(0, 4) * x * (1 - x) + r.normal(0, 0.4, len(x))
        for _ in range(3):
            value = value + r.uniform(0.2, 2) * numpy.sin(2 * math.pi * r.uniform(1, 20) * x + r.uniform(0, 6))
        return value

    def design(self):
        return (f'format = 1\nname = "inspected"\n[gearbox]\nkind = "gear"\nmodule_mm = {self.m}\ntips = "standard"\n'
                f"[gear]\nteeth = {self.z}\nshift = 0.0\nface_width_mm = {self.b}\n")

    def csv(self):
        return "record,tooth,flank,diameter_mm,z_mm,deviation_um\n" + "\n".join(self.rows) + "\n"

    def evaluated(self, root_form_diameter, tip_form_diameter):
        """{(symbol, flank): value}"""
        figures = {}
        limits = [math.sqrt(max(0.0, (0.5 * d) ** 2 - self.base**2)) for d in (root_form_diameter, tip_form_diameter)]
        for kind, letter in (("profile", "a"), ("helix", "b")):
            for flank in FLANKS:
                slopes, forms, totals, bows = [], [], [], []
                for side, at, values in self.traces[kind]:
                    if side != flank:
                        continue
                    if kind == "profile":
                        start, last = max(at[0], limits[0]), min(at[-1], limits[1])
                        end = start + 0.95 * (last - start)
                    else:
                        cut = min(0.05 * self.b, self.m)
                        start = max(at[0], cut)
                        end = last = min(at[-1], self.b - cut)
                    s, f, t, c = self.one(at, values, start, end, last)
                    slopes.append(s), forms.append(f), totals.append(t), bows.append(c)
                figures["fH" + letter, flank] = max(slopes, key=abs)
                figures["ff" + letter, flank] = max(forms)
                figures["F" + letter, flank] = max(totals)
                figures[f"fH{letter}m", flank] = numpy.mean(slopes)
                figures["C" + letter, flank] = numpy.mean(bows)
        for flank in FLANKS:
            place = self.index[flank] / math.cos(math.radians(20.0))
            step = place - numpy.roll(place, 1)
            figures["fp", flank] = numpy.max(numpy.abs(step))
            figures["Fp", flank] = place.max() - place.min()
            figures["fu", flank] = numpy.max(numpy.abs(step - numpy.roll(step, 1)))
            k = int(math.floor(self.z / 8 + 0.5))
            if k > 1:
                figures["Fpz/8", flank] = numpy.max(numpy.abs(numpy.roll(place, -k) - place))
        return figures

    @staticmethod
    def one(at, values, start, end, last):
        """Slope, form, total, crowning of one trace."""
        cut_off = max(0.25, (end - start) / 30.0)
        fine = numpy.linspace(at[0], at[-1], 4 * len(at) - 3)
        dense = numpy.interp(fine, at, values)
        alpha = 0.46971864  # sqrt(ln 2 / pi)
        smooth = numpy.empty(len(at))
        for i, x in enumerate(at):
            weight = numpy.exp(-math.pi * ((fine - x) / (alpha * cut_off)) ** 2)
            smooth[i] = numpy.sum(weight * dense) / numpy.sum(weight)
        inside = (at >= start) & (at <= end)
        # The least squares of an even trace: on the fine grid, so that uneven places do not count double.
        even = numpy.linspace(at[inside][0], at[inside][-1], 2000)
        smooth_even = numpy.interp(even, at, smooth)
        x = (even - 0.5 * (start + end)) / (0.5 * (end - start))
        slope, middle = numpy.polyfit(x, smooth_even, 1)
        bow = numpy.polyfit(x, smooth_even, 2)[0]
        off = smooth - middle - slope * (at - 0.5 * (start + end)) / (0.5 * (end - start))
        beyond = inside | ((at > end) & (at <= last + 1e-9))
        return (2 * slope, off[beyond].max() - off[inside].min(), smooth[beyond].max() - smooth[inside].min(), -bow)


def main():
    o = trial.words(each=0, gears=(3, "how many"))
    program, worst, wrong, asked = o.program, 0.0, 0, 0
    for number in range(o.gears):
        sheet = Sheet(numpy.random.default_rng([o.seed, number]))
        where = o.folder / f"inspected-{number}"
        where.mkdir(parents=True, exist_ok=True)
        (where / "gear.toml").write_text(sheet.design())
        (where / "sheet.csv").write_text(sheet.csv())
        for command in (["loop", "gear.toml", "sheet.csv", "-o", "."], ["check", "gear.toml", "-q", "--json", "report.json"]):
            done = subprocess.run([program, *command], cwd=where, capture_output=True, text=True, timeout=300)
            if done.returncode > 1:
                sys.exit(done.stderr)
        gear = json.loads((where / "report.json").read_text())["gears"]["gear"]
        mine = sheet.evaluated(gear["root_form_diameter_mm"], gear["tip_form_diameter_mm"])
        seen = set()
        for figure in json.loads((where / "loop.json").read_text())["iso_1328"]["figures"]:
            key = figure["symbol"], figure["flank"]
            if key not in mine:
                continue
            seen.add(key)
            off = abs(abs(figure["value_um"]) - abs(mine[key]))
            asked, worst = asked + 1, max(worst, off)
            if off > 0.05 + 0.01 * abs(mine[key]):
                wrong += 1
                print(f"gear {number} z {sheet.z} m {sheet.m}: {key}: {figure['value_um']} , own evaluation {mine[key]:.4f}")
        for key in sorted(set(mine) - seen):
            wrong += 1
            print(f"gear {number}: {key} is not told")
    print(f"{asked} figures of {o.gears} gears, largest difference {worst:.3f} um, {wrong} wrong")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
