#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD opens every sample: one valid closed solid, volume within 1e-6 of the exact curves'."""
import sys

sys.dont_write_bytecode = True
for folder in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"):
    sys.path.append(folder)
import FreeCAD  # noqa: E402,F401  (must come before Part)
import Part  # noqa: E402

from step_samples import write_samples  # noqa: E402


def complaints(path, volume):
    shape = Part.Shape()
    shape.read(str(path))
    if shape.ShapeType != "Solid" or len(shape.Solids) != 1:
        return [f"{shape.ShapeType} with {len(shape.Solids)} solids, not one solid"]
    found = []
    if not shape.isClosed():
        found.append("not closed")
    try:
        # every test of isValid(); with the search for self-intersections where that takes a second, not a minute
        shape.check(len(shape.Faces) < 80)
    except ValueError as error:
        found.append(f"check: {error}")
    relative = shape.Volume / volume - 1.0
    print(f"{path.name}: {len(shape.Faces)} faces, volume off by {relative:.1e}")
    if not abs(relative) < 1e-6:
        found.append(f"volume {shape.Volume} instead of {volume}")
    return found


def main():
    failed = False
    for path, volume in write_samples():
        for complaint in complaints(path, volume):
            failed = True
            print(f"{path.name}: {complaint}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
