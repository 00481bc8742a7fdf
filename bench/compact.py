# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of COMPAct (github.com/singhaman1750/COMPAct) beside ours, in one table.

COMPAct chooses teeth, module and number of planets of a planetary actuator for a motor and a ratio, by
trying all; teeth are without shifts. Its cost is mass + 0.2 times the face width - 2 times the efficiency (and what the
ratio is off). For each of its gearboxes this script
1. runs it (in a copy of its folder, so that nothing of it changes) and reads its optimum and its time;
2. has `trueflank check` judge that optimum: efficiency by the same formula and by the path integral, and what fails;
3. searches with ours, ratio, numbers of planets, friction, least tooth numbers, least module and least distance of
   planets (or what its optimum has, if less) being the peer's, in the outer diameter of its optimum: the same teeth
   with shifts; and all teeth, by efficiency, of which the one that costs least is told too.
All are judged by both measures: our efficiency, and the peer's cost of the tooth numbers, with its own masses and
widths, once with its efficiency and once with ours.

Where the tasks differ: the peer's diameter is a limit of the ring's pitch circle, ours of what its optimum fills; its
modules are 0.5, 0.6 ... 1.2, ours fill the diameter (not below its least); its cost knows no shifts, so that mass and width
of shifted sets are those of its teeth without; with 3k both modules are alike; our designs pass every check. Sets that break
the peer's own rules (centre distances without shifts, tooth numbers that its planets divide) have no cost.

Usage: compact.py TRUEFLANK FOLDER_OF_COMPACT [--case sspg=6.5] ... [--motor U8] [--set NUM_PLANET_MAX=3] ...
The folder is a clone that you have; nothing is downloaded. The peer needs numpy. Times are of the processor.
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
WIDTH = 10.0  # mm, of ours: the efficiency does not depend on it
RIM = 2.5  # modules, outside a ring's root
# what the peer prints, in its order, as our gears' names
PRINTED = {"sspg": (["sun", "planet", "ring"], ["module"], ["planets"]),
           "cpg": (["sun", "planet1", "planet2", "ring"], ["module"], ["planets"]),
           "wpg": (["sun", "planet1", "ring1", "planet2", "ring2"], ["module1", "module2"], ["planets"]),
           "dspg": (["sun1", "planet1", "ring1", "sun2", "planet2", "ring2"], ["module1", "module2"],
                    ["planets1", "planets2"])}
# columns of search.csv for these gears; a two-stage set's are in its column `teeth`
COLUMNS = {"sspg": ["sun", "planet1", "ring1"], "cpg": ["sun", "planet1", "planet2", "ring2"],
           "wpg": ["sun", "planet1", "ring1", "planet2", "ring2"]}
# The peer's classes, asked for the cost of sets: reads lines of JSON, writes lines of JSON.
COST = '''
import importlib, json, sys
case, motor, ratio = sys.argv[1], sys.argv[2], float(sys.argv[3])
optimiser = importlib.import_module(sys.argv[4])
actuator, judge = getattr(optimiser, "Actuator_" + motor), getattr(optimiser, "Optimizer_" + motor)
judge.gearRatioReq = ratio
holder = {"sspg": "planetaryGearbox", "cpg": "compoundPlanetaryGearbox", "wpg": "wolfromPlanetaryGearbox",
          "dspg": "doubleStagePlanetaryGearbox"}[case]
box = getattr(actuator, holder)
for line in sys.stdin:
    s = json.loads(line)
    z, n, m = s["teeth"], s["planets"], s["modules"]
    if case == "dspg":
        for stage, k in ((box.Stage1, 0), (box.Stage2, 1)):
            stage.setNs(z[3 * k]), stage.setNp(z[3 * k + 1]), stage.setNr(z[3 * k + 2])
            stage.setModule(m[-1 if k else 0]), stage.setNumPlanet(n[-1 if k else 0])
    elif case == "sspg":
        box.setNs(z[0]), box.setNp(z[1]), box.setNr(z[2]), box.setModule(m[0]), box.setNumPlanet(n[0])
    else:
        box.setNs(z[0]), box.setNpBig(z[1]), box.setModuleBig(m[0]), box.setModuleSmall(m[-1]), box.setNumPlanet(n[0])
        if case == "cpg":
            box.setNpSmall(z[2]), box.setNr(z[3])
        else:
            box.setNrBig(z[2]), box.setNpSmall(z[3]), box.setNrSmall(z[4])
    try:
        if not (box.geometricConstraint() and box.meshingConstraint() and box.noPlanetInterferenceConstraint()):
            raise ValueError("no set of the peer's")  # its widths would stay those of the set before
        actuator.updateFacewidth()
        told = {"cost": float(judge.cost(actuator)), "efficiency": float(box.getEfficiency())}
    except Exception as error:
        told = {"cost": None, "efficiency": None, "why": str(error)}
    sys.__stdout__.write(json.dumps(told) + chr(10))
'''


def timed(command, folder, timeout, text=None):
    """Output and processor seconds of a program."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=timeout, input=text)
    except subprocess.TimeoutExpired:
        done = subprocess.CompletedProcess(command, -1, "", f"stopped after {timeout:g} s")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return done, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Peer:
    def __init__(self, folder, work, args):
        self.folder, self.motor, self.timeout = work / "peer", args.motor, args.timeout
        self.folder.mkdir()
        for file in folder.glob("*.py"):
            shutil.copy(file, self.folder)
        shutil.copytree(folder / "config_files", self.folder / "config_files")
        for name in ("SSPG", "CPG", "WPG", "DSPG"):
            (self.folder / "CADs" / name).mkdir(parents=True)
        (self.folder / "results" / f"results_BruteForce_{args.motor}").mkdir(parents=True)
        for key, _, value in (text.partition("=") for text in args.set):
            self.change(key, float(value) if "." in value else int(value))

    def change(self, key, value):
        """In the copy, of all of its gearboxes: what both then search."""
        changed = False
        for case in KIND:
            path = self.folder / "config_files" / f"{case}_params.json"
            config = json.loads(path.read_text())
            found = config[f"{case}_optimization_parameters"]
            changed |= key in found
            found.update({key: value} if key in found else {})
            path.write_text(json.dumps(config))
        if not changed:
            sys.exit(f"compact.py: --set {key}: no such key in the peer's optimization parameters")

    def limits(self, case):
        keys = json.loads((self.folder / "config_files" / f"{case}_params.json").read_text())
        found = keys[f"{case}_optimization_parameters"]
        design = next((keys[k] for k in (f"{case}_3DP_design_parameters", f"{case}_design_parameters_3DP",
                                         f"{case}_design_parameters") if k in keys), {})
        pick = lambda *names: next(found[n] for n in names if n in found)
        return {"sun": pick("NUM_TEETH_SUN_MIN"),
                "planet": pick("NUM_TEETH_PLANET_MIN", "NUM_TEETH_PLANET_BIG_MIN"),
                "module": pick("MODULE_MIN", "MODULE_BIG_MIN", "MODULE_STAGE1_MIN"),
                "planets": range(pick("NUM_PLANET_MIN", "NUM_PLANET_STAGE1_MIN"),
                                 pick("NUM_PLANET_MAX", "NUM_PLANET_STAGE1_MAX") + 1),
                "step": found["GEAR_RATIO_STEP"], "apart": design.get("planetMinDistanceMM", 5.0),
                "friction": self.friction()}

    def friction(self):
        config = json.loads((self.folder / "config_files" / "config.json").read_text())
        return config["Gear_standard_parameters"]["coefficientOfFriction"]

    def run(self, case, ratio):
        """Its optimum as our names, None where it found none; seconds, why."""
        done, spent = timed([sys.executable, "actOpt.py", self.motor, case, str(ratio)], self.folder, self.timeout)
        gears, modules, planets = PRINTED[case]
        line = next((l for l in done.stdout.splitlines() if l.startswith("Number of teeth")), None)
        if line is None:
            last = (done.stderr or done.stdout).strip().splitlines()
            return None, spent, last[-1] if last else "no output"
        values = dict(zip(gears + modules + planets, (float(v) for v in re.findall(r"\)\s*:\s*([0-9.]+)", line))))
        return {"teeth": [int(values[g]) for g in gears], "modules": [values[m] for m in modules],
                "planets": [int(values[p]) for p in planets]}, spent, ""

    def costs(self, case, ratio, sets):
        """Of sets as `run` gives them: cost and efficiency by the peer."""
        script = self.folder / "cost_of_sets.py"
        script.write_text(COST)
        optimiser = re.search(f'"{case}": "(\\w+)"', (self.folder / "actOpt.py").read_text()).group(1)
        done, _ = timed([sys.executable, script.name, case, self.motor, str(ratio), optimiser], self.folder, self.timeout,
                        "".join(json.dumps(s) + "\n" for s in sets))
        lines = [json.loads(l) for l in done.stdout.splitlines() if l.startswith("{")]
        return lines if len(lines) == len(sets) else [{"cost": None, "efficiency": None}] * len(sets)


def design_text(case, peer, friction):
    """An optimum of the peer as a design of ours, with the teeth of the book."""
    kind, modules = KIND[case], peer["modules"]
    text = (f'format = 1\nname = "compact {case}"\n[gearbox]\nkind = "{kind}"\nplanets = {peer["planets"][0]}\n'
            f'module_mm = {modules[0]}\nfriction = {friction}\nbacklash_mm = 0.02\ntips = "standard"\n'
            + ('output = "ring2"\n' if kind == "3k" else ""))
    if kind == "two-stage":
        text += f'[stage2]\nplanets = {peer["planets"][1]}\nmodule_mm = {modules[1]}\n'
    for name, teeth in zip(PRINTED[case][0], peer["teeth"]):
        text += f"[{name}]\nteeth = {teeth}\nshift = 0.0\nface_width_mm = {WIDTH}\n"
        text += f"module_mm = {modules[1]}\n" if kind == "3k" and name.endswith("2") else ""
    return text


def checked(program, text, work):
    path = work / "design.toml"
    path.write_text(text)
    (work / "report.json").unlink(missing_ok=True)
    done, _ = timed([program, "check", path, "--json", work / "report.json"], work, 300)
    if not (work / "report.json").exists():
        return None, done.stderr.strip().splitlines()[-1:]
    report = json.loads((work / "report.json").read_text())
    return report, sorted({c["id"] for c in report["checks"] if c["status"] == "fail"})


def outer_diameter(report):
    """Of rings with rims of 2.5 modules, as the search counts it, and of planets on their way round."""
    largest = 0.0
    stages = report["train"].get("stages", [report["train"]])
    for name, gear in report["gears"].items():
        if gear["internal"]:
            largest = max(largest, gear["root_diameter_mm"] + 2 * RIM * gear["module_mm"])
        elif name.startswith("planet"):
            stage = stages[int(name[-1]) - 1] if len(stages) > 1 else stages[0]
            largest = max(largest, 2 * stage["centre_distance_mm"] + gear["tip_diameter_mm"])
    return largest


def planet_gap(report, planets):
    """Least distance of neighbouring planets' tips [mm]."""
    stages = report["train"].get("stages", [report["train"]])
    gaps = []
    for name, gear in report["gears"].items():
        if name.startswith("planet"):
            stage = int(name[-1]) - 1 if len(stages) > 1 else 0
            step = math.sin(math.pi / planets[min(stage, len(planets) - 1)])
            gaps.append(2 * stages[stage]["centre_distance_mm"] * step - gear["tip_diameter_mm"])
    return min(gaps)


def requirements(case, ratio, limits, diameter, teeth=None, listed=60, near=0):
    """The peer's box; with `teeth` (an optimum of the peer) these alone, or as many teeth more or fewer as `near`."""
    kind, step = KIND[case], limits["step"]
    most = int(diameter / limits["module"] - 2 * (RIM + 1.25 + 2))  # shifts reach 2: no module below the peer's least
    planets = sorted(set(teeth["planets"])) if teeth else limits["planets"]
    text = (f'format = 1\n[gearbox]\nkind = "{kind}"\nfriction = {limits["friction"]}\nouter_diameter_mm = {diameter:.4f}\n'
            f'face_width_mm = {WIDTH}\nplanets = "{", ".join(str(n) for n in planets)}"\n')
    text += {"3k": 'output = "ring2"\n', "two-stage": ""}.get(kind, 'output = "carrier"\n')
    if kind == "two-stage" and teeth:
        text += f'layer2_module_ratios = "{teeth["modules"][1] / teeth["modules"][0]:.6g}"\n'
    text += f"[ratio]\nmin = {ratio - step / 2 - 1e-7:.9g}\nmax = {ratio + step / 2 + 1e-7:.9g}\n[teeth]\n"
    if teeth:
        ranges = {}
        for name, z in zip(PRINTED[case][0], teeth["teeth"]):
            name = "sun" if name.startswith("sun") else name  # one range for the suns of both stages
            fewest = max(z - near, min(z, limits["sun" if name == "sun" else "planet"]))
            low, high = ranges.get(name, (fewest, z + near))
            ranges[name] = (min(low, fewest), max(high, z + near))
    else:
        ranges = {"sun": (limits["sun"], most // 2), "planet1": (limits["planet"], most // 2), "ring1": (40, most),
                  "planet2": (limits["planet"], most // 2), "ring2": (40, most)}
    text += "".join(f"{name}_min = {low}\n{name}_max = {high}\n" for name, (low, high) in ranges.items())
    return text + f'[limits]\nplanet_clearance_mm = {limits["apart"]}\n[search]\nresults = 1\nlisted = {listed}\n'


def searched(program, case, text, work, timeout):
    """Sets of search.csv as the peer's are, with what is told of each; processor seconds, why none."""
    (work / "needs.toml").write_text(text)
    folder = work / "found"
    shutil.rmtree(folder, ignore_errors=True)
    done, spent = timed([program, "search", work / "needs.toml", "-o", folder, "-q", "--threads", "1"], work, timeout)
    if not (folder / "search.csv").exists():
        return [], spent, (done.stderr.strip().splitlines() or ["no answer"])[-1]
    found = []
    with open(folder / "search.csv", newline="") as file:
        for row in csv.DictReader(file):
            teeth = [int(z) for z in row["teeth"].split("/")] if case == "dspg" else [int(row[c]) for c in COLUMNS[case]]
            module = float(row["module_mm"])
            modules = [module, module * float(row["layer2_module_ratio"] or 1)]
            found.append({"teeth": teeth, "planets": [int(n) for n in row["planets"].split("/")],
                          "modules": modules, "ratio": float(row["ratio"]), "integral": float(row["forward"]),
                          "diameter": float(row["outer_diameter_mm"]), "file": row["file"]})
    for one in found:
        if one["file"]:
            report, _ = checked(program, (folder / one["file"]).read_text(), work)
            one["formula"] = report and report["efficiency"]["by_formula"]["forward"]
    return found, spent, ""


def number(value, digits=2, factor=1.0):
    return "-" if value is None else f"{factor * value:.{digits}f}"


def print_row(task, who, one, cost, checks, spent):
    ours = None
    if one and cost["cost"] is not None:
        ours = cost["cost"] + 2.0 * (cost["efficiency"] - one["integral"])
    cells = [task, who] + (["-"] * 9 if one is None else [
        "/".join(map(str, one["teeth"])), "/".join(map(str, one["planets"])), "/".join(f"{m:.3f}" for m in one["modules"]),
        f'{one["ratio"]:.3f}', number(one["diameter"], 1), number(cost["efficiency"], 2, 100),
        number(one.get("formula"), 2, 100), number(one["integral"], 2, 100), f'{number(cost["cost"], 3)} / {number(ours, 3)}'])
    print("| " + " | ".join(cells + [checks, number(spent, 1)]) + " |", flush=True)


def told(case, ratio, args, peer, work):
    limits = peer.limits(case)
    task = f"{KIND[case]} {ratio:g}"
    optimum, spent, why = peer.run(case, ratio)
    if optimum is None:
        return print_row(task, "COMPAct", None, None, why, spent)
    report, failed = checked(args.trueflank, design_text(case, optimum, limits["friction"]), work)
    if report is None:
        return print_row(task, "COMPAct", None, None, f"cannot be laid out: {failed}", spent)
    optimum |= {"ratio": report["train"]["ratio"], "diameter": outer_diameter(report),
                "formula": report["efficiency"]["by_formula"]["forward"], "integral": report["efficiency"]["forward"]}
    print_row(task, "COMPAct", optimum, peer.costs(case, ratio, [optimum])[0],
              "fails " + ", ".join(failed) if failed else "passes", spent)
    limits["apart"] = max(0.0, min(limits["apart"], planet_gap(report, optimum["planets"])))
    near = f" within {args.near} teeth" if args.near else ""
    for who, teeth in (("its teeth, shifted", optimum), (f"ours{near}, most efficient", optimum if args.near else None)):
        of_all = who.startswith("ours")
        text = requirements(case, ratio, limits, optimum["diameter"], teeth, args.listed, args.near if of_all else 0)
        rows, time, why = searched(args.trueflank, case, text, work, args.timeout)
        best = next((r for r in rows if r["file"]), None)
        if best is None:
            print_row(task, who, None, None, why or "no set", time)
            continue
        costs = peer.costs(case, ratio, rows)
        print_row(task, who, best, costs[rows.index(best)], "passes", time)
        priced = [k for k, c in enumerate(costs) if c["cost"] is not None]
        if of_all and priced:
            least = min(priced, key=lambda k: costs[k]["cost"] + 2.0 * (costs[k]["efficiency"] - rows[k]["integral"]))
            print_row(task, f"ours{near}, least cost of {len(priced)}", rows[least], costs[least],
                      "passes" if rows[least]["file"] else "not judged", None)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trueflank", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("compact", type=pathlib.Path)
    parser.add_argument("--case", action="append", help="gearbox=ratio; gearboxes " + ", ".join(KIND))
    parser.add_argument("--motor", default="U8")
    parser.add_argument("--near", type=int, default=0, metavar="TEETH",
                        help="ours looks so many teeth around each of the peer's optimum only, with its planets")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE",
                        help="one of the peer's optimization parameters, for both")
    parser.add_argument("--listed", type=int, default=60, help="sets of ours of which the one that costs least is told")
    parser.add_argument("--timeout", type=float, default=3600.0, help="s by the clock, of one run of either")
    args = parser.parse_args()
    if not (args.compact / "actOpt.py").exists():
        print(f"compact.py: {args.compact} is no folder of COMPAct (it has no actOpt.py): nothing compared. It is public: "
              "github.com/singhaman1750/COMPAct (MIT).")
        return
    print("| task | who | teeth | planets | modules [mm] | ratio | diameter [mm] | by the peer [%] | by our formula [%] | "
          "path integral [%] | cost: its / our efficiency | checks | seconds |\n" + "| --- " * 13 + "|")
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        peer = Peer(args.compact, work, args)
        for case in args.case or CASES:
            name, _, ratio = case.partition("=")
            if name not in KIND or not ratio:
                parser.error(f"--case {case}: one of {', '.join(KIND)}, = and a ratio")
            told(name, float(ratio), args, peer, work)


if __name__ == "__main__":
    main()
