#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Doxygen's input filter: the charter at the top of a header becomes the description of that file, and its entries
(Thread, Memory, Fails, ...) become titled paragraphs.

  doxygen_filter.py HEADER      prints the header; other files are printed as they are
"""
import pathlib
import re
import sys

ENTRY = re.compile(r"^/// {2,4}([A-Z][a-z]+) {1,}(\S.*)$")


def described(name, text):
    """The header with its charter as Doxygen reads it."""
    lines = text.split("\n")
    begin = next((i for i, line in enumerate(lines) if line.startswith("///")), None)
    guard = next((i for i, line in enumerate(lines) if line.startswith("#pragma once")), None)
    if begin is None or guard is None or begin > guard:
        return text
    charter = [rf"/// \file {name}"]
    for line in lines[begin:guard]:
        entry = ENTRY.match(line)
        charter += [rf"/// \par {entry[1]}:", f"/// {entry[2]}"] if entry else [line]
    return "\n".join(lines[:begin] + charter + lines[guard:])


def main():
    path = pathlib.Path(sys.argv[1])
    text = path.read_text(encoding="utf-8")
    sys.stdout.write(described(path.name, text) if path.suffix == ".h" else text)


if __name__ == "__main__":
    main()
