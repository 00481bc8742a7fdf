# SPDX-License-Identifier: GPL-3.0-or-later
"""The man page and the completion for bash: what they say is what the program has."""
import os
import re
import subprocess
import unittest

PROGRAM = os.environ["TRUEFLANK_PROGRAM"]
SHELL = os.path.join(os.environ["TRUEFLANK_SOURCE_DIR"], "app", "shell")


def completed(*words):
    line = " ".join(f"'{w}'" for w in words)
    script = f"""source {SHELL}/trueflank.bash
COMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _trueflank; printf '%s\\n' "${{COMPREPLY[@]}}" """
    return subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout.split()


def help_of(*command):
    return subprocess.run([PROGRAM, *command, "--help"], capture_output=True, text=True, check=True).stdout


class ShellFiles(unittest.TestCase):
    def test_every_command_and_option_of_the_program_is_completed(self):
        commands = re.findall(r"^  (\w+) {2,}", help_of().split("Subcommands:")[1], re.M)
        self.assertIn("make", commands)
        for command in commands:
            self.assertIn(command, completed("trueflank", ""))
            for option in re.findall(r"(--[a-z][a-z-]+)", help_of(command)):
                if not option.startswith("--help"):
                    self.assertIn(option, completed("trueflank", command, "--"), command)

    def test_lists_of_formats_go_on_after_a_comma(self):
        self.assertEqual(completed("trueflank", "make", "--formats", "stl,3"), ["stl,3mf"])
        self.assertEqual(completed("trueflank", "new", "x", "--kind", "si"), ["simple"])

    def test_every_list_of_formats_is_the_programs(self):
        text = re.sub(r"\s+", "", help_of("make"))
        formats = re.search(r"comma-separated:([\w,]+)", text)[1].split(",")
        self.assertIn("step", formats)
        self.assertEqual(completed("trueflank", "make", "--formats", ""), formats)
        source = os.environ["TRUEFLANK_SOURCE_DIR"]
        with open(os.path.join(SHELL, "trueflank.1"), encoding="utf-8") as file:
            self.assertIn("Formats: " + ", ".join(formats), file.read())
        with open(os.path.join(source, "docs", "formats.md"), encoding="utf-8") as file:
            page = file.read()
        for name in formats:
            self.assertRegex(page, rf"(?m)^\| `?\.?{name}\b", name)

    def test_the_man_page_names_every_command(self):
        with open(os.path.join(SHELL, "trueflank.1"), encoding="utf-8") as file:
            page = file.read()
        for command in re.findall(r"^  (\w+) {2,}", help_of().split("Subcommands:")[1], re.M):
            self.assertIn(f".B trueflank {command}", page)


if __name__ == "__main__":
    unittest.main(verbosity=2)
