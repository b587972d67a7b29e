#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Turns the GLSL of a fragment stage into C++ in double precision, for tests that integrate over what a device draws.

  matc --preprocess FILE.mat | glsl_to_cpp.py --variant KEY > OUT

The result is included into a namespace after tests/shaders/composition/GlslCpp.h: uniforms, inputs and outputs
become variables, main() becomes fragmentMain(), specialisation constants can be set. Supports what the texts of shaders/
use; anything else does not compile.
"""
import argparse
import re
import sys

SWIZZLE = re.compile(r"\.([xyzw]{2,4}|[rgba]{2,4})\b(?!\s*\()")
ASSIGNMENT = re.compile(r"\s*(=(?!=)|[-+*/]=)")
LANES = {letter: index for letters in ("xyzw", "rgba") for index, letter in enumerate(letters)}


def section(text, variant):
    """The fragment stage of a variant in the output of matc --preprocess."""
    mark = f"// ==== variant {variant} fragment\n"
    if mark not in text:
        sys.exit(f"glsl_to_cpp.py: error: there is no variant {variant} in the text")
    return text.split(mark, 1)[1].split("// ==== variant", 1)[0]


def without_layout(text):
    """Removes what C++ lacks: versions, layouts, precisions, comments."""
    text = re.sub(r"//[^\n]*", "", text)
    text = re.sub(r"(?m)^#(version|extension|line)\b.*$", "", text)
    text = re.sub(r"(?m)^\s*precision\s+\w+\s+\w+\s*;", "", text)
    text = re.sub(r"\blayout\s*\([^)]*\)\s*", "", text)
    text = re.sub(r"\b(highp|mediump|lowp|flat|smooth)\s+", "", text)
    text = text.replace("#define VARYING in", "#define VARYING")
    text = re.sub(r"(?m)^(\s*)(in|out)\s+(?=\w+\s+\w+\s*;)", r"\1", text)
    text = re.sub(r"\b(?:uniform|readonly\s+buffer)\s+(\w+)\s*\{", r"struct \1Block {", text)
    text = re.sub(r"\[\s*\]\s*;", "[1];", text)  # the last member of a storage buffer
    text = re.sub(r"\buniform\s+", "", text)
    return re.sub(r"\bconst\s+(\w+\s+(?:quality_|variant_|materialConstants_)\w+\s*=)", r"\1", text)


def with_cpp_types(text):
    text = re.sub(r"\b(?:inout|out)\s+(\w+)\s+(\w+)", r"\1& \2", text)
    text = re.sub(r"([(,]\s*)in\s+(?=\w+\s+\w+)", r"\1", text)
    number = r"(\d+\.\d*(?:[eE][-+]?\d+)?|\.\d+(?:[eE][-+]?\d+)?|\d+[eE][-+]?\d+)"
    text = re.sub(r"(?<![\w.])" + number + r"[fF]\b", r"\1", text)
    text = re.sub(r"\bfloat\b", "double", text)
    text = re.sub(r"\bdiscard\b", "return", text)
    return re.sub(r"\bvoid\s+main\s*\(\s*\)", "void fragmentMain()", text)


def start_of_postfix(text, end):
    """The start of the expression that ends before text[end]: a name with members, indices and calls."""
    at = end
    while at > 0:
        c = text[at - 1]
        if c in ")]":
            depth = 0
            while True:
                at -= 1
                depth += (text[at] in ")]") - (text[at] in "([")
                if depth == 0:
                    break
        elif c.isalnum() or c in "_.":
            at -= 1
        else:
            break
    return at


def with_swizzles(text):
    at = 0
    while match := SWIZZLE.search(text, at):
        begin = start_of_postfix(text, match.start())
        lanes = ", ".join(str(LANES[letter]) for letter in match[1])
        function = "lanesOf" if ASSIGNMENT.match(text, match.end()) else "swizzle"
        replaced = f"{function}<{lanes}>({text[begin:match.start()]})"
        text = text[:begin] + replaced + text[match.end():]
        at = begin + len(function)
    return re.sub(r"\.([rgba])\b(?!\s*\()", lambda m: "." + "xyzw"["rgba".index(m[1])], text)


def with_braces(text):
    """Constructors of structures: Light(a, b) -> Light{ a, b }."""
    for name in re.findall(r"\bstruct\s+(\w+)\s*\{", text):
        at = 0
        pattern = re.compile(r"\b" + name + r"\(")
        while match := pattern.search(text, at):
            depth, end = 1, match.end()
            while depth:
                depth += (text[end] == "(") - (text[end] == ")")
                end += 1
            text = text[:match.end() - 1] + "{" + text[match.end():end - 1] + "}" + text[end:]
            at = match.end()
    return text


def translate(text):
    return with_braces(with_swizzles(with_cpp_types(without_layout(text))))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--variant", type=int, default=0)
    arguments = parser.parse_args()
    sys.stdout.write(translate(section(sys.stdin.read(), arguments.variant)))


if __name__ == "__main__":
    main()
