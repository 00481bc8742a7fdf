# SPDX-License-Identifier: GPL-3.0-or-later
"""What many shards, threads and ranks of `trueflank search` cost, and whether they give the same bytes.

Of one search (suns of 12, ratios of 95 to 96; all sets optimised with --all) this measures
- the journal, in bytes a line;
- SHARDS shards (64) merged against one run: files to the byte, processor time of each shard;
- one and two threads, and MPI ranks (where mpirun and trueflank-search-mpi are): processor time of all, of each rank;
and, of a far wider file, the peak of memory while so many sets are looked at until it is stopped after some seconds.

Times are of the processor (user and system), so that a loaded machine does not change them much; the load is printed.
Usage: search_scale.py TRUEFLANK [--shards 64] [--all] [--ranks 1,2,4] [--mpi PROGRAM] [--seconds 20]
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

NEEDS = """format = 1
name = "scale"
[gearbox]
kind = "3k"
[ratio]
min = 95
max = 96
[teeth]
sun_min = 12
sun_max = 12
[search]
results = 3
listed = {listed}
"""
WIDE = """format = 1
name = "wide"
[gearbox]
kind = "3k"
output = "any"
planets = "3, 4"
[ratio]
min = 10
max = {most}
[teeth]
sun_max = 60
planet1_max = 80
planet2_max = 80
ring1_max = 160
ring2_max = 160
[search]
results = 1
listed = 1
"""
SAME = ("design-001.toml", "design-002.toml", "design-003.toml", "search.csv", "search.svg", "search.html")


def measured(command, stop_after=None):
    """Exit code, processor seconds and peak memory [MB] of a program, asked to stop after some seconds of the clock."""
    child = subprocess.Popen([str(c) for c in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    if stop_after:
        time.sleep(stop_after)
        child.send_signal(signal.SIGINT)
    child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def journal(folder):
    """Lines of sets and bytes of the journals of a folder."""
    texts = [path.read_text() for path in pathlib.Path(folder).glob("search*.journal")]
    lines = [l for t in texts for l in t.splitlines() if l[0].isdigit()]
    return len(lines), sum(len(l) + 1 for l in lines)


def told(words, seconds, memory, folder=None):
    count, size = journal(folder) if folder else (0, 0)
    each = f", {count} sets optimised, {size / count:.0f} bytes of journal each" if count else ""
    print(f"{words:30s} {seconds:8.2f} s, {memory:6.1f} MB{each}", flush=True)


def shards(program, needs, work, count, whole):
    times, memory = [], 0.0
    for k in range(1, count + 1):
        code, seconds, peak = measured([program, "search", needs, "-o", work / f"s{k}", "-q", "--threads", 1,
                                        "--shard", f"{k}/{count}"])
        assert code == 0, (k, code)
        times.append(seconds)
        memory = max(memory, peak)
    optimised = sum(journal(work / f"s{k}")[0] for k in range(1, count + 1))
    size = sum(journal(work / f"s{k}")[1] for k in range(1, count + 1))
    print(f"{count} shards: {sum(times):.2f} s in all, {min(times):.2f} to {max(times):.2f} s each, at most {memory:.1f} MB, "
          f"{optimised} sets optimised, {size} bytes of journals")
    code, seconds, peak = measured([program, "search", needs, "-o", work / "merged", "-q", "--merge",
                                    *(work / f"s{k}" for k in range(1, count + 1))])
    told("merged", seconds, peak)
    differ = [n for n in SAME if (whole / n).exists() and (whole / n).read_bytes() != (work / "merged" / n).read_bytes()]
    print("merged against one run: " + ("the same bytes" if not differ else "DIFFERENT: " + ", ".join(differ)))
    return not differ


def ranks(launcher, mpi, needs, work, counts):
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")
    for count in counts:
        folder = work / f"ranks{count}"
        timer = 'TIMEFORMAT="rank %U %S"; time "$0" "$@"'
        done = subprocess.run([launcher, "-n", str(count), "bash", "-c", timer, mpi, needs, "-o", folder, "-q"],
                              env=environment, capture_output=True, text=True)
        each = [float(u) + float(s) for u, s in re.findall(r"rank ([0-9.]+) ([0-9.]+)", done.stderr)]
        same = all((folder / n).read_bytes() == (work / "one" / n).read_bytes() for n in SAME if (work / "one" / n).exists())
        sets = [journal_of.read_text().count("\n") - 2 for journal_of in sorted(folder.glob("search*.journal"))]
        print(f"{count} ranks: {sum(each):.2f} s in all ({', '.join(f'{t:.2f}' for t in each)}), sets optimised {sets}, "
              + ("the same bytes" if done.returncode == 0 and same else f"DIFFERENT or failed ({done.returncode})"), flush=True)


def memory(program, work, seconds):
    for most in (15, 60, 500):
        needs = work / f"wide{most}.toml"
        needs.write_text(WIDE.format(most=most))
        code, spent, peak = measured([program, "search", needs, "-o", work / f"wide{most}", "--threads", 1], seconds)
        report = work / f"wide{most}" / "search.json"
        sets = json.loads(report.read_text())["to_optimise"] if report.exists() else "?"
        print(f"ratios of 10 to {most}: {sets} sets, stopped after {seconds:g} s (exit code {code}): {spent:.2f} s, "
              f"{peak:.1f} MB", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("trueflank", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--shards", type=int, default=64)
    parser.add_argument("--all", action="store_true", help="every set is optimised (listed = 0), no bound")
    parser.add_argument("--listed", type=int, default=20)
    parser.add_argument("--ranks", default="1,2,4")
    parser.add_argument("--mpi", type=pathlib.Path, help="trueflank-search-mpi; beside TRUEFLANK unless given")
    parser.add_argument("--seconds", type=float, default=20.0, help="of each look at memory; 0: none")
    args = parser.parse_args()
    print(f"load {os.getloadavg()[0]:.1f}, {os.cpu_count()} processors")
    good = True
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        needs = work / "needs.toml"
        needs.write_text(NEEDS.format(listed=0 if args.all else args.listed))
        for threads, name in ((1, "one"), (2, "two")):
            code, seconds, peak = measured([args.trueflank, "search", needs, "-o", work / name, "-q", "--threads", threads])
            assert code == 0, code
            told(f"{name} thread{'s' if threads > 1 else ''}", seconds, peak, work / name)
        report = json.loads((work / "one" / "search.json").read_text())
        print(f"{report['considered']} considered, {report['to_optimise']} sets, {report['optimised']} optimised, "
              f"{report['feasible']} with shifts")
        if args.shards:
            good = shards(args.trueflank, needs, work, args.shards, work / "one")
        launcher, mpi = shutil.which("mpirun"), args.mpi or args.trueflank.parent / "trueflank-search-mpi"
        if args.ranks and launcher and mpi.exists():
            ranks(launcher, str(mpi), needs, work, [int(n) for n in args.ranks.split(",")])
        elif args.ranks:
            print("no ranks: mpirun or trueflank-search-mpi is not here")
        if args.seconds > 0:
            memory(args.trueflank, work, args.seconds)
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
