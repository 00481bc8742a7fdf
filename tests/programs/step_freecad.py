#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""FreeCAD opens samples: one valid closed solid, volume within 1e-6 of the exact curves'.

In the campaign every sample. Sample gears are read, judged and measured by step_opencascade, too (StepRead.EverySampleGear...),
with the very libraries that FreeCAD links. In the gate FreeCAD opens of them what is small enough that it looks for
self-intersections, which that test does not, and one larger gear and ring; and all other parts."""
import os
import sys

sys.dont_write_bytecode = True
for folder in ("/usr/lib/freecad-python3/lib", "/usr/lib/freecad/lib"):
    sys.path.append(folder)
import FreeCAD  # noqa: E402,F401  (must come before Part)
import Part  # noqa: E402

from step_samples import write_samples  # noqa: E402

SMALL_FACES = 80  # self-intersections are looked for in a second, not a minute
LARGER_GEARS = {"planet of 39 teeth", "ring of 81 teeth"}


def complaints(path, volume):
    shape = Part.Shape()
    shape.read(str(path))
    if shape.ShapeType != "Solid" or len(shape.Solids) != 1:
        return [f"{shape.ShapeType} with {len(shape.Solids)} solids, not one solid"]
    found = []
    if not shape.isClosed():
        found.append("not closed")
    try:
        # every test of isValid()
        shape.check(len(shape.Faces) < SMALL_FACES)
    except ValueError as error:
        found.append(f"check: {error}")
    relative = shape.Volume / volume - 1.0
    print(f"{path.name}: {len(shape.Faces)} faces, volume off by {relative:.1e}")
    if not abs(relative) < 1e-6:
        found.append(f"volume {shape.Volume} instead of {volume}")
    return found


def opened(samples):
    if "TRUEFLANK_CAMPAIGN" in os.environ:
        return samples
    gears = [path.name for path, _ in samples].index("planet.step")  # before it
    return [sample for at, sample in enumerate(samples) if at >= gears or sample[0].stem in LARGER_GEARS
            or sample[0].read_text(encoding="utf-8").count("=ADVANCED_FACE(") < SMALL_FACES]


def main():
    failed, samples = False, opened(write_samples())
    for path, volume in samples:
        for complaint in complaints(path, volume):
            failed = True
            print(f"{path.name}: {complaint}")
    if len(samples) < 14:
        sys.exit(f"only {len(samples)} samples were opened")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
