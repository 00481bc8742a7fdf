# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials and shaft inertias of a design file reach strength and inertia of the report."""
import json
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "materials"
DESIGN = """format = 1
name = "two-materials"
[gearbox]
kind = "pair"
module_mm = 2.0
{gearbox}
[pinion]
teeth = 20
face_width_mm = 20
{pinion}
[wheel]
teeth = 40
face_width_mm = 20
{rest}
"""
TABLE = """[material.wood]
bending_limit_mpa = 5
contact_limit_mpa = 20
elastic_modulus_mpa = 9000
poisson_ratio = 0.3
density_kg_m3 = 700
"""


def check(*options, gearbox="", pinion="", rest=""):
    path = OUTPUT / "design.toml"
    path.write_text(DESIGN.format(gearbox=gearbox, pinion=pinion, rest=rest))
    done = subprocess.run([PROGRAM, "check", path, "-q", "--json", OUTPUT / "report.json", *options],
                          capture_output=True, text=True)
    report = json.loads((OUTPUT / "report.json").read_text()) if done.returncode < 2 else None
    return done, report


def teeth(report):
    mesh = report["strength"]["meshes"]["pinion-wheel"]
    return mesh["tooth1"]["material"], mesh["tooth2"]["material"]


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    (OUTPUT / "more.toml").write_text(TABLE)

    _, plain = check()
    assert teeth(plain) == ("scm440-hb280",) * 2
    _, mixed = check(gearbox='material = "pom"', pinion='material = "brass"')
    assert teeth(mixed) == ("brass", "pom")
    assert mixed["strength"]["output_torque_nm"] < 0.5 * plain["strength"]["output_torque_nm"]
    # the wheel of pom: inertia by the densities 1410 and 7850
    share = mixed["inertia"]["output_side_kg_m2"] / plain["inertia"]["output_side_kg_m2"]
    assert abs(share - 1410 / 7850) < 1e-9, share
    share = mixed["inertia"]["input_side_kg_m2"] / plain["inertia"]["input_side_kg_m2"]
    assert abs(share - 8500 / 7850) < 1e-9, share  # the pinion of brass
    _, wood = check("--materials", OUTPUT / "more.toml", gearbox='material = "wood"')
    assert teeth(wood) == ("wood", "wood")
    _, over = check("--material", "brass", pinion='material = "pom"')
    assert teeth(over) == ("brass", "brass")

    # every torque with its material; ISO 6336 for metals, VDI 2736 for plastics
    done = subprocess.run([PROGRAM, "check", OUTPUT / "design.toml"], capture_output=True, text=True)
    said = " ".join(done.stdout.split())  # lines break at 80 columns
    assert "(pom, scm440-hb280)" in said and "in the form of VDI 2736" in done.stdout, done.stdout
    done = subprocess.run([PROGRAM, "check", OUTPUT / "design.toml", "--material", "brass"], capture_output=True,
                          text=True)
    assert "(brass)" in done.stdout and "in the form of ISO 6336" in done.stdout, done.stdout
    strength = plain["strength"]
    assert strength["limiting_material"] == "scm440-hb280" and strength["plastic"] is None
    assert 0.5 < strength["iso6336"]["output_torque_nm"] / strength["output_torque_nm"] < 2, strength["iso6336"]
    assert mixed["strength"]["limiting_material"] == "brass, pom" and mixed["strength"]["iso6336"] is None
    cool = mixed["strength"]["plastic"]
    assert [t["gear"] for t in cool["teeth"]] == ["wheel"] and cool["teeth"][0]["flank_c"] == 20, cool
    _, fast = check(gearbox='material = "pom"', pinion='material = "brass"',
                    rest='[strength]\ninput_speed_rpm = 2000\nlife_h = 1000\nlubrication = "dry"\n')
    hot = fast["strength"]["plastic"]
    assert hot["output_torque_nm"] < cool["output_torque_nm"], (hot, cool)
    assert hot["teeth"][0]["flank_c"] > 30 and hot["teeth"][0]["wear_um"] > 0, hot
    assert hot["teeth"][0]["cycles"] == 2000 * 60 * 1000 / 2, hot
    _, eased = check(rest='[strength]\nspectrum = "1:0.1, 0.4:0.9"\n')
    assert eased["strength"]["iso6336"]["output_torque_nm"] > strength["iso6336"]["output_torque_nm"]

    done, _ = check(pinion='material = "unobtainium"')
    assert done.returncode == 2
    for word in ("design.toml:10", "pinion.material", "unobtainium", "scm440-hb280"):
        assert word in done.stderr, (word, done.stderr)
    done = subprocess.run([PROGRAM, "make", OUTPUT / "design.toml", "-o", OUTPUT / "parts", "-q"],
                          capture_output=True, text=True)
    assert done.returncode == 2 and "pinion.material" in done.stderr

    _, loaded = check(rest="[shafts]\nrotor_inertia_kg_m2 = 1e-3\nload_inertia_kg_m2 = 0.02\n")
    for key, extra in (("input_side_kg_m2", 1e-3), ("output_side_kg_m2", 0.02)):
        assert abs(loaded["inertia"][key] - plain["inertia"][key] - extra) < 1e-12, key
    return 0


if __name__ == "__main__":
    sys.exit(main())
