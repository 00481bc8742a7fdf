# SPDX-License-Identifier: GPL-3.0-or-later
"""How a blind trial is asked for, run and counted: the words of its command line, its cases through the program two
at a time, what was wrong, and a table. A case has `run(program, folder)`, which returns it, `right` and `line()`."""
import argparse
import collections
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import time


def words(each=2, **more):
    """The command line: PROGRAM FOLDER and the options of every trial; `more`: name=(default, help) of its own."""
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda p: str(pathlib.Path(p).resolve()))
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seed", type=int, default=1)
    if each:
        parser.add_argument("--each", type=int, default=each, help="cases a kind")
        parser.add_argument("--least", type=float, default=0.0, help="the share that must be right; exit 1 below")
    parser.add_argument("--only", default="", help="kinds whose name holds this text")
    parser.add_argument("--list", action="store_true", help="every case, not only the wrong ones")
    parser.add_argument("--one-in", type=int, default=1, help="of the cases, kind after kind, one in so many")
    for name, (default, text) in more.items():
        parser.add_argument(f"--{name}", type=type(default), default=default, help=text)
    return parser.parse_args()


def close_loop(case, program, where, *arguments):
    """`program loop ARGUMENTS -o .` in the folder `where`. Gives the case `seconds`, `answer` (loop.json; None where it was
    refused), `why` (what case.judge() finds wrong with it, or the refusal; empty: nothing) and `right`."""
    start = time.time()
    done = subprocess.run([program, "loop", *arguments, "-o", "."], cwd=where, capture_output=True, text=True, timeout=600)
    case.seconds, case.answer, case.why = time.time() - start, None, f"exit {done.returncode}: {done.stderr[:300]}"
    if done.returncode == 0:
        case.answer = json.loads((where / "loop.json").read_text())
        case.why = case.judge()
    case.right = not case.why
    return case


def run_all(cases, program, folder, tell=lambda case: None):
    """Every case through the program; `tell` hears of each in its order."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for case in pool.map(lambda c: c.run(program, folder), cases):
            tell(case)


def tell_intervals(cases, held_of=lambda case: case.held()):
    """What a trial says last: how many intervals hold, of `held_of(case)`: how many hold, and of how many."""
    held, asked = (sum(figures) for figures in zip(*(held_of(case)[:2] for case in cases)))
    print(f"intervals that hold: {held} of {asked}; {sum(c.seconds for c in cases):.0f} s in the program")


def campaign(cases, o, *, keys, counts=lambda case: (), worth_a_line=lambda case: False, columns="| hidden | right | of |", after=lambda cases: None):
    """All cases with what was wrong, a table of how many are right, and the exit code. `keys`: the rows in which a
    case counts beside "all"; `counts`: figures added to those of its rows, under the further `columns`. `worth_a_line`: right, and yet told."""
    if not cases:
        sys.exit(f"no kind of case has `{o.only}` in its name")
    cases = cases[::o.one_in]
    run_all(cases, o.program, o.folder, lambda c: print(c.line(), flush=True) if o.list or not c.right or worth_a_line(c) else None)
    rows = collections.defaultdict(list)
    for case in cases:
        for key in (*keys(case), "all"):
            rows[key].append((int(case.right), 1, *counts(case)))
    rows["all"] = rows.pop("all", [(0, 0)])
    print(f"\n{columns}\n|{' --- |' * (columns.count('|') - 1)}")
    for name, of_row in rows.items():
        print("| " + " | ".join(map(str, (name, *map(sum, zip(*of_row))))) + " |")
    after(cases)
    right, count = [sum(c) for c in zip(*rows["all"])][:2]
    sys.exit(1 if right < o.least * count else 0)
