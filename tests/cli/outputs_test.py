"""What a run writes: result file, CSV, Markdown and pictures; clean stdout; and nothing is lost when writing fails."""

import csv
import io
import json
import os
import pathlib
import subprocess
import unittest

from formats import png_size
from ptbench import BINARY, ONE, SOURCE, TINY, CliTest, Scratch, changed, ended
from validate_schema import schema_errors

BINARY_DIR = pathlib.Path(os.environ["PTB_BINARY_DIR"])
SCHEMA = SOURCE / "configs/schema/result.schema.json"


class TwoDevices(unittest.TestCase):
    """One run on both devices where numbers have commas; its files are looked at from all sides."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = Scratch()
        cls.addClassCleanup(cls.scratch.remove)
        cls.words = changed(TINY, spp="2,5", size="24x16")
        german = {"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(BINARY_DIR / "locales")}
        point = subprocess.run(["locale", "decimal_point"], env={**os.environ, **german}, capture_output=True, text=True,
                               check=True).stdout
        assert point == ",\n", f"no German locale here: {point}"
        cls.ran = cls.scratch.run(*cls.words, "--out", "out", "--csv", "asked.csv", **german)
        assert cls.ran.returncode == 0, cls.ran.stdout + cls.ran.stderr

    def file(self, name):
        return self.scratch.work / "out" / name

    def test_every_file_is_there_and_no_other(self):
        names = ["journal.jsonl", "pocl-0.png", "pocl-1.png", "result.csv", "result.json", "table.md"]
        self.assertEqual(self.scratch.files(), ["asked.csv", "out", *(f"out/{name}" for name in names)])

    def test_the_result_file_keeps_to_its_schema(self):
        self.assertEqual(schema_errors(SCHEMA, self.file("result.json")), "")
        result = self.scratch.result()
        self.assertEqual(result["schema"], "ptbench.v1")
        self.assertEqual(result["run"]["argv"][1:], [*self.words, "--out", "out", "--csv", "asked.csv"])
        self.assertFalse(result["run"]["interrupted"])
        for case in result["cases"]:
            self.assertEqual(ended(case), "ok", case["reason"])
            self.assertTrue(case["validation"]["valid"])
            self.assertEqual(case["work"]["samples"], 24 * 16 * case["params"]["spp"])

    def test_the_schema_notices_what_is_missing(self):
        broken = self.scratch.result()
        del broken["cases"][0]["status"]
        file = self.scratch.root / "broken.json"
        file.write_text(json.dumps(broken))
        self.assertIn("/cases/0", schema_errors(SCHEMA, file))

    def test_csv_starts_with_the_columns_of_the_thesis(self):
        text = self.file("result.csv").read_text()
        self.assertEqual(text, (self.scratch.work / "asked.csv").read_text())
        rows = list(csv.reader(io.StringIO(text)))
        self.assertEqual(rows[0][:5], ["vendor", "type", "device", "spp", "time_ms"])
        self.assertTrue(all(len(row) == len(rows[0]) for row in rows))
        cases, devices = self.scratch.result()["cases"], self.scratch.result()["devices"]
        self.assertEqual(len(rows), 1 + len(cases))
        names = {device["key"]: device["name"] for device in devices}
        for row, case in zip(rows[1:], cases):
            self.assertEqual(row[1:4], ["CPU", names[case["params"]["device"]], str(case["params"]["spp"])])
            self.assertAlmostEqual(float(row[4]) * 1e6, case["statistics"]["median_ns"], delta=1)

    def test_the_journal_has_each_record_on_a_line(self):
        lines = [json.loads(line) for line in self.file("journal.jsonl").read_text().splitlines()]
        self.assertEqual(lines[0]["schema"], "ptbench.v1")
        self.assertEqual(lines[1:], self.scratch.result()["cases"])

    def test_a_picture_per_device(self):
        for name in ("pocl-0.png", "pocl-1.png"):
            self.assertEqual(png_size(self.file(name).read_bytes()), (24, 16))

    def test_markdown_and_table_show_both_devices(self):
        names = [device["name"] for device in self.scratch.result()["devices"]]
        for text in (self.file("table.md").read_text(), self.ran.stdout):
            for name in names:
                self.assertIn(name, text)
        self.assertIn("| vendor | type | device | SPP | time ms |", self.file("table.md").read_text())

    def test_progress_and_hints_go_to_stderr(self):
        for part in ("predicted: ", "[1/4] pocl:0", "[4/4] pocl:1", "written: out/result.json", "hint: "):
            self.assertIn(part, self.ran.stderr)
            self.assertNotIn(part, self.ran.stdout)
        self.assertNotIn("\x1b", self.ran.stdout + self.ran.stderr)

    def test_no_temporary_files_are_left(self):
        self.assertEqual(self.scratch.temporary_files(), [])


class Stdout(CliTest):
    def test_a_format_on_stdout_is_alone_there(self):
        for flag, file in (("--json", "result.json"), ("--csv", "result.csv"), ("--md", "table.md")):
            with self.subTest(flag):
                result = self.run_ok(*ONE, flag, "-", "--out", "out")
                self.assertEqual(result.stdout, (self.scratch.work / "out" / file).read_text())
                self.assertIn("[1/1]", result.stderr)
                self.assertIn("times, scene thesis", result.stderr)

    def test_quiet_is_quiet(self):
        result = self.run_ok(*ONE, "-q", "--out", "out")
        self.assertEqual(result.stderr, "")
        self.assertIn("times, scene thesis", result.stdout)
        self.assertEqual(self.run_ok(*ONE, "-q", "--csv", "-", "--out", "out").stderr, "")

    def test_colour_only_when_asked_for(self):
        self.scratch.write("kernels/pt/pt.cl", "no kernel\n")
        failing = (*ONE, "--kernel-dir", "kernels", "--out", "out")
        self.assertNotIn("\x1b", self.run_ok(*failing, code=1).stderr)
        self.assertIn("\x1b[31m", self.run_ok(*failing, "--color", "always", code=1).stderr)

    def test_without_out_the_folder_is_named_after_time_and_config(self):
        self.run_ok(*ONE, "-q")
        self.assertRegex(" ".join(self.scratch.files()),
                         r"ptbench-results/\d{4}-\d\d-\d\dT\d\d-\d\d-\d\dZ-quick/result.json")


class NothingLost(CliTest):
    def test_what_cannot_be_written_is_said_before_the_run(self):
        for flag in ("--json", "--csv", "--md"):
            self.assert_refused(*ONE, flag, "missing/x", says=[flag, "missing/x", "No such file or directory"])
        self.assert_refused(*ONE, "--csv", ".", says=["--csv", "Is a directory"])
        self.assert_refused(*ONE, "--out", "/proc/x", says=["--out", "/proc/x"])
        self.scratch.write("file", "precious")
        self.assert_refused(*ONE, "--out", "file", says=["--out", "file"])
        self.assert_refused(*ONE, "--out", "out", "--csv", "out/result.json", says=["both json and csv"])

    def test_a_file_may_lie_in_the_folder_of_the_run(self):
        self.run_ok(*ONE, "--out", "new", "--csv", "new/my.csv", "-q")
        self.assertIn("new/my.csv", self.scratch.files())

    def test_a_full_disk_leaves_the_journal_and_says_where(self):
        result = self.run_ok(*ONE, "--csv", "/dev/full", "--out", "out", code=1)
        journal = self.scratch.work / "out/journal.jsonl"
        last = result.stderr.splitlines()[-1]
        self.assertTrue(last.startswith("error: cannot write /dev/full: No space left on device"), last)
        self.assertIn(os.path.realpath(journal), last)
        record = json.loads(journal.read_text().splitlines()[1])
        self.assertEqual(ended(record), "ok")
        self.assertIn("times, scene thesis", result.stdout)

    def test_a_full_disk_behind_stdout(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            for words in (("list",), ("--help",), ("--dump-config",), (*ONE, "--dry-run", "-q")):
                with self.subTest(words):
                    self.assertIn("error: stdout", self.run_ok(*words, stdout=full, code=1).stderr)
            result = self.run_ok(*ONE, "--json", "-", "--out", "out", stdout=full, code=1)
        self.assertIn("error: cannot write to stdout", result.stderr)
        self.assertEqual(ended(self.scratch.result()["cases"][0]), "ok")

    def test_readers_who_leave_do_not_cost_the_result(self):
        for stream in ("stdout", "stderr"):
            with self.subTest(stream):
                reading, writing = os.pipe()
                os.close(reading)
                process = self.scratch.start(*changed(ONE, spp="1:40:1"), "--out", stream, **{stream: writing})
                os.close(writing)
                process.communicate(timeout=60)
                records = self.scratch.result(stream)["cases"]
                self.assertEqual({ended(record) for record in records}, {"ok"})
                self.assertEqual(len(records), 40)

    def test_closed_streams_do_not_become_files(self):
        close_all = f"exec {BINARY} {' '.join(ONE)} --out out <&- >&- 2>&-"
        process = subprocess.run(["sh", "-c", close_all], cwd=self.scratch.work, check=False,
                                 env=self.scratch.environment(), timeout=60)
        self.assertEqual(process.returncode, 1)  # nothing took the table
        lines = (self.scratch.work / "out/journal.jsonl").read_text().splitlines()
        self.assertEqual([ended(json.loads(line)) for line in lines[1:]], ["ok"])
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "out/result.json"), "")

    def test_an_older_picture_does_not_pass_for_a_new_one(self):
        self.run_ok(*ONE, "--out", "out", "-q")
        self.assertIn("out/pocl-1.png", self.scratch.files())
        result = self.run_ok(*ONE, "--out", "out", "--max-total-time", "0.001")
        self.assertEqual(self.scratch.result()["cases"][0]["status"], "skipped")
        self.assertNotIn("out/pocl-1.png", self.scratch.files())
        self.assertNotIn("png", result.stderr)

    def test_existing_files_are_replaced_and_links_followed(self):
        self.scratch.write("real.csv", "old")
        (self.scratch.work / "link.csv").symlink_to("real.csv")
        self.run_ok(*ONE, "--csv", "link.csv", "--out", "out", "-q")
        self.assertTrue((self.scratch.work / "link.csv").is_symlink())
        self.assertTrue((self.scratch.work / "real.csv").read_text().startswith("vendor,type,device"))


class Shipped(unittest.TestCase):
    def test_configs_scenes_and_archived_results_keep_to_their_schemas(self):
        configs, archive = SOURCE / "configs", SOURCE / "results/archive"
        for schema, files in (("config", configs.glob("*.json")), ("scene", (configs / "scenes").glob("*.json")),
                              ("result", archive.rglob("result.json"))):
            files = sorted(files)
            self.assertTrue(files)
            self.assertEqual(schema_errors(configs / f"schema/{schema}.schema.json", *files), "")

    def test_archived_results_are_right_pictures_of_committed_trees(self):
        for file in (SOURCE / "results/archive").rglob("result.json"):
            result = json.loads(file.read_text())
            with self.subTest(file.relative_to(SOURCE)):
                self.assertFalse(result["run"]["git_dirty"] or result["run"]["interrupted"])
                self.assertEqual({ended(case) for case in result["cases"]} - {"ok", "skipped", "unsupported"},
                                 set())
                for case in result["cases"]:
                    timed = bool(case["samples"])
                    self.assertEqual(ended(case) == "ok", timed)
                    self.assertTrue(not timed or case["validation"]["valid"])


if __name__ == "__main__":
    unittest.main()
