#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads a design, checks it, and says what fails or warns. Usage: check_gearbox.py [DESIGN]"""
import pathlib
import sys

import trueflank

EXAMPLES = pathlib.Path(__file__).parent.parent
path = sys.argv[1] if len(sys.argv) > 1 else EXAMPLES / "bilateral_drive/design.toml"
try:
    gearbox = trueflank.read(path)
except trueflank.TrueflankError as error:
    sys.exit(str(error))  # every mistake with file, line, value and cure

report = gearbox.report()
for check in report["checks"]:
    if check["status"] in ("warn", "fail"):
        print(f"{check['status']} {check['id']} at {check['where']}: {check['message']}")
print(f"ratio {report['train']['ratio']:.4f}, efficiency {report['efficiency']['forward']:.2%} forward, "
      f"{report['efficiency']['backward']:.2%} backward")
for friction in (0.05, 0.1, 0.15):
    print(f"  friction {friction}: {gearbox.efficiency(friction=friction)['forward']:.2%} forward")
sys.exit(report["verdict"] == "fail")
