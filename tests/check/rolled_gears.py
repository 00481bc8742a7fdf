# SPDX-License-Identifier: GPL-3.0-or-later
"""Teeth made by rolling a rack, as points; nothing here comes from the library.

A rack's contour is a set of points with normals. A point cuts where its normal passes the pitch point (the law of
gearing); what no point of the contour reaches deeper is left. A ring's flank is cut by the same rack from the other
side; its fillet is the circle that touches flank and root circle, found by bisection on the points. Lengths in
modules, angles in radians, a tooth space stands on the line to the mate."""
import functools

import numpy as np

FLANK_POINTS, FILLET_POINTS, RADII = 1500, 1500, 3000
PRESSURE_ANGLE = np.radians(20.0)


def cut(teeth, shift, u, v, normal_u, normal_v):
    """Radius and half angle of the space that contour points (u across, v deep) cut, with their outward normals."""
    pitch_radius = teeth / 2
    travel = (v - shift) * normal_u / normal_v - u
    x, y = u + travel, pitch_radius + shift - v
    return np.hypot(x, y), np.arctan2(x, y) - travel / pitch_radius


def widest(branches, radii):
    """At each radius the widest of the branches, each a curve of angle over radius that may turn back."""
    angle = np.full(radii.shape, -np.inf)
    for r, a in branches:
        # where it turns back one run ends and the next begins
        turns = np.flatnonzero(np.diff(np.sign(np.diff(r)))) + 1
        for begin, end in zip([0, *turns], [*turns, len(r) - 1]):
            run = slice(begin, end + 1)
            along, over = (r[run], a[run]) if r[end] > r[begin] else (r[run][::-1], a[run][::-1])
            first, last = np.searchsorted(radii, (along[0], along[-1]))
            angle[first:last] = np.maximum(angle[first:last], np.interp(radii[first:last], along, over))
    return angle


class External:
    """Gear of `teeth` with its `tip` radius; `form` is the radius where fillet and flank meet."""

    def __init__(self, teeth, shift, tip, dedendum=1.25, rounding=0.38):
        alpha = PRESSURE_ANGLE
        depth = dedendum - rounding
        across = np.pi / 4 - depth * np.tan(alpha) - rounding / np.cos(alpha)
        assert across >= 0, "the rounding does not fit the rack"
        start = depth + rounding * np.sin(alpha)  # of the rounding, on the flank
        v = np.linspace(-1.2 - abs(shift), start, FLANK_POINTS)
        flank = cut(teeth, shift, np.pi / 4 - v * np.tan(alpha), v, np.cos(alpha), np.sin(alpha))
        beta = np.linspace(alpha, np.pi / 2, FILLET_POINTS)
        fillet = cut(teeth, shift, across + rounding * np.cos(beta), depth + rounding * np.sin(beta),
                     np.cos(beta), np.sin(beta))
        root = teeth / 2 + shift - dedendum
        self.teeth, self.tip, self.root = teeth, tip, root
        self.radii = np.linspace(root, tip, RADII)[1:]
        flank_angle = widest([flank], self.radii)
        self.space = widest([flank, fillet], self.radii)
        on_flank = flank_angle >= self.space
        self.form = self.radii[np.argmax(on_flank)] if on_flank.any() else tip
        half_tooth = np.pi / teeth - self.space
        self.pointed = bool((half_tooth <= 0).any())


class Ring:
    """Internal gear; `form` is where the flank ends and the fillet of its root begins."""

    def __init__(self, teeth, shift, tip, dedendum=1.25, rounding=0.38):
        alpha = PRESSURE_ANGLE
        v = np.linspace(-2.2 - shift, 2.2 - shift, 2 * FLANK_POINTS)
        r, a = cut(teeth, shift, np.pi / 4 - v * np.tan(alpha), v, np.cos(alpha), np.sin(alpha))
        grows = np.concatenate([[True], np.diff(r) < 0])  # v goes inwards; beyond the base circle the curve turns back
        stop = np.argmin(grows) if not grows.all() else len(r)
        r, a = r[:stop][::-1], a[:stop][::-1]
        root = teeth / 2 + shift + dedendum
        self.teeth, self.tip, self.root = teeth, tip, root
        self.radii = np.linspace(tip, root, RADII)[:-1]
        self.space = np.pi / teeth - np.interp(self.radii, r, a)
        flank = np.column_stack([self.radii * np.cos(self.space), self.radii * np.sin(self.space)])
        centre = lambda angle: (root - rounding) * np.array([np.cos(angle), np.sin(angle)])
        apart = lambda angle: np.hypot(*(flank - centre(angle)).T).min()
        assert apart(0.0) >= rounding, "the fillet does not fit the space"
        low, high = 0.0, np.interp(root - rounding, self.radii, self.space)
        for _ in range(50):
            middle = (low + high) / 2
            low, high = (middle, high) if apart(middle) > rounding else (low, middle)
        touch = np.argmin(np.hypot(*(flank - centre(low)).T))
        self.form = self.radii[touch]
        beyond = self.radii > self.form
        # distance of the circle's points from the middle of the space, at their radii
        d, R = root - rounding, self.radii[beyond]
        self.space[beyond] = low + np.arccos(np.clip((d * d + R * R - rounding**2) / (2 * d * R), -1, 1))


def contour(gear, parts=slice(None)):
    """Both flanks of one space as points (radius, angle), with the tip circle between neighbours."""
    r, a = gear.radii[parts], gear.space[parts]
    return np.concatenate([r, r]), np.concatenate([a, -a])


def within(points, low, high):
    """Radii of complex numbers, and these, where they lie between two radii."""
    square = points.real**2 + points.imag**2
    near = (square >= low * low) & (square <= high * high)
    return np.sqrt(square[near]), points[near]


class Mesh:
    """gear1 (external) in gear2 (external or ring) at a centre distance; gear 1 turns, gear 2 is pushed."""

    def __init__(self, gear1, gear2, distance):
        self.gear1, self.gear2, self.distance = gear1, gear2, distance
        self.internal = isinstance(gear2, Ring)

    def seen_from_2(self, points, turned, low, high):
        """Points of gear 1 (a tooth of it on the line of centres where turned = 0) in polar coordinates of gear 2,
        whose middle of space looks at gear 1's axis; gear 2 turns along with the ratio. Of radii between `low` and `high`."""
        seen = points * np.exp(1j * turned)
        seen = seen + self.distance if self.internal else self.distance - seen.conj()
        radius, seen = within(seen, low, high)
        turned2 = turned * self.gear1.teeth / self.gear2.teeth
        pitch = 2 * np.pi / self.gear2.teeth
        return radius, (np.angle(seen) - turned2 + pitch / 2) % pitch - pitch / 2

    @functools.lru_cache(maxsize=None)
    def points_of_1(self, flanks_only=False):
        """The teeth of gear 1 about the line of centres, as complex numbers."""
        r, a = contour(self.gear1, self.gear1.radii > self.gear1.form if flanks_only else slice(None))
        pitch = 2 * np.pi / self.gear1.teeth
        reach = min(4, self.gear1.teeth // 2)
        return np.concatenate([r * np.exp(1j * (a + (k + 0.5) * pitch)) for k in range(-reach, reach)])

    @functools.lru_cache(maxsize=None)
    def points_of_2(self):
        """The spaces of gear 2 about the line of centres, as complex numbers."""
        r, a = contour(self.gear2)
        pitch = 2 * np.pi / self.gear2.teeth
        return np.concatenate([r * np.exp(1j * (a + k * pitch)) for k in range(-4, 5)])

    def turns(self, steps):
        return np.arange(steps) / steps * 2 * np.pi / self.gear1.teeth

    def plays(self, steps, flanks_only):
        """How far gear 2 can be turned either way at each position of gear 1: two rows."""
        gear = self.gear2
        low, high = (gear.tip, gear.form) if self.internal else (gear.form, gear.tip)
        if not flanks_only:
            low, high = (gear.tip, np.inf) if self.internal else (0.0, gear.tip)
        found = []
        for turned in self.turns(steps):
            r2, a2 = self.seen_from_2(self.points_of_1(flanks_only), turned, low, high)
            free = np.interp(r2, gear.radii, gear.space)
            # nothing stands in the way where gear 2 has no teeth
            found.append([np.min(free - a2, initial=np.inf), np.min(free + a2, initial=np.inf)])
        return np.array(found).T

    def conjugate_plays(self, steps=120):
        """The play of the flanks alone. Where a corner meets a flank it is less: the largest counts."""
        return self.plays(steps, True).max(axis=1)

    def deepest(self, turned2, turned1, least=0.0):
        """How deep any point of one gear stands in the other, gear 2 turned by `turned2` out of the middle; no less than
        `least`."""
        least = depth_in(self.gear2, self.points_in_2(turned1, turned2), least)
        return depth_in(self.gear1, self.points_in_1(turned1, turned2), least)

    def points_in_2(self, turned1, turned2):
        r2, a2 = self.seen_from_2(self.points_of_1(), turned1, *sorted((self.gear2.root, self.gear2.tip)))
        return r2, a2 - turned2

    def points_in_1(self, turned1, turned2):
        """Points of gear 2 near the mesh in coordinates of gear 1, the middle of its space at 0."""
        ratio = self.gear1.teeth / self.gear2.teeth
        seen = self.points_of_2() * np.exp(1j * (turned1 * ratio + turned2))
        seen = seen - self.distance if self.internal else self.distance - seen.conj()
        radius, seen = within(seen, self.gear1.root, self.gear1.tip)
        pitch = 2 * np.pi / self.gear1.teeth
        # a tooth of gear 1 stands at angle turned1: its spaces half a pitch aside
        angle = np.angle(seen) - turned1 - pitch / 2
        return radius, (angle + pitch / 2) % pitch - pitch / 2


def depth_in(gear, points, least=0.0):
    """Deepest of the points in a gear's material: distance to its contour, or `least` where that is more. Points in polar
    coordinates of a space. No point is farther from the contour than along the arc at its own radius, so those with
    shorter arcs than the deepest so far are not measured."""
    radius, angle = points
    low, high = sorted((gear.root, gear.tip))
    space = np.interp(radius, gear.radii, gear.space)
    inside = (radius > low) & (radius < high) & (np.abs(angle) > space)
    arc = (np.abs(angle) - space) * radius
    inside &= arc > least
    if not inside.any():
        return least
    r, a, arc = radius[inside], np.abs(angle[inside]), arc[inside]
    tooth = np.column_stack([gear.radii * np.cos(gear.space), gear.radii * np.sin(gear.space)])
    p = np.column_stack([r * np.cos(a), r * np.sin(a)])
    order = np.argsort(-arc)[:400]
    best = least
    start, step = tooth[:-1], np.diff(tooth, axis=0)
    length2 = (step**2).sum(axis=1)
    for point, longest in zip(p[order], arc[order]):
        if longest <= best:
            break
        t = np.clip(((point - start) * step).sum(axis=1) / length2, 0, 1)
        nearest = np.hypot(*(point - start - t[:, None] * step).T).min()
        best = max(best, min(nearest, abs(np.hypot(*point) - gear.tip)))
    return best
