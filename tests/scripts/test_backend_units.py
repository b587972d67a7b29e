# SPDX-License-Identifier: Apache-2.0
"""backend/vulkan and backend/gles: units with the same task have the same name, and the tables list them."""
import pathlib
import re
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ["vulkan", "gles"]


def units(folder):
    return {path.stem for path in (ROOT / "backend" / folder).iterdir() if path.suffix in {".h", ".cpp"}}


def table(folder):
    """The rows of the table of units as text, from its heading to the first line that is not a row."""
    lines = (ROOT / "backend" / folder / "README.md").read_text(encoding="utf-8").splitlines()
    start = lines.index("| unit | Vulkan | OpenGL ES |")
    rows = []
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        rows.append(line)
    return rows


def named(folder):
    """The units that the folder's own column of its table describes."""
    column = 2 + FOLDERS.index(folder)
    names = []
    for row in table(folder):
        cells = [cell.strip() for cell in row.split("|")]
        if cells[column]:
            names += re.findall(r"`(\w+)`", cells[1])
    return names


class BackendUnits(unittest.TestCase):
    def test_both_folders_have_the_same_table(self):
        self.assertEqual(table("vulkan"), table("gles"))

    def test_every_unit_stands_in_the_table_once_and_exists(self):
        for folder in FOLDERS:
            self.assertEqual(sorted(named(folder)), sorted(units(folder)), folder)

    def test_most_units_are_twins(self):
        twins = units("vulkan") & units("gles")
        for folder in FOLDERS:
            self.assertGreater(2 * len(twins), len(units(folder)), folder)


if __name__ == "__main__":
    unittest.main()
