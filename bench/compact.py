# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of COMPAct (github.com/singhaman1750/COMPAct) beside ours, side by side.

COMPAct chooses teeth, module and number of planets of a planetary actuator for a motor and a ratio, by
trying all; teeth are without shifts. For each of its gearboxes this script
1. runs it (in a copy of its folder, so that nothing of it changes) and reads its optimum and its time;
2. writes that optimum as a design of ours and asks `trueflank check`: efficiency by the same formula and
   by the path integral, and what the checks say;
3. searches the same box with ours: ratio as near to the one asked for as the peer takes it, the peer's outer diameter, its
   least tooth numbers and module, its numbers of planets, its friction; ranked by forward efficiency. Two
   stages are pairs of simple ones, each searched in narrow ranges of its ratio; the best pairs are written
   as designs of kind two-stage and checked until one passes.

The peer weighs mass and width against efficiency; ours is asked for efficiency alone in the same
diameter and width: its figure is what the box holds, and no judgement of the peer's compromise.

Usage: compact.py TRUEFLANK FOLDER_OF_COMPACT [--case sspg=6.5] ... [--motor U8]
The folder is one that you have; nothing is downloaded. It needs numpy. Times are of the processor.
"""
import argparse
import csv
import json
import math
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile

KIND = {"sspg": "simple", "cpg": "stepped", "wpg": "3k", "dspg": "two-stage"}
CASES = ["sspg=6.5", "cpg=14", "wpg=16", "dspg=20"]
# what the peer prints, in its order, as our gears' names
PRINTED = {"sspg": (["sun", "planet", "ring"], ["module"], ["planets"]),
           "cpg": (["sun", "planet1", "planet2", "ring"], ["module"], ["planets"]),
           "wpg": (["sun", "planet1", "ring1", "planet2", "ring2"], ["module1", "module2"], ["planets"]),
           "dspg": (["sun1", "planet1", "ring1", "sun2", "planet2", "ring2"], ["module1", "module2"],
                    ["planets1", "planets2"])}
PAIRS_TRIED = 40  # of two stages, the best first


def timed(command, folder, timeout):
    """Output and processor seconds of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=timeout)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done, spent


class Peer:
    def __init__(self, folder, work, motor):
        self.folder = work / "peer"
        self.folder.mkdir()
        for file in folder.glob("*.py"):
            shutil.copy(file, self.folder)
        shutil.copytree(folder / "config_files", self.folder / "config_files")
        for name in ("SSPG", "CPG", "WPG", "DSPG"):
            (self.folder / "CADs" / name).mkdir(parents=True)
        (self.folder / "results" / f"results_BruteForce_{motor}").mkdir(parents=True)
        self.motor = motor

    def limits(self, case):
        keys = json.loads((self.folder / "config_files" / f"{case}_params.json").read_text())
        found = keys[f"{case}_optimization_parameters"]
        design = keys.get(f"{case}_design_parameters_3DP", keys.get(f"{case}_design_parameters", {}))
        pick = lambda *names: next(found[n] for n in names if n in found)
        return {"sun": pick("NUM_TEETH_SUN_MIN"),
                "planet": pick("NUM_TEETH_PLANET_MIN", "NUM_TEETH_PLANET_BIG_MIN"),
                "module": pick("MODULE_MIN", "MODULE_BIG_MIN", "MODULE_STAGE1_MIN"),
                "planets": range(pick("NUM_PLANET_MIN", "NUM_PLANET_STAGE1_MIN"),
                                 pick("NUM_PLANET_MAX", "NUM_PLANET_STAGE1_MAX") + 1),
                "step": found["GEAR_RATIO_STEP"],
                "apart": design.get("planetMinDistanceMM", 5.0)}

    def friction(self):
        config = json.loads((self.folder / "config_files" / "config.json").read_text())
        return config["Gear_standard_parameters"]["coefficientOfFriction"]

    def run(self, case, ratio, timeout):
        done, spent = timed([sys.executable, "actOpt.py", self.motor, case, str(ratio)], self.folder, timeout)
        gears, modules, planets = PRINTED[case]
        line = next((l for l in done.stdout.splitlines() if l.startswith("Number of teeth")), None)
        if line is None:
            last = (done.stderr or done.stdout).strip().splitlines()
            return None, spent, last[-1] if last else "no output"
        values = [float(v) for v in re.findall(r"\)\s*:\s*([0-9.]+)", line)]
        names = gears + modules + planets
        return dict(zip(names, values)), spent, ""


def design_text(case, peer, friction, width_mm):
    """An optimum of the peer as a design of ours, with the teeth of the book."""
    kind = KIND[case]
    module1 = peer.get("module", peer.get("module1"))
    module2 = peer.get("module2", module1)
    text = (f'format = 1\nname = "compact {case}"\n[gearbox]\nkind = "{kind}"\nplanets = '
            f'{int(peer.get("planets", peer.get("planets1", 0)))}\nmodule_mm = {module1}\nfriction = {friction}\n'
            'backlash_mm = 0.02\ntips = "standard"\n' + ('output = "ring2"\n' if kind == "3k" else ""))
    if kind == "two-stage":
        text += f'[stage2]\nplanets = {int(peer["planets2"])}\nmodule_mm = {module2}\n'
    for name in PRINTED[case][0]:
        text += f"[{name}]\nteeth = {int(peer[name])}\nshift = 0.0\nface_width_mm = {width_mm}\n"
        if kind == "3k" and name.endswith("2"):
            text += f"module_mm = {module2}\n"
    return text


def checked(program, text, work):
    path = work / "design.toml"
    path.write_text(text)
    done, _ = timed([program, "check", path, "--json", work / "report.json"], work, 300)
    if not (work / "report.json").exists():
        return None, done.stderr.strip().splitlines()[-1:]
    report = json.loads((work / "report.json").read_text())
    (work / "report.json").unlink()
    return report, sorted({c["id"] for c in report["checks"] if c["status"] == "fail"})


def outer_diameter(report):
    """Of rings with rims of 2.5 modules (2 mm at least), and of planets on their way round."""
    gears, meshes = report["gears"], report["meshes"]
    largest = 0.0
    stages = report["train"].get("stages", [report["train"]])
    for name, gear in gears.items():
        if gear["internal"]:
            largest = max(largest, gear["root_diameter_mm"] + 2 * max(2.5 * gear["module_mm"], 2.0))
        elif name.startswith("planet"):
            stage = stages[int(name[-1]) - 1] if len(stages) > 1 else stages[0]
            largest = max(largest, 2 * stage["centre_distance_mm"] + gear["tip_diameter_mm"])
    return largest


def requirements(kind, ratio, limits, diameter, friction, listed, width):
    most = int(diameter / limits["module"])
    text = (f'format = 1\n[gearbox]\nkind = "{kind}"\nfriction = {friction}\nouter_diameter_mm = {diameter:.4f}\n'
            f'face_width_mm = {width}\nplanets = "{", ".join(str(n) for n in limits["planets"])}"\n')
    text += 'output = "ring2"\n' if kind == "3k" else 'output = "carrier"\n'
    text += (f'[ratio]\nmin = {ratio[0]:.6g}\nmax = {ratio[1]:.6g}\n[teeth]\nsun_min = {limits["sun"]}\nsun_max = {most // 2}\n'
             f'planet1_min = {limits["planet"]}\nplanet1_max = {most // 2}\nring1_min = 40\nring1_max = {most}\n'
             f'planet2_min = {limits["planet"]}\nplanet2_max = {most // 2}\nring2_min = 40\nring2_max = {most}\n'
             f'[limits]\nplanet_clearance_mm = {limits["apart"]}\n[search]\nresults = 1\nlisted = {listed}\n')
    return text


def searched(program, text, work, timeout):
    """Rows of search.csv, processor seconds."""
    (work / "needs.toml").write_text(text)
    folder = work / "found"
    shutil.rmtree(folder, ignore_errors=True)
    done, spent = timed([program, "search", work / "needs.toml", "-o", folder, "-q"], work, timeout)
    if not (folder / "search.csv").exists():
        return [], spent, (done.stderr.strip().splitlines() or ["no answer"])[-1]
    with open(folder / "search.csv", newline="") as file:
        return list(csv.DictReader(file)), spent, ""


def stage_rows(program, ratio, limits, diameter, friction, width, work, timeout):
    """The best simple stages of narrow ranges of ratio, of which two make the whole."""
    rows, spent = [], 0.0
    low, high = max(3.2, ratio[0] / 8.0), min(8.0, ratio[1] / 3.2)
    steps = max(1, math.ceil((high - low) / 0.4))
    for k in range(steps):
        part = (low + (high - low) * k / steps, low + (high - low) * (k + 1) / steps)
        text = requirements("simple", part, limits, diameter, friction, 25, width)
        found, time, _ = searched(program, text, work, timeout)
        rows += found
        spent += time
    return rows, spent


def stage_text(row, number, width):
    module = float(row["module_mm"])
    ring_shift = float(row["ring1_shift"])
    text = ""
    for name, column in (("sun", "sun"), ("planet", "planet1"), ("ring", "ring1")):
        text += f"[{name}{number}]\nteeth = {row[column]}\nface_width_mm = {width}\n"
        text += f"shift = {ring_shift!r}\n" if name == "ring" else ""
    return module, float(row["centre_distance_modules"]) * module, text


def two_stages(program, ratio, limits, diameter, friction, width, work, timeout):
    rows, spent = stage_rows(program, ratio, limits, diameter, friction, width, work, timeout)
    pairs = []
    for a in rows:
        for b in rows:
            if ratio[0] <= float(a["ratio"]) * float(b["ratio"]) <= ratio[1]:
                pairs.append((float(a["forward"]) * float(b["forward"]), a, b))
    pairs.sort(key=lambda p: -p[0])
    for merit, a, b in pairs[:PAIRS_TRIED]:
        module1, centre1, gears1 = stage_text(a, 1, width)
        module2, centre2, gears2 = stage_text(b, 2, width)
        text = (f'format = 1\nname = "two stages"\n[gearbox]\nkind = "two-stage"\nplanets = {a["planets"]}\n'
                f"module_mm = {module1!r}\ncentre_distance_mm = {centre1!r}\nfriction = {friction}\n"
                f"backlash_mm = {0.04 * min(module1, module2)!r}\n[stage2]\nplanets = {b['planets']}\n"
                f"module_mm = {module2!r}\ncentre_distance_mm = {centre2!r}\n" + gears1 + gears2)
        report, failed = checked(program, text, work)
        if report and not failed:
            return merit, report, text, spent, len(pairs)
    return None, None, "", spent, len(pairs)


def percent(value):
    return "-" if value is None else f"{100 * value:.2f} %"


def told(case, ratio, args, peer, work):
    limits, friction = peer.limits(case), peer.friction()
    optimum, spent, why = peer.run(case, ratio, args.timeout)
    if optimum is None:
        print(f"{case} {ratio}: the peer found nothing in {spent:.1f} s: {why}")
        return
    width = 10.0
    report, failed = checked(args.trueflank, design_text(case, optimum, friction, width), work)
    teeth = "/".join(str(int(optimum[name])) for name in PRINTED[case][0])
    print(f"{case} {ratio} ({KIND[case]}): peer {teeth}, modules "
          + ", ".join(f"{v:g}" for k, v in optimum.items() if k.startswith("module"))
          + ", planets " + ", ".join(f"{int(v)}" for k, v in optimum.items() if k in PRINTED[case][2])
          + f"; {spent:.1f} s")
    if report is None:
        print(f"  cannot be laid out: {failed}")
        return
    diameter = outer_diameter(report)
    formula = report["efficiency"]["by_formula"]["forward"]
    print(f"  its design in ours: ratio {report['train']['ratio']:.4f}, outer diameter {diameter:.2f} mm, forward "
          f"{percent(formula)} by the formula, {percent(report['efficiency']['forward'])} by the path integral, "
          f"fails {', '.join(failed) or 'nothing'}")
    window = (ratio - limits["step"] / 2, ratio + limits["step"] / 2)
    if KIND[case] == "two-stage":
        merit, best, text, time, pairs = two_stages(args.trueflank, window, limits, diameter, friction, width, work,
                                                    args.timeout)
        if best is None:
            print(f"  ours: none of {pairs} pairs passes; {time:.1f} s")
            return
        gears = "/".join(str(g["teeth"]) for g in best["gears"].values())
        print(f"  ours in the same diameter: {gears}, ratio {best['train']['ratio']:.4f}, forward "
              f"{percent(best['efficiency']['forward'])} (product of the stages {percent(merit)}), passes every check; "
              f"{pairs} pairs, {time:.1f} s")
        if args.save:
            pathlib.Path(args.save).write_text(text)
        return
    rows, time, why = searched(args.trueflank, requirements(KIND[case], window, limits, diameter, friction, 60, width),
                               work, args.timeout)
    best = next((r for r in rows if r["file"]), None)
    if best is None:
        print(f"  ours: nothing in {time:.1f} s {why}")
        return
    print(f"  ours in the same diameter: {best['teeth']}, {best['planets']} planets, ratio {float(best['ratio']):.4f}, forward "
          f"{percent(float(best['forward']))}, passes every check; {time:.1f} s")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trueflank", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("compact", type=pathlib.Path)
    parser.add_argument("--case", action="append", help="gearbox=ratio; gearboxes " + ", ".join(KIND))
    parser.add_argument("--motor", default="U8")
    parser.add_argument("--timeout", type=float, default=3600.0, help="s, of one run of either")
    parser.add_argument("--save", help="file for the best design of two stages")
    args = parser.parse_args()
    if not (args.compact / "actOpt.py").exists():
        parser.error(f"{args.compact} is no folder of COMPAct: it has no actOpt.py")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        peer = Peer(args.compact, work, args.motor)
        for case in args.case or CASES:
            name, _, ratio = case.partition("=")
            if name not in KIND or not ratio:
                parser.error(f"--case {case}: one of {', '.join(KIND)}, = and a ratio")
            told(name, float(ratio), args, peer, work)


if __name__ == "__main__":
    main()
