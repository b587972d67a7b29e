#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compiles the code blocks of docs/, whatever their language.

  check_code.py --compiler c++ --matc build/release/bin/matc [--include DIR ...] [--root DIR] [--work DIR]

  cpp        bodies of functions that know what Context.h declares; lines of #include stay outside. Errors name the document.
  material   compiled by matc, without warnings
  json, sh, python   parsed; tests/python/test_manual.py runs the Python of docs/python.md
  cmake      run, with commands of projects that do nothing
Blocks without a language are output or pseudocode. Those of tutorials are run by test_tutorials.py.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"^```([\w-]*)[^\n]*\n(.*?)^```$", re.DOTALL | re.MULTILINE)
KNOWN = {"", "c", "cpp", "material", "json", "sh", "cmake", "python"}


def blocks(root):
    """(document, line of the first line, language, text) of every code block."""
    for path in sorted((root / "docs").rglob("*.md")):
        text = path.read_text(encoding="utf-8")
        for found in BLOCK.finditer(text):
            yield path.relative_to(root), text.count("\n", 0, found.start()) + 2, found[1], found[2]


def program(examples):
    """One translation unit of all C++ examples."""
    includes, bodies = [], []
    for number, (name, line, text) in enumerate(examples):
        lines = text.split("\n")
        includes += [each for each in lines if each.startswith("#include") and "materials/" not in each]
        body = "\n".join("" if each.startswith("#include") else each for each in lines)
        # right after Engine::create() an engine is a Result, which reads as a pointer
        engine = "Device engine" if re.search(r"\*engine|engine->", body) else "Engine& engine"
        opening = f"[[maybe_unused]] int example{number}({engine}) {{ {{"  # twice: it may declare an engine
        closing = "} return 0; }"
        if re.search(r"^int main\(", body, re.MULTILINE):
            continue  # a whole program, which tests of its own build
        bodies.append(f'{opening}\n#line {line} "{name}"\n{body}\n{closing}')
    begin = '#include "tests/documents/Context.h"\n' + "".join(f"{each}\n" for each in dict.fromkeys(includes))
    return begin + "namespace example {\n" + "\n".join(bodies) + "\n} // namespace example\n"


def run(command, text=None):
    return subprocess.run(command, input=text, capture_output=True, text=True, check=False)


def check_cpp(options, examples, folder):
    file = folder / "examples.cpp"
    file.write_text(program(examples), encoding="utf-8")
    includes = [f"-I{options.root}"] + [f"-I{path}" for path in options.include]
    done = run([options.compiler, "-std=c++20", "-fsyntax-only", "-Wall", "-Wextra", "-Wno-unused", "-Wno-unused-result", "-Werror",
                "-Wno-missing-field-initializers", *includes, str(file)])
    return [done.stderr] if done.returncode else []


def check_c(options, name, line, text, folder):
    """Over the C interface, as the body of a function."""
    lines = text.split("\n")
    includes = "\n".join(each for each in lines if each.startswith("#include"))
    body = "\n".join("" if each.startswith("#include") else each for each in lines)
    file = folder / "example.c"
    file.write_text(f'{includes}\n#include <stdio.h>\nint example(void) {{\n#line {line} "{name}"\n{body}\nreturn 0; }}\n', encoding="utf-8")
    done = run(["cc", "-std=c11", "-fsyntax-only", "-Wall", "-Wextra", "-Wno-unused", "-Werror",
                f"-I{options.root}/c_interface/include", str(file)])
    return [f"{name}:{line}: {done.stderr.strip()}"] if done.returncode else []


def check_material(options, name, line, text, folder):
    file = folder / "example.mat"
    file.write_text(text, encoding="utf-8")
    done = run([options.matc, "-o", str(folder / "example.fmat"), str(file)])
    return [f"{name}:{line}: {done.stderr.strip()}"] if done.returncode or done.stderr else []


def check_json(name, line, text):
    try:
        json.loads(text)
    except ValueError as error:
        return [f"{name}:{line}: {error}"]
    return []


def check_cmake(name, line, text, folder):
    commands = sorted(set(re.findall(r"^\s*(\w+)\(", text, re.MULTILINE)))
    stubs = "".join(f"function({each})\nendfunction()\n" for each in commands)
    (folder / "example.cmake").write_text(stubs + text, encoding="utf-8")
    done = run(["cmake", "-P", str(folder / "example.cmake")])
    return [f"{name}:{line}: {done.stderr.strip()}"] if done.returncode else []


def check_shell(name, line, text):
    done = run(["bash", "-n"], text)
    return [f"{name}:{line}: {done.stderr.strip()}"] if done.returncode else []


def check_python(name, line, text):
    try:
        compile(text, name, "exec")
    except SyntaxError as error:
        return [f"{name}:{line + error.lineno - 1}: {error.msg}"]
    return []


def check(options, folder):
    wrong, cpp, count = [], [], 0
    for name, line, language, text in blocks(options.root):
        count += 1
        if language == "cpp":
            cpp.append((name, line, text))
        elif language == "c":
            wrong += check_c(options, name, line, text, folder)
        elif language == "material":
            wrong += check_material(options, name, line, text, folder)
        elif language == "json":
            wrong += check_json(name, line, text)
        elif language == "cmake":
            wrong += check_cmake(name, line, text, folder)
        elif language == "sh":
            wrong += check_shell(name, line, text)
        elif language == "python":
            wrong += check_python(name, line, text)
        elif language not in KNOWN:
            wrong.append(f"{name}:{line}: nothing checks code of the language '{language}'")
    wrong += check_cpp(options, cpp, folder)
    return wrong, count


def main():
    parser = argparse.ArgumentParser(description="Compiles the code blocks of the documents.")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--matc", default="matc")
    parser.add_argument("--include", action="append", default=[])
    parser.add_argument("--root", type=pathlib.Path, default=pathlib.Path(__file__).resolve().parents[2])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        wrong, count = check(options, pathlib.Path(folder))
    for each in wrong:
        print(each)
    print(f"documents: {count} code blocks, {len(wrong)} wrong")
    sys.exit(1 if wrong or not count else 0)


if __name__ == "__main__":
    main()
