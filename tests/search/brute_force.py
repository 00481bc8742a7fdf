#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The best shifts of single tooth sets by plain exhaustion, against `trueflank search`.

Nothing is shared with the program: roots come from sweeping the rack's flank and rounded corner over
the gear, tip corners from turning the mate, losses from the torques on both gears over a mesh cycle,
the train from the balance of torques. Modules are 1, teeth without backlash, tip circles as
docs/checks.md defines them.

  brute_force.py TRUEFLANK [SETS [SEED [GRID]]]

GRID is the number of centre distances and of shifts first looked at (40); what is around the told
design is looked at too. With 1 that alone (2 s a set), with 0 the told designs are judged only.

Exit code 1: the search was more than 1e-5 short of exhaustion, or told a design that breaks a limit.
"""
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import tomllib

import numpy as np

ALPHA, HA, HF, RHO = math.radians(20), 1.0, 1.25, 0.38
TAN, SIN, COS = math.tan(ALPHA), math.sin(ALPHA), math.cos(ALPHA)
TIP_CLEARANCE, TIP_THICKNESS, SPACING = 0.1, 0.2, 0.5
SHORT = 1e-5
# Near its fillet a tip's distance grows with the square of its way: 1e-9 modules too few are 3e-5 of
# shift and 2e-5 of efficiency.
ROUNDING = 1e-12


def inv(angle):
    return np.tan(angle) - angle


def pressure_angle(radius, base):
    return np.arccos(np.clip(base / np.maximum(radius, base), -1, 1))


class Gear:
    def __init__(self, z, x, ring=False):
        self.z, self.x, self.ring = z, x, ring
        self.r, self.base = z / 2, z / 2 * COS
        self.tip = self.r + (x - HA if ring else HA + x)
        self.root = self.r + (HF + x if ring else x - HF)

    def half_tooth(self, radius):
        """Half of a tooth's angle; a ring's space is an external gear's tooth."""
        external = (math.pi / 2 + 2 * self.x * TAN) / self.z + inv(ALPHA) - inv(pressure_angle(radius, self.base))
        return math.pi / self.z - external if self.ring else external

    def joint(self):
        """Radius where the rack's flank ends to cut; None: undercut."""
        height = HF - self.x - RHO * (1 - SIN)
        roll = self.r * SIN - height / SIN
        return math.hypot(self.base, roll) if roll >= 0 else None


def swept_gap(gear, radii):
    """Half angle of an external gear's gap at radii that the rack's corner sweeps: for every position
    of the rack the farthest point of its corner circle on each radius."""
    land = math.pi / 4 - HF * TAN - RHO * (1 - SIN) / COS
    depth = HF - gear.x - RHO  # of the circle's centre below the pitch line
    # where the rack does not reach the reference circle its corner leaves the flank far from the middle
    above = max(0.0, gear.x - HF + RHO * (1 - SIN)) / (SIN * COS)
    span = (2.2 + above + 1.2 * math.sqrt(max(0.0, gear.r ** 2 - gear.root ** 2))) / gear.r
    best, where = None, None
    low, high = np.full(radii.shape, -span), np.full(radii.shape, span)
    for count in (61, 13, 13, 13, 13):
        turn = low[:, None] + (high - low)[:, None] * np.linspace(0, 1, count)
        # gap's middle on +x at rest; the rack moves along y by r * turn while the gear turns
        cx, cy = gear.r - depth, land + gear.r * turn
        centre, direction = np.hypot(cx, cy), np.arctan2(cy, cx) - turn
        cosine = (centre ** 2 + radii[:, None] ** 2 - RHO ** 2) / (2 * centre * radii[:, None])
        reach = np.where(np.abs(cosine) <= 1, direction + np.arccos(np.clip(cosine, -1, 1)), -9)
        k = reach.argmax(axis=1)
        best = reach[np.arange(len(radii)), k]
        where = turn[np.arange(len(radii)), k]
        step = (high - low) / (count - 1)
        low, high = where - step, where + step
    return best


FORMS = {}


def form_radius(gear):
    """Where the involute begins."""
    key = (gear.z, gear.x)
    if key not in FORMS:
        joint = gear.joint()
        if joint is None:
            radii = np.linspace(gear.base * (1 + 1e-9), gear.r + HA + gear.x, 400)
            for _ in range(3):
                excess = swept_gap(gear, radii) - (math.pi / gear.z - gear.half_tooth(radii))
                over = np.nonzero(excess > 0)[0]
                if len(over) == 0:
                    joint = radii[0]
                    break
                top = over[-1]
                joint = radii[top]
                if top + 1 == len(radii):
                    break
                radii = np.linspace(radii[top], radii[top + 1], 30)
        FORMS[key] = joint
    return FORMS[key]


def ring_fillet(gear):
    """Centre (radius, angle from the gap's middle) of the circle that rounds a ring's root, by
    bisection on its distance from the flank; the largest that fits where 0.38 does not."""
    radii = np.linspace(gear.base * 1.0001, gear.root + 0.5, 4000)
    flank = math.pi / gear.z - gear.half_tooth(radii)  # half of the gap
    flank_x, flank_y = radii * np.cos(flank), radii * np.sin(flank)

    def distance(centre, angle):
        d = np.hypot(flank_x - centre * math.cos(angle), flank_y - centre * math.sin(angle))
        k = int(d.argmin())
        if 0 < k < len(d) - 1:  # parabola
            p, q, s = d[k - 1], d[k], d[k + 1]
            return q - (s - p) ** 2 / (8 * (p - 2 * q + s))
        return d[k]

    rho = RHO
    if distance(gear.root - rho, 0.0) < rho:
        low, high = 0.0, rho
        for _ in range(40):
            rho = (low + high) / 2
            low, high = (low, rho) if distance(gear.root - rho, 0.0) < rho else (rho, high)
        return rho, 0.0
    low, high = 0.0, 2 / gear.r
    for _ in range(45):
        angle = (low + high) / 2
        low, high = (angle, high) if distance(gear.root - rho, angle) > rho else (low, angle)
    return rho, (low + high) / 2


FILLETS = {}


def ring_fillet_of(gear):
    key = (gear.z, gear.x)
    if key not in FILLETS:
        FILLETS[key] = ring_fillet(gear)
    return FILLETS[key]


def ring_foot(gear):
    """Radius where a ring's fillet touches the flank."""
    rho, _ = ring_fillet_of(gear)
    return math.hypot(gear.base, math.sqrt((gear.root - rho) ** 2 - gear.base ** 2) + rho)


def ring_gap(gear, radii):
    """Of the fillet alone; nan where there is none."""
    rho, angle = ring_fillet_of(gear)
    centre = gear.root - rho
    cosine = (centre ** 2 + radii ** 2 - rho ** 2) / (2 * centre * radii)
    point = angle + np.arccos(np.clip(cosine, -1, 1))
    return np.where((np.abs(cosine) <= 1) & (radii >= ring_foot(gear)), point, np.nan)


def corner_distance(own, mate, a, enough=-9.0):
    """Least distance of the mate's tip corner from the root curve of `own`; where it is below
    `enough`, some distance below that."""
    best = 9.0
    # the corner is in the root while it is this far from the own axis
    limit = ring_foot(own) + 2e-7 if own.ring else form_radius(own) - 2e-7
    cosine = (-1 if own.ring else 1) * (a ** 2 + mate.tip ** 2 - limit ** 2) / (2 * a * mate.tip)
    if cosine >= 1:
        return best
    # a corner that just reaches the root touches the flank's end: that is contact, not interference
    half, span = mate.half_tooth(mate.tip), math.acos(max(-1.0, cosine)) * (1 - 1e-9)
    turns = np.linspace(-span, span, 61) - half
    for _ in range(4):
        if mate.ring:
            angle = turns + mate.half_tooth(mate.tip)
            x, y, own_turn = mate.tip * np.cos(angle) - a, mate.tip * np.sin(angle), turns * mate.z / own.z
        elif own.ring:
            angle = turns + mate.half_tooth(mate.tip)
            x, y, own_turn = a + mate.tip * np.cos(angle), mate.tip * np.sin(angle), turns * mate.z / own.z
        else:
            angle = math.pi + turns + mate.half_tooth(mate.tip)
            x, y, own_turn = a + mate.tip * np.cos(angle), mate.tip * np.sin(angle), -turns * mate.z / own.z
        radius = np.hypot(x, y)
        from_gap = np.abs(np.arctan2(y, x) - own_turn)
        if own.ring:
            gap = ring_gap(own, radius)
        else:
            inside = radius < limit
            gap = np.full(radius.shape, np.nan)
            if inside.any():
                gap[inside] = swept_gap(own, radius[inside])
        distance = np.where(np.isfinite(gap), radius * (gap - from_gap), 9.0)
        k = int(distance.argmin())
        best = min(best, float(distance[k]))
        if distance[k] > 0.2 or distance[k] < enough:
            break
        turns = np.linspace(turns[max(0, k - 1)], turns[min(len(turns) - 1, k + 1)], 17)
    return best


def tips_apart(planet, ring, a):
    """Distance of the tips where their circles cross, the planet's corner having passed first."""
    c = (ring.tip ** 2 - planet.tip ** 2 - a ** 2) / (2 * a * planet.tip)
    if c >= 1:
        return 0.5
    at_planet = math.acos(c)
    at_ring = math.acos((a ** 2 + ring.tip ** 2 - planet.tip ** 2) / (2 * a * ring.tip))
    working = pressure_angle(a, ring.base - planet.base)
    turned = at_planet + inv(pressure_angle(planet.tip, planet.base)) - inv(working)
    return ring.tip * (turned * planet.z / ring.z + inv(working) - inv(pressure_angle(ring.tip, ring.base)) - at_ring)


def mesh_efficiency(base1, base2, internal, before, after, tangent, friction, first_drives):
    """Work out over work in through a mesh cycle; the pairs in contact share the load equally."""
    pitch = 2 * math.pi * 0.5 * COS
    pairs = int((before + after) / pitch)
    total = 0.0
    breaks = sorted({-before, after - pairs * pitch, min(pitch - before, after), *(
        -j * pitch for j in range(pairs + 1) if -before < -j * pitch < pitch - before)})
    nodes, weights = np.polynomial.legendre.leggauss(12)
    sense = 1 if first_drives else -1
    for low, high in zip(breaks, breaks[1:]):
        if high - low < 1e-14:
            continue
        s0 = (low + high) / 2 + (high - low) / 2 * nodes
        s = s0 + pitch * np.arange(pairs + 2)[:, None]
        in_contact = s <= after + 1e-13
        mu = np.where(s < 0, -friction, friction) * sense
        torque1 = (in_contact * (base1 + mu * (base1 * tangent + s))).sum(0)
        torque2 = (in_contact * (base2 + mu * (base2 * tangent + (s if internal else -s)))).sum(0)
        ratio = torque1 / torque2 if first_drives else torque2 / torque1
        total += (weights * ratio).sum() * (high - low) / 2
    mean = total / pitch
    return (base1 / base2 if first_drives else base2 / base1) / mean


class Layer:
    """One layer at a centre distance and a shift of its ring."""

    def __init__(self, teeth, a, x_ring, case):
        self.a, self.case = a, case
        z_sun, z_planet, z_ring = teeth
        inner = pressure_angle(a, (z_ring - z_planet) / 2 * COS)
        x_planet = x_ring - (z_ring - z_planet) * (inv(inner) - inv(ALPHA)) / (2 * TAN)
        self.planet, self.ring, self.sun = Gear(z_planet, x_planet), Gear(z_ring, x_ring, True), None
        self.inner = math.tan(inner)
        if z_sun:
            outer = pressure_angle(a, (z_sun + z_planet) / 2 * COS)
            self.outer = math.tan(outer)
            self.sun = Gear(z_sun, (z_sun + z_planet) * (inv(outer) - inv(ALPHA)) / (2 * TAN) - x_planet)
            y = a - (z_sun + z_planet) / 2
            self.sun.tip = z_sun / 2 + HA + y - x_planet
            self.planet.tip = min(self.planet.tip, z_planet / 2 + HA + y - self.sun.x)

    def roll(self, gear):
        return math.sqrt(max(0.0, gear.tip ** 2 - gear.base ** 2))

    def simple_limits(self):
        """Least margin of what needs no roots."""
        bound, a, p, r, s = self.case.bound, self.a, self.planet, self.ring, self.sun
        margins = [bound - abs(r.x), bound - abs(p.x), r.tip - r.base,
                   2 * a * math.sin(math.pi / 3) - 2 * p.tip - SPACING,
                   r.root - a - p.tip - TIP_CLEARANCE, r.tip - a - p.root - TIP_CLEARANCE]
        gears = [p, r]
        if s:
            gears.append(s)
            margins += [bound - abs(s.x), a - s.tip - p.root - TIP_CLEARANCE, a - p.tip - s.root - TIP_CLEARANCE]
        if min(margins) < -1e-6:
            return min(margins)
        margins += [2 * g.tip * g.half_tooth(g.tip) - TIP_THICKNESS for g in gears]
        if min(margins) < -1e-6 or min(g.root for g in (p, s or p)) <= 0:
            return min(margins)
        for before, after, _, _ in self.paths(False):
            ratio = (before + after) / (math.pi * COS)
            margins += [ratio - 1, 2 - ratio]
        margins.append(tips_apart(p, r, a) - self.case.clearance)
        return min(margins)

    def paths(self, shortened=True):
        """Before and after the pitch point, sun and planet first."""
        p, r, s = self.planet, self.ring, self.sun
        out = []
        if s:
            before, after = self.roll(p) - p.base * self.outer, self.roll(s) - s.base * self.outer
            if shortened:
                before = min(before, s.base * self.outer - math.sqrt(form_radius(s) ** 2 - s.base ** 2))
                after = min(after, p.base * self.outer - math.sqrt(form_radius(p) ** 2 - p.base ** 2))
            out.append((before, after, s, p))
        before, after = r.base * self.inner - self.roll(r), self.roll(p) - p.base * self.inner
        if shortened:
            before = min(before, p.base * self.inner - math.sqrt(form_radius(p) ** 2 - p.base ** 2))
        out.append((before, after, p, r))
        return out

    def efficiencies(self, drives):
        """Of each mesh; None where contact is interrupted."""
        out = []
        for (before, after, g1, g2), first in zip(self.paths(), drives):
            if before + after < math.pi * COS * (1 - 1e-9):
                return None
            out.append(mesh_efficiency(g1.base, g2.base, g2.ring, before, after,
                                       self.inner if g2.ring else self.outer, self.case.friction, first))
        return out

    def corners(self):
        """Least distance of tip corners from roots, less the clearance."""
        pairs = [(self.planet, self.ring), (self.ring, self.planet)]
        if self.sun:
            pairs += [(self.sun, self.planet), (self.planet, self.sun)]
        least = 9.0
        for own, mate in pairs:
            least = min(least, corner_distance(own, mate, self.a, self.case.clearance - 1e-6) - self.case.clearance)
            if least < -1e-6:
                break
        return least


class Case:
    """A tooth set with what is asked of it. 3k: sun in, ring 1 held, ring 2 out; simple: carrier out."""

    def __init__(self, rng):
        self.bound = rng.choice([0.6, 0.8, 1.0, 1.3, 2.0])
        self.friction = rng.choice([0.04, 0.07, 0.1, 0.13])
        self.backward = rng.random() < 0.4
        self.clearance = rng.choice([0.0, 0.002, 0.005])
        while True:
            sun, planet1 = rng.randint(9, 26), rng.randint(18, 52)
            ring1 = sun + 2 * planet1 + rng.randint(-2, 3)
            if (sun + ring1) % 3 or ring1 > 130:
                continue
            self.kind = "3k" if rng.random() < 0.8 else "simple"
            planet2 = planet1 - rng.randint(2, 16)
            ring2 = ring1 - (planet1 - planet2) + rng.randint(-2, 2)
            if self.kind == "simple":
                planet2 = ring2 = 0
            elif planet2 < 15 or ring1 * planet2 == ring2 * planet1:
                continue
            self.teeth = (sun, planet1, ring1, planet2, ring2)
            if self.kind == "simple" or 15 < abs(self.ratio()) < 250:
                break

    def ratio(self):
        s, p1, r1, p2, r2 = self.teeth
        return 1 + r1 / s if self.kind == "simple" else (1 + r1 / s) / (1 - r1 * p2 / (p1 * r2))

    def relative(self):
        """Turning of planet against the carrier, times what the planet's torque from each mesh is
        with a torque of 1 on the sun driving forward and nothing lost: > 0 where the planet is driven."""
        s, p1, r1, p2, r2 = self.teeth
        spin = -1.0 / p1 * s  # of the planet where the sun turns by 1 against the carrier
        # sun against the carrier where the sun turns forward
        if self.kind == "simple":
            sun = 1 - 1 / self.ratio()
            return [-p1 / s * sun * spin, p1 / s * sun * spin]
        carrier = s / (s + r1)
        out = self.ratio()
        torque_out = -out
        torque_held = -1 - torque_out
        turned = (1 - carrier) * spin
        return [-p1 / s * turned, p1 / r1 * torque_held * turned, p2 / r2 * torque_out * turned]

    def drives(self):
        """Of each mesh whether its first gear (sun; planet against rings) drives."""
        planet_driven = [v > 0 for v in self.relative()]
        first = [planet_driven[0]] + [not v for v in planet_driven[1:]]
        return [f != self.backward for f in first]

    def efficiency(self, meshes):
        s, p1, r1, p2, r2 = self.teeth
        planet_driven = [v > 0 for v in self.relative()]
        k = [e if d != self.backward else 1 / e for e, d in zip(meshes, planet_driven)]
        # torques on the planets add up to nothing, and those from outside
        if self.kind == "simple":
            held = (p1 / s * k[0]) / (p1 / r1 * k[1])
            out = -(1 + held)
        else:
            out = -(p1 / s * k[0] + p1 / r1 * k[1]) / (p1 / r1 * k[1] - p2 / r2 * k[2])
        forward = -out / self.ratio()
        value = 1 / forward if self.backward else forward
        return value if 0 < value <= 1 else -1.0

    def layer(self, number, a, x):
        s, p1, r1, p2, r2 = self.teeth
        return Layer((s, p1, r1) if number == 0 else (0, p2, r2), a, x, self)

    def __str__(self):
        return (f"{self.kind} {'/'.join(str(z) for z in self.teeth if z)} |x| <= {self.bound} mu {self.friction} "
                f"{'backward' if self.backward else 'forward'} clearance {1e3 * self.clearance:g} um")


class Exhaustion:
    def __init__(self, case, grid):
        self.case, self.grid, self.drives = case, grid, case.drives()

    def layer_best(self, number, a, shifts, worth):
        """The best of some shifts that keeps all limits: (merit, meshes, shift)."""
        drives = self.drives[:2] if number == 0 else self.drives[2:]
        found = []
        for x in shifts:
            try:
                layer = self.case.layer(number, a, x)
                if layer.simple_limits() < -1e-9:
                    continue
                meshes = layer.efficiencies(drives)
            except (ValueError, ZeroDivisionError):
                continue
            if meshes:
                found.append((worth(meshes), x, meshes, layer))
        for merit, x, meshes, layer in sorted(found, key=lambda f: -f[0]):
            if layer.corners() >= -ROUNDING:
                return merit, meshes, x
        return None

    def at(self, a, shifts1, shifts2):
        second = (0, [], 0.0)
        if self.case.kind == "3k":
            second = self.layer_best(1, a, shifts2, lambda m: m[0])
        if not second:
            return None
        first = self.layer_best(0, a, shifts1, lambda m: self.case.efficiency(m + second[1]))
        return first and (first[0], a, first[2], second[2])

    def possible_distances(self):
        """From all shifts at their bounds."""
        bound = self.case.bound
        s, p1, r1, p2, r2 = self.case.teeth
        low, high = 0.0, 1e9
        for total, most in ((s + p1, 2 * bound), (r1 - p1, 2 * bound), (r2 - p2, 2 * bound)):
            if total <= 0:
                continue
            ends = []
            for shift_sum in (-most, most):
                target = float(inv(ALPHA)) + 2 * TAN * shift_sum / total
                if target <= 0:
                    ends.append(total / 2 * COS)
                    continue
                left, right = 0.0, 1.4
                for _ in range(60):
                    middle = (left + right) / 2
                    left, right = (middle, right) if math.tan(middle) - middle < target else (left, middle)
                ends.append(total / 2 * COS / math.cos(left))
            low, high = max(low, ends[0]), min(high, ends[1])
        return low + 1e-6, high

    def climbed(self, peak, da, dx, zooms, rate):
        low, high = self.possible_distances()
        bound = self.case.bound
        for _ in range(zooms):
            for a in np.clip(peak[1] + da * np.linspace(-1, 1, 5), low, high):
                near = [np.unique(np.clip(x + dx * np.linspace(-1.5, 1.5, 9), -bound, bound)) for x in peak[2:]]
                point = self.at(a, *near)
                if point and point[0] > peak[0]:
                    peak = point
            da, dx = da * rate, dx * rate
        return peak

    def best(self, told):
        """Of a grid and around what was told."""
        bound, n = self.case.bound, self.grid
        low, high = self.possible_distances()
        if not low < high:
            return None
        found = []
        if n > 1:
            shifts = np.linspace(-bound, bound, n)
            line = [p for p in (self.at(a, shifts, shifts) for a in np.linspace(low, high, n)) if p]
            for peak in sorted(line, key=lambda p: -p[0])[:2]:
                found.append(self.climbed(peak, (high - low) / n, 2 * bound / n, 9, 0.4))
        if told:
            found.append(self.climbed((told[0] - 1e-6, *told[1:]), (high - low) / 24, bound / 12, 16, 0.45))
        return max(found, default=None)


def searched(program, case, folder):
    """Of the program: (efficiency, centre distance, shifts), or None."""
    s, p1, r1, p2, r2 = case.teeth
    names = {"sun": s, "planet1": p1, "ring1": r1, "planet2": p2 or 20, "ring2": r2 or 60}
    text = (f'format = 1\n[gearbox]\nkind = "{case.kind}"\nfriction = {case.friction}\nbacklash_mm = 0\n'
            f'[ratio]\nmin = {abs(case.ratio()) * 0.999}\nmax = {abs(case.ratio()) * 1.001}\n[teeth]\n'
            'identical_planets = false\n'
            + "".join(f"{n}_min = {z}\n{n}_max = {z}\n" for n, z in names.items())
            + f'[shift]\nmin = {-case.bound}\nmax = {case.bound}\n[limits]\nclearance_um = {1e3 * case.clearance}\n'
            f'[search]\nobjectives = "{"backward" if case.backward else "forward"}"\nlisted = 0\nresults = 1\n')
    needs = pathlib.Path(folder) / "needs.toml"
    needs.write_text(text)
    out = pathlib.Path(tempfile.mkdtemp(dir=folder))
    run = subprocess.run([program, "search", str(needs), "-o", str(out), "--threads", "1"],
                         capture_output=True, text=True, check=False)
    if run.returncode not in (0, 1):
        raise SystemExit(f"{case}: {run.stdout}{run.stderr}")
    if not (out / "design-001.toml").exists():
        return None
    # the design file has every digit
    design = tomllib.loads((out / "design-001.toml").read_text())
    shifts = {name: gear["shift"] for name, gear in design.items() if isinstance(gear, dict) and "shift" in gear}
    told = json.loads((out / "search.json").read_text())["designs"][0]
    return (told["backward" if case.backward else "forward"], design["gearbox"]["centre_distance_mm"],
            shifts.get("ring1", shifts.get("ring")), shifts.get("ring2", 0.0))


def judge(case, told):
    """Least margin and efficiency of the program's design, as seen from here."""
    layers = [case.layer(0, told[1], told[2])] + ([case.layer(1, told[1], told[3])] if case.kind == "3k" else [])
    drives = case.drives()
    meshes = layers[0].efficiencies(drives[:2]) + (layers[1].efficiencies(drives[2:]) if len(layers) > 1 else [])
    return min(min(l.simple_limits(), l.corners()) for l in layers), case.efficiency(meshes)


def main():
    program, *numbers = sys.argv[1:] or [os.environ["TRUEFLANK_PROGRAM"], 5, 20, 0]
    sets, seed, grid = (int(v) for v in (numbers + [6, 18, 40][len(numbers):]))
    rng, bad, feasible, judged, worst = random.Random(seed), 0, 0, 0, -9.0
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(sets):
            case = Case(rng)
            FORMS.clear()
            FILLETS.clear()
            told = searched(program, case, folder)
            best = Exhaustion(case, grid).best(told) if grid else None
            line = f"{case}: "
            judged += bool(told)
            if told:
                margin, efficiency = judge(case, told)
                line += f"told {told[0]:.7f} (here {efficiency:.7f}, margin {margin:.1e}) at {told[1:]}, "
                wrong = margin < -3e-6 or abs(efficiency - told[0]) > 2e-6
            else:
                line, wrong = line + "told none, ", False
            short = best[0] - (told[0] if told else -1.0) if best else -9.0
            if best:
                line += f"exhaustion {best[0]:.7f} at {tuple(float(v) for v in best[1:])}"
                feasible += 1
                worst = max(worst, short)
            else:
                line += "exhaustion none"
            wrong = wrong or short > SHORT
            bad += wrong
            print(line + (f", short by {short:.1e}" if best else "") + ("  <-- WRONG" if wrong else ""), flush=True)
    print(f"{sets} sets, {judged} designs judged, {feasible} feasible by exhaustion, at most {worst:.1e} short, "
          f"{bad} wrong")
    return 1 if bad or not judged else 0


if __name__ == "__main__":
    sys.exit(main())
