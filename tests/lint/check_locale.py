#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""No library asks for a function whose answer hangs on the locale of its host program.

Looks at what the compiled libraries ask of others, so that std::to_string() of a real number is found, which asks
for vsnprintf(). Numbers: base/number_text.h; letters: base/ascii_letters.h. nlohmann/json asks for localeconv(),
snprintf() and strtod() itself and undoes what they do.

Usage: check_locale.py LIBRARY.a...
"""
import re
import subprocess
import sys

from complaints import told

ASKS = re.compile(r"^(\S+):\s+U (?:_*)(vsn?printf(?:_chk)?|to(?:lower|upper)|"
                  r"is(?:alnum|alpha|blank|cntrl|digit|graph|lower|print|punct|space|upper|xdigit)|ato[fil]|strtof|strtold|"
                  r"(?:isoc\d+_)?v?sscanf|setlocale|strcoll|strftime)$")


def check(listed):
    """Complaints about what `nm -u -A` lists."""
    asked = filter(None, map(ASKS.match, listed.split("\n")))
    return [f"{match.group(1)} asks for {match.group(2)}(), which hangs on the locale" for match in asked]


def main():
    found = []
    for library in sys.argv[1:]:
        found += check(subprocess.run(["nm", "-u", "-A", library], capture_output=True, text=True, check=True).stdout)
    return told(found) or len(sys.argv) < 2


if __name__ == "__main__":
    sys.exit(main())
