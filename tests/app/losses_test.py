# SPDX-License-Identifier: GPL-3.0-or-later
"""A loss found on the bench goes into the design, and check, make and search predict with it."""
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "losses"
DESIGN = pathlib.Path(__file__).resolve().parents[2] / "examples/bilateral_drive/design.toml"
FRICTION, DRAG_NM = 0.12, 0.0006
NEEDS = """format = 1
name = "small"
[gearbox]
kind = "3k"
{losses}
[ratio]
min = 96.2
max = 96.3
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
[search]
loss_model = "path_integral"
results = 1
"""


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stderr)
    return done.stdout


def report(design):
    run("check", design, "-q", "--json", OUTPUT / "report.json")
    return json.loads((OUTPUT / "report.json").read_text())


def sweep(ratio, forward, backward):
    """A bench with the losses of a gearbox whose teeth have the efficiencies given."""
    noise = random.Random(5)
    rows = ["direction,input_speed_rpm,input_torque_nm,output_torque_nm"]
    for _ in range(4):
        for speed in (200, 600, 1200):
            for torque in (0.005, 0.01, 0.02, 0.04, 0.08, 0.12):
                out = forward * ratio * (torque - DRAG_NM) + noise.gauss(0, 0.01)
                rows.append(f"forward,{speed},{torque},{out:.5f}")
            for torque in (0.5, 1, 2, 4, 8):
                driven = backward * torque / ratio - DRAG_NM + noise.gauss(0, 0.0001)
                rows.append(f"backward,{speed},{driven:.6f},{torque}")
    (OUTPUT / "bench.csv").write_text("\n".join(rows) + "\n")


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    # the truth: the same design with other lubricant, as the program's own model has it
    truth = OUTPUT / "truth.toml"
    text = DESIGN.read_text()
    assert "friction = 0.1 " in text
    truth.write_text(text.replace("friction = 0.1 ", f"friction = {FRICTION} "))
    real = report(truth)
    teeth = real["efficiency"]["forward"], real["efficiency"]["backward"]
    ratio = real["train"]["ratio"]
    sweep(ratio, *teeth)
    run("loop", DESIGN, OUTPUT / "bench.csv", "-o", OUTPUT / "loop", "-q")
    found = json.loads((OUTPUT / "loop/loop.json").read_text())
    values = {e["id"]: e["parameters"] for e in found["effects"]}
    assert abs(values["friction_coefficient"]["value"]["value"] - FRICTION) < 0.002, values
    assert abs(values["drag_torque"]["torque_nm"]["value"] - DRAG_NM) < 5e-5, values
    assert found["after"]["held_out_rms_nm"] < 0.3 * found["before"]["held_out_rms_nm"]

    calibrated = report(OUTPUT / "loop/calibrated.toml")
    losses = calibrated["efficiency"]["losses"]
    assert abs(losses["mesh_forward"] - teeth[0]) < 0.002
    assert calibrated["efficiency"]["forward"] < teeth[0] - 0.002
    start_nm = DRAG_NM * ratio / teeth[1]  # at the output, against the drag
    assert abs(calibrated["inertia"]["starting_torque_nm"] / start_nm - 1) < 0.1
    assert report(DESIGN)["inertia"]["starting_torque_nm"] is None
    run("make", OUTPUT / "loop/calibrated.toml", "-o", OUTPUT / "parts", "--formats", "svg", "-q")

    best = []
    for name, text in (("plain", ""),
                       ("lossy", f"[losses]\nload_nm = 5\ninput_speed_rpm = 600\ndrag_torque_nm = {DRAG_NM}\n")):
        (OUTPUT / f"{name}.toml").write_text(NEEDS.format(losses=text))
        run("search", OUTPUT / f"{name}.toml", "-o", OUTPUT / name, "-q")
        header, row = (OUTPUT / name / "search.csv").read_text().splitlines()[:2]
        best.append(float(dict(zip(header.split(","), row.split(",")))["forward"]))
        design = OUTPUT / name / "design-001.toml"
        assert abs(report(design)["efficiency"]["forward"] - best[-1]) < 1e-4, name
    # what the drag takes of the torque at the input that carries the load
    share = DRAG_NM * ratio * best[0] / 5
    assert abs(best[1] / best[0] - 1 / (1 + share)) < 0.003, (best, share)
    return 0


if __name__ == "__main__":
    sys.exit(main())
