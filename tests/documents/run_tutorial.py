#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Follows a tutorial literally, as its reader would, and compares its images.

  run_tutorial.py DOCUMENT.md --bin DIR [--prefix DIR] [--work DIR] [--store]

In the order of the document, in an empty folder:
  - a code block after a paragraph that names a file, "Save this as `stone.mat`:", becomes that file: the last `name` of the
    paragraph;
  - a block of `sh` is run by bash, which stops at the first command that fails; --bin comes first in its PATH, and PREFIX is
    the installed package;
  - an image below a comment <!-- shows: out/gles.png --> must be that file, bit for bit. --store stores it instead.
Every other block is an error: nothing in a tutorial is untested.
"""
import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

STEP = re.compile(r"^```([\w-]*)\n(?P<code>.*?)^```$|^<!-- shows: (?P<file>\S+) -->\n!\[[^\]]*\]\((?P<picture>[^)]+)\)",
                  re.DOTALL | re.MULTILINE)


class Failed(Exception):
    pass


def file_name(before):
    """The file that the paragraph above a block names."""
    paragraph = before.rstrip().rsplit("\n\n", 1)[-1]
    names = re.findall(r"`([\w./-]+\.\w+)`", paragraph)
    return names[-1] if names else None


def save(work, name, code):
    path = work / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(code, encoding="utf-8")


def run(work, options, code):
    path = os.pathsep.join([str(options.bin.resolve()), os.environ.get("PATH", "")])
    environment = os.environ | {"PATH": path, "PREFIX": str(options.prefix.resolve()) if options.prefix else ""}
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", code], cwd=work, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        raise Failed(f"'{code.strip()}' ended with {done.returncode}:\n{done.stdout}")


def compare(work, options, found):
    drawn, stored = work / found["file"], options.document.parent / found["picture"]
    if not drawn.exists():
        raise Failed(f"no command has made {found['file']}")
    if options.store:
        shutil.copyfile(drawn, stored)
        return
    done = subprocess.run([options.bin / "imgdiff", stored, drawn], capture_output=True, text=True, check=False)
    if done.returncode:
        raise Failed(f"{found['file']} is not {found['picture']}: {done.stdout}{done.stderr}")


def follow(options, work):
    """The number of steps."""
    text = options.document.read_text(encoding="utf-8")
    steps = list(STEP.finditer(text))
    for found in steps:
        line = text.count("\n", 0, found.start()) + 1
        try:
            if found["file"]:
                compare(work, options, found)
            elif found[1] == "sh":
                run(work, options, found["code"])
            elif name := file_name(text[:found.start()]):
                save(work, name, found["code"])
            else:
                raise Failed("this block is neither a command nor a file: name the file in the paragraph above")
        except (Failed, OSError) as error:
            sys.exit(f"{options.document}:{line}: {error}")
    return len(steps)


def main():
    parser = argparse.ArgumentParser(description="Follows a tutorial.")
    parser.add_argument("document", type=pathlib.Path)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--prefix", type=pathlib.Path)
    parser.add_argument("--store", action="store_true")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        count = follow(options, pathlib.Path(folder))
    print(f"{options.document.name}: {count} steps")
    sys.exit(0 if count else 1)


if __name__ == "__main__":
    main()
