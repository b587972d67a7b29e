#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Finds phrases of scripts/banned_phrases.txt in the prose of the repository: Markdown and the comments of C++, shaders, Python, shell
and CMake, docstrings included. scripts/check_documents.py reports them. Code, identifiers and strings are not looked at."""
import ast
import io
import pathlib
import re
import tokenize

PHRASES = pathlib.Path(__file__).with_name("banned_phrases.txt")
CODE = "\0"  # in place of code: no phrase reaches across it
BRACED = {".cpp", ".h", ".inl", ".inc", ".c", ".glsl", ".mat", ".frag", ".vert", ".js", ".css"}
HASHED = {".cmake", ".sh", ".yml", ".yaml"}
# Inputs of tests, and folders that are still to be rewritten.
EXCEPT = ("tests/fuzz/corpus/",)

TOKENS = re.compile(
    r'R"(?P<end>[^\s()\\]{0,16})\(.*?\)(?P=end)"'  # raw strings
    r'|(?P<comment>//(?:\\\n|[^\n])*|/\*.*?\*/)'
    r'|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'(?=[^\w])', re.DOTALL)


def without(text):
    return re.sub(r"\S+", lambda word: CODE * len(word[0]), text)


def kept(text, spans):
    """The text with everything outside of the spans blanked."""
    parts, at = [], 0
    for begin, end, words in spans:
        parts += [without(text[at:begin]), words]
        at = end
    return "".join(parts) + without(text[at:])


def braced(text):
    """`///<` is kept as `<`: what follows trails a declaration."""
    leader = lambda found: found[0].replace("/", " ").replace("*", " ").replace("!", " ")
    for found in TOKENS.finditer(text):
        if found["comment"]:
            yield *found.span(), re.sub(r"^\s*(?://[/!]?|/?\*+/?)|\*/$", leader, found[0], flags=re.MULTILINE)


def hashed(text):
    for found in re.finditer(r"(?:(?<=\s)|^)#[^\n]*", text, re.MULTILINE):
        yield *found.span(), " " + found[0][1:]


def python(text):
    begins = [0]
    for line in text.splitlines(keepends=True):
        begins.append(begins[-1] + len(line))
    spans = []
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            begin = begins[token.start[0] - 1] + token.start[1]
            spans.append((begin, begin + len(token.string), " " + token.string[1:]))
    lines = [len(line.encode()) - len(line) for line in text.splitlines()]
    for node in ast.walk(ast.parse(text)):
        body = getattr(node, "body", None)
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)) and ast.get_docstring(node, clean=False) is not None:
            at = body[0].value
            begin = begins[at.lineno - 1] + at.col_offset
            end = begins[at.end_lineno] - 1 if at.end_lineno > at.lineno else begin + at.end_col_offset - at.col_offset
            spans.append((begin, end, text[begin:end]))
    return sorted(spans)


def prose(path, text):
    """The text with all but its prose blanked, or None of a file without any; line numbers do not change."""
    if path.suffix == ".md":
        return re.sub(r"^```.*?^```|`[^`\n]*`", lambda found: without(found[0]), text, flags=re.DOTALL | re.MULTILINE)
    suffix = path.with_suffix("").suffix if path.suffix == ".in" else path.suffix
    if suffix in BRACED:
        return kept(text, braced(text))
    if suffix in {".py", ".pyi"} or re.match(r"#!.*python", text):
        return kept(text, python(text))
    if suffix in HASHED or path.name == "CMakeLists.txt" or text.startswith("#!"):
        return kept(text, hashed(text))
    return None


def fixed_part(phrase):
    """The longest text that is part of whatever the phrase matches: a search for it is fast."""
    count = 1
    while count:
        phrase, count = re.subn(r"\([^()]*\)\??", "|", phrase)
    return max((part.strip() for part in re.split(r"[^a-z< ]+", re.sub(r".\?", "|", phrase))), key=len)


def phrases():
    """(fixed part, pattern, what to write instead) of each line of the list."""
    for line in PHRASES.read_text(encoding="utf-8").splitlines():
        if line and not line.startswith("#"):
            phrase, instead = line.split(" | ")
            pattern = r"(?<!\w)(?:" + phrase.strip().replace(" ", r"\s+") + r")(?!\w)"
            yield fixed_part(phrase), re.compile(pattern, re.IGNORECASE), instead


def check(root, files):
    """One line for each banned phrase in the files."""
    banned = list(phrases())
    for file in files:
        name = file.relative_to(root).as_posix()
        if name.startswith(EXCEPT):
            continue
        try:
            text = prose(file, file.read_text(encoding="utf-8"))
        except (UnicodeDecodeError, SyntaxError):
            continue
        plain = " ".join((text or "").lower().split())
        for part, pattern, instead in banned:
            for found in pattern.finditer(text) if part in plain else ():
                words = " ".join(found[0].split())
                yield f"{name}:{text.count(chr(10), 0, found.start()) + 1}: '{words}': write {instead}"
