# SPDX-License-Identifier: GPL-3.0-or-later
"""Design files as people write them, well or badly: every kind, odd values, odd layout. One seed, one file."""
import json
import math
import random


def cosd(degrees):
    return math.cos(math.radians(degrees))


def rounded(value, digits=4):
    return round(value, digits)


class Draft:
    """A design as nested tables, with what a generator needs to know of it."""

    def __init__(self, seed):
        self.dice = random.Random(seed)
        self.tables = {"": {"format": 1, "name": f"random-{seed}"}, "gearbox": {}}
        self.gears, self.rings = [], []
        self.module = self.dice.choice([0.3, 0.5, 0.8, 1.0, 1.0, 1.25, 2.0, 2.5, 4.0])
        self.helix = 0.0

    def chance(self, share):
        return self.dice.random() < share

    def real(self, low, high, digits=4):
        return rounded(self.dice.uniform(low, high), digits)

    @property
    def box(self):
        return self.tables["gearbox"]

    def gear(self, name, teeth, ring=False):
        face = rounded(self.module * self.dice.choice([4, 6, 8, 10, 12.5]), 3)
        self.tables[name] = {"teeth": max(5, teeth), "face_width_mm": face}
        self.gears.append(name)
        if ring:
            self.rings.append(name)

    def distance(self, inner, outer, ring):
        z = self.tables[outer]["teeth"] + (-1 if ring else 1) * self.tables[inner]["teeth"]
        return 0.5 * self.module * z / cosd(self.helix)


def add_pair(d):
    internal = d.chance(0.45)
    pinion = d.dice.choice([d.dice.randint(5, 16), d.dice.randint(12, 50)])
    d.box["kind"] = "pair"
    d.gear("pinion", pinion)
    d.gear("wheel", pinion + d.dice.randint(2, 60) if internal else d.dice.randint(6, 110), internal)
    if internal:
        d.tables["wheel"]["internal"] = True
    return [("pinion", "wheel", internal)]


def add_simple(d):
    sun, planet = d.dice.randint(6, 40), d.dice.randint(8, 50)
    d.box.update({"kind": "simple", "planets": d.dice.choice([1, 2, 3, 3, 4, 5, 7])})
    if d.chance(0.3):
        d.box["output"] = d.dice.choice(["carrier", "ring"])
    d.gear("sun", sun)
    d.gear("planet", planet)
    d.gear("ring", sun + 2 * planet + d.dice.choice([0, 0, 0, 1, -1, 2]), True)
    return [("sun", "planet", False), ("planet", "ring", True)]


def add_stepped(d):
    sun, planet = d.dice.randint(7, 30), d.dice.randint(15, 50)
    step = d.dice.randint(9, planet)
    d.box.update({"kind": "stepped", "planets": d.dice.choice([2, 3, 3, 4])})
    d.gear("sun", sun)
    d.gear("planet1", planet)
    d.gear("planet2", step)
    d.gear("ring", sun + planet + step + d.dice.choice([0, 0, 1, -1, 2]), True)
    return [("sun", "planet1", False), ("planet2", "ring", True)]


def add_3k(d):
    sun, planet = d.dice.randint(7, 28), d.dice.randint(14, 48)
    less = d.dice.randint(-6, 10)
    d.box.update({"kind": "3k", "planets": d.dice.choice([2, 3, 3, 4, 5]), "output": d.dice.choice(["ring2", "ring1"])})
    if d.chance(0.2):
        d.box["input"] = "carrier"
    d.gear("sun", sun)
    d.gear("planet1", planet)
    d.gear("ring1", sun + 2 * planet + d.dice.choice([0, 0, 1, -1]), True)
    d.gear("planet2", max(8, planet - less))
    d.gear("ring2", d.tables["planet2"]["teeth"] + sun + planet + d.dice.choice([0, 0, 1, -1]), True)
    return [("sun", "planet1", False), ("planet1", "ring1", True), ("planet2", "ring2", True)]


def add_rack(d):
    rack = {}
    if d.chance(0.15):
        rack["profile"] = d.dice.choice(["ISO53-A", "ISO53-B", "ISO53-C", "ISO53-D"])
    if d.chance(0.25):
        rack["pressure_angle_deg"] = d.dice.choice([14.5, 15, 17.5, 22.5, 25, 28, 30])
    if d.chance(0.2):
        rack["addendum"] = d.real(0.7, 1.25, 2)
    if d.chance(0.2):
        rack["dedendum"] = d.real(0.95, 1.45, 2)
    if d.chance(0.3):
        rack["root_radius"] = d.dice.choice([0, 0.1, 0.2, 0.3, 0.38, 0.5])
    if rack:
        d.tables["rack"] = rack


def add_shifts(d, meshes):
    """None, some or all; small, plausible or extreme; the distance fitting, near it or mistyped."""
    style = d.dice.choice(["none", "some", "all", "distance", "distance", "typed"])
    reach = d.dice.choice([0.2, 0.5, 1.2])
    first = meshes[0]
    distance = d.distance(*first)
    if style in ("some", "all"):
        for gear in d.gears:
            if style == "all" or d.chance(0.4):
                d.tables[gear]["shift"] = d.real(-0.6 * reach, reach, d.dice.choice([1, 2, 4]))
        if style == "all" and d.chance(0.5):
            x1, x2 = (d.tables[g].get("shift", 0.0) for g in first[:2])
            d.box["centre_distance_mm"] = rounded(distance + d.module * (x2 - x1 if first[2] else x1 + x2)
                                                  + d.dice.choice([0, 0, -0.02, 0.1]), 3)
    elif style == "distance" and distance > d.module:
        d.box["centre_distance_mm"] = rounded(distance + d.module * d.dice.uniform(-0.5, 1.0) * reach, d.dice.choice([1, 2, 4]))
    elif style == "typed" and distance > d.module:
        wrong = d.dice.choice([1.01, 0.985, 1.1, 0.9, 1.0])
        d.box["centre_distance_mm"] = rounded(distance * wrong, 2)
        d.tables[first[0]]["shift"] = d.real(-0.2, 0.6, 2)


def add_tips(d):
    if d.chance(0.35):
        d.box["tips"] = d.dice.choice(["standard", "standard", "clear"])
    if not d.chance(0.35):
        return
    for gear in d.gears:
        if not d.chance(0.5):
            continue
        reference = d.module * d.tables[gear]["teeth"] / cosd(d.helix)
        out = -1 if gear in d.rings else 1
        d.tables[gear]["tip_diameter_mm"] = rounded(
            reference + 2 * out * d.module * (1 + d.dice.uniform(-0.4, 0.35)) + 2 * d.module * d.tables[gear].get("shift", 0.0),
            d.dice.choice([1, 2, 4]))


def add_ring_roots(d):
    for ring in d.rings:
        table = d.tables[ring]
        if d.chance(0.25):
            table["root"] = "shaper"
            d.tables[ring + ".cutter"] = {"teeth": d.dice.randint(12, max(13, min(50, table["teeth"] - 8))),
                                          "shift": d.real(-0.1, 0.25, 2), "tip_radius": d.dice.choice([0, 0.1, 0.2, 0.3])}
        if d.chance(0.2):
            table["outer_diameter_mm"] = rounded(d.module * (table["teeth"] / cosd(d.helix) + d.dice.uniform(3, 9)
                                                             + 2 * abs(table.get("shift", 0.0))), 2)


def add_bodies(d):
    for gear in d.gears:
        if gear in d.rings or gear == "planet2" or not d.chance(0.2):
            continue
        root = d.module * (d.tables[gear]["teeth"] - 3)
        if root > 0.5:
            d.tables[gear]["bore_mm"] = rounded(root * d.dice.choice([0.3, 0.5, 0.8, 0.95]), 2)


def add_modifications(d):
    if not d.chance(0.15):
        return
    for gear in d.gears:
        if not d.chance(0.5):
            continue
        made = {}
        if d.chance(0.5):
            made["crowning_um"] = d.dice.choice([3, 8, 20])
        if d.chance(0.3):
            made["tip_rounding_mm"] = rounded(0.05 * d.module, 3)
        if d.chance(0.3):
            made["edge_chamfer_mm"] = 0.1
        if made:
            d.tables[gear + ".modifications"] = made


def add_made(d):
    made = {}
    if d.chance(0.15):
        made["process"] = d.dice.choice(["fdm-0.4", "grinding", "hobbing"])
    if d.chance(0.15):
        made["tolerance_class"] = d.dice.choice([5, 6, 7, 8, 9])
    if d.chance(0.08):
        made["axis_tolerance_um"] = d.dice.choice([5, 10, 25])
    if d.chance(0.08):
        made["thickness_tolerance_um"] = d.dice.choice([5, 10, 25])
    if d.chance(0.08):
        made["clearance_um"] = d.dice.choice([5, 20, 50])
    if made:
        d.tables["made"] = made


def add_housing(d):
    """A motor, a housing and bearings around a set of planets of a size that a printer makes."""
    if d.box["kind"] not in ("3k", "simple") or d.helix != 0.0 or not d.chance(0.15):
        return
    for gear in d.gears:
        for key in ("bore_mm", "outer_diameter_mm"):
            d.tables[gear].pop(key, None)
    d.tables |= {"housing": {}, "motor": {"name": "nema17"},
                 "output": {"speed_rpm": 6.0}, "bearings": {"output": d.dice.choice(["6806", "6807", "6808"]), "planet": "625"}}
    d.tables.setdefault("made", {})["process"] = "fdm-0.4"
    if d.chance(0.3):
        d.tables["housing"]["outer_diameter_mm"] = rounded(d.module * d.tables[d.rings[0]]["teeth"] + d.dice.uniform(5, 40), 1)


def draft(seed):
    d = Draft(seed)
    kind = d.dice.choices([add_pair, add_simple, add_stepped, add_3k], [10, 4, 3, 4])[0]
    if d.chance(0.3):
        d.helix = d.dice.choice([8, 12.5, 20, 30, -15, 40])
    meshes = kind(d)
    if d.helix:
        d.box["helix_angle_deg"] = d.helix
        if d.chance(0.2):
            d.box["herringbone"] = True
            width = d.tables[d.gears[0]]["face_width_mm"]
            for gear in d.gears:
                d.tables[gear]["face_width_mm"] = width
    d.box["module_mm"] = d.module
    if d.chance(0.75):
        d.box["backlash_mm"] = rounded(d.module * d.dice.choice([0, 0.01, 0.03, 0.05, 0.1, 0.2]), 4)
    if d.chance(0.3):
        d.box["friction"] = d.dice.choice([0.03, 0.05, 0.15])
    if "planets" in d.box and d.box["kind"] != "simple" and d.chance(0.3):
        d.box["layer_gap_mm"] = d.dice.choice([0, 0.5, 2])
    add_rack(d)
    add_shifts(d, meshes)
    add_tips(d)
    add_ring_roots(d)
    add_bodies(d)
    add_modifications(d)
    add_made(d)
    add_housing(d)
    return d


# --- layout -----------------------------------------------------------------------------------------------------

REMARKS = ["# from the catalogue", "#old: 12.5 # not this", "# \u00f8 measured, see the 'drawing'", "# TODO ask = Anna \"soon\"",
           "#", "# [gearbox] is above", "#\ttabs\there"]


def in_inches(d, table, key, value):
    """A length as the same key in inches, where the file speaks them."""
    if key.endswith("_mm") and isinstance(value, (int, float)) and not isinstance(value, bool):
        return key[:-3] + "_in", round(value / 25.4, 7)
    return key, value


def value_text(d, value):
    if isinstance(value, str) and d.chance(0.2):
        return f"'{value}'"
    if isinstance(value, float) and d.chance(0.05) and 0.01 < abs(value) < 1000:
        return f"{value:e}"
    if isinstance(value, float) and value == int(value) and d.chance(0.3):
        return str(int(value))
    return json.dumps(value)


def text_of(d):
    """The file's text, and whether its layout is one of which comments are promised to stay."""
    inches = d.chance(0.1)
    dotted = d.chance(0.06)
    tidy = d.chance(0.4)
    names = [n for n in d.tables if n]
    if d.chance(0.2):
        d.dice.shuffle(names)
    lines = []
    for name in [""] + names:
        keys = list(d.tables[name].items())
        if not tidy and d.chance(0.3):
            d.dice.shuffle(keys)
        if name and not dotted:
            if d.chance(0.3):
                lines.append(d.dice.choice(REMARKS))
            lines.append(f"[{name}]" if tidy or d.chance(0.8) else f"  [ {name} ]  # the {name}")
        for key, value in keys:
            if inches and name != "":
                key, value = in_inches(d, name, key, value)
            equals = " = " if tidy else d.dice.choice([" = ", "=", "\t=  ", "      = "])
            line = (f"{name}." if name and dotted else "") + key + equals + value_text(d, value)
            if not tidy and d.chance(0.2):
                line = "    " + line
            if d.chance(0.25):
                line += d.dice.choice(["  ", " ", ""]) + d.dice.choice(REMARKS)
            lines.append(line)
        if d.chance(0.6):
            lines.append("")
    newline = "\r\n" if d.chance(0.07) else "\n"
    text = newline.join(lines)
    return text if d.chance(0.05) else text + newline


def random_design(seed):
    """A design file's text."""
    d = draft(seed)
    return text_of(d)


if __name__ == "__main__":
    import sys
    print(random_design(int(sys.argv[1])), end="")
