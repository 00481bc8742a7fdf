# SPDX-License-Identifier: GPL-3.0-or-later
"""The search command: equal answers however it is run, files that `check` takes, errors by code."""
import csv
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import tomllib

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "search"
WHOLE = "TRUEFLANK_CAMPAIGN" in os.environ
NEEDS = """format = 1
name = "small"
[gearbox]
kind = "3k"
[ratio]
min = 95
max = 97
[teeth]
sun_min = 12
sun_max = 12
planet1_min = 39
planet1_max = 39
ring1_min = 84
ring1_max = 96
planet2_max = 34
[search]
results = 1
"""
RESULTS = ["design-001.toml", "search.csv", "search.json", "search.svg", "search.html", "search.journal"]


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, "search", *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def same(one, other, names):
    for name in names:
        assert (one / name).read_bytes() == (other / name).read_bytes(), name


KINDS = """format = 1
name = "kinds"
[gearbox]
kind = "simple, stepped, pair, 3k"
planets = "3, 4"
output = "any"
input = "any"
wheel = "any"
[ratio]
min = 5
max = 5.02
[shift]
min = -0.8
max = 0.8
[teeth]
sun_min = 15
sun_max = 15
planet1_min = 20
planet1_max = 22
planet2_min = 18
planet2_max = 18
ring1_max = 60
ring2_max = 75
ring_max = 60
wheel_max = 75
[search]
results = 30
"""


def every_limit_is_named(folder, report):
    """`binding` of search.csv: each key of search.json's once, the limit where it has none; of written designs alone."""
    rows = list(csv.DictReader((folder / "search.csv").open()))
    by_file = {row["file"]: row["binding"].split() for row in rows if row["file"]}
    for design in report["designs"]:
        named = [b["key"] or b["limit"] for b in design["binding"]]
        told = by_file[design["file"]]
        assert set(told) == set(named) and len(told) == len(set(told)), (design["file"], told, named)
    assert "shift.max" in by_file["design-001.toml"], by_file
    others = [row for row in rows if not row["file"]]
    assert others and all(row["binding"] == "" for row in others), others


def every_kind():
    """Several kinds in one search: the same bytes however it runs, designs that check takes, files that say the kind."""
    needs = OUTPUT / "kinds.toml"
    needs.write_text(KINDS)
    whole = OUTPUT / "kinds"
    run(needs, "-o", whole, "--threads", 1, "-q")
    names = sorted(p.name for p in whole.glob("design-*.toml")) + RESULTS[1:]
    threads = OUTPUT / "kinds-threads"
    threads.mkdir()
    text = (whole / "search.journal").read_bytes()
    (threads / "search.journal").write_bytes(text[: len(text) // 3])
    run(needs, "-o", threads, "--resume", "--threads", 3, "-q")
    same(whole, threads, names)
    if WHOLE:  # as parts of one kind are merged, which the gate sees, too
        for part in (1, 2, 3):
            run(needs, "-o", OUTPUT / f"kinds{part}", "--shard", f"{part}/3", "-q")
        merged = OUTPUT / "kinds-merged"
        run(needs, "-o", merged, "--merge", *(OUTPUT / f"kinds{part}" for part in (1, 2, 3)), "-q")
        same(whole, merged, names[:-1])

    report = json.loads((whole / "search.json").read_text())
    rows = list(csv.DictReader((whole / "search.csv").open()))
    by_file = {row["file"]: row for row in rows if row["file"]}
    assert {d["kind"] for d in report["designs"]} == {"simple", "stepped", "pair", "3k"}, report["designs"]
    for design in report["designs"]:
        written = tomllib.loads((whole / design["file"]).read_text())
        row = by_file[design["file"]]
        assert written["gearbox"]["kind"] == design["kind"] == row["kind"]
        for gear, teeth in design["teeth"].items():
            assert written[gear]["teeth"] == teeth
        assert row["teeth"] == "/".join(map(str, design["teeth"].values()))
        assert written["gearbox"].get("planets", 1) == design["planets"] == int(row["planets"])
        assert 5 <= design["ratio"] <= 5.02
        check = subprocess.run([PROGRAM, "check", whole / design["file"], "-q"])
        assert check.returncode == 0, design["file"]


def short_list():
    """The best sets alone, the others passed over: the designs of the whole list, the same bytes however it runs."""
    needs = OUTPUT / "short.toml"
    needs.write_text(NEEDS.replace("results = 1", "results = 1\nlisted = 2"))
    whole = OUTPUT / "short"
    assert "the best 2 of" in run(needs, "-o", whole, "--threads", 1).stdout
    report = json.loads((whole / "search.json").read_text())
    assert report["complete"] and report["optimised"] == report["feasible"] == 2
    assert report["passed_over"] == report["to_optimise"] - 2 > 0
    assert sum(c["count"] for c in report["rejected"]) + 2 == report["considered"]
    assert len((whole / "search.csv").read_text().splitlines()) == 3
    everything = OUTPUT / "everything"
    needs_all = OUTPUT / "everything.toml"
    needs_all.write_text(NEEDS.replace("results = 1", "results = 1\nlisted = 0"))
    run(needs_all, "-o", everything, "-q")
    same(whole, everything, ["design-001.toml"])
    listed = (whole / "search.csv").read_text().splitlines()
    assert (everything / "search.csv").read_text().splitlines()[:3] == listed
    names = RESULTS[:-1]
    threads = OUTPUT / "short-threads"
    threads.mkdir()
    # without its last line the journal does not say that it is complete
    lines = (whole / "search.journal").read_text().splitlines(keepends=True)
    (threads / "search.journal").write_text("".join(lines[:2]))
    run(needs, "-o", threads, "--resume", "--threads", 3, "-q")
    same(whole, threads, names + RESULTS[-1:])
    for part in (1, 2):
        run(needs, "-o", OUTPUT / f"short{part}", "--shard", f"{part}/2", "-q")
    merged = OUTPUT / "short-merged"
    run(needs, "-o", merged, "--merge", OUTPUT / "short1", OUTPUT / "short2", "-q")
    same(whole, merged, names)
    assert "tooth sets" in run(needs, "-o", merged, "--merge", OUTPUT / "short2", code=2).stderr


IN_SERIES = """format = 1
name = "series"
[gearbox]
kind = "two-stage"
[ratio]
min = 15
max = 20
[teeth]
sun_min = 17
sun_max = 18
planet1_min = 18
planet1_max = 18
planet2_min = 19
planet2_max = 20
ring1_min = 54
ring1_max = 55
ring2_min = 56
ring2_max = 57
[search]
objectives = "forward, size"
results = 1
listed = 1
"""


def in_series():
    """Trains of two stages: their journal is resumed and merged like others', the bytes are the same."""
    needs = OUTPUT / "series.toml"
    needs.write_text(IN_SERIES)
    whole = OUTPUT / "series"
    assert "trains put together from" in run(needs, "-o", whole, "--threads", 1).stdout
    assert json.loads((whole / "search.json").read_text())["complete"]
    lines = (whole / "search.journal").read_text().splitlines(keepends=True)
    assert sum(line.startswith("stage ") for line in lines) == len(lines) - 2 >= 2, lines
    resumed = OUTPUT / "series-resumed"
    resumed.mkdir()
    (resumed / "search.journal").write_text("".join(lines[:2]) + lines[2][:20])
    run(needs, "-o", resumed, "--resume", "--threads", 3, "-q")
    same(whole, resumed, RESULTS)
    for part in (1, 2):
        run(needs, "-o", OUTPUT / f"series{part}", "--shard", f"{part}/2", "-q")
    merged = OUTPUT / "series-merged"
    run(needs, "-o", merged, "--merge", OUTPUT / "series1", OUTPUT / "series2", "-q")
    same(whole, merged, RESULTS[:-1])
    assert "trains in series" in run(needs, "-o", merged, "--merge", OUTPUT / "series2", code=2).stderr
    needs.write_text(IN_SERIES.replace("forward, size", "forward, backlash"))
    assert "backlash" in run(needs, "-o", merged, code=2).stderr


def shift_map():
    """The map over one set's shifts: its best is the search's, and each place says what forbids it."""
    needs = OUTPUT / "small-map.toml"
    needs.write_text(NEEDS)
    folder = OUTPUT / "map"
    call = [PROGRAM, "shifts", needs, "--teeth", "12/39/90/32/81", "-o", folder, "--points", "31"]
    told = subprocess.run(call, capture_output=True, text=True)
    assert told.returncode == 0 and "12/39/90/32/81: 90.99" in told.stdout, (told.stdout, told.stderr)
    rows = list(csv.DictReader((folder / "shifts.csv").open()))
    assert len(rows) == 3 * 31 * 31
    for number in "123":
        kept = [row for row in rows if row["map"] == number and row["feasible"] == "1"]
        assert 10 < len(kept) < 31 * 31
        assert all(float(row["margin_modules"]) >= 0 and float(row["efficiency"]) < 0.90997 for row in kept)
    assert all((float(row["margin_modules"]) >= 0) == (row["feasible"] == "1") for row in rows)
    page = (folder / "shifts.html").read_text()
    assert page.count("<svg") == 3 and "fillet_interference: planet1-ring1" in page
    assert "3k, sun drives ring2, 3 planets" in page
    # the bound of a shift is a border as any other, where it is
    borders = list(csv.DictReader((folder / "shifts-borders.csv").open()))
    bounds = [row for row in borders if row["limit"] == "shift: ring2 (greatest)"]
    assert bounds and len(bounds) % 2 == 0
    assert all(abs(float(row["layer2_shift"]) - 2.0) < 1e-5 for row in bounds)
    assert {row["limit"] for row in borders} >= {"fillet_interference: planet1-ring1 (root of planet1)"}
    first = (folder / "shifts.csv").read_bytes()
    subprocess.run(call, capture_output=True, check=True)
    assert (folder / "shifts.csv").read_bytes() == first
    wrong = subprocess.run([*call[:4], "12/39", *call[5:]], capture_output=True, text=True)
    assert wrong.returncode == 2 and "--teeth" in wrong.stderr


def shift_map_of_sets_alike():
    """Of several sets of the same teeth the best is mapped, and the others are told; stages are sets."""
    needs = OUTPUT / "pairs.toml"
    needs.write_text('format = 1\n[gearbox]\nkind = "pair"\nwheel = "any"\n[ratio]\nmin = 2\nmax = 2\n'
                     "[teeth]\npinion_min = 14\npinion_max = 14\nwheel_max = 40\n")
    folder = OUTPUT / "map-pairs"
    call = [PROGRAM, "shifts", needs, "--teeth", "14/28", "-o", folder, "--points", "11"]
    told = subprocess.run(call, capture_output=True, text=True, check=True).stdout
    first, _, others = told.partition("\n")
    assert "as pair, internal wheel" in others and "pair, external wheel: 9" in others, told
    best, other = float(first.split()[1]), float(others.split("external wheel: ")[1].split()[0])
    assert best > other + 0.5, told
    needs.write_text('format = 1\n[gearbox]\nkind = "two-stage"\n[ratio]\nmin = 26\nmax = 26.1\n'
                     "[teeth]\nsun_min = 20\nsun_max = 20\nplanet1_min = 31\nplanet1_max = 31\n"
                     "ring1_min = 82\nring1_max = 82\nplanet2_min = 31\nplanet2_max = 31\n"
                     "ring2_min = 82\nring2_max = 82\n")
    told = subprocess.run([*call[:4], "20/31/82", *call[5:]], capture_output=True, text=True, check=True).stdout
    assert "stage 1 of two-stage, 3 planets" in told and (folder / "shifts.html").read_text().count("<svg") == 1, told


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    needs = OUTPUT / "small.toml"
    needs.write_text(NEEDS)
    whole = OUTPUT / "whole"
    summary = run(needs, "-o", whole, "--threads", 1).stdout
    assert "12  39  90  34  86" in summary, summary
    report = json.loads((whole / "search.json").read_text())
    assert report["complete"] and report["designs"][0]["forward"] > 0.908
    # what the best stands on is named, with what each costs
    binding = report["designs"][0]["binding"]
    assert binding and all(b["key"] is None or b["objective"] >= report["designs"][0]["forward"] for b in binding), binding
    assert all(b["key"] is None or b["key"] in summary for b in binding), summary
    every_limit_is_named(whole, report)
    lost = sum(c["count"] for c in report["rejected"])
    assert lost + report["feasible"] == report["considered"]
    lines = (whole / "search.csv").read_text().splitlines()
    assert len(lines) == report["feasible"] + 1 and lines[1].endswith("design-001.toml")

    # what it writes is a design as it is
    check = subprocess.run([PROGRAM, "check", whole / "design-001.toml", "-q"])
    assert check.returncode == 0

    # two threads, two parts merged: the same bytes
    threads = OUTPUT / "threads"
    threads.mkdir()
    # designs of an earlier search go, what has another name stays
    earlier, own = ("design-099.toml", "design-1000.toml"), ("design-12.toml", "design-mine.toml", "my-design-001.toml", "design-.toml")
    for name in earlier + own:
        (threads / name).touch()
    run(needs, "-o", threads, "--threads", 2, "-q")
    same(whole, threads, RESULTS)
    assert not any((threads / name).exists() for name in earlier) and all((threads / name).exists() for name in own)
    for part in (1, 2):
        run(needs, "-o", OUTPUT / f"part{part}", "--shard", f"{part}/2", "-q")
    merged = OUTPUT / "merged"
    run(needs, "-o", merged, "--merge", OUTPUT / "part1", OUTPUT / "part2", "-q")
    same(whole, merged, RESULTS[:-1])
    lacking = run(needs, "-o", merged, "--merge", OUTPUT / "part1", code=2)
    assert "tooth sets" in lacking.stderr

    # a run that ended has nothing left to do; a journal cut off in the middle of a line: what is lost is computed again
    run(needs, "-o", threads, "--resume", "-q")
    same(whole, threads, RESULTS)
    text = (whole / "search.journal").read_bytes()
    (threads / "search.journal").write_bytes(text[: len(text) // 2])
    run(needs, "-o", threads, "--resume", "-q")
    same(whole, threads, RESULTS)

    # Ctrl-C keeps what was found, and --resume ends as if nothing had happened
    stopped = OUTPUT / "stopped"
    process = subprocess.Popen([PROGRAM, "search", needs, "-o", stopped, "--threads", "1"],
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    for _ in range(500):
        time.sleep(0.01)
        if (stopped / "search.journal").exists():
            break
    time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    message = process.communicate()[1]
    assert process.returncode in (0, 3), process.returncode
    if process.returncode == 3 and "--resume" not in message:
        # caught while the answer is written: the journal is there all the same
        assert "stopped by a signal" in message, message
    elif process.returncode == 3:
        assert not json.loads((stopped / "search.json").read_text())["complete"]
    run(needs, "-o", stopped, "--resume", "-q")
    same(whole, stopped, RESULTS)

    every_kind()
    short_list()
    in_series()
    shift_map()
    shift_map_of_sets_alike()

    # errors
    run(OUTPUT / "none.toml", "-o", whole, code=3)
    run(needs, "-o", whole, "--shard", "3/2", code=2)
    run(needs, "-o", whole, "--shard", "1/2", "--merge", whole, code=2)
    endless = OUTPUT / "endless"
    endless.mkdir()
    (endless / "search.journal").symlink_to("/dev/zero")
    assert "journal" in run(needs, "-o", endless, "--resume", code=2).stderr
    assert "journal" in run(needs, "-o", whole, "--merge", endless, code=2).stderr
    needs.write_text(NEEDS.replace("min = 95", "min = 98"))
    assert "ratio.max" in run(needs, "-o", whole, code=2).stderr
    needs.write_text(NEEDS.replace("results = 1", "results = 1\n[shift]\nmax = 1.5"))
    assert "journal" in run(needs, "-o", whole, "--resume", code=2).stderr


if __name__ == "__main__":
    sys.exit(main())
