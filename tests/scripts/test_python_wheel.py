#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The wheel, installed in a fresh virtual environment: its libraries are its own, a notebook draws with it, and the type
stubs satisfy mypy --strict. Exit status 77: patchelf, venv or mypy are not installed (scripts/setup --check)."""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

MISTAKE = """
import filament_core as fc
engine: fc.Engine = fc.Engine(7)
"""


def run(*words, **options):
    return subprocess.run([str(word) for word in words], check=True, capture_output=True, text=True, **options).stdout


def check_libraries(site):
    """None of those that the module needs comes from the folder of the system's, except for what every system has."""
    module = next((site / "filament_core").glob("_core*.so"))
    copied = {file.name for file in (site / "filament_core.libs").iterdir()}
    assert len(copied) > 8, copied
    for line in run("ldd", module).splitlines():
        name, arrow, file = line.strip().partition(" => ")
        assert "not found" not in line, line
        assert name in copied or not name.startswith(("libfmt", "libpng", "libdraco", "libavif", "libzstd")), line
        if name in copied:
            assert str(site) in file, line
    assert len(list(site.glob("filament_core-*.dist-info/licenses/*.txt"))) > 5


def check_notebook(python, root, folder):
    notebook = json.loads((root / "samples/notebook/first_picture.ipynb").read_text())
    assert notebook["nbformat"] == 4
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    run(python, "-c", "\n".join(cells), cwd=folder)
    assert (folder / "notebook.png").is_file()


def check_types(root, folder):
    mypy = ["/usr/bin/mypy" if os.access("/usr/bin/mypy", os.X_OK) else "mypy", "--cache-dir", folder / "mypy"]
    run(*mypy, "--strict", "filament_core", cwd=root / "python")
    (folder / "mistake.py").write_text(MISTAKE)
    found = subprocess.run([*map(str, mypy), "mistake.py"], cwd=folder, capture_output=True, text=True,
                           env={**os.environ, "MYPYPATH": str(root / "python")})
    assert found.returncode == 1 and 'expected "str"' in found.stdout, found


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--root", type=pathlib.Path, required=True)
    parser.add_argument("--build", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.root, options.build = options.root.resolve(), options.build.resolve()
    needed = {"patchelf": shutil.which("patchelf"), "mypy": shutil.which("mypy"),
              "python3-venv": subprocess.run([sys.executable, "-c", "import ensurepip"], capture_output=True).returncode == 0}
    if not all(needed.values()):
        print("not installed:", *(name for name, there in needed.items() if not there))
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wheel = run(sys.executable, options.root / "scripts/python_wheel", "--build", options.build, "--out", folder).strip()
        again = run(sys.executable, options.root / "scripts/python_wheel", "--build", options.build, "--out", folder / "b").strip()
        assert pathlib.Path(wheel).read_bytes() == pathlib.Path(again).read_bytes(), "the same bytes from the same files"
        run(sys.executable, "-m", "venv", "--system-site-packages", folder / "venv")  # NumPy is that of the system
        python = folder / "venv/bin/python"
        run(python, "-m", "pip", "install", "--no-index", "--no-deps", wheel)
        site = pathlib.Path(run(python, "-c", "import filament_core; print(filament_core.__file__)", cwd=folder).strip()).parents[1]
        assert folder / "venv" in site.parents, site
        check_libraries(site)
        check_notebook(python, options.root, folder)
        check_types(options.root, folder)


main()
