# SPDX-License-Identifier: GPL-3.0-or-later
"""How often a form is seen (verdict not no_effect) and, where it has a name, named, over the number of traced teeth.
Usage: power.py PROGRAM DIRECTORY [--seed N] [--draws N] [--sizes 3,5] [--teeth 3,4,...] [--only TEXT]
Sizes are heights in multiples of the noise; profile and helix traces of 50 values on a gear of 100 teeth."""
import concurrent.futures
import json
import math
import subprocess

import numpy

import made
import trial

TEETH = 100
FORMS = {
    "helix_error, one flank": ("helix_error", lambda k, side, u, v: 0.5 * v * (side > 0)),
    "taper": ("taper", lambda k, side, u, v: 0.5 * v + 0.0 * u),
    "crowning": ("crowning", lambda k, side, u, v: -v * v + 0.0 * u),
    "pressure_angle_error": ("pressure_angle_error", lambda k, side, u, v: 0.5 * u + 0.0 * v),
    "tip_relief": ("tip_relief", lambda k, side, u, v: -(numpy.maximum(u - 0.2, 0.0) / 0.8) ** 2 + 0.0 * v),
    "axis_tilt": ("axis_tilt", None),
    "lead step": ("", lambda k, side, u, v: (v > 0.2) + 0.0 * u),
    "groove": ("", lambda k, side, u, v: -numpy.exp(-((v - 0.3) / 0.1) ** 2) + 0.0 * u),
    "feed marks, own phases": ("", None),
    "waviness": ("", lambda k, side, u, v: 0.5 * numpy.sin(math.pi * 5.0 * u + 1.0) + 0.0 * v),
}


def form_of(name, gear, size, random):
    if name == "axis_tilt":
        phase = random.uniform(0, 2 * math.pi)
        return lambda k, side, u, v: size * v * numpy.cos(gear.normal_angle(k, side, u) - phase)
    if name == "feed marks, own phases":
        phases = random.uniform(0, 2 * math.pi, TEETH + 1)
        return lambda k, side, u, v: 0.5 * size * numpy.sin(math.pi * 9.0 * v + phases[k]) + 0.0 * u
    return lambda k, side, u, v: size * FORMS[name][1](k, side, u, v)


def run(program, folder, seed, name, teeth, size, draw):
    random = numpy.random.default_rng([seed, list(FORMS).index(name), teeth, int(10 * size), draw])
    gear = made.Gear(TEETH, 1.5, 0.1, 12.0)
    noise = made.Noise(float(random.uniform(0.4, 1.2)))
    traced = sorted({1 + round(i * TEETH / teeth) % TEETH for i in range(teeth)})
    plan = {"teeth": traced, "records": ("profile", "helix"), "points": 50, "index": False, "common_zero": False}
    where = folder / f"{list(FORMS).index(name)}_{teeth}_{size}_{draw}"
    where.mkdir(parents=True, exist_ok=True)
    (where / "part.toml").write_text(gear.design())
    (where / "data.csv").write_text(made.spots(gear, random, noise, form_of(name, gear, size * noise.sigma, random), plan))
    subprocess.run([program, "loop", "part.toml", "data.csv", "-o", "."], cwd=where, check=True, capture_output=True, timeout=300)
    answer = json.loads((where / "loop.json").read_text())
    names = {e["id"] for e in answer["effects"] if e["named"]}
    alike = names.union(*(e["confounded_with"] for e in answer["effects"] if e["named"]))
    wanted = FORMS[name][0]
    return answer["verdict"] != "no_effect", wanted in alike if wanted else not names


def main():
    o = trial.words(each=0, draws=(4, "gears a cell"), sizes=("3,5", "heights over the noise"),
                    teeth=("3,4,6,8,10,12,14,16,18,24,40,100", "numbers of traced teeth"))
    counts, program = [int(t) for t in o.teeth.split(",")], o.program
    print("| form, height / noise | " + " | ".join(str(c) for c in counts) + " |\n|" + " --- |" * (len(counts) + 1))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for name in FORMS:
            if o.only not in name:
                continue
            for size in (float(s) for s in o.sizes.split(",")):
                cells = [[pool.submit(run, program, o.folder, o.seed, name, c, size, d) for d in range(o.draws)] for c in counts]
                results = [[f.result() for f in cell] for cell in cells]
                text = [f"{sum(r[0] for r in cell)}, {sum(r[1] for r in cell)}" for cell in results]
                print(f"| {name}, {size:g} | " + " | ".join(text) + " |", flush=True)
    print(f"seen, and told rightly (with its name, or none), of {o.draws}")


if __name__ == "__main__":
    main()
