#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The documents name what exists: a link within the repository leads to a file, an anchor to a heading, and the index
of the decisions has every page once, under its own heading.

Usage: check_documents.py [ROOT]
"""
import re
import sys

from complaints import root_of_sources, told

FENCED = re.compile(r"^(```|~~~).*?^\1", re.M | re.S)
CODE = re.compile(r"`[^`\n]*`")
LINK = re.compile(r"\]\(([^()\s]+)\)")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.M)
LISTED = re.compile(r"^- \[(\d{4})\]\((\S+?)\): (.+)$", re.M)


def anchor_of(heading):
    """As GitHub makes it of a heading's text."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return re.sub(r"[^\w\- ]", "", text).replace(" ", "-")


def anchors(text):
    found = []
    for heading in HEADING.findall(FENCED.sub("", text)):
        anchor = anchor_of(heading)
        found.append(anchor)
        found.append(f"{anchor}-{found.count(anchor) - 1}")  # the same heading again
    return set(found) | set(re.findall(r'(?:id|name)="([^"]+)"', text))


def documents(root):
    return sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))


def links(text):
    return LINK.findall(CODE.sub("", FENCED.sub("", text)))


def check_links(root):
    complaints = []
    for path in documents(root):
        for target in links(path.read_text(encoding="utf-8")):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            leads_to = (path.parent / file) if file else path
            name = path.relative_to(root).as_posix()
            if not leads_to.exists():
                complaints.append(f"{name}: the link {target} leads to no file")
            elif anchor and leads_to.suffix == ".md" and anchor not in anchors(leads_to.read_text(encoding="utf-8")):
                complaints.append(f"{name}: the link {target} leads to no heading")
    return complaints


def check_decisions(root):
    index = root / "docs/decisions/README.md"
    if not index.exists():
        return []
    pages = {page.name: page.read_text(encoding="utf-8").split("\n", 1)[0]
             for page in index.parent.glob("[0-9]*.md")}
    complaints, listed = [], []
    for number, file, title in LISTED.findall(index.read_text(encoding="utf-8")):
        listed.append(file)
        if file in pages and pages[file] != f"# {number}: {title}":
            complaints.append(f"docs/decisions/{file}: its heading is \"{pages[file]}\", the index has \"{number}: {title}\"")
    for page in sorted(pages):
        if listed.count(page) != 1:
            complaints.append(f"docs/decisions/README.md: {page} is listed {listed.count(page)} times")
    return complaints


def check(root):
    return check_links(root) + check_decisions(root)


if __name__ == "__main__":
    sys.exit(told(check(root_of_sources())))
