"""The archive of real machines' results: its files may be there, and its index page holds them as they are."""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import zlib

from ptbench import BINARY, SOURCE

sys.path.insert(0, str(SOURCE / "scripts"))
from archive import device_faults, file_faults  # noqa: E402

ARCHIVE = SOURCE / "results/archive"
DEVICE = "amd/epyc-avx2-rusticl"  # the one with the fewest results


def from_base91(text):
    """The bytes that bench/report/html/packed.cpp wrote as text."""
    digits = [(60 if code == 33 else code) - 35 for code in text.encode()]
    pairs = [(low + 91 * high, 13) for low, high in zip(digits[::2], digits[1::2])]
    groups = pairs + [(digit, 6) for digit in digits[2 * len(pairs):]]
    bits = "".join(f"{value:0{count}b}"[::-1] for value, count in groups)
    return bytes(int(bits[i:i + 8][::-1], 2) for i in range(0, len(bits) - 7, 8))


class Bits:
    """Reads what bench/report/html/exp_golomb.h writes."""

    def __init__(self, data):
        self.digits = "".join(f"{byte:08b}" for byte in data)
        self.at = 0

    def number(self, order):
        one = self.digits.index("1", self.at)
        end = 2 * one - self.at + order + 1
        self.at, code = end, self.digits[one:end]
        return int(code, 2) - 2 ** order


def samples_of(columns, bits):
    """A case's samples, from what bench/report/html/packed.h says of its columns."""
    samples = [{"cause": cause} for cause in columns.pop("cause")]
    for key, column in columns.items():
        for sample in samples:
            number = bits.number(column["order"])
            difference = -(number + 1) // 2 if number % 2 else number // 2
            sample[key] = column["middle"] + column["step"] * difference + (sample["kernel_ns"] if column.get("kernel") else 0)
    return samples


def results_in(page):
    """The results that a page carries, by their names."""
    found = {}
    for block in re.findall(r'class="data">([^<]*)<', page.read_text(encoding="utf-8")):
        head, _, data = zlib.decompress(from_base91(block)).partition(b"\n")
        packed = json.loads(head)
        result = json.loads(packed["text"])
        bits = Bits(data)
        for case, columns in zip(result["cases"], packed["samples"], strict=True):
            case["samples"] = samples_of(columns, bits)
        found[packed["name"]] = result
    return found


def within(part, whole):
    """Whether all of `part` is in `whole`; a newer ptbench may write more of the same result."""
    if isinstance(part, dict):
        return all(key in whole and within(value, whole[key]) for key, value in part.items())
    if isinstance(part, list):
        return len(part) == len(whole) and all(map(within, part, whole))
    return part == whole


def make(folder, index):
    """The one command; its exit status and what it says."""
    made = subprocess.run([sys.executable, "-B", SOURCE / "scripts/archive.py", BINARY, folder, index],
                          capture_output=True, text=True)
    return made.returncode, made.stdout + made.stderr


class Archive(unittest.TestCase):
    def setUp(self):
        """A copy of one device's results, to spoil."""
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "archive"
        shutil.copytree(ARCHIVE / DEVICE, self.folder / DEVICE)
        shutil.copy(ARCHIVE / "README.md", self.folder)
        self.index = self.folder.parent / "index.html"

    def change(self, change):
        """Another content of the first result; its folder."""
        file = sorted(self.folder.glob("*/*/*/result.json"))[0]
        result = json.loads(file.read_text())
        change(result)
        file.write_text(json.dumps(result))
        return file.parent

    def assert_refused(self, says):
        code, words = make(self.folder, self.index)
        self.assertEqual(code, 1, words)
        self.assertIn(says, words)
        self.assertFalse(self.index.exists())

    def test_the_index_in_the_tree_holds_the_results_in_the_tree(self):
        """Remade by: scripts/archive.py build/release/bin/ptbench"""
        results = results_in(ARCHIVE / "index.html")
        files = {str(file.parent.relative_to(ARCHIVE)): file for file in ARCHIVE.glob("*/*/*/result.json")}
        self.assertEqual(sorted(results), sorted(files), "archived or taken away since the index was made")
        for name, file in files.items():
            self.assertTrue(within(json.loads(file.read_text()), results[name]), f"{name} is not as in the index")

    def test_every_line_is_of_a_device(self):
        lines = re.findall(r"^\| `([^`]+)` \|", (ARCHIVE / "README.md").read_text(), re.M)
        self.assertEqual(sorted(lines), sorted({str(file.parents[1].relative_to(ARCHIVE)) for file in ARCHIVE.glob("*/*/*/result.json")}))

    def measure(self, runs, seconds, devices="pocl:0"):
        command = [sys.executable, "-B", SOURCE / "scripts/archive_device.py", BINARY, "here/this", "-d", devices, "--seconds", seconds]
        measured = subprocess.run([*command, "--runs", runs, "--folder", self.folder], capture_output=True, text=True)
        self.assertEqual(measured.returncode, 0, measured.stderr)

    def test_a_device_is_measured_into_its_folder(self):
        self.measure("quick,quality", "60")
        self.measure("quality", "10")  # again takes its own place
        folder = self.folder / "here/this"
        files = sorted(folder.glob("*/result.json"))
        self.assertEqual([file.parent.name for file in files], ["quality", "quick"])
        faults = [fault for file in files for fault in file_faults(file)]
        self.assertEqual([fault for fault in faults if "not committed" not in fault], [])
        readme = (self.folder / "README.md").read_text()
        self.assertEqual(readme.count("| `here/this` |"), 1)
        self.assertEqual([bool(json.loads(file.read_text())["pictures"]) for file in files], [False, True])
        self.assertEqual(list(device_faults(folder, readme)), [])

    def test_several_devices_are_measured_together(self):
        self.measure("one-picture", "10", devices="0,pocl:1")
        result = json.loads((self.folder / "here/this/one-picture/result.json").read_text())
        self.assertEqual([device["key"] for device in result["devices"]], ["pocl:0", "pocl:1"])
        self.assertIn("| `here/this` | 2 of ", (self.folder / "README.md").read_text())

    def test_the_command_makes_an_index_of_every_result(self):
        code, words = make(ARCHIVE, self.index)
        self.assertEqual(code, 0, words)
        self.assertEqual(results_in(self.index).keys(), results_in(ARCHIVE / "index.html").keys())
        self.assertLess(self.index.stat().st_size, 3_500_000)

    def test_runs_that_were_interrupted_or_of_changed_trees_are_refused(self):
        for key, says in (("interrupted", "interrupted"), ("git_dirty", "not committed")):
            with self.subTest(key):
                self.change(lambda result: result["run"].update({"interrupted": False, "git_dirty": False, key: True}))
                self.assert_refused(says)

    def test_folders_of_a_machine_are_refused(self):
        for key, of_machine, clean in (("argv", ["/home/me/ptbench"], ["ptbench"]), ("folder", "/home/me", ".")):
            with self.subTest(key):
                self.change(lambda result: result["run"].update({key: of_machine}))
                self.assert_refused("names a folder of that machine: /home/me")
                self.change(lambda result: result["run"].update({key: clean}))

    def test_times_without_a_valid_image_are_refused(self):
        self.change(lambda result: result["cases"][0]["validation"].update(valid=False))
        self.assert_refused("/cases/0: a time without a valid image")

    def test_what_is_no_result_is_refused(self):
        for key in ("host", "devices"):
            self.change(lambda result: result.pop(key))
            self.assert_refused(f"'{key}' is a required property")

    def test_a_device_without_picture_or_line_and_stray_files_are_refused(self):
        folder = self.change(lambda result: None)
        (folder / "notes.txt").write_text("")
        self.assert_refused("notes.txt lies there")
        (folder / "notes.txt").unlink()
        for picture in folder.parent.glob("*/*.png"):
            picture.unlink()
        self.assert_refused("none of its runs has its picture")
        self.change(lambda result: result["devices"].append(result["devices"][0] | {"key": "again:0", "excluded": "the same device"}))
        self.assert_refused("none of its runs has its picture")
        (self.folder / "README.md").write_text("")
        self.assert_refused("README.md has no line for it")


if __name__ == "__main__":
    unittest.main()
