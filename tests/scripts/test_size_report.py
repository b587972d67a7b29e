# SPDX-License-Identifier: Apache-2.0
"""The size report finds every kind of function with its true length, and fails if something is too long without a reason."""
import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "size_report"
loader = importlib.machinery.SourceFileLoader("size_report", str(SCRIPT))
size_report = importlib.util.module_from_spec(importlib.util.spec_from_loader("size_report", loader))
loader.exec_module(size_report)


def names(text):
    return [name for _, _, name in size_report.functions(text)]


def run(files):
    """Exit status and output over a tree of {path: text}."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in files.items():
            path = pathlib.Path(folder, name)
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        done = subprocess.run([sys.executable, SCRIPT, "--root", folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout


def function_of(lines, name="long"):
    return f"void {name}() {{\n" + "    step();\n" * (lines - 2) + "}\n"


class Functions(unittest.TestCase):
    def test_every_kind_is_found_by_its_name(self):
        for text, name in {
                "int f(int a) { return a; }": "f",
                "namespace a::b { namespace { void f() {} } }": "f",
                "class A : public B { int f() const noexcept override { return 1; } };": "f",
                "A::A(int a) : mA{ a }, mB(a), mC{ { a } } { go(); }": "A::A",
                "A::~A() = default;\nA::operator bool() const { return true; }": "A::operator bool",
                "bool operator==(A const& a, A const& b) { return &a == &b; }": "operator==",
                "void A::operator()(int x) { }": "A::operator()",
                "auto f(int a) -> std::vector<int> { return { a }; }": "f",
                "template <class T> requires std::integral<T> T f(T a) { return a; }": "f",
                "void f(std::function<void(A&)> const& change = {}) { }": "f",
                "explicit S(A a = make()) : mA(a) { }": "S",
                "constexpr auto square = [](int a) { return a * a; };": "square",
                "TEST_P(Suite, Holds) { EXPECT_TRUE(true); }": "Suite.Holds",
                "struct S* f() { return nullptr; }": "f",
                "const char* f() { return R\"(} not {)\"; }": "f",
                "char f() { return '{'; } // {": "f",
        }.items():
            with self.subTest(text):
                self.assertEqual(names(text), [name])

    def test_tables_types_and_namespaces_are_no_functions(self):
        for text in ["int a[] = { f(1), g(2) };", "struct A { int a = f(1); B b{ 2 }; };", "enum class E : uint8_t { A, B };",
                     "const std::array<A, static_cast<size_t>(kCount)> kTable{ { { 1 } } };", "namespace a { using B = int; }",
                     "template <class T> concept C = requires(T t) { t.f(); };", "extern \"C\" { int f(int); }"]:
            with self.subTest(text):
                self.assertEqual(names(text), [])

    def test_a_function_counts_from_its_declaration_to_its_last_brace(self):
        text = "int before;\n\n// a comment\nstatic int\nf(int a,\n  int b)\n{\n    return a + b;\n}\n"
        self.assertEqual(size_report.functions(text), [(6, 4, "f")])


class Report(unittest.TestCase):
    def test_what_is_short_is_not_listed(self):
        status, output = run({"a.cpp": function_of(60) + "\n" * 339})
        self.assertEqual(status, 0)
        self.assertIn("0 functions over 60 lines, 0 files over 400; 0 without", output)

    def test_what_is_long_is_listed_and_what_is_too_long_fails(self):
        for files, status, words in [
                ({"a.cpp": function_of(61)}, 0, "61 lines  a.cpp:1: long()"),
                ({"a.h": function_of(80)}, 0, "1 functions over 60 lines"),
                ({"a.glsl": function_of(81)}, 1, "81 lines  a.glsl:1: long()"),
                ({"a.cpp": "\n" * 600}, 0, "600 lines  a.cpp"),
                ({"a.cpp": "\n" * 601}, 1, "601 lines  a.cpp"),
                ({"a.py": "def long():\n" + "    step()\n" * 80}, 1, "81 lines  a.py:1: long()"),
                ({"tool": "#!/usr/bin/env python3\ndef long():\n" + "    step()\n" * 80}, 1, "81 lines  tool:2: long()"),
        ]:
            with self.subTest(words):
                done = run(files)
                self.assertEqual(done[0], status, done[1])
                self.assertIn(words, done[1])

    def test_comments_over_120_columns_fail_wherever_they_begin(self):
        for files, status, words in [
                ({"a.h": "// " + "x" * 117 + "\n"}, 0, "without a reason"),
                ({"a.h": "\n// " + "x" * 118 + "\n"}, 1, "121 columns  a.h:2: wrap the comment at 120"),
                ({"a.cpp": "int a = 1; ///< " + "x" * 120 + "\n"}, 1, "a.cpp:1: wrap"),
                ({"a.inl": "// " + "\u00e9" * 117 + "\n"}, 0, "without a reason"),
                ({"a.cpp": 'auto a = "https://' + "x" * 120 + '";\n'}, 0, "without a reason"),
                ({"a.cpp": "const int a[] = { " + "1, " * 60 + "};\n"}, 0, "without a reason"),
                ({"a.py": "# " + "x" * 140 + "\n"}, 0, "without a reason"),
        ]:
            with self.subTest(files):
                done = run(files)
                self.assertEqual(done[0], status, done[1])
                self.assertIn(words, done[1])

    def test_a_reason_among_the_first_lines_excuses_a_file(self):
        self.assertEqual(run({"a.cpp": "// SPDX\n// Size: one table.\n" + function_of(90)})[0], 0)
        self.assertEqual(run({"a.cpp": "// Size:\n" + function_of(90)})[0], 1)
        self.assertEqual(run({"a.cpp": "\n" * 20 + "// Size: too far down.\n" + function_of(90)})[0], 1)


if __name__ == "__main__":
    unittest.main()
