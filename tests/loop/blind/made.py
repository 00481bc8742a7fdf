# SPDX-License-Identifier: GPL-3.0-or-later
"""Gears as made and as measured, for the blind trial of the loop: an involute of its own (thread unwound from
the base circle), deviations along the normal, traces with zeros of their own, scans of flanks, noise of several
kinds. Shares no code and no formula with the library."""
import dataclasses
import math

import numpy


@dataclasses.dataclass
class Gear:
    teeth: int
    module: float
    shift: float
    face: float

    @property
    def reference(self):
        return 0.5 * self.module * self.teeth

    @property
    def base(self):
        return self.reference * math.cos(math.radians(20.0))

    @property
    def low(self):
        """Roll length where measuring starts: above the fillet of a usual rack."""
        radius = max(self.reference + self.module * (self.shift - 0.75), self.base * 1.004)
        return math.sqrt(radius**2 - self.base**2)

    @property
    def high(self):
        radius = self.reference + self.module * (self.shift + 0.93)
        return math.sqrt(radius**2 - self.base**2)

    def radius(self, u):
        roll = self.low + 0.5 * (u + 1.0) * (self.high - self.low)
        return numpy.hypot(self.base, roll)

    def unwound(self, u):
        """Angle unwound from the base circle."""
        return (self.low + 0.5 * (u + 1.0) * (self.high - self.low)) / self.base

    def centre(self, tooth):
        return 2.0 * math.pi * (tooth - 1) / self.teeth

    def half_at_base(self):
        t = math.tan(math.radians(20.0))
        thickness = self.module * (0.5 * math.pi + 2.0 * self.shift * t)
        return 0.5 * thickness / self.reference + t - math.radians(20.0)

    def normal_angle(self, tooth, side, u):
        """Angle of the outward normal: the thread is tangent to the base circle."""
        foot = self.centre(tooth) + side * (self.half_at_base() - self.unwound(u))
        return foot + side * 0.5 * math.pi

    def point(self, tooth, side, u):
        t = self.unwound(u)
        angle = self.centre(tooth) + side * (self.half_at_base() - t + numpy.arctan(t))
        return self.radius(u), angle

    def u_reference(self):
        return 2.0 * (self.base * math.tan(math.radians(20.0)) - self.low) / (self.high - self.low) - 1.0

    def design(self):
        return (f'format = 1\nname = "part"\n\n[gearbox]\nkind = "gear"\nmodule_mm = {self.module}\n\n[gear]\n'
                f"teeth = {self.teeth}\nshift = {self.shift}\nface_width_mm = {self.face}\n")


@dataclasses.dataclass
class Noise:
    sigma: float
    kind: str = "white"  # white, ar, smooth, heavy

    def draw(self, random, count):
        """Errors of successive values, with standard deviation sigma."""
        white = random.standard_normal(count)
        if self.kind == "ar":
            rho = 0.7
            out = numpy.empty(count)
            state = random.standard_normal()
            for i in range(count):
                state = rho * state + math.sqrt(1.0 - rho * rho) * white[i]
                out[i] = state
            return self.sigma * out
        if self.kind == "smooth":  # a stylus that drifts a little: half of the variance over about ten values
            kernel = numpy.exp(-0.5 * (numpy.arange(-12, 13) / 4.0) ** 2)
            slow = numpy.convolve(random.standard_normal(count + 24), kernel, "valid")
            slow /= math.sqrt(numpy.sum(kernel**2))
            return self.sigma * math.sqrt(0.5) * (white + slow)
        if self.kind == "heavy":
            return self.sigma * random.standard_t(4.0, count) / math.sqrt(2.0)
        return self.sigma * white


def make_wild(random, plan, noise, value):
    """Dust and loose contacts: a share of the values is anywhere."""
    if not plan.get("wild"):
        return value
    wild = random.uniform(0.0, 1.0, len(value)) < plan["wild"]
    return numpy.where(wild, value + random.uniform(-60.0, 60.0, len(value)) * noise.sigma, value)


def spots(gear, random, noise, form, plan):
    """Rows of an inspection: profile and helix traces of some teeth, index of all, both flanks or one.
    form(tooth, side, u, v): deviation [um] on arrays u, v (-1 ... 1)."""
    rows = ["record,tooth,flank,diameter_mm,z_mm,deviation_um"]
    if plan["common_zero"]:
        rows.insert(0, "# zero = common")
    u_ref = gear.u_reference()
    sides, step = plan.get("sides", (1, -1)), plan.get("rounding_um", 1e-4)
    for tooth in plan["teeth"]:
        for side in sides:
            for record in plan["records"]:
                count = plan["points"]
                along = numpy.linspace(-0.96, 0.96, count)
                u = along if record == "profile" else numpy.full(count, u_ref)
                v = along if record == "helix" else numpy.zeros(count)
                zero = 0.0 if plan["common_zero"] else 9.0 * random.standard_normal()
                value = form(tooth, side, u, v) + noise.draw(random, count) + zero
                value = step * numpy.round(make_wild(random, plan, noise, value) / step)
                radius = gear.radius(u)
                for i in range(count):
                    rows.append(f"{record},{tooth},{'left' if side > 0 else 'right'},{2.0 * radius[i]:.6f},"
                                f"{0.5 * (v[i] + 1.0) * gear.face:.5f},{value[i]:.4f}")
    if plan["index"]:
        for side in sides:
            first = None
            for tooth in range(1, gear.teeth + 1):
                value = float(form(tooth, side, numpy.array([u_ref]), numpy.zeros(1))[0])
                value += float(noise.sigma * random.standard_normal())
                if first is None:
                    first = 0.0 if plan["common_zero"] else value
                rows.append(f"index,{tooth},{'left' if side > 0 else 'right'},{2.0 * gear.radius(u_ref):.6f},"
                            f"{0.5 * gear.face:.5f},{value - first:.4f}")
    return "\n".join(rows) + "\n"


def scan(gear, random, noise, form, plan):
    """Points of all flanks along scan lines, moved along their normals; of some teeth none (`hole`)."""
    count, hole = plan["scan"], plan.get("hole", (1, 0))
    rows = ["x_mm,y_mm,z_mm"]
    per_flank = max(20, count // (2 * gear.teeth))
    for tooth in range(1, gear.teeth + 1):
        if (tooth - hole[0]) % gear.teeth < hole[1]:
            continue
        for side in (1, -1):
            u = random.uniform(-0.97, 0.97, per_flank)
            v = random.uniform(-0.985, 0.985, per_flank)
            order = numpy.lexsort((u, numpy.floor((v + 1.0) * 10.0)))
            u, v = u[order], v[order]
            value = 1e-3 * make_wild(random, plan, noise, form(tooth, side, u, v) + noise.draw(random, per_flank))
            radius, angle = gear.point(tooth, side, u)
            normal = gear.normal_angle(tooth, side, u)
            x = radius * numpy.cos(angle) + value * numpy.cos(normal)
            y = radius * numpy.sin(angle) + value * numpy.sin(normal)
            z = 0.5 * (v + 1.0) * gear.face
            rows.extend(f"{a:.6f},{b:.6f},{c:.6f}" for a, b, c in zip(x, y, z))
    return "\n".join(rows) + "\n"
