"""`ptbench render` by several devices: the bits of one, who made what, and that again."""

import json
import os
import re
import signal
import unittest

from formats import pfm_pixels
from ptbench import CliTest

WORK = ("render", "--size", "48x32", "--spp", "40", "--path-length", "6")
BOTH = ("-d", "0,1")


def parts_of(ranges):
    return sorted(tuple(pair) for device in ranges["devices"] for pair in device["parts"])


class Together(CliTest):
    def picture(self, *words, name="x.pfm"):
        self.run_ok(*words, "-o", name, "-q")
        return (self.scratch.work / name).read_bytes()

    def ranges(self, name="x.pfm"):
        return json.loads((self.scratch.work / f"{name}.ranges.json").read_text())

    def test_two_devices_make_the_bits_of_one(self):
        for kernel in ("pt", "bdpt"):  # what one pixel's samples add to others, too
            with self.subTest(kernel):
                words = (*WORK, "--kernel", kernel)
                alone = self.picture(*words, "-d", "0")
                self.assertEqual(self.picture(*words, *BOTH), alone)

    def test_a_film_of_several_bands_has_the_bits_of_one(self):
        for kernel in ("pt", "bdpt"):
            with self.subTest(kernel):
                words = ("render", "--size", "4x600", "--spp", "4", "--path-length", "4", "--kernel", kernel)
                self.assertEqual(self.picture(*words, *BOTH), self.picture(*words, "-d", "0"))

    def test_every_part_is_made_once_and_it_is_said_by_whom(self):
        said = self.run_ok(*WORK, *BOTH, "-o", "x.pfm").stderr
        ranges = self.ranges()
        ends = [0]
        for first, end in parts_of(ranges):
            self.assertEqual(first, ends[-1])
            ends.append(end)
        self.assertEqual(ends[-1], ranges["part_count"])
        self.assertEqual([device["device"] for device in ranges["devices"]], ["pocl:0", "pocl:1"])
        self.assertEqual((ranges["params"]["spp"], ranges["seed"]), (40, 1))
        self.assertRegex(said, r"^written: x.pfm x.pfm.ranges.json \(pocl:0 [\d.]+ %, pocl:1 [\d.]+ %; [\d.]+ s, [\d.]+ % of the "
                               rf"devices' speeds together; film {ranges['film_hash']}\)\n$")

    def test_the_picture_says_it_too(self):
        content = self.picture(*WORK, *BOTH, name="x.exr")
        self.assertIn((self.scratch.work / "x.exr.ranges.json").read_bytes().strip(), content)

    def test_ranges_repeat_who_made_what(self):
        first = self.picture(*WORK, "-d", "pocl:1", "-d", "pocl:0", "--seed", "5")
        again = self.picture("render", "--ranges", "x.pfm.ranges.json", name="y.pfm")
        self.assertEqual(again, first)
        for key in ("seed", "film_hash", "cut", "params"):
            self.assertEqual(self.ranges("y.pfm")[key], self.ranges()[key])
        self.assertEqual([d["parts"] for d in self.ranges("y.pfm")["devices"]], [d["parts"] for d in self.ranges()["devices"]])

    def test_a_repetition_that_comes_out_otherwise_is_a_wrong_picture(self):
        self.picture(*WORK, *BOTH)
        changed = {**self.ranges(), "film_hash": "0" * 16}
        self.scratch.write("other.json", changed)
        said = self.run_ok("render", "--ranges", "other.json", "-o", "y.pfm", code=4).stderr
        self.assertIn("a device computes otherwise", said)

    def test_what_cannot_be_repeated_is_refused(self):
        self.picture(*WORK, *BOTH)
        ranges = self.ranges()
        twice = {**ranges, "devices": [ranges["devices"][0], {**ranges["devices"][0], "device": "pocl:1"}]}
        gone = {**ranges, "devices": [{**ranges["devices"][0], "device": "pocl:7", "parts": [[0, ranges["part_count"]]]}]}
        for changed, says, code in [
            ({**ranges, "facts": {**ranges["facts"], "kernel pt": "0"}}, "kernel pt (there 0, here ", 7),
            ({**ranges, "params": {**ranges["params"], "kernel": "bdpt"}}, 'there is no "kernel bdpt"', 2),
            ({**ranges, "scene_hash": "0"}, "scene thesis", 7),
            ({**ranges, "devices": [{**device, "name": "other"} for device in ranges["devices"]]}, "other", 7),
            (twice, "/devices: ", 2),
            (gone, "pocl:7", 2),
            ({}, '"schema" is not "ptbench.ranges.v1"', 2),
        ]:
            with self.subTest(says):
                self.scratch.write("other.json", changed)
                self.assert_refused("render", "--ranges", "other.json", "-o", "y.pfm", says=says, code=code)

    def test_what_several_devices_cannot_do_is_refused(self):
        self.scratch.write("r.json", {})
        for words, says in [
            (("--kernel", "thesis"), "several devices cannot share its pictures"),
            (("--kernel", "gpt"), "several devices cannot share its pictures"),
            (("--kernel", "rays"), "several devices cannot share its pictures"),
            (("--kernel", "gbdpt", "--aov", "dx"), "--aov: found \"dx\""),
            (("--time", "1"), "--time: found beside 2 devices"),
            (("--aov", "cost", "--scene", "knot"), "--aov: found \"cost\""),
            (("--launcher", "env"), "--launcher: found beside 2 devices"),
            (("--ranges", "r.json"), "--ranges"),
        ]:
            with self.subTest(words):
                self.assert_refused("render", *BOTH, *words, "-o", "x.pfm", says=says)
        self.assert_refused("render", "--ranges", "r.json", "--spp", "4", "-o", "x.pfm", says="--ranges: found beside axes")
        self.assert_refused("render", "-d", "0,7", "-o", "x.pfm", says='"7" matches none')

    def test_a_worker_that_is_killed_costs_what_it_made(self):
        words = ("render", "--size", "64", "--spp", "6000", "--path-length", "6")
        alone = self.picture(*words, "-d", "0")
        process, terminal = self.start_in_terminal(*words, *BOTH, "-o", "y.pfm")
        terminal.wait_for(r"[1-9]\d* %")
        for pid in self.scratch.processes():
            if b"pocl:1" in command_of(pid):
                os.kill(int(pid), signal.SIGKILL)
        self.assertEqual(terminal.end_of(process), 0, terminal.text)
        self.assertIn("pocl:1: killed by SIGKILL (9); what it made is made again", terminal.text)
        self.assertEqual((self.scratch.work / "y.pfm").read_bytes(), alone)
        self.assertEqual(self.scratch.processes(), [])

    def on_node(self, node, *words):
        """Equal devices on all: whoever comes first says how the picture is cut."""
        return self.scratch.start(*WORK, "-d", "0", "--fleet", "F", "--expect", "n1,n2", *words, "-o", "y.pfm", SLURMD_NODENAME=node)

    def test_two_nodes_make_the_bits_of_one(self):
        alone = self.picture(*WORK, "-d", "0")
        nodes = [self.on_node("n1"), self.on_node("n2")]
        said = [node.communicate(timeout=60)[1] for node in nodes]
        self.assertEqual([node.returncode for node in nodes], [0, 0], said)
        self.assertEqual((self.scratch.work / "y.pfm").read_bytes(), alone)
        made = {device["device"] for device in self.ranges("y.pfm")["devices"]}
        self.assertLessEqual(made, {"n1/pocl:0", "n2/pocl:0"})
        self.assertIn("written: y.pfm", "".join(said))

    def test_a_node_that_died_begins_again_with_what_it_had_claimed(self):
        alone = self.picture(*WORK, "-d", "0")
        folder = self.scratch.work / "F"
        (folder / "chunks").mkdir(parents=True)
        (folder / "chunks/000000").write_text("n1\n")  # as it was left by a process that was killed
        with self.on_node("n2") as other:
            said = other.communicate(timeout=60)[1]
        self.assertRegex(said, r"n2: made ([\d.]+) % of the picture\n\1 % of the picture are in F: the rest is of n1; who ends last")
        self.assertFalse((self.scratch.work / "y.pfm").exists())
        with self.on_node("n1") as again:
            said = again.communicate(timeout=60)[1]
        self.assertIn("written: y.pfm", said)
        self.assertEqual((self.scratch.work / "y.pfm").read_bytes(), alone)

    def test_what_a_node_made_until_it_was_interrupted_is_kept(self):
        words = ("render", "--size", "64", "--spp", "6000", "--path-length", "6", "-d", "0")
        alone = self.picture(*words)
        fleet = (*words, "--fleet", "F", "--expect", "n1", "-o", "y.pfm")
        process, terminal = self.start_in_terminal(*fleet, SLURMD_NODENAME="n1")
        terminal.wait_for(r"[1-9]\d* %")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        made = float(re.search(r"n1: made ([\d.]+) % of the picture; interrupted: what is made is kept, and", terminal.text)[1])
        self.assertTrue(0 < made < 100, terminal.text)
        with self.scratch.start(*fleet, SLURMD_NODENAME="n2") as other:
            said = other.communicate(timeout=60)[1]
        self.assertAlmostEqual(float(re.search(r"n2: made ([\d.]+) %", said)[1]), 100 - made, delta=0.11)
        self.assertEqual((self.scratch.work / "y.pfm").read_bytes(), alone)

    def test_another_picture_in_the_folder_is_refused(self):
        with self.on_node("n1") as first:
            first.communicate(timeout=60)
        with self.on_node("n2", "--seed", "2") as other:
            said = other.communicate(timeout=60)[1]
        self.assertEqual(other.returncode, 7)
        self.assertIn("another picture was begun there: seed (there 1, here 2)", said)

    def test_interruption_keeps_what_all_have_made(self):
        words = ("render", "--size", "32", "--path-length", "5")
        _, whole = pfm_pixels(self.picture(*words, "-d", "0", "--spp", "1000"))
        process, terminal = self.start_in_terminal(*words, *BOTH, "--spp", "500000", "-o", "part.pfm")
        terminal.wait_for(r"[1-9]\d* %")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        self.assertTrue(terminal.text.endswith("; interrupted: as far as it got)\n"), terminal.text)
        _, part = pfm_pixels((self.scratch.work / "part.pfm").read_bytes())
        self.assertAlmostEqual(sum(part) / sum(whole), 1, delta=0.1)
        self.assertEqual(self.scratch.processes(), [])


def command_of(pid):
    try:
        with open(f"/proc/{pid}/cmdline", "rb") as file:
            return file.read()
    except OSError:
        return b""


if __name__ == "__main__":
    unittest.main()
