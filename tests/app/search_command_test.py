# SPDX-License-Identifier: GPL-3.0-or-later
"""The search command: equal answers however it is run, files that `check` takes, errors by code."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
OUTPUT = pathlib.Path(os.environ["TRUEFLANK_TEST_OUTPUT"]) / "search"
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
results = 3
"""
RESULTS = ["design-001.toml", "search.csv", "search.json", "search.svg", "search.html", "search.journal"]


def run(*arguments, code=0):
    done = subprocess.run([PROGRAM, "search", *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def same(one, other, names):
    for name in names:
        assert (one / name).read_bytes() == (other / name).read_bytes(), name


def main():
    shutil.rmtree(OUTPUT, ignore_errors=True)
    OUTPUT.mkdir(parents=True)
    needs = OUTPUT / "small.toml"
    needs.write_text(NEEDS)
    whole = OUTPUT / "whole"
    summary = run(needs, "-o", whole, "--threads", 1).stdout
    assert "12  39  90  32  81" in summary, summary
    report = json.loads((whole / "search.json").read_text())
    assert report["complete"] and report["designs"][0]["forward"] > 0.908
    lost = sum(c["count"] for c in report["rejected"])
    assert lost + report["feasible"] == report["considered"]
    lines = (whole / "search.csv").read_text().splitlines()
    assert len(lines) == report["feasible"] + 1 and lines[1].endswith("design-001.toml")

    # what it writes is a design as it is
    check = subprocess.run([PROGRAM, "check", whole / "design-001.toml", "-q"])
    assert check.returncode == 0

    # two threads, a second run over the first, two parts merged: the same bytes
    threads = OUTPUT / "threads"
    run(needs, "-o", threads, "--threads", 2, "-q")
    same(whole, threads, RESULTS)
    run(needs, "-o", threads, "--resume", "-q")
    same(whole, threads, RESULTS)
    for part in (1, 2):
        run(needs, "-o", OUTPUT / f"part{part}", "--shard", f"{part}/2", "-q")
    merged = OUTPUT / "merged"
    run(needs, "-o", merged, "--merge", OUTPUT / "part1", OUTPUT / "part2", "-q")
    same(whole, merged, RESULTS[:-1])
    lacking = run(needs, "-o", merged, "--merge", OUTPUT / "part1", code=2)
    assert "tooth sets" in lacking.stderr

    # a journal cut off in the middle of a line: what is lost is computed again
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

    # errors
    run(OUTPUT / "none.toml", "-o", whole, code=3)
    run(needs, "-o", whole, "--shard", "3/2", code=2)
    run(needs, "-o", whole, "--shard", "1/2", "--merge", whole, code=2)
    needs.write_text(NEEDS.replace("min = 95", "min = 98"))
    assert "ratio.max" in run(needs, "-o", whole, code=2).stderr
    needs.write_text(NEEDS.replace("results = 3", "results = 3\n[shift]\nmax = 1.5"))
    assert "journal" in run(needs, "-o", whole, "--resume", code=2).stderr


if __name__ == "__main__":
    sys.exit(main())
