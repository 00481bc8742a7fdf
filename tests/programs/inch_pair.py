# SPDX-License-Identifier: GPL-3.0-or-later
"""A design whose sizes are in inches, with a thickness allowance."""

INCHES = """format = 1
name = "pitch 24"
[gearbox]
kind = "pair"
diametral_pitch = 24
[pinion]
teeth = 20
face_width_in = 0.25
thickness_allowance = "cd25"
[wheel]
teeth = 30
face_width_in = 0.25
thickness_allowance = "cd25"
"""
