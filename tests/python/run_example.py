# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an example as it stands, in a folder of its own; it must end with 0 and say something."""
import os
import pathlib
import subprocess
import sys

script = pathlib.Path(os.environ["TRUEFLANK_SOURCE_DIR"]) / "examples/python" / f"{sys.argv[1]}.py"
done = subprocess.run([sys.executable, "-B", script], cwd=os.environ["TRUEFLANK_TEST_OUTPUT"],
                      capture_output=True, text=True, timeout=120)
print(done.stdout, done.stderr)
if done.returncode or not done.stdout.strip():
    sys.exit(f"{script.name} ended with {done.returncode}")
