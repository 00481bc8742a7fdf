#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the time goes: instructions of each stage of the commands people wait for, against the figures kept in
bench/stages.json, and processor time against `cp` of the same files, in one run.

Instructions do not depend on what else the machine does; a stage that takes 5 % more than the kept
figure, or a job whose files hold more facets, fails the bench and is named. Needs valgrind.

  python3 bench/stages.py [PROGRAM] [--update] [--job NAME]

--update writes the figures of this program to the file (after a release, or with a change that is worth its price).
"""
import argparse
import json
import math
import pathlib
import random
import re
import resource
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
KEPT = SOURCE / "bench/stages.json"
ALLOWED = 1.05
# A stage smaller than this share of its job is told with the rest.
LEAST_SHARE = 0.01

# A thread's share of work that is done in pieces on all processors: which pieces differs from run to run.
# Kept threads are given it as a function (base/threads.h).
BESIDE = r"std::_Function_handler<void \(\), trueflank::for_each_piece<(?:trueflank::for_each_run<)?"
# Work begun on a thread of its own.
ON_A_THREAD = r"std::__future_base::_Async_state_impl<std::thread::_Invoker<std::tuple<"
# Inclusive instructions of these functions, threads added up. What one stage calls of another counts in both.
STAGES = {
    "check": r"trueflank::check_gearbox\(|" + ON_A_THREAD + r"trueflank::cure_text.*::_M_run",
    "cure of corner contact": r"trueflank::(shift_cure|tip_radius_cure_mm)\(",
    "meshing": r"trueflank::part_mesh\(",
    "measuring meshes": r"trueflank::measure_accuracy\(",
    "meshes turned through": r"trueflank::mesh_states\((?!.*\{lambda)|" + BESIDE + r"trueflank::mesh_states",
    "packing": r"trueflank::io::deflated?\(|trueflank::io::packed",
    "reading back": r"trueflank::io::visit_facets\(",
    "unpacking": r"libdeflate_(zlib|deflate)_decompress_ex",
    "exact bodies": r"trueflank::brep_of\(",
    "STEP": r"trueflank::io::.*write_step|trueflank::io::step_",
    "effects of a drive": r"trueflank::loop::DriveSelection::run\(",
    "reading measured files": r"trueflank::loop::read_measured_files\(",
    "points to observations": r"trueflank::loop::make_observations\(|" + BESIDE +
                              r"trueflank::loop::\(anonymous namespace\)::(TableBuilder|PoseSearch)",
    "patches": r"trueflank::loop::make_patches\(|" + BESIDE +
               r"trueflank::loop::(RowsByClass::RowsByClass<trueflank::loop::)?\(anonymous namespace\)::PatchMaker",
    "columns of candidates": r"trueflank::loop::set_candidates\(|" + BESIDE + r"trueflank::loop::set_candidates",
    "discovery": r"trueflank::loop::Discovery::Discovery\(|trueflank::loop::Discovery::finished\(|" + BESIDE +
                 r"trueflank::loop::(BlockStatistics|ProjectedCandidates|StructureTest|CrossValidation|QuickErrors|agreement_of_wholes)",
    "what is left": r"trueflank::loop::look_at_remainder\(|" + ON_A_THREAD + r".*RemainderSearch::run.*::_M_run|" +
                    BESIDE + r"trueflank::loop::(\(anonymous namespace\)::(CourseScan|RemainderSearch|Spectrum|SpotSearch)|likeliest_rotation_wave)",
    "moving points": r"trueflank::loop::linearise_at\((?!.*\{lambda)|" + BESIDE +
                     r"trueflank::loop::\(anonymous namespace\)::largest_of_points<trueflank::loop::linearise_at",
    "fits to points": r"trueflank::loop::PointFit::sums_of\((?!.*\{lambda)",
    "shifts of tooth sets": r"trueflank::optimise_set\(",
    "certificate of a search": r"trueflank::certified_bound\(",
    "reading meshes": r"trueflank::io::read_mesh\(",
    "testing that meshes are closed": r"trueflank::mesh_validity\(",
    "tree of facets": r"trueflank::TriangleTree::TriangleTree\(",
    "distances of corners": r"trueflank::\(anonymous namespace\)::Directed::look_from_corners\(",
    "searches for the nearest facet": r"trueflank::TriangleTree::Nearest trueflank::TriangleTree::search<",
}

PAIR = """format = 1
name = "gear"
[gearbox]
kind = "gear"
module_mm = 1.0
[gear]
teeth = 24
face_width_mm = 10.0
bore_mm = 8.0
"""
CROWNED = """format = 1
name = "gear"
[gearbox]
kind = "gear"
module_mm = 1.0
helix_angle_deg = 20.0
[gear]
teeth = 24
face_width_mm = 10.0
[gear.modifications]
crowning_um = 8.0
tip_relief_um = 10.0
tip_relief_start_diameter_mm = 26.6
"""
DRIVE = """format = 1
name = "pair"
[gearbox]
kind = "pair"
module_mm = 2.0
friction = 0.06
[pinion]
teeth = 19
shift = 0.2
face_width_mm = 16.0
[wheel]
teeth = 57
face_width_mm = 16.0
"""
SEARCH = """format = 1
[gearbox]
kind = "3k"
output = "any"
[ratio]
min = 95.9
max = 96.1
[teeth]
identical_planets = true
sun_min = 12
sun_max = 13
planet1_min = 38
planet1_max = 39
[search]
results = 1
listed = 0
"""


def scan(path, count):
    """A scan of the gear of PAIR, 20 um off its axis, 5 um noise: a binary PLY of points in any order."""
    numbers = random.Random(1)
    z, width, alpha = 24, 10.0, math.radians(20.0)
    base = 0.5 * z * math.cos(alpha)
    half = math.pi / (2 * z) + math.tan(alpha) - alpha
    low, high = (math.sqrt((r / base) ** 2 - 1.0) for r in (11.4, 13.0))
    with open(path, "wb") as file:
        file.write(b"ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\n"
                   b"property float y\nproperty float z\nend_header\n" % count)
        for _ in range(count):
            height = numbers.uniform(0.0, width)
            if numbers.random() < 0.05:  # the bore
                turn = numbers.uniform(0.0, 2.0 * math.pi)
                file.write(struct.pack("<fff", 4.0 * math.cos(turn), 4.0 * math.sin(turn), height))
                continue
            xi = math.sqrt(numbers.uniform(low * low, high * high))
            off = numbers.gauss(0.0, 0.005)
            away, tau = base * xi + off, half - xi
            x = base * math.cos(tau) - away * math.sin(tau)
            y = (base * math.sin(tau) + away * math.cos(tau)) * numbers.choice((-1, 1))
            turn = 2.0 * math.pi * numbers.randrange(z) / z
            file.write(struct.pack("<fff", x * math.cos(turn) - y * math.sin(turn) + 0.02,
                                   x * math.sin(turn) + y * math.cos(turn), height))


def bench_log(path, count):
    """A log of a drive with a ratio of 3: noise, and a loss below 700 rpm that the design lacks."""
    numbers = random.Random(2)
    with open(path, "w", encoding="utf-8") as file:
        file.write("direction,input_speed_rpm,input_torque_nm,output_torque_nm\n")
        for _ in range(count):
            speed, torque = numbers.uniform(50.0, 2500.0), numbers.uniform(3.0, 18.0)
            lost = 0.3 if speed < 700.0 else 0.0
            file.write(f"forward,{speed:.2f},{torque:.5f},"
                       f"{2.97 * (torque - lost) + numbers.gauss(0.0, 0.2):.5f}\n")


def jobs(program, folder):
    """Commands by name, each with the folder or file it writes."""
    def make(example, formats, name):
        return [program, "make", SOURCE / "examples" / example / "design.toml", "-o", folder / name,
                "-q", "--formats", formats], folder / name
    (folder / "gear.toml").write_text(PAIR)
    (folder / "crowned.toml").write_text(CROWNED)
    (folder / "search.toml").write_text(SEARCH)
    (folder / "pair.toml").write_text(DRIVE)
    scan(folder / "scan.ply", 20000)
    bench_log(folder / "log.csv", 4000)
    ring = folder / "helical/ring"
    return {
        "search 3k": ([program, "search", folder / "search.toml", "-o", folder / "search", "-q", "--threads", "1"], None),
        "check 3k": ([program, "check", SOURCE / "examples/bilateral_drive/design.toml"], None),
        "3k": make("bilateral_drive", "stl,3mf", "3k"),
        "3k step": make("bilateral_drive", "stl,3mf,step", "3k_step"),
        "helical": make("helical_planetary", "stl,3mf", "helical"),
        "herringbone": make("herringbone_pair", "stl,3mf", "herringbone"),
        "crowned gear": ([program, "make", folder / "crowned.toml", "-o", folder / "crowned", "-q", "--formats", "stl,3mf"],
                         folder / "crowned"),
        "compare": ([program, "compare", f"{ring}.stl", f"{ring}.3mf"], None),
        "loop 20 000": ([program, "loop", folder / "gear.toml", folder / "scan.ply", "-o", folder / "loop"],
                        folder / "loop"),
        "bench log 4000": ([program, "loop", folder / "pair.toml", folder / "log.csv", "-o", folder / "log"], folder / "log"),
    }


def run(command):
    """Processor seconds of one run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    if result.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def instructions(command, folder):
    """Of the whole process and of each stage."""
    profile = folder / "profile"
    run(["valgrind", "-q", "--tool=callgrind", f"--callgrind-out-file={profile}", *command])
    table = subprocess.run(["callgrind_annotate", "--inclusive=yes", "--threshold=100", profile],
                           capture_output=True, text=True, check=True).stdout
    total, stages = 0, {}
    for line in table.splitlines():
        match = re.match(r"\s*([\d,]+)\s+\(\s*[\d.]+%\)\s+(.*)", line)
        if not match:
            continue
        count = int(match[1].replace(",", ""))
        if "PROGRAM TOTALS" in match[2]:
            total = count
        function = match[2].split(":", 1)[-1]
        for stage, pattern in STAGES.items():
            if re.match(pattern, function) and "'2" not in function:
                stages[stage] = stages.get(stage, 0) + count
    return {"total": total, "stages": {s: n for s, n in stages.items() if n >= LEAST_SHARE * total}}


def copy_seconds(folder, out):
    """Processor seconds of `cp -r` of what the job wrote."""
    def once():
        shutil.rmtree(folder / "copy", ignore_errors=True)
        return run(["cp", "-r", out, folder / "copy"])
    return statistics.median(once() for _ in range(5))


def compared(now, kept, name):
    """Tells one job; whether a stage or the whole takes more than is allowed."""
    slower = []
    rows = [("whole", now["total"], kept.get("total"))]
    rows += [(stage, n, kept.get("stages", {}).get(stage)) for stage, n in now["stages"].items()]
    facets, before = now.get("facets", 0), kept.get("facets")
    if before and facets > before:
        slower.append(f"{name}: {facets} facets in its files, {before} before")
    for stage, count, before in rows:
        ratio = count / before if before else math.nan
        print(f"  {stage:28} {count / 1e6:9.1f} M  {count / now['total']:6.1%}"
              + (f"  {ratio:.3f} of the kept figure" if before else "  no figure kept"))
        if before and ratio > ALLOWED:
            slower.append(f"{name}: {stage}: {ratio:.3f} times the kept instructions")
    return slower


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", nargs="?", default=SOURCE / "build/trueflank", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--job", action="append", help="only this one; may be given again")
    arguments = parser.parse_args()
    if not shutil.which("valgrind"):
        sys.exit("bench/stages.py needs valgrind. On Debian: apt-get install valgrind")
    kept = json.loads(KEPT.read_text()) if KEPT.exists() else {}
    slower = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        todo = jobs(arguments.program.resolve(), folder)
        for name, (command, out) in todo.items():
            if arguments.job and name not in arguments.job and not (name == "helical" and "compare" in arguments.job):
                continue
            seconds = statistics.median(run(command) for _ in range(5))
            ratio = f", {seconds / max(copy_seconds(folder, out), 1e-3):.1f} x cp" if out else ""
            print(f"{name}: {1e3 * seconds:.0f} ms of processor time{ratio}", flush=True)
            now = instructions(command, folder)
            report = out / "report.json" if out else None
            if report and report.exists():
                now["facets"] = sum(file.get("triangles") or 0 for file in json.loads(report.read_text())["files"])
            slower += compared(now, {} if arguments.update else kept.get(name, {}), name)
            if arguments.update:
                kept[name] = now
    if arguments.update:
        KEPT.write_text(json.dumps(kept, indent=1) + "\n")
    for line in slower:
        print(f"slower: {line}")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
