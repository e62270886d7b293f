"""Workers behind --launcher: shell scripts that start them as clusters do, and worse; no process may be left."""

import shutil
import signal
import unittest

from formats import pfm_pixels, png_size
from ptbench import ONE, SOURCE, CliTest, changed, ended

# "$@" is the worker's command.
PLAIN = '"$@"'
LATE = 'sleep 2.5; "$@"'
KEEPS_STDIN_OPEN = '"$@" < <(cat; sleep 1000)'
IN_A_GROUP_OF_ITS_OWN = 'setsid --wait "$@"'
NEVER = 'echo "job 12 queued" >&2; sleep 1000'
TWO = '{ tee >("$@" >&3) | "$@"; } 3>&1'
TWO_SESSIONS = f'case "$*" in *--device*) {TWO} ;; *) "$@" ;; esac'
NO_SESSION = 'case "$*" in *--device*) echo "node is down" >&2; exit 1 ;; *) "$@" ;; esac'

# The second case lasts for minutes; the first one for milliseconds.
LONG = changed(ONE, size="256", spp="1,100000000") + ["--max-total-time", "0"]


class Launchers(CliTest):
    def tearDown(self):
        self.assertEqual(self.scratch.processes(), [], "processes are left behind")
        super().tearDown()

    def statuses(self):
        return [ended(case) for case in self.scratch.result()["cases"]]

    def test_a_run_behind_one_is_a_run(self):
        for script in (PLAIN, LATE, KEEPS_STDIN_OPEN, IN_A_GROUP_OF_ITS_OWN):
            with self.subTest(script):
                self.run_ok(*ONE, *self.scratch.launcher(script), "--out", "out", "-q")
                self.assertEqual(self.statuses(), ["ok"])
                self.assertEqual(png_size((self.scratch.work / "out/pocl-1.png").read_bytes()), (16, 16))
                shutil.rmtree(self.scratch.work / "out")

    def test_an_interruption_leaves_nothing(self):
        for script in (PLAIN, KEEPS_STDIN_OPEN, IN_A_GROUP_OF_ITS_OWN):
            with self.subTest(script):
                process = self.start_and_wait_for_one_record(*LONG, *self.scratch.launcher(script), "-q")
                process.send_signal(signal.SIGINT)
                _, err = process.communicate(timeout=30)
                self.assertEqual(process.returncode, 130, err)
                self.assertEqual(self.statuses(), ["ok", "skipped"])
                shutil.rmtree(self.scratch.work / "out")

    def test_two_workers_are_refused(self):
        self.assert_refused(*ONE, *self.scratch.launcher(TWO), says=["--launcher: found two workers", "allowed: one"])
        result = self.run_ok(*ONE, *self.scratch.launcher(TWO_SESSIONS), "--out", "out", "-q", code=2)
        self.assertIn("--launcher: found two workers", result.stderr)
        self.assertFalse((self.scratch.work / "out/result.json").exists())

    def test_without_a_worker_a_run_has_failed(self):
        self.assert_refused(*ONE, *self.scratch.launcher(NEVER), "--start-timeout", "1", "-q", code=1,
                            says=["--launcher: no worker within 1 s (--start-timeout)", "job 12 queued"])
        self.assert_refused(*ONE, *self.scratch.launcher("echo 'Invalid node name' >&2; exit 3"), code=1,
                            says="--launcher: no worker: exited with code 3: Invalid node name")
        result = self.run_ok(*ONE, *self.scratch.launcher(NO_SESSION), "--out", "out", code=1)
        self.assertEqual(self.statuses(), ["skipped"])
        self.assertIn("the worker of pocl:1 fails to start: exited with code 1: node is down", result.stdout)

    def test_a_wait_is_told(self):
        result = self.run_ok(*ONE, *self.scratch.launcher('echo "job 12 queued" >&2; ' + LATE), "--dry-run")
        self.assertIn("waiting for a worker of --launcher: job 12 queued\n", result.stderr)

    def test_a_picture_arrives_from_another_folder(self):
        self.run_ok(*ONE, *self.scratch.launcher('cd /; "$@"'), "--out", "out", "-q")
        self.assertEqual(self.statuses(), ["ok"])
        self.assertEqual(png_size((self.scratch.work / "out/pocl-1.png").read_bytes()), (16, 16))

    def test_a_picture_that_cannot_be_written_costs_no_time(self):
        self.scratch.write("out/pocl-1.png/in_the_way", "")
        result = self.run_ok(*ONE, "--out", "out")
        self.assertEqual(self.statuses(), ["ok"])
        self.assertIn("no picture of pocl:1: ", result.stdout)

    def test_another_scene_there_is_not_timed(self):
        scene = (SOURCE / "configs/scenes/free_light.json").read_text()
        self.scratch.write("mine.json", scene)
        self.scratch.write("there/mine.json", scene.replace("40", "41"))
        self.run_ok(*ONE, "--scene", "mine.json", *self.scratch.launcher('cd there; "$@"'), "--out", "out", "-q", code=1)
        (record,) = self.scratch.result()["cases"]
        self.assertEqual((record["status"], record["samples"], record["statistics"]), ("runtime", [], None))
        self.assertRegex(record["reason"], r"scene mine.json: found the content \w{16} where the worker is; allowed: \w{16}")

    def test_render_renders_there(self):
        icds = self.scratch.root / "icds_there"
        self.scratch.icds.rename(icds)  # here is no driver
        self.scratch.icds.mkdir()
        there = self.scratch.launcher(f'cd /; OCL_ICD_VENDORS={icds} "$@"')
        words = ("render", "-d", "pocl:1", "--size", "12x8", "--spp", "4", "--path-length", "5", "-o", "x.pfm", "-q")
        self.run_ok(*words, *there)
        size, pixels = pfm_pixels((self.scratch.work / "x.pfm").read_bytes())
        self.assertEqual(size, (12, 8))
        self.assertGreater(max(pixels), 0)

    def test_an_interrupted_render_there_keeps_what_there_is(self):
        process, terminal = self.start_in_terminal("render", "-d", "pocl:1", "--size", "32", "--spp", "500000", "--path-length", "5",
                                                   "-o", "part.pfm", *self.scratch.launcher(IN_A_GROUP_OF_ITS_OWN))
        terminal.wait_for(r"[1-9]\d* %")
        process.send_signal(signal.SIGINT)
        self.assertEqual(terminal.end_of(process), 130, terminal.text)
        self.assertRegex(terminal.text, r"\033\[Kwritten: part.pfm \([\d.e+]+ SPP in [\d.]+ s; interrupted: as far as it got\)\n$")
        self.assertEqual(pfm_pixels((self.scratch.work / "part.pfm").read_bytes())[0], (32, 32))


if __name__ == "__main__":
    unittest.main()
