# SPDX-License-Identifier: GPL-3.0-or-later
"""A third traces alone, a third traces with index, runout and spans, a third clouds aligned or in any pose, of spur,
helical and internal gears of 12 to 90 teeth: what machinists, gauges, clamping, heat and damage leave (36 forms without
a name, nearly half of them beside a name), 15 names alone, and nothing. Written by the file formats and the signs alone:
shares nothing with the other trials nor with the library (involutes by their roll, normals by formula).
Usage: outside_judge.py PROGRAM DIRECTORY [--seed N] [--each N] [--only TEXT] [--list] [--least SHARE] [--every N]
Right: nothing: no_effect. A name: it alone or one it can be confused with. A form: seen, no wrong name, and the name
beside it told. Always: a held-out error within 1.2 of the true noise, or said to be more."""
import json
import math
import subprocess

import numpy as np

import trial

PI = math.pi


class Gear:
    def __init__(s, rng, z=None, internal=None, beta=None):
        s.internal = bool(rng.random() < 0.2) if internal is None else internal
        s.z = int(z or rng.choice([12, 14, 17, 19, 22, 25, 29, 33, 38, 44, 52, 63, 75, 90]))
        if s.internal:
            s.z = max(s.z, 40)
        s.m = float(rng.choice([0.5, 0.8, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0]))
        if s.z > 50:
            s.m = min(s.m, 2.0)
        s.beta = math.radians(float(rng.choice([0, 0, 0, 8, 15, 20, -12, -25])) if beta is None else beta)
        s.x = float(rng.choice([0.0, 0.1, 0.2, 0.3])) if s.z > 18 else float(rng.choice([0.3, 0.4]))
        s.b = round(s.m * float(rng.uniform(5, 14)), 1)
        an = math.radians(20)
        s.at = math.atan(math.tan(an) / math.cos(s.beta))
        s.r = s.m / math.cos(s.beta) * s.z / 2
        s.rb = s.r * math.cos(s.at)
        s.bb = math.asin(math.sin(s.beta) * math.cos(an))
        half = (PI / 2 + 2 * s.x * math.tan(an)) / s.z
        inv = lambda a: math.tan(a) - a
        # half angle of the tooth (ring: of the gap) at the base circle
        s.psib = half + inv(s.at)

    def design(s):
        return (f'format = 1\nname = "judged"\n[gearbox]\nkind = "gear"\nmodule_mm = {s.m}\n'
                f'helix_angle_deg = {math.degrees(s.beta):.6f}\n[gear]\nteeth = {s.z}\nshift = {s.x}\n'
                f'face_width_mm = {s.b}\n' + ('internal = true\n' if s.internal else ''))

    def read_report(s, rep):
        g = rep['gears']['gear']
        s.tip, s.form = g['tip_diameter_mm'] / 2, g['root_form_diameter_mm'] / 2
        roll = lambda r: math.sqrt(max(r * r - s.rb ** 2, 0))
        s.Ltip, s.Lroot = roll(s.tip), roll(s.form)
        s.span_k, s.span = g['span_teeth'], g['span_mm']

    def u(s, L):
        return 2 * (L - s.Lroot) / (s.Ltip - s.Lroot) - 1

    def v(s, zz):
        return 2 * zz / s.b - 1

    def point(s, k, side, L, zz):
        """side +1: counter-clockwise flank; returns point and normal out of the material."""
        t = L / s.rb
        rr = s.rb * np.sqrt(1 + t * t)
        inv = t - np.arctan(t)
        if s.internal:
            psi = PI / s.z - (s.psib - inv)
        else:
            psi = s.psib - inv
        th = 2 * PI * (k - 1) / s.z + side * psi + zz * math.tan(s.beta) / s.r
        er = np.stack([np.cos(th), np.sin(th), 0 * th], -1)
        et = np.stack([-np.sin(th), np.cos(th), 0 * th], -1)
        ca, sa = s.rb / rr, L / rr
        P = er * rr[..., None]
        P[..., 2] = zz
        sg = -1.0 if s.internal else 1.0
        n = (et * (side * ca)[..., None] + sg * er * sa[..., None]) * math.cos(s.bb)
        n[..., 2] = -side * math.sin(s.bb)
        return P, n, th


# Effects with a name: (what they do at places P [um], {name: what is true of it}); `a` sets the size.
# P: tooth k, side (+1 counter-clockwise), roll length L, height z, angle th, outward normal n.
def theta_tooth(g, P):
    return 2 * PI * (P['k'] - 1) / g.z


def eccentricity(rng, g, a):
    ph = rng.uniform(-PI, PI)
    e = a * 1.5
    f = lambda P: e * (P['n'][..., 0] * math.cos(ph) + P['n'][..., 1] * math.sin(ph))
    return f, {'eccentricity': {'amplitude_um': e, 'phase_deg': math.degrees(ph)}}


def helix_error(rng, g, a):
    s = a * 2 * rng.choice([-1, 1])
    return (lambda P: s * P['side'] * (P['z'] / g.b - 0.5)), {'helix_error': {'slope_um': s}}


def taper(rng, g, a):
    s = a * 2 * rng.choice([-1, 1])
    return (lambda P: s * (P['z'] / g.b - 0.5)), {'taper': {'slope_um': s}}


def crowning(rng, g, a):
    s = a * 1.5
    return (lambda P: -s * g.v(P['z']) ** 2), {'crowning': {'amount_um': s}}


def pressure_angle_error(rng, g, a):
    s = a * 2 * rng.choice([-1, 1])
    return (lambda P: s * g.u(P['L']) / 2), {'pressure_angle_error': {'slope_um': s}}


def profile_crowning(rng, g, a):
    s = a * 1.5
    return (lambda P: -s * g.u(P['L']) ** 2), {'profile_crowning': {'amount_um': s}}


def tip_relief(rng, g, a):
    s = a * 2
    w = rng.uniform(0.3, 0.6)
    def f(P):
        q = np.clip((g.u(P['L']) / 2 + 0.5 - (1 - w)) / w, 0, None)
        return -s * q * q
    return f, {'tip_relief': {'amount_um': s}}


def pitch_wave(rng, g, a):
    o = int(rng.integers(2, 5))
    ph = rng.uniform(-PI, PI)
    return (lambda P: a * P['side'] * np.cos(o * theta_tooth(g, P) - ph)), {'pitch_wave': {'order': o}}


def lobing(rng, g, a):
    o = int(rng.integers(2, 5))
    ph = rng.uniform(-PI, PI)
    # radially outwards by a: along the normal its radial part
    def f(P):
        nr = P['n'][..., 0] * np.cos(P['th']) + P['n'][..., 1] * np.sin(P['th'])
        return 2.5 * a * nr * np.cos(o * P['th'] - ph)
    return f, {'lobing': {'order': o, 'amplitude_um': 2.5 * a}}


def single_tooth(rng, g, a):
    k = int(rng.integers(2, g.z + 1))
    s = 2.5 * a * rng.choice([-1, 1])
    return (lambda P: s * (P['k'] == k)), {'single_tooth': {'tooth': k, 'amount_um': s}}


def tooth_thickness(rng, g, a):
    s = 3 * a * rng.choice([-1, 1])   # circular thickness on the reference circle
    c = 0.5 * math.cos(g.at) * math.cos(g.bb)
    return (lambda P: s * c + 0 * P['L']), {'tooth_thickness': {'amount_um': s}}


def flank_wear(rng, g, a):
    c, w = rng.uniform(-0.3, 0.3), rng.uniform(0.25, 0.4)
    return (lambda P: -2 * a * np.exp(-((g.u(P['L']) - c) / w) ** 2)), {'flank_wear': {'depth_um': 2 * a}}


def axis_tilt(rng, g, a):
    ph = rng.uniform(-PI, PI)
    s = 2.5 * a / (g.b / 2)
    f = lambda P: s * (P['z'] - g.b / 2) * (P['n'][..., 0] * math.cos(ph) + P['n'][..., 1] * math.sin(ph))
    return f, {'axis_tilt': {'slope_um_per_mm': s, 'phase_deg': math.degrees(ph)}}


def elephant_foot(rng, g, a):
    h = rng.uniform(0.06, 0.15) * g.b
    return (lambda P: 4 * a * np.exp(-P['z'] / h)), {'elephant_foot': {'amount_um': 4 * a}}


def flank_twist(rng, g, a):
    s = 2 * a * rng.choice([-1, 1])
    return (lambda P: s * g.u(P['L']) * g.v(P['z'])), {'flank_twist': {'amount_um': s}}


NAMED = [eccentricity, helix_error, taper, crowning, pressure_angle_error, profile_crowning, tip_relief, pitch_wave,
         lobing, single_tooth, tooth_thickness, flank_wear, axis_tilt, elephant_foot, flank_twist]
# visible in: t traces, m mixed, s scan in any pose, a aligned scan
SEEN = dict(eccentricity='ma', helix_error='tmsa', taper='tmsa', crowning='tmsa', pressure_angle_error='tmsa',
            profile_crowning='tmsa', tip_relief='tmsa', pitch_wave='msa', lobing='msa', single_tooth='msa',
            tooth_thickness='msa', flank_wear='tmsa', axis_tilt='tma', elephant_foot='tmsa', flank_twist='sa')
# what an expert would call the same thing
ALIKE = {'eccentricity': {'pitch_wave', 'lobing'}, 'tooth_thickness': {'contour_offset', 'scale'},
         'lobing': {'scale_xy', 'skew'}, 'pitch_wave': {'lobing'}}


# Forms that nobody declared.
def hash_phase(rng, n):
    return rng.uniform(0, 2 * PI, n)


def feed_marks(rng, g, a):
    lam = g.b / rng.uniform(6, 14)
    ph = hash_phase(rng, 2 * g.z + 2) if rng.random() < 0.5 else np.full(2 * g.z + 2, rng.uniform(0, 6))
    return lambda P: a * np.cos(2 * PI * P['z'] / lam + ph[P['k'] * 2 - (P['side'] > 0)])


def profile_waviness(rng, g, a):
    n, ph = rng.uniform(2.2, 6), rng.uniform(0, 6)
    return lambda P: a * np.cos(PI * n * g.u(P['L']) + ph)


def step_profile(rng, g, a):
    u0, s = rng.uniform(-0.5, 0.5), rng.choice([-1, 1])
    return lambda P: 1.3 * a * s * (g.u(P['L']) > u0)


def step_lead(rng, g, a):
    v0, s = rng.uniform(-0.5, 0.5), rng.choice([-1, 1])
    return lambda P: 1.3 * a * s * (g.v(P['z']) > v0)


def step_lead_opposite(rng, g, a):
    v0, s = rng.uniform(-0.5, 0.5), rng.choice([-1, 1])
    return lambda P: 1.3 * a * s * P['side'] * (g.v(P['z']) > v0)


def groove_height(rng, g, a):
    v0, w = rng.uniform(-0.6, 0.6), rng.uniform(0.06, 0.15)
    return lambda P: -2 * a * (np.abs(g.v(P['z']) - v0) < w)


def ridge_profile(rng, g, a):
    u0, w = rng.uniform(-0.5, 0.5), rng.uniform(0.08, 0.16)
    return lambda P: 2 * a * np.exp(-((g.u(P['L']) - u0) / w) ** 2)


def profile_kink(rng, g, a):
    u0, s = rng.uniform(-0.3, 0.3), rng.choice([-1, 1])
    return lambda P: 2 * s * a * np.abs(g.u(P['L']) - u0)


def lead_kink(rng, g, a):
    v0, s = rng.uniform(-0.3, 0.3), rng.choice([-1, 1])
    return lambda P: 2 * s * a * P['side'] * np.clip(g.v(P['z']) - v0, 0, None)


def root_relief(rng, g, a):
    u0 = rng.uniform(-0.5, -0.1)
    return lambda P: -3 * a * np.clip((u0 - g.u(P['L'])) / (1 + u0), 0, None)


def root_ridge(rng, g, a):
    return lambda P: 2.5 * a * np.clip((-0.7 - g.u(P['L'])) / 0.3, 0, None)


def tip_ridge(rng, g, a):
    return lambda P: 2.5 * a * np.clip((g.u(P['L']) - 0.65) / 0.35, 0, None)


def profile_hollow(rng, g, a):
    return lambda P: 1.6 * a * (g.u(P['L']) ** 2)


def profile_s(rng, g, a):
    s = rng.choice([-1, 1])
    return lambda P: 1.6 * a * s * np.sin(PI * g.u(P['L']))


def lead_s(rng, g, a):
    s = rng.choice([-1, 1])
    return lambda P: 1.6 * a * s * np.sin(PI * g.v(P['z'])) * P['side']


def end_relief_top(rng, g, a):
    v0 = rng.uniform(0.3, 0.6)
    return lambda P: -3 * a * np.clip((g.v(P['z']) - v0) / (1 - v0), 0, None)


def jaws(rng, g, a):
    ph = rng.uniform(0, 6)
    return lambda P: 2 * a * np.cos(3 * theta_tooth(g, P) - ph) * (1 - P['z'] / g.b)


def clamp_squared(rng, g, a):
    o, ph = int(rng.integers(2, 5)), rng.uniform(0, 6)
    return lambda P: 2 * a * np.cos(o * theta_tooth(g, P) - ph) * (P['z'] / g.b) ** 2


def twist_by_thirds(rng, g, a):
    t = rng.permutation([-1.5, 0.3, 1.2])
    return lambda P: 1.6 * a * t[((P['k'] - 1) * 3) // g.z] * P['side'] * g.v(P['z'])


def saddle(rng, g, a):
    ph = rng.uniform(0, 6)
    return lambda P: 2 * a * np.cos(2 * theta_tooth(g, P) - ph) * g.v(P['z']) * P['side']


def weld_seam(rng, g, a):
    t0, w = rng.uniform(0, 2 * PI), rng.uniform(0.10, 0.25) + 2.0 / g.z
    def f(P):
        d = (P['th'] - t0 + PI) % (2 * PI) - PI
        return 3 * a * np.exp(-(d / w) ** 2)
    return f


def cooling(rng, g, a):
    t0 = rng.uniform(0, 6)
    return lambda P: -2.4 * a * (1 + np.cos(theta_tooth(g, P) - t0)) / 2 * (P['z'] / g.b) ** 2


def wear_some_teeth(rng, g, a):
    k0, n = int(rng.integers(1, g.z)), max(3, g.z // 4)
    side = rng.choice([-1, 1])
    u0 = rng.uniform(-0.3, 0.3)
    return lambda P: -4 * a * (((P['k'] - k0) % g.z) < n) * (P['side'] == side) * np.exp(-((g.u(P['L']) - u0) / 0.35) ** 2)


def sector(rng, g, a):
    k0, n = int(rng.integers(2, g.z)), max(3, int(g.z * rng.uniform(0.15, 0.4)))
    return lambda P: 2.2 * a * P['side'] * (((P['k'] - k0) % g.z) < n)


def drift_restart(rng, g, a):
    n = max(4, int(g.z * rng.uniform(0.2, 0.45)))
    return lambda P: 2.6 * a * P['side'] * (((P['k'] - 1) % n) / n - 0.5)


def drift_once(rng, g, a):
    return lambda P: 3 * a * P['side'] * ((P['k'] - 1) / g.z - 0.5)


def comb(rng, g, a):
    n = int(rng.choice([2, 3, 4]))
    return lambda P: 1.6 * a * P['side'] * ((P['k'] % n) == 0)


def half_offset(rng, g, a):
    k0 = int(rng.integers(1, g.z))
    ph = rng.uniform(0, 6)
    def f(P):
        half = ((P['k'] - k0) % g.z) < g.z // 2
        return 2.5 * a * half * (P['n'][..., 0] * math.cos(ph) + P['n'][..., 1] * math.sin(ph))
    return f


def bad_tooth_one_flank(rng, g, a):
    k0, side = int(rng.integers(2, g.z)), rng.choice([-1, 1])
    return lambda P: 5 * a * ((P['k'] == k0) & (P['side'] == side)) * (0.3 + 0.7 * g.u(P['L']) ** 2)


def spot(rng, g, a):
    k0, side = int(rng.integers(1, g.z + 1)), rng.choice([-1, 1])
    u0, v0 = rng.uniform(-0.4, 0.4), rng.uniform(-0.5, 0.5)
    def f(P):
        q = ((g.u(P['L']) - u0) / 0.5) ** 2 + ((g.v(P['z']) - v0) / 0.35) ** 2
        return -8 * a * ((P['k'] == k0) & (P['side'] == side)) * np.exp(-q)
    return f


def chatter(rng, g, a):
    n, q, ph = rng.uniform(1.5, 4), rng.uniform(3, 7), rng.uniform(0, 6)
    return lambda P: a * np.cos(PI * n * g.u(P['L']) + PI * q * g.v(P['z']) + ph)


def layers(rng, g, a):
    lam = g.b / int(rng.integers(12, 25))
    return lambda P: 1.2 * a * (2 * ((P['z'] / lam) % 1) - 1)


def bulge_mid(rng, g, a):
    v0 = rng.uniform(-0.4, 0.4)
    return lambda P: 2.5 * a * np.exp(-((g.v(P['z']) - v0) / 0.3) ** 2)


def crowning_varies(rng, g, a):
    ph = rng.uniform(0, 6)
    return lambda P: -2 * a * g.v(P['z']) ** 2 * np.cos(theta_tooth(g, P) - ph)


def profile_slope_varies(rng, g, a):
    ph, o = rng.uniform(0, 6), int(rng.integers(2, 4))
    return lambda P: 1.8 * a * g.u(P['L']) * np.cos(o * theta_tooth(g, P) - ph) * P['side']


def wear_upper_half(rng, g, a):
    return lambda P: -2.5 * a * (P['side'] > 0) * np.clip(g.v(P['z']), 0, None) * np.clip(1 - g.u(P['L']) ** 2, 0, None)


FORMS = [feed_marks, profile_waviness, step_profile, step_lead, step_lead_opposite, groove_height, ridge_profile,
         profile_kink, lead_kink, root_relief, root_ridge, tip_ridge, profile_hollow, profile_s, lead_s, end_relief_top,
         jaws, clamp_squared, twist_by_thirds, saddle, weld_seam, cooling, wear_some_teeth, sector, drift_restart,
         drift_once, comb, half_offset, bad_tooth_one_flank, spot, chatter, layers, bulge_mid, crowning_varies,
         profile_slope_varies, wear_upper_half]
FSEEN = {f.__name__: 'tmsa' for f in FORMS}
FSEEN.update(sector='msa', drift_restart='msa', drift_once='msa', comb='msa', half_offset='ma', spot='sa', chatter='sa',
             bad_tooth_one_flank='msa', wear_some_teeth='tmsa', wear_upper_half='tmsa', layers='tsa', weld_seam='msa',
             jaws='tmsa')
# names that are the form, or that an expert would accept for it
FALIKE = {'comb': {'pitch_wave'}, 'bad_tooth_one_flank': {'single_tooth'}, 'profile_hollow': {'profile_crowning'}}


# Measuring.
def ar(rng, n, rho):
    e = rng.standard_normal(n)
    if rho <= 0:
        return e
    o = np.empty(n)
    o[0] = e[0]
    q = math.sqrt(1 - rho * rho)
    for i in range(1, n):
        o[i] = rho * o[i - 1] + q * e[i]
    return o


def place(g, k, side, L, zz):
    k = np.asarray(k)
    L = np.broadcast_to(np.asarray(L, float), k.shape).copy()
    zz = np.broadcast_to(np.asarray(zz, float), k.shape).copy()
    side = np.broadcast_to(np.asarray(side), k.shape).copy()
    P, n, th = g.point(k, side, L, zz)
    return dict(k=k, side=side, L=L, z=zz, th=th, n=n, P=P)


def name_of(g, side):
    left = side > 0
    if g.internal:
        left = not left
    return 'left' if left else 'right'


def inspection(rng, g, f, noise, rho, kind, d):
    nt = g.z if (kind == 'm' and rng.random() < 0.3) or rng.random() < 0.2 else int(rng.choice([3, 4, 4, 6, 8, 12]))
    nt = min(nt, g.z)
    teeth = np.unique(np.round(1 + np.arange(nt) * g.z / nt).astype(int))
    teeth = teeth[teeth <= g.z]
    npts = int(rng.choice([60, 120, 240])) if nt <= 12 else 60
    u = np.linspace(-0.96, 0.95, npts)
    Ls = g.Lroot + (u + 1) / 2 * (g.Ltip - g.Lroot)
    zs = np.linspace(0.02, 0.98, npts) * g.b
    Lm = (g.Lroot + g.Ltip) / 2
    rows = ['record,tooth,flank,diameter_mm,z_mm,deviation_um']
    dia = lambda L: 2 * math.sqrt(g.rb ** 2 + L * L)
    tot = []
    for rec in ('profile', 'helix'):
        for k in teeth:
            for side in (1, -1):
                kk = np.full(npts, k)
                P = place(g, kk, side, Ls, g.b / 2) if rec == 'profile' else place(g, kk, side, Lm, zs)
                e = noise * ar(rng, npts, rho)
                d_ = f(P) + e
                rng.random()
                d_ = d_ - d_.mean()
                for i in range(npts):
                    rows.append(f'{rec},{k},{name_of(g, side)},{dia(P["L"][i]):.5f},{P["z"][i]:.4f},{d_[i]:.3f}')
    files = []
    if kind == 'm':
        all_k = np.arange(1, g.z + 1)
        for side in (1, -1):
            P = place(g, all_k, side, Lm, g.b / 2)
            d_ = f(P) + noise * rng.standard_normal(g.z)
            d_ -= d_[0]
            for k in all_k:
                rows.append(f'index,{k},{name_of(g, side)},{dia(Lm):.5f},{g.b / 2:.4f},{d_[k - 1]:.3f}')
        # runout: a ball that touches near the reference circle in the gap after each tooth
        ball = round(1.7 * g.m, 2)
        # centre of the ball: inv(aM) = ball/(2 rb cos bb) -+ half the gap at base
        if g.internal:
            eta = g.psib - ball / 2 / (g.rb * math.cos(g.bb))
        else:
            eta = ball / 2 / (g.rb * math.cos(g.bb)) - (PI / g.z - g.psib)
        if eta > 0.002:
            lo, hi = 0.0, 1.2
            for _ in range(80):
                mid = (lo + hi) / 2
                lo, hi = (mid, hi) if math.tan(mid) - mid < eta else (lo, mid)
            aM = lo
            # roll length at contact
            sgn = 1 if g.internal else -1
            Lc = g.rb * math.tan(aM) + sgn * ball / 2 * math.cos(g.bb)
            if g.Lroot < Lc < g.Ltip:
                out = f(place(g, all_k, 1, Lc, g.b / 2)) + f(place(g, all_k % g.z + 1, -1, Lc, g.b / 2))
                rad = out / 2 / (math.sin(aM) * math.cos(g.bb)) + noise * rng.standard_normal(g.z)
                rows.insert(0, f'# ball_diameter_mm = {ball}')
                for k in all_k:
                    rows.append(f'radial,{k},,,{g.b / 2:.4f},{rad[k - 1]:.3f}')
        if not g.internal and g.span:
            sz = ['quantity,value_mm,detail,sigma_um']
            for _ in range(3):
                k0 = int(rng.integers(1, g.z + 1))
                k1 = (k0 - 1 + g.span_k - 1) % g.z + 1
                # The line between both contacts touches the base cylinder: their rolls add up to the span's transverse part.
                Lspan = 0.5 * g.span * math.cos(g.bb)
                w = (f(place(g, np.array([k1]), 1, Lspan, g.b / 2)) + f(place(g, np.array([k0]), -1, Lspan, g.b / 2)))[0]
                sz.append(f'span,{g.span + (w + noise * rng.standard_normal()) / 1000:.5f},{g.span_k},{max(noise, 0.3):.2f}')
            open(f'{d}/sizes.csv', 'w').write('\n'.join(sz) + '\n')
            files.append(f'{d}/sizes.csv')
    open(f'{d}/traces.csv', 'w').write('\n'.join(rows) + '\n')
    return [f'{d}/traces.csv'] + files, len(teeth)


def scan(rng, g, f, noise, rho, aligned, d):
    n = int(rng.choice([6000, 10000, 15000]))
    k = rng.integers(1, g.z + 1, n)
    side = rng.choice([-1, 1], n)
    L = g.Lroot + rng.uniform(0.03, 0.97, n) * (g.Ltip - g.Lroot)
    zz = rng.uniform(0.01, 0.99, n) * g.b
    P = place(g, k, side, L, zz)
    e = rng.standard_normal(n)
    if rho > 0:   # patches of a smooth random field over each flank
        c = rng.standard_normal((g.z + 1, 2, 6, 6))
        for t in range(1, g.z + 1):
            for s_ in (0, 1):
                w = np.where((k == t) & ((side > 0) == s_))[0]
                if len(w) == 0:
                    continue
                a_, b_ = (g.u(L[w]) + 1) * 2.49, (g.v(zz[w]) + 1) * 2.49
                i, j = np.floor(a_).astype(int), np.floor(b_).astype(int)
                p, q = a_ - i, b_ - j
                F = c[t, s_]
                num = (F[i, j] * (1 - p) * (1 - q) + F[i + 1, j] * p * (1 - q) + F[i, j + 1] * (1 - p) * q + F[i + 1, j + 1] * p * q)
                den = np.sqrt(((1 - p) ** 2 + p * p) * ((1 - q) ** 2 + q * q))
                e[w] = math.sqrt(rho) * num / den + math.sqrt(1 - rho) * e[w]
    X = P['P'] + P['n'] * ((f(P) + noise * e) / 1000)[:, None]
    if rng.random() < 0.5:   # tip lands too
        nl = n // 12
        kk = rng.integers(1, g.z + 1, nl)
        t = g.Ltip / g.rb
        inv = t - math.atan(t)
        half = (PI / g.z - g.psib + inv) if g.internal else g.psib - inv
        zz2 = rng.uniform(0.01, 0.99, nl) * g.b
        a = 2 * PI * (kk - 1) / g.z + rng.uniform(-0.95, 0.95, nl) * half + zz2 * math.tan(g.beta) / g.r
        rr = g.tip + noise / 1000 * rng.standard_normal(nl)
        X = np.vstack([X, np.stack([rr * np.cos(a), rr * np.sin(a), zz2], -1)])
    if not aligned:
        q, _ = np.linalg.qr(rng.standard_normal((3, 3)))
        if np.linalg.det(q) < 0:
            q[:, 0] *= -1
        X = X @ q.T + rng.uniform(-40, 40, 3)
    if rng.random() < 0.5:
        fn = f'{d}/scan.ply'
        with open(fn, 'w') as o:
            o.write(f'ply\nformat ascii 1.0\nelement vertex {len(X)}\nproperty double x\nproperty double y\nproperty double z\nend_header\n')
            np.savetxt(o, X, fmt='%.6f')
    else:
        fn = f'{d}/scan.csv'
        with open(fn, 'w') as o:
            o.write('x_mm,y_mm,z_mm\n')
            np.savetxt(o, X, fmt='%.6f', delimiter=',')
    return [fn], n


KINDS = ([("name", f.__name__, f, SEEN[f.__name__]) for f in NAMED] + [("form", f.__name__, f, FSEEN[f.__name__]) for f in FORMS] +
         [("nothing", f"nothing_{i}", None, "tmsa") for i in range(10)])


class Case:
    def __init__(self, at, i, seed):
        self.what, self.kind, self.hidden, self.seen_by = KINDS[at]
        self.name, self.seed = f"{self.kind}-{i}", seed
        self.r = np.random.default_rng([seed, at, i])
        self.way = str(self.r.choice([w for w in self.seen_by for _ in range(1 if w in "sa" else 2)]))
        self.gear = Gear(self.r)

    def hide(self):
        """What is done to the teeth [um], what names say of it, and the names that are no error."""
        r, g = self.r, self.gear
        self.noise = float(np.exp(r.uniform(math.log(0.3), math.log(3.0 if self.way in "tm" else 8.0))))
        self.rho = float(r.choice([0, 0, 0.3, 0.6] if self.way in "tm" else [0, 0, 0.2, 0.4]))
        a = self.noise * float(np.exp(r.uniform(math.log(2.5), math.log(8))))
        self.truth, self.alike, parts = {}, set(), []
        if self.what == "name":
            f, self.truth = self.hidden(r, g, a)
            parts.append(f)
        elif self.what == "form":
            parts.append(self.hidden(r, g, a))
            self.alike = set(FALIKE.get(self.kind, set()))
            if r.random() < 0.45:
                beside = [f for f in (crowning, eccentricity, helix_error, pressure_angle_error, tip_relief, taper) if self.way in SEEN[f.__name__]]
                f, self.truth = beside[int(r.integers(len(beside)))](r, g, a)
                parts.append(f)
        for name in self.truth:
            self.alike |= {name} | ALIKE.get(name, set())
        return lambda P: sum((f(P) for f in parts), 0.0 * P["L"])

    def run(self, program, folder):
        where = folder / self.name
        where.mkdir(parents=True, exist_ok=True)
        (where / "part.toml").write_text(self.gear.design())
        told = subprocess.run([program, "check", "part.toml", "--json", "-"], cwd=where, capture_output=True, text=True).stdout
        self.gear.read_report(json.loads(told[told.index("{"):]))
        form = self.hide()
        if self.way in "tm":
            files = inspection(self.r, self.gear, form, self.noise, self.rho, self.way, where)[0]
        else:
            files = scan(self.r, self.gear, form, self.noise, self.rho, self.way == "a", where)[0]
        self.sized = self.way in "sa" or any("sizes" in f for f in files)
        return trial.close_loop(self, program, where, "part.toml", *(f.split("/")[-1] for f in files), *["--aligned"] * (self.way == "a"))

    def judge(self):
        """What is wrong; empty: nothing."""
        a, want = self.answer, set(self.truth)
        named = [e for e in a["effects"] if e["named"]]
        if self.what == "nothing":
            return "" if a["verdict"] == "no_effect" and not a["effects"] else "alarm"
        wrong = [e["id"] for e in named if e["id"] not in self.alike and not want & set(e["confounded_with"])]
        if wrong:
            return f"misnamed {wrong}"
        # Rings and narrow gears have no span, and nothing else here shows a thickness: then it must be said to be hidden.
        hidden = set() if self.sized else set(a["not_observable"])
        missing = [n for n in want - hidden if not any(e["id"] == n or n in e["confounded_with"] for e in named)]
        if missing:
            return f"not named: {missing}"
        unnamed = len(named) < len(a["effects"])
        if self.what == "name" and unnamed:
            return "more than the name"
        if self.what == "form" and not (unnamed or a["verdict"] == "partly_explained" or {e["id"] for e in named} & (self.alike - want)):
            return "not seen"
        if a["after"]["held_out_rms_um"] > 1.2 * self.noise and a["verdict"] != "partly_explained":
            return f"called {a['verdict']}"
        return ""

    def held(self):
        held = asked = 0
        for e in self.answer["effects"] if self.answer else []:
            for key, value in self.truth.get(e["id"], {}).items() if e["named"] else []:
                if key in ("order", "tooth") or key not in e["parameters"]:
                    continue
                low, high = e["parameters"][key]["ci95"]
                # A spur or helical gear looks the same turned over: which end of a free scan is up nobody knows.
                if self.way == "s" and e["id"] in ("taper", "flank_twist"):
                    value = math.copysign(value, low + high)
                if key.endswith("_deg"):
                    value = 0.5 * (low + high) + (value - 0.5 * (low + high) + 180.0) % 360.0 - 180.0
                held, asked = held + (low <= value <= high), asked + 1
        return held, asked

    def line(self):
        g = self.gear
        told = "" if self.answer is None else "; ".join(
            e["id"] + ("" if e["flank"] == "both" else " " + e["flank"]) + ("" if e["named"] else " {" + e["description"][:120] + "}") for e in self.answer["effects"])
        return (f"{'' if self.right else 'WRONG '}{self.name} {self.way} beside {sorted(self.truth)} z {g.z} m {g.m} beta {math.degrees(g.beta):.0f}"
                f"{' internal' if g.internal else ''} noise {self.noise:.2f} rho {self.rho}: {self.why} | {told} | {self.seconds:.1f}s")


def main():
    o = trial.words(each=1, every=(1, "only every n-th kind"))
    cases = [Case(at, i, o.seed) for at in range(0, len(KINDS), o.every) for i in range(o.each)]
    trial.campaign([c for c in cases if o.only in c.name], o, keys=lambda c: (c.kind, "all form") if c.what == "form" else ("all " + c.what,),
                   columns="| hidden | right | of |", after=trial.tell_intervals)


if __name__ == "__main__":
    main()
