# SPDX-License-Identifier: GPL-3.0-or-later
"""Textbook formulas of cylindrical gears (ISO 21771, DIN 3960; involute geometry), apart from the program.

Given what identifies a gear (teeth, normal module, pressure angle, helix, shift, thinning), the sizes that
follow. Lengths in mm, angles in rad.
"""
import math


def inv(a):
    return math.tan(a) - a


def inverse_inv(value):
    """By bisection: slow, and with nothing to get wrong."""
    low, high = 0.0, math.radians(89.9)
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if inv(middle) < value else (low, middle)
    return 0.5 * (low + high)


def gear_sizes(gear):
    """Sizes of a gear of report.json, from its first entries alone."""
    z, m, x = gear["teeth"], gear["normal_module_mm"], gear["shift"]
    a_n, beta = math.radians(gear["normal_pressure_angle_deg"]), math.radians(gear["helix_angle_deg"])
    inside = -1.0 if gear["internal"] else 1.0
    m_t, a_t = m / math.cos(beta), math.atan(math.tan(a_n) / math.cos(beta))
    d, beta_b = z * m_t, math.asin(math.sin(beta) * math.cos(a_n))
    d_b = d * math.cos(a_t)
    # a thinning is an arc of the transverse section
    s_t = m_t * (math.pi / 2 + inside * 2 * x * math.tan(a_n)) - 1e-3 * gear["thinning_um"]
    sizes = {
        "transverse_module_mm": m_t,
        "transverse_pressure_angle_deg": math.degrees(a_t),
        "base_helix_angle_deg": math.degrees(beta_b),
        "reference_diameter_mm": d,
        "base_diameter_mm": d_b,
        "reference_thickness_mm": s_t,
        "lead_mm": math.pi * d / math.tan(abs(beta)) if beta else None,
    }
    if gear["span_mm"] is not None:
        k = gear["span_teeth"]
        sizes["span_mm"] = math.cos(a_n) * ((k - 1) * math.pi * m + s_t * math.cos(beta) + z * m * inv(a_t))
    if gear["over_pins_mm"] is not None:
        # the pin's centre lies where the involutes through it, half a space apart, meet the middle
        pin = gear["pin_diameter_mm"]
        half_space = math.pi / z - s_t / d
        half_pin = pin / (z * m * math.cos(a_n))
        at_pin = inv(a_t) + inside * (half_pin - half_space)
        across = d_b / math.cos(inverse_inv(at_pin))
        if z % 2:
            across *= math.cos(math.pi / (2 * z))
        sizes["over_pins_mm"] = across + inside * pin
    if not (gear["pointed"] or gear["tip_trimmed_by_cutter"] or gear["tip_inside_base_circle"]
            or gear["modified"]):
        d_a = gear["tip_diameter_mm"]
        at_tip = math.acos(d_b / d_a)
        sizes["tip_thickness_mm"] = d_a * (s_t / d + inside * (inv(a_t) - inv(at_tip)))
    return sizes


def mesh_sizes(inner, outer, centre_distance_mm, face_mm, friction):
    """Sizes of a mesh of two gears of report.json; the inner (or first) gear drives."""
    z1, z2, inside = inner["teeth"], outer["teeth"], outer["internal"]
    sign = -1.0 if inside else 1.0
    one, two = gear_sizes(inner), gear_sizes(outer)
    r_b1, r_b2 = one["base_diameter_mm"] / 2, two["base_diameter_mm"] / 2
    a_w = math.acos((r_b2 + sign * r_b1) / centre_distance_mm)
    pitch = 2 * math.pi * r_b1 / z1

    def beyond_pitch_point(gear, r_b):
        tip = gear["tip_form_diameter_mm"] / 2
        return math.sqrt(max(tip * tip - r_b * r_b, 0.0)) - r_b * math.tan(a_w)

    recess = beyond_pitch_point(inner, r_b1) / pitch
    approach = sign * beyond_pitch_point(outer, r_b2) / pitch
    beta_b = math.radians(abs(one["base_helix_angle_deg"]))
    beta, m = math.radians(abs(inner["helix_angle_deg"])), inner["normal_module_mm"]
    polynomial = approach ** 2 + recess ** 2 - approach - recess + 1
    return {
        "working_pressure_angle_deg": math.degrees(a_w),
        "approach_contact_ratio": approach,
        "recess_contact_ratio": recess,
        "contact_ratio": approach + recess,
        "overlap_ratio": face_mm * math.sin(beta) / (math.pi * m),
        "basic_efficiency": 1 - friction * math.pi * (1 / z1 + sign / z2) * polynomial / math.cos(beta_b),
        # arc of the gap less arc of the tooth on the working pitch circle
        "backlash_mm": backlash(one, two, inner, outer, centre_distance_mm, a_w, sign),
    }


def backlash(one, two, inner, outer, centre_distance_mm, a_w, sign):
    def thickness(sizes, gear, r_w):
        inside = -1.0 if gear["internal"] else 1.0
        a_t = math.radians(sizes["transverse_pressure_angle_deg"])
        return 2 * r_w * (sizes["reference_thickness_mm"] / sizes["reference_diameter_mm"]
                          + inside * (inv(a_t) - inv(a_w)))

    r_w1 = one["base_diameter_mm"] / 2 / math.cos(a_w)
    r_w2 = two["base_diameter_mm"] / 2 / math.cos(a_w)
    return (2 * math.pi * r_w1 / inner["teeth"] - thickness(one, inner, r_w1)
            - thickness(two, outer, r_w2))
