"""scripts/ci/gate.sh on two revisions of a repository whose build takes no time."""

import json
import shutil
import subprocess
import unittest

from ptbench import BINARY, SOURCE, TINY, CliTest

BUILD = """cmake_minimum_required(VERSION 3.21)
project(tiny NONE)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
file(CREATE_LINK %s ${CMAKE_BINARY_DIR}/bin/ptbench SYMBOLIC)
add_custom_target(ptbench)
"""


class Repository(CliTest):
    def git(self, *words):
        identity = ("-c", "user.name=a", "-c", "user.email=a@b")
        subprocess.run(["git", *identity, *words], cwd=self.scratch.work, check=True, capture_output=True)

    def make_repository(self, script):
        work = self.scratch.work
        (work / "scripts/ci").mkdir(parents=True)
        for file in (script, "scripts/packages.sh", "CMakePresets.json"):
            shutil.copy(SOURCE / file, work / file)
        self.scratch.write(".gitignore", "build/\n")
        self.scratch.write("CMakeLists.txt", BUILD % BINARY)
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-qm", "base")
        self.git("commit", "-qm", "change", "--allow-empty")


class Recipe(Repository):
    def gate(self, *words):
        environment = self.scratch.environment(GITHUB_STEP_SUMMARY=str(self.scratch.work / "summary.md"))
        return subprocess.run(["scripts/ci/gate.sh", *words], cwd=self.scratch.work, env=environment,
                              capture_output=True, text=True, check=False)

    def test_two_equal_revisions_pass_and_leave_the_decision(self):
        self.make_repository("scripts/ci/gate.sh")
        run = self.gate("HEAD~1", "-d", "pocl:1", *TINY[:8], "--wg", "implicit", "--tolerance", "100%")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        decision = json.loads((self.scratch.work / "gate-results/gate.json").read_text())
        self.assertEqual(decision["schema"], "ptbench.ab.v1")
        table = (self.scratch.work / "gate-results/gate.md").read_text()
        self.assertEqual((self.scratch.work / "summary.md").read_text(), table)
        self.assertIn("pocl:1", table + run.stdout)

    def test_what_is_not_a_revision_is_refused(self):
        self.make_repository("scripts/ci/gate.sh")
        run = self.gate("nowhere")
        self.assertNotEqual(run.returncode, 0)
        self.assertIn("nowhere", run.stderr)
        self.assertNotEqual(self.gate().returncode, 0)


if __name__ == "__main__":
    unittest.main()
