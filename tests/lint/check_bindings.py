#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""No lambda takes a structured binding from around it: clang 14 refuses what g++ 12 compiles.

It is read as text: a name bound by `auto [a, b]` that is used in a lambda of its scope, unless the lambda has a name of
its own for it.

Usage: check_bindings.py [ROOT]
"""
import re
import sys

from complaints import root_of_sources, told

BLANKED = re.compile(r"//[^\n]*|/\*.*?\*/|\"(?:[^\"\\\n]|\\.)*\"|'(?:[^'\\\n]|\\.)'", re.DOTALL)
BINDING = re.compile(r"\bauto\s*&{0,2}\s*\[([\w\s,]+)\]")
LAMBDA = re.compile(r"(?:(?<![\w\])\s])|\breturn)\s*\[([^\[\]]*)\]\s*(\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\))?[^{};()]*\{")
CLOSES = {"{": "}", "(": ")"}


def end_of(text, at):
    """Behind the bracket that closes the one at a place."""
    opens, closes, depth = text[at], CLOSES[text[at]], 0
    for i in range(at, len(text)):
        depth += (text[i] == opens) - (text[i] == closes)
        if depth == 0:
            return i + 1
    return len(text)


def end_of_scope(text, at):
    """Of a name that is declared at a place: of its block, or of the statement of its loop or condition."""
    depth = 0
    for i in range(at, len(text)):
        if text[i] in "({":
            depth += 1
        elif text[i] in ")}":
            depth -= 1
        if depth < 0:
            if text[i] == "}":
                return i
            rest = i + 1 + len(text[i + 1:]) - len(text[i + 1:].lstrip())
            if text[rest:rest + 1] == "{":
                return end_of(text, rest)
            while rest < len(text) and text[rest] != ";":  # (a statement of its own: to its end)
                rest = end_of(text, rest) if text[rest] in CLOSES else rest + 1
            return rest
    return len(text)


def check(root):
    complaints = []
    for path in sorted(p for folder in root.iterdir() if folder.is_dir() and not folder.name.startswith((".", "build"))
                       for ending in ("*.h", "*.cpp") for p in folder.rglob(ending)):
        text = BLANKED.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), path.read_text(encoding="utf-8"))
        for binding in BINDING.finditer(text):
            scope = text[binding.end():end_of_scope(text, binding.end())]
            for taking in LAMBDA.finditer(scope):
                body = scope[taking.end():end_of(scope, taking.end() - 1)]
                for name in re.findall(r"\w+", binding[1]):
                    own = re.search(rf"\b{name}\b", taking[2] or "") or re.search(rf"\b{name}\s*=[^=]", taking[1]) or \
                        re.search(rf"\[[\w\s,]*\b{name}\b[\w\s,]*\]\s*[=:]|[\w>][&*]*\s[&*]*{name}\s*(?:=[^=]|\{{|:[^:])", body)
                    if not own and re.search(rf"(?<![\w.>:])(?<!\. ){name}\b(?!\s*(?:\(|::))", body):
                        line = text.count("\n", 0, binding.end() + taking.start(1)) + 1
                        complaints.append(f"{path.relative_to(root).as_posix()}:{line}: a lambda takes the structured binding {name}")
    return complaints


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
