#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""gmsh meshes samples with tetrahedra: one volume, and what the elements fill is the part.

Flat elements cut corners: within 0.5 %.
"""
import os
import subprocess
import sys

sys.dont_write_bytecode = True
from step_samples import write_samples  # noqa: E402

# The parallel Delaunay method, and no better shapes of the tetrahedra afterwards: they fill the same, in half the time.
QUICK = ["-algo", "hxt", "-setnumber", "Mesh.Optimize", "0"]
# as fine as the size of the teeth asks for
FINE = ["-clmax", "0.5", "-clcurv", "12"]
SAMPLES = {
    "planet.step": [],
    "undercut pinion of 8 teeth.step": FINE,
    "sharp rack, undercut.step": FINE,
    "pointed teeth.step": ["-clmax", "0.8", "-clcurv", "8"],
    "ring, tip inside the base circle.step": ["-clmax", "1"],
    "helical planet.step": [],
    "herringbone pinion.step": ["-clmax", "0.5"],
    "chamfered herringbone.step": ["-clmax", "1"],
}
TETRAHEDRON = 4


def mesh_volume(mesh_file):
    """Volume of the tetrahedra and the set of volumes they belong to, from a format 2.2 mesh."""
    lines = iter(mesh_file.read_text(encoding="ascii").splitlines())
    points, total, volumes = {}, 0.0, set()
    for line in lines:
        if line == "$Nodes":
            for _ in range(int(next(lines))):
                number, x, y, z = next(lines).split()
                points[number] = (float(x), float(y), float(z))
        if line == "$Elements":
            for _ in range(int(next(lines))):
                field = next(lines).split()
                if int(field[1]) != TETRAHEDRON:
                    continue
                volumes.add(field[4])
                o, a, b, c = (points[n] for n in field[-4:])
                (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (
                    [p - q for p, q in zip(corner, o)] for corner in (a, b, c))
                total += abs(ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx)
                             + az * (bx * cy - by * cx)) / 6.0
    return total, volumes


def complaints(path, volume, options):
    mesh_file = path.with_suffix(".msh")
    run = subprocess.run(
        ["gmsh", "-3", "-format", "msh22", *QUICK, *options, str(path), "-o", str(mesh_file)],
        capture_output=True, text=True, timeout=300, check=False)
    if run.returncode != 0:
        return ["gmsh: " + run.stdout[-500:] + run.stderr[-500:]]
    meshed, volumes = mesh_volume(mesh_file)
    relative = meshed / volume - 1.0
    print(f"{path.name}: {len(volumes)} volume, {relative:+.2%}")
    found = []
    if len(volumes) != 1:
        found.append(f"{len(volumes)} volumes")
    if not abs(relative) < 0.005:
        found.append(f"the mesh fills {meshed} of {volume} mm^3")
    return found


def main():
    samples = {path.name: (path, volume) for path, volume in write_samples()}
    failed = False
    every = 1 if "TRUEFLANK_CAMPAIGN" in os.environ else 2
    for name, options in list(SAMPLES.items())[::every]:
        for complaint in complaints(*samples[name], options):
            failed = True
            print(f"{name}: {complaint}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
