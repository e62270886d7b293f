"""Ctrl-C: what was measured is written, and the exit code is 130."""

import json
import os
import shutil
import signal
import time
import unittest

from ptbench import ONE, CliTest, changed

# The second case lasts for minutes; the first one for milliseconds.
LONG = changed(ONE, size="256", spp="1,100000000,2") + ["--max-total-time", "0"]


class Interrupted(CliTest):
    def wait_for(self, condition, process):
        deadline = time.monotonic() + 60
        while not condition():
            self.assertIsNone(process.poll(), "the process ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)

    def journal(self):
        file = self.scratch.work / "out/journal.jsonl"
        return file.read_text().splitlines() if file.exists() else []

    def start(self, *words):
        process = self.scratch.start(*words)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def start_and_wait_for_one_record(self, *words):
        process = self.start(*LONG, "--out", "out", *words)
        self.wait_for(lambda: len(self.journal()) == 2, process)
        return process

    def test_what_was_measured_is_written(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = self.start_and_wait_for_one_record()
                process.send_signal(number)
                out, err = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 130, err)
                result = self.scratch.result()
                self.assertTrue(result["run"]["interrupted"])
                found = [(r["params"]["spp"], r["status"], r["reason"]) for r in result["cases"]]
                self.assertEqual(found, [(1, "ok", ""), (100000000, "skipped", "interrupted"),
                                         (2, "skipped", "interrupted")])
                self.assertIn("interrupted: these are the cases measured until then", out)
                self.assertIn("written: out/result.json", err)
                self.assertIn("go on with: ptbench --resume out/journal.jsonl", err)
                (self.scratch.work / "out/journal.jsonl").unlink()

    def test_a_batch_system_that_ends_all_processes_leaves_no_crash(self):
        process = self.start_and_wait_for_one_record()
        for worker in set(map(int, self.scratch.processes())) - {process.pid}:  # which hears of it first
            os.kill(worker, signal.SIGTERM)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertEqual([(r["status"], r["reason"]) for r in self.scratch.result()["cases"][1:]],
                         [("skipped", "interrupted")] * 2)

    def test_another_run_is_kept_out_of_the_folder_until_the_first_ends(self):
        process = self.start_and_wait_for_one_record()
        begun = self.journal()
        for words in ((*ONE, "--out", "out"), (*ONE, "--out", "../work/out"), ("--resume", "out/journal.jsonl", "-q")):
            line = self.assert_refused(*words, says=["--out: ", "in use by another run"])
            self.assertIn("name another folder", line)
        self.assertEqual(self.journal(), begun)
        process.kill()  # with SIGKILL: nothing is tidied up
        process.wait()
        for left in (self.scratch.root / "tmp").iterdir():
            shutil.rmtree(left)
        self.run_ok(*ONE, "--out", "out", "-q")

    def test_a_second_one_ends_at_once_and_leaves_the_journal(self):
        process = self.start_and_wait_for_one_record("--no-isolate")  # which cannot stop within a case
        time.sleep(2)  # the first record is in the journal before the second case begins
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        self.assertIsNone(process.poll(), "one signal was enough; nothing is tested")
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130, err)
        lines = [json.loads(line) for line in self.journal()]
        self.assertEqual([line["status"] for line in lines[1:]], ["ok"])
        for folder in (self.scratch.root / "tmp").iterdir():  # it had no time to tidy up
            shutil.rmtree(folder)

    def test_while_drivers_are_asked_nothing_is_left_behind(self):
        for words in (("--config", "thesis", "--dry-run"), (*LONG, "--out", "out"),
                      ("render", "--spp", "100000", "-o", "x.png")):
            with self.subTest(words):
                process = self.start(*words)
                self.wait_for(self.scratch.temporary_files, process)
                process.send_signal(signal.SIGINT)
                _, err = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 130, err)
                self.assertNotIn("error", err)
                self.assertEqual(self.scratch.temporary_files(), [])


if __name__ == "__main__":
    unittest.main()
