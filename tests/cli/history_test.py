"""`ptbench report --history`, and the script that keeps such a folder in a CI; results are archived ones with other times."""

import copy
import json
import os
import pathlib
import random
import shutil
import subprocess
import unittest

from browser import Browser
from gate_recipe_test import Repository
from ptbench import SOURCE, TINY, CliTest

ARCHIVED = SOURCE / "results/archive/amd/epyc-avx512-pocl/speed/result.json"
SCHEMA = SOURCE / "configs/schema/history.schema.json"
SHOTS = pathlib.Path(os.environ["PTB_BINARY_DIR"]) / "page"
DAYS, SLOWER_FROM = 24, 15


def scaled(result, factor):
    for case in result["cases"]:
        for sample in case["samples"]:
            sample.update({key: round(sample[key] * factor) for key in ("kernel_ns", "sum_ns", "host_ns")})


def on(day, change=lambda result: None):
    """The archived result as if it were of another day; from the 15th on a tenth slower, by another kernel."""
    result = copy.deepcopy(json.loads(ARCHIVED.read_text()))
    result["run"].update(started_at=f"2031-01-{day:02}T03:00:00Z", git_sha=f"{day:02}" * 20)
    scaled(result, random.Random(day).uniform(0.99, 1.01) * (1.1 if day >= SLOWER_FROM else 1))
    for case in result["cases"]:
        if day >= SLOWER_FROM and case["params"]["kernel"] == "pt":
            case["build"]["kernel_hash"] = "feedfacefeedface"
    change(result)
    return result


class History(CliTest):
    def setUp(self):
        super().setUp()
        for day in range(1, DAYS + 1):
            self.scratch.write(f"runs/{day:02}.json", on(day))
        self.lines = len([case for case in on(1)["cases"] if case["status"] == "ok" and case["statistics"]])

    def history(self, code=0):
        return json.loads(self.run_ok("report", "--history", "runs", "--json", "-", code=code).stdout)

    def test_a_line_a_case_and_the_change_where_it_happened(self):
        history = self.history()
        self.assertEqual(len(history["lines"]), self.lines)
        for line in history["lines"]:
            self.assertEqual([point["run"] for point in line["points"]], list(range(DAYS)))
            (step,) = line["steps"]
            self.assertEqual(step["at"], SLOWER_FROM - 1, line["case"])
            self.assertAlmostEqual(2.718281828 ** step["shift"]["value"], 1.1, delta=0.01)
        self.assertEqual(history["left_out"], [])

    def test_terminal_and_markdown_say_since_when_and_with_which_kernel(self):
        for words in ((), ("--md", "-")):
            shown = self.run_ok("report", "--history", "runs", *words).stdout
            for part in ("2031-01-15 03:00", "151515151", "regressed", "feedfacef", f"{self.lines} changes", "▁"):
                self.assertIn(part, shown)

    def test_the_json_keeps_to_its_schema(self):
        from validate_schema import schema_errors
        self.run_ok("report", "--history", "runs", "--json", "history.json")
        self.assertFalse(schema_errors(SCHEMA, self.scratch.work / "history.json"))

    def test_other_drivers_and_devices_have_lines_of_their_own(self):
        def other(result):
            scaled(result, 3)
            for device in result["devices"]:
                device.update(driver_version="9.9")

        self.scratch.write("runs/25.json", on(25, other))
        history = self.history()
        self.assertEqual(len(history["lines"]), 2 * self.lines)
        self.assertEqual({len(line["points"]) for line in history["lines"]}, {1, DAYS})
        self.assertTrue(any("9.9" in text for text in history["apart"]))
        self.assertIn("driver 9.9", self.run_ok("report", "--history", "runs").stdout)

    def test_another_text_of_the_scene_is_not_mixed_in(self):
        def edited(result):
            result["run"]["scenes"] = ["thesis 0123456789abcdef"]
            scaled(result, 3)

        self.scratch.write("runs/25.json", on(25, edited))
        history = self.history()
        self.assertEqual(len(history["lines"]), 2 * self.lines)
        self.assertTrue(any("0123456789abcdef" in text for text in history["apart"]), history["apart"])

    def test_broken_and_foreign_files_and_copies_are_told(self):
        self.scratch.write("runs/broken.json", '{"schema": "ptbench.v1", "run": ')
        self.scratch.write("runs/deep/other.json", {"schema": "ptbench.ab.v1"})
        shutil.copy(self.scratch.work / "runs/03.json", self.scratch.work / "runs/copy.json")
        shown = self.run_ok("report", "--history", "runs")
        for part in ("broken.json: not JSON", "deep/other.json: ", "copy.json: the same as 03.json"):
            self.assertIn(f"left out: {part}", shown.stderr)
        history = self.history()
        self.assertEqual([each["file"] for each in history["left_out"]], ["broken.json", "copy.json", "deep/other.json"])
        self.assertEqual(len(history["runs"]), DAYS)

    def test_what_is_no_history_is_refused(self):
        (self.scratch.work / "empty").mkdir()
        self.assert_refused("report", "--history", "nowhere", says=("--history", "nowhere"))
        self.assert_refused("report", "--history", "empty", says=("--history", "empty", "no file with a time"))
        self.assert_refused("report", "runs/01.json", "--history", "runs", says="--history")
        self.assert_refused("report", "--history", "runs", "--csv", "-", says="--history")
        self.assert_refused("report", "--history", "runs", "--tolerance", "much", says="--tolerance")

    def test_the_page_has_charts_and_without_scripts_tables(self):
        self.run_ok("report", "--history", "runs", "--html", "history.html")
        page = self.scratch.work / "history.html"
        browser = Browser()
        self.addCleanup(browser.close)
        SHOTS.mkdir(exist_ok=True)
        for width, scheme in ((1280, "light"), (380, "dark")):
            browser.look(width, scheme)
            browser.open(page, "document.documentElement.classList.contains('ready')")
            self.assertEqual(browser.complaints(), [])
            self.assertLessEqual(browser.evaluate("document.documentElement.scrollWidth"), width)
            self.assertEqual(browser.evaluate("document.querySelectorAll('#charts canvas').length"), self.lines)
            browser.screenshot(SHOTS / f"history-{width}-{scheme}.png")
        words = browser.evaluate("document.querySelector('#charts figcaption').textContent")
        self.assertIn("times as long since run 15 (2031-01-15 03:00)", words)
        browser.call("Emulation.setScriptExecutionDisabled", value=True)
        browser.open(page)
        self.assertEqual(browser.evaluate("document.querySelectorAll('#history svg.trend .slower').length"), self.lines)
        self.assertEqual(browser.evaluate("document.querySelectorAll('#changes tbody tr').length"), self.lines)


class Recipe(Repository):
    def test_the_script_adds_a_run_and_shows_the_history(self):
        self.make_repository("scripts/ci/history.sh")
        environment = self.scratch.environment(GITHUB_STEP_SUMMARY=str(self.scratch.work / "summary.md"))
        for runs in (1, 2):
            self.git("commit", "-qm", "next", "--allow-empty")
            run = subprocess.run(["scripts/ci/history.sh", "kept", "-d", "pocl:1", *TINY], cwd=self.scratch.work, env=environment,
                                 capture_output=True, text=True, check=False)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            self.assertEqual(len(list((self.scratch.work / "kept").glob("*.json"))), runs)
            self.assertIn(f"a history of {runs} runs", (self.scratch.work / "kept/index.html").read_text())
        self.assertIn((self.scratch.work / "kept/history.md").read_text(), (self.scratch.work / "summary.md").read_text())


if __name__ == "__main__":
    unittest.main()
