# SPDX-License-Identifier: GPL-3.0-or-later
"""A locale that is as unlike C as those of Europe together: numbers are "1.234,5", letters are single bytes beyond
ASCII, of which UTF-8 text has halves, and as in Turkey no 'i' belongs to 'I'. Made here, so that none need be installed.
"""
import subprocess

NAME = "foreign_XX"
# capital and small letters of ISO 8859-9, Turkish: I with 0xFD, 0xDD with i
CAPITALS = [c for c in [*range(0x41, 0x5B), *range(0xC0, 0xDF)] if c != 0xD7]
PAIRS = [(c, {0x49: 0xFD, 0xDD: 0x69}.get(c, c + 0x20)) for c in CAPITALS]


def letter(code):
    return f"<U{code:04X}>"


def make(folder):
    """Makes the locale in the folder, to be named in LOCPATH."""
    charmap = "<code_set_name> ISO-8859-9\n<mb_cur_min> 1\n<mb_cur_max> 1\n<escape_char> /\n<comment_char> %\nCHARMAP\n"
    charmap += "".join(f"{letter(c)} /x{c:02x}\n" for c in range(256)) + "END CHARMAP\n"
    (folder / "one_byte").write_text(charmap)
    (folder / "foreign.def").write_text(
        "comment_char %\nescape_char /\nLC_CTYPE\n" +
        "upper " + ";".join(letter(c) for c, _ in PAIRS) + "\n" +
        "lower " + ";".join(letter(s) for _, s in PAIRS) + "\n" +
        "space " + ";".join(letter(c) for c in (0x20, 0x09, 0x0A, 0x0B, 0x0C, 0x0D)) + "\n" +
        "toupper " + ";".join(f"({letter(s)},{letter(c)})" for c, s in PAIRS) + "\n" +
        "tolower " + ";".join(f"({letter(c)},{letter(s)})" for c, s in PAIRS) + "\n" +
        'END LC_CTYPE\nLC_NUMERIC\ndecimal_point ","\nthousands_sep "."\ngrouping 3;3\nEND LC_NUMERIC\n')
    subprocess.run(["localedef", "--no-archive", "-c", "-f", "./one_byte", "-i", "./foreign.def", f"./{NAME}"],
                   cwd=folder, capture_output=True)  # it ends with 1: there are categories that this locale lacks
    assert (folder / NAME / "LC_NUMERIC").exists() and (folder / NAME / "LC_CTYPE").exists(), "localedef made no locale"
