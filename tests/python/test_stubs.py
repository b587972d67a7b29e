# SPDX-License-Identifier: Apache-2.0
"""Everything public is in the type stubs with the same parameters, has a text for help(), and is in docs/python.md."""
import ast
import inspect
import pathlib
import re

from support import ROOT, fc, unittest

SPECIAL = {"__init__", "__enter__", "__exit__", "__copy__", "__getitem__", "__setitem__"}


def public_members(kind):
    return {name for name in vars(kind) if not name.startswith("_") or name in SPECIAL}


def stubs():
    """The module's classes, each with its members, and its functions; by name."""
    tree = ast.parse((pathlib.Path(fc.__file__).parent / "_core.pyi").read_text(encoding="utf-8"))
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    return classes, functions


def members_of(node):
    names = {}
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            names[item.name] = item
        elif isinstance(item, ast.AnnAssign):
            names[item.target.id] = item
    return names


def parameters_of(node):
    arguments = node.args
    return [argument.arg for argument in arguments.args], [argument.arg for argument in arguments.kwonlyargs]


def declared_parameters(function):
    """Names from the signature that pybind11 writes into the documentation: all, and those behind the star."""
    line = function.__doc__.splitlines()[0]
    words = line[line.index("(") + 1:line.rindex(")")]
    words = re.sub(r"\[[^\]]*\]|\([^)]*\)", "", words)
    names = [word.split(":")[0].split("=")[0].strip() for word in words.split(",")]
    names = [name for name in names if name]
    if "*" not in names:
        return names, []
    star = names.index("*")
    return names[:star], names[star + 1:]


class Stubs(unittest.TestCase):
    def test_have_what_the_module_has(self):
        classes, functions = stubs()
        core = {name: value for name, value in vars(fc._core).items() if not name.startswith("_")}
        self.assertEqual(set(classes) | set(functions), set(core))
        self.assertEqual(set(fc.__all__) - {"__version__", "reports"}, set(core))
        for name, node in classes.items():
            expected = public_members(core[name])
            if issubclass(core[name], fc.Error):
                continue
            if "__init__" not in members_of(node):
                expected -= {"__init__"}  # pybind11 gives every class one, which refuses
            self.assertEqual(set(members_of(node)), expected, name)

    def test_have_its_parameters(self):
        classes, functions = stubs()
        for name, node in functions.items():
            self.assertEqual(parameters_of(node), declared_parameters(getattr(fc, name)), name)
        for kind, node in classes.items():
            for name, item in members_of(node).items():
                member = vars(getattr(fc, kind)).get(name)
                member = member.__func__ if isinstance(member, staticmethod) else member
                if isinstance(item, ast.FunctionDef) and name not in SPECIAL - {"__init__"} and callable(member):
                    self.assertEqual(parameters_of(item), declared_parameters(member), f"{kind}.{name}")


class Documentation(unittest.TestCase):
    def everything(self):
        for name in fc.__all__:
            value = getattr(fc, name)
            if name == "__version__" or inspect.ismodule(value):
                continue
            yield name, value
            if inspect.isclass(value) and not issubclass(value, Exception):
                for member in public_members(value) - SPECIAL:
                    yield f"{name}.{member}", inspect.getattr_static(value, member)

    def test_says_what_everything_is(self):
        for name, value in self.everything():
            text = inspect.getdoc(value) or ""
            text = "\n".join(line for line in text.splitlines() if "->" not in line).strip()
            self.assertGreater(len(text), 12, f"{name} has no documentation")
        for name in fc.reports.__all__:
            self.assertTrue(inspect.getdoc(getattr(fc.reports, name)), name)

    def test_of_the_manual_names_everything(self):
        manual = (ROOT / "docs/python.md").read_text(encoding="utf-8")
        words = set(re.findall(r"\w+", manual))
        for name, _ in self.everything():
            self.assertIn(name.split(".")[-1], words, f"docs/python.md does not name {name}")
        for name in fc.reports.__all__:
            self.assertIn(name, words)

    def test_has_the_options_of_the_command_line(self):
        options = fc.options()
        view = fc.View()
        self.assertEqual(set(view.options()), set(options))
        for name, text in options.items():
            self.assertTrue(text, name)
            view[name] = view[name]
        self.assertEqual(view.options(), fc.View().options())
        for name in ("ambientOcclusion", "shadows", "fog.density", "bloom", "antiAliasing", "agxLook", "toneMapper", "debugView", "samples"):
            self.assertIn(name, options)

    def test_has_the_version_of_the_library(self):
        self.assertRegex(fc.__version__, r"^\d+\.\d+\.\d+$")


if __name__ == "__main__":
    unittest.main()
