# SPDX-License-Identifier: GPL-3.0-or-later
"""Every command with the system failing at its n-th call: memory, write, rename, open, close, threads.

A run ends with the exit code of the environment (3) or did not need the call (0, and files as ever). What stands
under a final name is byte for byte what an undisturbed run writes; nothing temporary stays; nothing crashes.

Arguments: the library that lets calls fail, how many places of each kind are tried, [--beyond N: without those that
are tried where N of each kind are,] and the commands (all).
"""
import os
import pathlib
import resource
import shutil
import subprocess
import sys

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "failing_calls"
LIBRARY, PLACES = sys.argv[1], int(sys.argv[2])
BEYOND = int(sys.argv[4]) if sys.argv[3:4] == ["--beyond"] else 0
COMMANDS = sys.argv[5:] if BEYOND else sys.argv[3:]
FILE_LIMIT = 1 << 40  # bytes; not reached
REMEDIES = {b"No space left": b"free some space", b"File too large": b"beyond 1099511627776 bytes here; wanted: a higher limit (ulimit -f",
            b"Too many open files": b"open here; wanted: a higher limit (ulimit -n"}
SLOW_ONLY = {"certified", "wished"}
LONG = {"fix", "shifts", "bench", "scan", "certified"}  # up to a second each: at a quarter of the places
GEAR = """format = 1
name = "g"
[gearbox]
kind = "gear"
[gear]
teeth = 11
shift = 0.4
face_width_mm = 2
module_mm = 1
"""
PAIR = GEAR.replace('kind = "gear"', 'kind = "pair"\nmodule_mm = 1').replace("[gear]", "[pinion]").replace(
    "module_mm = 1\n", "") + "[wheel]\nteeth = 13\nface_width_mm = 2\n"
PAIR = PAIR.replace('kind = "pair"\n', 'kind = "pair"\nmodule_mm = 1\n')
FAILS = PAIR.replace("teeth = 11\nshift = 0.4", "teeth = 9\nshift = 0").replace("teeth = 13", "teeth = 23")
BENCH = "direction,input_speed_rpm,input_torque_nm,output_torque_nm\n" + "".join(
    f"{d},{n},{t},{(0.93 if d == 'forward' else 1.08) * t * 2 + 0.01 * ((7 * k) % 5)}\n"
    for k, (d, n, t) in enumerate((d, n, t) for d in ("forward", "backward") for n in (100, 400) for t in (0.5, 1, 2, 4)))
LOOP = ('{"format": "trueflank-loop", "version": 1, "gear": "gear", "effects": [{"id": "eccentricity", '
        '"parameters": {"amplitude_um": {"value": 30}, "phase_deg": {"value": 0}}}]}')
CERTIFIED_NEEDS = """format = 1
name = "small"
[gearbox]
kind = "pair"
[ratio]
min = 2.388
max = 2.389
[teeth]
pinion_min = 18
pinion_max = 18
[search]
results = 1
"""
# Every call is made in a search of one set too. That it be short, the shifts have room about the best ones alone, and the
# objective no certified bound.
SHORT_NEEDS = CERTIFIED_NEEDS.replace("[teeth]", "[shift]\nmin = 0.9\nmax = 1.7\n[teeth]") + 'objectives = "length"\n'
CENTRES = "".join(f"profile,{t},{f},{10 + 0.1 * k:.1f},1,{0.3 * ((7 * t + 3 * k) % 5)}\n"
                  for t in (1, 4, 8) for f in ("left", "right") for k in range(12))


def run(arguments, failing=None, count=None):
    environment = dict(os.environ, LD_PRELOAD=LIBRARY)
    if failing:
        environment["FAILING_CALL"] = failing
    if count:
        environment["FAILING_CALL_COUNT"] = str(count)
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, env=environment, timeout=120,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_LIMIT, FILE_LIMIT)))


def files_of(folder):
    return {p.relative_to(folder): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def places(calls, most):
    """All of few; of many the first ones and then ever farther apart."""
    if calls <= most:
        return list(range(1, calls + 1))
    near = max(1, most // 3)
    chosen = list(range(1, near + 1))
    while chosen[-1] < calls and len(chosen) < most:
        share = (len(chosen) - near + 1) / (most - near)
        chosen.append(max(chosen[-1] + 1, round(near * (calls / near) ** share)))
    return [n for n in chosen if n <= calls]


def chosen_places(name, calls):
    most, beyond = (max(2, n // 4) if name in LONG else n for n in (PLACES, BEYOND))
    tried_before = places(calls, beyond) if BEYOND and name not in SLOW_ONLY else []
    return [n for n in places(calls, most) if n not in tried_before]


def run_calmly(name, arguments):
    """Exit code and files of a run in which nothing fails, and how many calls of each kind it made."""
    whole = OUTPUT / f"{name}_whole"
    whole.mkdir(parents=True)
    count = OUTPUT / f"{name}.count"
    calm = run(arguments(whole), count=count)
    assert calm.returncode in (0, 1), (name, calm.stderr)
    calls = {kind: int(number) for kind, number in (line.split() for line in count.read_text().splitlines())}
    expected = files_of(whole)
    shutil.rmtree(whole)
    return calm.returncode, expected, calls


def try_command(name, arguments, kind, calm):
    """`arguments` is a function of the folder that the command writes to; `calm` is what a run did in which nothing fails."""
    code, expected, calls = calm
    tried = 0
    for place in chosen_places(name, calls[kind]):
        for failing in (f"{kind}:{place}", f"{kind}:{place}+"):
            folder = OUTPUT / f"{name}_failing"
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            done = run(arguments(folder), failing)
            told = (name, failing, done.returncode, done.stderr[-300:])
            found = files_of(folder)
            assert done.returncode in (3, code), told
            assert not [p for p in found if p.name.endswith(".tmp")], (told, list(found))
            for path, content in found.items():
                assert path.name.endswith(".journal") or content == expected.get(path), (told, path)
            if done.returncode == 3:
                assert b"trueflank: " in done.stderr or kind in ("malloc", "write"), told
                assert b"internal error" not in done.stderr, told
                for words, remedy in REMEDIES.items():
                    assert words not in done.stderr or remedy in done.stderr, told
            else:
                assert set(found) == set(expected), (told, set(expected) - set(found))
            if kind == "thread":
                assert done.returncode == code, told
            tried += 1
    return tried


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    for file, text in (("gear.toml", GEAR), ("pair.toml", PAIR), ("loop.json", LOOP),
                       ("short.toml", SHORT_NEEDS), ("certified.toml", CERTIFIED_NEEDS),
                       ("fails.toml", FAILS), ("bench.csv", BENCH),
                       ("traces.csv", "record,tooth,flank,diameter_mm,z_mm,deviation_um\n" + CENTRES)):
        (OUTPUT / file).write_text(text)
    gear, pair = OUTPUT / "gear.toml", OUTPUT / "pair.toml"
    assert run(["make", gear, "-o", OUTPUT / "golden", "--formats", "stl,obj", "--tolerance-um", 20]).returncode == 0
    golden = OUTPUT / "golden"
    assert run(["make", gear, "-o", OUTPUT / "worn", "--formats", "ply", "--correct", OUTPUT / "loop.json"]).returncode == 0
    assert run(["search", OUTPUT / "short.toml", "-o", OUTPUT / "searched"]).returncode == 0
    searched = (OUTPUT / "searched" / "search.journal").read_text().splitlines(keepends=True)

    def interrupted(folder):
        """A search that ended before its first set was done."""
        (folder / "search.journal").write_text(searched[0])
        return ["search", OUTPUT / "short.toml", "-o", folder, "--resume"]

    commands = {
        "make": lambda d: ["make", pair, "-o", d, "--formats", "stl,3mf,glb,step,svg,dxf,scad,pdf", "--tolerance-um",
                           20, "--allow-failing"],
        "draw": lambda d: ["make", gear, "-o", d, "--formats", "pdf", "--tolerance-um", 20],
        "correct": lambda d: ["make", gear, "-o", d, "--formats", "stl,ply", "--correct", OUTPUT / "loop.json",
                              "--tolerance-um", 20],
        "check": lambda d: ["check", pair, "--json", d / "c.json", "--html", d / "c.html"],
        "compare": lambda d: ["compare", golden / "gear.stl", golden / "gear.obj", "--json", d / "c.json"],
        "new": lambda d: ["new", d / "mine"],
        "fix": lambda d: ["fix", OUTPUT / "fails.toml", "-o", d / "mended.toml"],
        "shifts": lambda d: ["shifts", OUTPUT / "short.toml", "--teeth", "18/43", "--points", 11, "-o", d],
        "bench": lambda d: ["loop", pair, OUTPUT / "bench.csv", "-o", d],
        "resume": interrupted,
        "merge": lambda d: ["search", OUTPUT / "short.toml", "-o", d, "--merge", OUTPUT / "searched"],
        "loop": lambda d: ["loop", gear, OUTPUT / "traces.csv", "--gear", "gear", "-o", d],
        "scan": lambda d: ["loop", gear, OUTPUT / "worn" / "gear.ply", "--gear", "gear", "-o", d],
        "search": lambda d: ["search", OUTPUT / "short.toml", "-o", d, "--threads", 2],
    }
    kinds = {"certified": ("malloc",), "wished": ("thread", "rename", "open", "close", "write")}
    if BEYOND:  # a second and more each; of a wish, memory is the search's
        commands["certified"] = lambda d: ["search", OUTPUT / "certified.toml", "-o", d, "--threads", 2]
        commands["wished"] = lambda d: ["new", d / "mine", "--kind", "pair", "--ratio", 8]
    for name in COMMANDS or commands:
        calm = run_calmly(name, commands[name])
        for kind in kinds.get(name, ("thread", "rename", "open", "close", "write", "malloc")):
            tried = try_command(name, commands[name], kind, calm)
            print(f"{name}: {kind} fails at {tried} places of {calm[2][kind]} calls", flush=True)


if __name__ == "__main__":
    main()
