# SPDX-License-Identifier: GPL-3.0-or-later
"""Requirements of a search of one tooth set, for tests of what is written of it."""

NEEDS = """format = 1
name = "small"
[gearbox]
kind = "3k"
[ratio]
min = 96.2
max = 96.3
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
[search]
results = 1
objectives = "forward: 1, mass: 0.25"
"""
