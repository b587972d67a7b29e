# SPDX-License-Identifier: Apache-2.0
"""scripts/exports finds what public headers declare, and every way in which headers, list and library can differ."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "exports"
HEADER = """
#include <cstdint>
namespace filament_core {
int free(int);
inline int inlined() { return 1; }
constexpr int kConstant = 3;
inline constexpr int kInline = 4;
extern int counter;
template <class T> struct Box { T get() const; T value; };
template <class T> T made();
class Engine {
public:
    Engine();
    Engine(Engine const&) = delete;
    Engine(Engine&&) = default;
    ~Engine();
    static Engine* current();
    int get() const { return 1; }
    explicit operator bool() const;
    friend bool operator==(Engine const&, Engine const&);
    friend bool operator<(Engine const&, Engine const&) { return false; }
    struct Inner { void set(std::uint8_t value); uint8_t value = 0; };
    static int count;
    static constexpr int kLimit = 2;
private:
    void hidden();
};
namespace nested { long deep(Box<int> const&); }
}
namespace other { int foreign(); }
"""
DECLARED = {
    "filament_core::free(int)", "filament_core::counter", "filament_core::Engine::Engine()", "filament_core::Engine::~Engine()",
    "filament_core::Engine::current()", "filament_core::Engine::operator bool() const",
    "filament_core::operator==(filament_core::Engine const&, filament_core::Engine const&)", "filament_core::Engine::Inner::set(unsigned char)",
    "filament_core::Engine::count", "filament_core::Engine::hidden()", "filament_core::nested::deep(filament_core::Box<int> const&)",
}
SOURCE = """
namespace filament_core {
int free(int) { return 0; }
int surplus() { return 0; }
}
"""


class Tree:
    """A folder with public headers; `list` is what its list holds."""

    def __init__(self, folder, header, listed=None):
        self.root = pathlib.Path(folder)
        for name in ("base/include/filament_core", "shaders/package/include/filament_core", "filament_core/include/filament_core"):
            (self.root / name).mkdir(parents=True)
        (self.root / "filament_core/include/filament_core/filament_core.h").write_text(header, encoding="utf-8")
        self.list = self.root / "filament_core/exports.txt"
        if listed is not None:
            self.list.write_text("".join(name + "\n" for name in listed), encoding="utf-8")

    def run(self, *arguments):
        done = subprocess.run([sys.executable, SCRIPT, "--root", self.root, *arguments], capture_output=True, text=True,
                              check=False)
        return done.returncode, done.stdout + done.stderr

    def library(self, source):
        path = self.root / "libtest.so"
        (self.root / "test.cpp").write_text(source, encoding="utf-8")
        subprocess.run(["g++", "-shared", "-fPIC", "-o", path, self.root / "test.cpp"], check=True)
        return path


class Exports(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def test_writes_what_the_headers_declare_without_a_body(self):
        tree = Tree(self.folder, HEADER)
        status, output = tree.run("--write")
        self.assertEqual((status, output), (0, f"exports: {len(DECLARED)} symbols, 0 differences\n"))
        self.assertEqual(tree.list.read_text(encoding="utf-8").splitlines(), sorted(DECLARED))

    def test_a_new_function_and_one_that_is_gone_are_named_with_the_cure(self):
        tree = Tree(self.folder, HEADER, DECLARED - {"filament_core::free(int)"} | {"filament_core::gone()"})
        status, output = tree.run()
        self.assertEqual(status, 1)
        self.assertIn("in the headers, not in filament_core/exports.txt: filament_core::free(int)\n", output)
        self.assertIn("in filament_core/exports.txt, not in the headers: filament_core::gone()\n", output)
        self.assertIn("run scripts/exports --write", output)

    def test_a_library_that_exports_more_or_less_is_named(self):
        tree = Tree(self.folder, "namespace filament_core { int free(int); int missing(); }", ["filament_core::free(int)", "filament_core::missing()"])
        status, output = tree.run("--library", tree.library(SOURCE))
        self.assertEqual(status, 1)
        self.assertIn("in filament_core/exports.txt, not in libtest.so: filament_core::missing()\n", output)
        self.assertIn("in libtest.so, not in filament_core/exports.txt: filament_core::surplus()\n", output)
        self.assertNotIn("free", output)

    def test_headers_that_do_not_compile_are_an_error_with_the_compilers_reason(self):
        status, output = Tree(self.folder, "namespace filament_core { int broken( }").run()
        self.assertEqual(status, 1)
        self.assertIn("exports: error:", output)
        self.assertIn("expected", output)

    def test_headers_without_functions_are_an_error(self):
        status, output = Tree(self.folder, "namespace filament_core { struct Plain { int value; }; }").run()
        self.assertEqual(status, 1)
        self.assertIn("declare no functions", output)


if __name__ == "__main__":
    unittest.main()
