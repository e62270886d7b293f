"""The .deb packages: lintian has no error to report, and what they hold runs from another root."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

BUILD = pathlib.Path(os.environ["PTB_BINARY_DIR"])


def run(*command, code=0, **environment):
    words = [str(word) for word in command]
    result = subprocess.run(words, cwd="/", env={**os.environ, **environment}, capture_output=True, text=True,
                            timeout=250, check=False)
    if result.returncode != code:
        raise AssertionError(f"{words} exits {result.returncode}:\n{result.stdout}{result.stderr}")
    return result.stdout + result.stderr


class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.work = pathlib.Path(folder.name)
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.work)
        cls.packages = {file.name.split("_")[0]: file for file in cls.work.glob("*.deb")}
        run("dpkg", "-x", cls.packages["ptbench"], cls.work / "root")
        cls.program = cls.work / "root/usr/bin/ptbench"

    def test_there_are_two(self):
        self.assertEqual(sorted(self.packages), ["libptbench-dev", "ptbench"])

    def test_lintian_finds_no_error(self):
        for package in self.packages.values():
            with self.subTest(package.name):
                run("lintian", "--allow-root", "--fail-on", "error", package)

    def test_the_program_finds_its_files(self):
        listing = json.loads(run(self.program, "list", "--json"))
        self.assertTrue(listing["devices"])
        self.assertIn("thesis", listing["scenes"])

    def test_without_a_driver_it_says_what_to_install(self):
        (self.work / "no drivers").mkdir()
        said = run(self.program, "--all-devices", code=77, OCL_ICD_VENDORS=str(self.work / "no drivers"))
        self.assertIn("apt-get install pocl-opencl-icd", said)

    def test_man_page_and_completions_lie_where_they_are_looked_for(self):
        for file in ("man/man1/ptbench.1.gz", "bash-completion/completions/ptbench", "zsh/vendor-completions/_ptbench"):
            self.assertTrue((self.work / "root/usr/share" / file).is_file(), file)


if __name__ == "__main__":
    unittest.main()
