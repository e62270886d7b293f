"""Runs ptbench in a scratch folder of its own, with PoCL's driver alone."""

import copy
import json
import os
import pathlib
import pty
import re
import select
import shutil
import statistics
import subprocess
import tempfile
import time
import unittest

BINARY = os.environ["PTBENCH"]
SOURCE = pathlib.Path(os.environ["PTB_SOURCE_DIR"])

# A case that takes milliseconds; its validation at path length 2 takes less than a second.
TINY = ("--kernel", "pt", "--size", "16", "--spp", "2", "--path-length", "2", "--wg", "implicit", "--samples", "1",
        "--warmup", "0", "--timeout", "60")
ONE = ("-d", "pocl:1", *TINY)


def pocl_icd():
    """The installed .icd file of PoCL."""
    folder = pathlib.Path(os.environ.get("OCL_ICD_VENDORS") or "/etc/OpenCL/vendors")
    return next(file for file in sorted(folder.glob("*.icd")) if "pocl" in file.read_text())


def changed(words, **values):
    """`words` with other values: changed(TINY, spp=4, path_length=5)."""
    words = [str(word) for word in words]
    for flag, value in values.items():
        words[words.index("--" + flag.replace("_", "-")) + 1] = str(value)
    return words


def ended(record):
    """How a case ended. Whether other programs disturbed its times is not for tests to tell, but where they are about that."""
    return "ok" if record["status"] == "unstable" else record["status"]


def undisturbed(result):
    """The result as a machine without other programs would have it: of every timed case steady times around the median."""
    result = copy.deepcopy(result)
    for case in filter(lambda case: case["statistics"], result["cases"]):
        case.update(status=ended(case), reason="")
        middle, samples = round(case["statistics"]["median_ns"]) * case["work"]["renders"], case["samples"]
        for i, sample in enumerate(samples):
            ns = middle + middle // 1000 * (i - len(samples) // 2)
            sample.update(kernel_ns=ns, sum_ns=ns, host_ns=ns + 20_000, cause="")
        times = sorted(sample["kernel_ns"] / case["work"]["renders"] for sample in samples)
        q1, median, q3 = statistics.quantiles(times, method="inclusive")
        outer = {9: 1, 12: 2}[len(times)]  # the median is between these order statistics, from both ends, with 95 %
        case["statistics"].update(
            timer="event", timer_reason="", n=len(times), flagged=0, median_ns=median, q1_ns=q1, q3_ns=q3, mean_ns=statistics.mean(times),
            mad_ns=statistics.median(abs(time - median) for time in times), min_ns=times[0], max_ns=times[-1], ci_low_ns=times[outer],
            ci_high_ns=times[-1 - outer])
    return result


class Scratch:
    """A folder to work in, a folder of drivers and one for temporary files; used by a class or by each test."""

    def __init__(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="ptbench-cli-"))
        for name in ("work", "icds", "tmp"):
            (self.root / name).mkdir()
        self.work, self.icds = self.root / "work", self.root / "icds"
        shutil.copy(pocl_icd(), self.icds / "pocl.icd")

    def remove(self):
        shutil.rmtree(self.root)

    def environment(self, **variables):
        kept = {name: value for name, value in os.environ.items() if not name.startswith("PTBENCH")}
        return {**kept, "XDG_CONFIG_HOME": str(self.root / "config"), "OCL_ICD_VENDORS": str(self.icds), "OCL_ICD_FILENAMES": "",
                "TMPDIR": str(self.root / "tmp"), **variables}

    def start(self, *words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, folder=None,
              **variables):
        """In a folder of `work`, or in it."""
        return subprocess.Popen([BINARY, *map(str, words)], cwd=self.work / (folder or ""),
                                env=self.environment(**variables), stdin=stdin, stdout=stdout, stderr=stderr, text=True)

    def run(self, *words, timeout=60, **options):
        with self.start(*words, **options) as process:
            try:
                out, err = process.communicate(timeout=timeout)
            except subprocess.TimeoutExpired:
                process.kill()
                raise
        return subprocess.CompletedProcess(process.args, process.returncode, out, err)

    def write(self, name, content):
        text = content if isinstance(content, str) else json.dumps(content)
        (self.work / name).parent.mkdir(parents=True, exist_ok=True)
        (self.work / name).write_text(text)
        return name

    def result(self, folder="out"):
        return json.loads((self.work / folder / "result.json").read_text())

    def journal(self, folder="out"):
        """Lines of a run's journal so far: the header, then a record a line."""
        file = self.work / folder / "journal.jsonl"
        return file.read_text().splitlines() if file.exists() else []

    def files(self):
        return sorted(str(file.relative_to(self.work)) for file in self.work.rglob("*"))

    def processes(self):
        """Numbers of the processes that were started here, or by one of them, and still run."""
        def environment(file):
            try:
                return file.read_bytes()
            except OSError:  # another user's, or of one that has just ended
                return b""

        return [file.parent.name for file in pathlib.Path("/proc").glob("[0-9]*/environ") if str(self.root).encode() in environment(file)]

    def launcher(self, script):
        """Flags for a launcher; in the bash script "$@" is the worker's command."""
        file = self.root / "launcher.sh"
        file.write_text(f"#!/bin/bash\n{script}\n")
        file.chmod(0o755)
        return ("--launcher", file)

    def temporary_files(self):
        return sorted(file.name for file in (self.root / "tmp").iterdir())


class Terminal:
    """What a process shows on one, as it comes: moments of its progress."""

    def __init__(self):
        self.ours, self.theirs = pty.openpty()
        self.shown = b""

    @property
    def text(self):
        """Line ends are as they were written."""
        return self.shown.decode().replace("\r\n", "\n")

    def more(self):
        """False once the other side is closed."""
        assert select.select([self.ours], [], [], 60)[0], f"nothing more is shown after {self.shown}"
        try:
            block = os.read(self.ours, 4096)
        except OSError:
            block = b""
        self.shown += block
        return bool(block)

    def wait_for(self, pattern):
        while not re.search(pattern, self.text):
            assert self.more(), f"it ended without {pattern}: {self.text}"

    def end_of(self, process):
        """The exit code, once all is read."""
        while self.more():
            pass
        process.communicate(timeout=60)
        return process.returncode


class CliTest(unittest.TestCase):
    """Each test has a scratch folder; none may leave temporary files."""

    def setUp(self):
        self.scratch = Scratch()
        self.addCleanup(self.scratch.remove)

    def tearDown(self):
        self.assertEqual(self.scratch.temporary_files(), [], "temporary files are left behind")

    def start(self, *words, **options):
        """A process that does not outlive the test."""
        process = self.scratch.start(*words, **options)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def start_in_terminal(self, *words, **variables):
        """A process, and the terminal that has its stderr."""
        terminal = Terminal()
        process = self.start(*words, stderr=terminal.theirs, **{"TERM": "xterm", **variables})
        os.close(terminal.theirs)
        self.addCleanup(os.close, terminal.ours)
        return process, terminal

    def wait_for(self, condition, process):
        deadline = time.monotonic() + 60
        while not condition():
            self.assertIsNone(process.poll(), "the process ended by itself")
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.02)

    def start_and_wait_for_one_record(self, *words):
        """Of a run into out."""
        process = self.start(*words, "--out", "out")
        self.wait_for(lambda: len(self.scratch.journal()) == 2, process)
        return process

    def run_ok(self, *words, code=0, **options):
        result = self.scratch.run(*words, **options)
        if code is not None:
            self.assertEqual(result.returncode, code, f"{result.args}\n{result.stdout}{result.stderr}")
        return result

    def assert_refused(self, *words, says=(), code=2, **variables):
        """One line on stderr with every part of `says`, the exit code, nothing on stdout, no file."""
        before = self.scratch.files()
        result = self.run_ok(*words, code=code, **variables)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, lines[0])
        for noise in ("what()", "terminate", "exception", "std::"):
            self.assertNotIn(noise, lines[0])
        self.assertEqual(result.stdout, "")
        self.assertEqual(self.scratch.files(), before, "files were left behind")
        return lines[0]

    def only_case(self, *words, code=0, **options):
        """The single record of a run into `out`."""
        self.run_ok(*words, "--out", "out", "-q", code=code, **options)
        (record,) = self.scratch.result()["cases"]
        return record
