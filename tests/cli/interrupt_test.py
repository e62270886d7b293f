"""Ctrl-C: what was measured is written, and the exit code is 130."""

import json
import os
import shutil
import signal
import time
import unittest

from ptbench import ONE, CliTest, changed, ended

# The second case lasts for minutes; the first one for milliseconds.
LONG = changed(ONE, size="256", spp="1,100000000,2") + ["--max-total-time", "0"]


class Interrupted(CliTest):
    def test_what_was_measured_is_written(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                process = self.start_and_wait_for_one_record(*LONG)
                process.send_signal(number)
                out, err = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 130, err)
                result = self.scratch.result()
                self.assertTrue(result["run"]["interrupted"])
                self.assertEqual([(r["params"]["spp"], ended(r)) for r in result["cases"]],
                                 [(1, "ok"), (100000000, "skipped"), (2, "skipped")])
                self.assertEqual([r["reason"] for r in result["cases"][1:]], ["interrupted"] * 2)
                self.assertIn("interrupted: these are the cases measured until then", out)
                self.assertIn("written: out/result.json", err)
                self.assertIn("go on with: ptbench --resume out/journal.jsonl", err)
                (self.scratch.work / "out/journal.jsonl").unlink()

    def test_a_batch_system_that_ends_all_processes_leaves_no_crash(self):
        process = self.start_and_wait_for_one_record(*LONG)
        for worker in set(map(int, self.scratch.processes())) - {process.pid}:  # which hears of it first
            os.kill(worker, signal.SIGTERM)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 130)
        self.assertEqual([(r["status"], r["reason"]) for r in self.scratch.result()["cases"][1:]],
                         [("skipped", "interrupted")] * 2)

    def test_another_run_is_kept_out_of_the_folder_until_the_first_ends(self):
        process = self.start_and_wait_for_one_record(*LONG)
        begun = self.scratch.journal()
        for words in ((*ONE, "--out", "out"), (*ONE, "--out", "../work/out"), ("--resume", "out/journal.jsonl", "-q")):
            line = self.assert_refused(*words, says=["--out: ", "in use by another run"])
            self.assertIn("name another folder", line)
        self.assertEqual(self.scratch.journal(), begun)
        process.kill()  # with SIGKILL: nothing is tidied up
        process.wait()
        for left in (self.scratch.root / "tmp").iterdir():
            shutil.rmtree(left)
        self.run_ok(*ONE, "--out", "out", "-q")

    def test_a_second_one_ends_at_once_and_leaves_the_journal(self):
        process, terminal = self.start_in_terminal(*LONG, "--no-isolate", "--out", "out")  # which cannot stop within a case
        terminal.wait_for(r"\[2/3\][^\r]* (warmup|sample) ")
        process.send_signal(signal.SIGINT)
        time.sleep(0.2)
        self.assertIsNone(process.poll(), "one signal was enough; nothing is tested")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        lines = [json.loads(line) for line in self.scratch.journal()]
        self.assertEqual([ended(line) for line in lines[1:]], ["ok"])
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
