# SPDX-License-Identifier: GPL-3.0-or-later
"""Trueflank: exact gears, checked, made, measured and corrected.

    import trueflank
    gearbox = trueflank.read("design.toml")
    print(gearbox.report()["verdict"], gearbox.efficiency()["forward"])
    mesh = gearbox.mesh("sun", tolerance_um=1)   # NumPy: mesh.vertices, mesh.triangles
    gearbox.export("parts", formats=["stl", "step"])

    gear = trueflank.Gear(17, module_mm=2, shift=0.2)   # one gear, no file
    print(gear.tip_diameter_mm, gear.span_mm(), gear.profile().shape)

Lengths are millimetres (names say _um where micrometres), angles degrees. Errors are InputError
(the data are wrong) and SystemFailure (files could not be read or written), both TrueflankError.
"""
from ._core import (
    ClosedDriveLoop,
    ClosedLoop,
    Gear,
    Gearbox,
    GearPair,
    Mesh,
    Rack,
    SearchResult,
    __version__,
    compare,
    new_design,
    read,
    read_text,
    search,
    search_text,
)
from ._errors import InputError, Problem, SystemFailure, TrueflankError

__all__ = [
    "ClosedDriveLoop",
    "ClosedLoop",
    "Gear",
    "GearPair",
    "Gearbox",
    "InputError",
    "Mesh",
    "Problem",
    "Rack",
    "SearchResult",
    "SystemFailure",
    "TrueflankError",
    "__version__",
    "compare",
    "new_design",
    "read",
    "read_text",
    "search",
    "search_text",
]
