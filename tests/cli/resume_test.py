"""--resume: goes on with a run that was cut short; measures what is missing, and nothing else."""

import json
import shutil
import unittest

from ptbench import ONE, SOURCE, CliTest, changed, ended

SWEEP = changed(ONE, spp="1,2,3,4")


class ResumeTest(CliTest):
    def setUp(self):
        super().setUp()
        self.run_ok(*SWEEP, "--out", "out", "-q")
        self.journal = self.scratch.work / "out/journal.jsonl"

    def cut(self, keep):
        """The journal as a killed run leaves it: the header, `keep` records and a part of the next."""
        lines = self.journal.read_text().splitlines(keepends=True)
        self.journal.write_text("".join(lines[:1 + keep]) + lines[1 + keep][:100])
        (self.scratch.work / "out/result.json").unlink()
        return [json.loads(line) for line in lines[1:1 + keep]]

    def edit_header(self, edit):
        lines = self.journal.read_text().splitlines()
        header = json.loads(lines[0])
        edit(header)
        self.journal.write_text("\n".join([json.dumps(header), *lines[1:]]) + "\n")


class GoingOn(ResumeTest):
    def test_measures_what_is_missing_and_keeps_the_rest(self):
        kept = self.cut(2)
        result = self.run_ok("--resume", "out/journal.jsonl")
        self.assertIn("resumed: 2 of 4 cases are in out/journal.jsonl", result.stderr)
        self.assertIn("[2/2]", result.stderr)
        after = self.scratch.result()
        self.assertEqual(after["cases"][:2], kept)
        self.assertEqual([(r["params"]["spp"], ended(r)) for r in after["cases"]],
                         [(spp, "ok") for spp in (1, 2, 3, 4)])
        self.assertEqual(len(after["run"]["resumed_at"]), 1)
        journal = [json.loads(line) for line in self.journal.read_text().splitlines()]
        self.assertEqual(journal[1:], after["cases"])
        self.assertIn("out/pocl-1.png", self.scratch.files())

    def test_cases_that_were_not_tried_are_missing_and_those_that_failed_are_not(self):
        records = [json.loads(line) for line in self.journal.read_text().splitlines()[1:]]
        crash = {**records[1], "status": "crash", "reason": "killed by SIGSEGV (11)", "samples": [], "statistics": None}
        skipped = {**records[2], "status": "skipped", "reason": "interrupted", "samples": [], "statistics": None}
        header = self.journal.read_text().splitlines()[0]
        self.journal.write_text("\n".join([header, *map(json.dumps, [records[0], crash, skipped, records[3]])]) + "\n")
        self.run_ok("--resume", "out/journal.jsonl", "-q", code=1)
        after = self.scratch.result()["cases"]
        self.assertEqual([ended(record) for record in after], ["ok", "crash", "ok", "ok"])
        self.assertEqual([after[0], after[1], after[3]], [records[0], crash, records[3]])

    def test_pictures_of_cases_that_others_disturbed_or_that_were_wrong_stay(self):
        header, *lines = self.journal.read_text().splitlines()
        picture = self.scratch.work / "out/pocl-1.png"
        before = picture.read_bytes()
        for status in ("unstable", "invalid"):
            with self.subTest(status):
                records = [json.loads(line) for line in lines]
                records[3]["status"] = status
                self.journal.write_text("\n".join([header, *map(json.dumps, records)]) + "\n")
                self.scratch.run("--resume", "out/journal.jsonl", "-q")
                self.assertEqual(picture.read_bytes(), before)
                self.assertEqual([made["file"] for made in self.scratch.result()["pictures"]], ["pocl-1.png"])

    def test_from_a_result_file_of_another_name_into_another_folder(self):
        result = self.scratch.result()
        result["cases"] = result["cases"][1:]
        self.scratch.write("partial.json", json.dumps(result, indent=2))
        self.run_ok("--resume", "partial.json", "--out", "more", "-q")
        self.assertEqual(self.scratch.result("more")["cases"][1:], result["cases"])

    def test_nothing_missing_writes_the_files_again(self):
        before = self.scratch.result()
        (self.scratch.work / "out/table.md").unlink()
        self.run_ok("--resume", "out/journal.jsonl", "-q")
        self.assertEqual(self.scratch.result()["cases"], before["cases"])
        self.assertIn("out/table.md", self.scratch.files())

    def test_the_same_words_again_and_another_patience_are_no_difference(self):
        self.cut(1)
        planned = self.run_ok(*changed(SWEEP, timeout=50), "--max-total-time", "100", "--resume", "out/journal.jsonl",
                              "--dry-run", "-q").stdout
        self.assertEqual(len(planned.splitlines()), 3)

    def test_what_was_asked_for_is_a_config(self):
        self.scratch.write("again.json", self.scratch.result()["run"]["settings"])
        self.run_ok("--config", "again.json", "--out", "again", "-q")
        self.assertEqual(self.scratch.result("again")["run"]["settings"], self.scratch.result()["run"]["settings"])


class FromAnotherFolder(CliTest):
    def test_relative_paths_are_from_where_the_run_began(self):
        self.scratch.write("first/my, scene.json", (SOURCE / "configs/scenes/furnace.json").read_text())
        shutil.copytree(SOURCE / "kernels/pt", self.scratch.work / "first/kernels/pt")
        (self.scratch.work / "second").mkdir()
        words = (*changed(ONE, spp="1,2"), "--scene", "my, scene.json", "--kernel-dir", "kernels", "--out", "out", "-q")
        self.run_ok(*words, folder="first")
        journal = self.scratch.work / "first/out/journal.jsonl"
        lines = journal.read_text().splitlines(keepends=True)
        journal.write_text("".join(lines[:2]))
        self.run_ok("--resume", "../first/out/journal.jsonl", "-q", folder="second")
        after = self.scratch.result("first/out")
        self.assertEqual([(r["params"]["spp"], r["params"]["scene"], ended(r)) for r in after["cases"]],
                         [(1, "../first/my, scene.json", "ok"), (2, "../first/my, scene.json", "ok")])
        self.assertEqual(after["cases"][0]["samples"], json.loads(lines[1])["samples"])
        self.run_ok("--resume", "out/journal.jsonl", "-q", folder="first")
        again = self.scratch.result("first/out")
        self.assertEqual([r["params"]["scene"] for r in again["cases"]], ["my, scene.json"] * 2)
        self.assertEqual([r["samples"] for r in again["cases"]], [r["samples"] for r in after["cases"]])


class Refused(ResumeTest):
    def refused(self, *words, says, code=7):
        line = self.assert_refused("--resume", "out/journal.jsonl", *words, says=says, code=code)
        self.assertTrue(line.startswith("error: "))
        return line

    def test_other_options_or_another_plan(self):
        line = self.refused("--max-time", "7", "--seed", "9", says=["out/journal.jsonl is of another run"])
        self.assertRegex(line, r"option max_time \(there [0-9.]+, here 7\.0\)")
        self.assertIn("option seed (there 1, here 9)", line)
        self.refused("--spp", "1,2", says="option series (there ")
        self.refused("--config", "ci", says="option series (there ")
        self.refused("-d", "all", says="device pocl:0 (there nothing, here ")

    def test_another_driver_cpu_device_or_ptbench(self):
        def other(header):
            (device,) = header["devices"]
            device["driver_version"] = "old"
            header["host"]["cpu"] = "Z80"
            header["run"]["tool_version"] = "0.0"
        self.edit_header(other)
        line = self.refused(says="driver of pocl:1 (there ")
        for part in ("cpu (there Z80", "ptbench (there 0.0"):
            self.assertIn(part, line)
        self.assertEqual(line.count("(there "), 3)

    def test_another_kernel(self):
        text = (SOURCE / "kernels/pt/pt.cl").read_text()
        self.scratch.write("kernels/pt/pt.cl", text)
        self.run_ok(*SWEEP, "--kernel-dir", "kernels", "--out", "out", "-q")
        self.scratch.write("kernels/pt/pt.cl", text + "/* faster */\n")
        self.refused(says="kernel pt (there ")

    def test_another_scene(self):
        scene = json.loads((SOURCE / "configs/scenes/furnace.json").read_text())
        self.scratch.write("my scene.json", scene)
        self.run_ok(*SWEEP, "--scene", "my scene.json", "--out", "out", "-q")
        scene["materials"]["wall"]["radiance"] = [2, 2, 2]
        self.scratch.write("my scene.json", scene)
        self.refused(says="scene my scene.json (there ")

    def test_files_that_are_no_run(self):
        self.assert_refused("--resume", "nowhere", says="--resume")
        self.scratch.write("empty", "")
        self.assert_refused("--resume", "empty", says="empty: ")
        self.edit_header(lambda header: header["run"].pop("settings"))
        self.refused(says="does not say what was asked for", code=2)

    def test_records_of_another_plan(self):
        lines = self.journal.read_text().splitlines(keepends=True)
        shutil.copy(self.journal, self.scratch.work / "whole")
        self.journal.write_text("".join([*lines, lines[1]]))
        self.refused(says="two of one")
        self.journal.write_text("".join([*lines[:-1], lines[-1].replace('"spp":4', '"spp":5')]))
        self.refused(says="records there of no case here")


if __name__ == "__main__":
    unittest.main()
