"""Every command of README.md and docs/ runs as it stands there; a run that would take long, with --dry-run."""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import unittest

from ptbench import BINARY, ONE, SOURCE, CliTest

DOCUMENTS = ("README.md", "CONTRIBUTING.md", *sorted(f"docs/{file.name}" for file in (SOURCE / "docs").glob("*.md")))
SCREEN = 50  # lines of a README that sells
TREE = pathlib.Path(os.environ["PTB_BINARY_DIR"]).parent
SMALL = ("--kernel", "pt", "--size", "16", "--spp", "2", "--path-length", "2", "--wg", "implicit")
SHORT = ("compare ", "report ", "baseline", "list", "render", "--dry-run", "--dump-config", "--csv")  # these run for real


def commands():
    """Lines of the documents' ```sh blocks, without their comments; those of the thesis run in thesis_test.py."""
    for document in DOCUMENTS:
        if document == "docs/thesis.md":
            continue
        for block in re.findall(r"```sh\n(.*?)```", (SOURCE / document).read_text(), re.S):
            for line in block.splitlines():
                yield re.sub(r"\s+#.*", "", line)


class Readme(CliTest):
    def ptbench(self, line):
        redirected = re.fullmatch(r"(.*?) > (\S+)", line)
        words = shlex.split(redirected[1] if redirected else line)[1:]
        if "gpu" in words:
            words[words.index("gpu")] = "cpu"  # this test has none
        if words[0] == "ab":
            words = [BINARY if word.endswith("bin/ptbench") else word for word in words] + [*SMALL, "--tolerance", "100%"]
        elif words[0] == "tune":
            words += [*SMALL[2:], "--lanes", "16"]
        elif words[0] == "doctor":
            words.append("--no-aa")
        elif not any(part in line for part in SHORT):
            words.append("--dry-run")
        elif words[0].startswith("-") and "--dump-config" not in words:
            words += ["--samples", "3"]
        if "--dry-run" in words:
            words.append("-q")  # no estimates: each of them compiles a kernel
        result = self.run_ok(*words, timeout=300, POCL_DEVICES="pthread")
        if redirected:
            self.scratch.write(redirected[2], result.stdout)

    def shell(self, line):
        run = subprocess.run(line, shell=True, cwd=SOURCE, capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, f"{line}\n{run.stdout}{run.stderr}")

    def put_down_what_commands_name(self):
        self.run_ok(*ONE, "--json", "old.json", "-q")
        for name in ("new", "a1", "a2", "a3", "b1", "b2", "b3"):
            shutil.copy(self.scratch.work / "old.json", self.scratch.work / f"{name}.json")
        self.scratch.write("runs/1.json", (self.scratch.work / "old.json").read_text())
        self.scratch.write("my.json", self.run_ok("--config", "ci", "--dump-config").stdout)
        for name in ("old", "new"):
            shutil.copytree(SOURCE / "kernels", self.scratch.work / name / "kernels")

    def test_every_command_runs(self):
        self.put_down_what_commands_name()
        seen = set()
        for line in commands():
            with self.subTest(line):
                program = shlex.split(line)[0]
                seen.add(program)
                if program == "ptbench":
                    self.ptbench(line)
                elif program == "scripts/bench.sh":
                    self.shell(f"{line} --dry-run") if TREE == SOURCE / "build/release" else None
                elif program == "scripts/test.sh":
                    pass  # what runs this test
                elif line.startswith("cmake --preset"):
                    self.shell(f"{line} -N")
                elif line.startswith("cmake --build"):
                    self.shell(f"{line} -- -n") if TREE == SOURCE / "build/release" else None
                elif program.startswith("scripts/"):
                    self.assertTrue(os.access(SOURCE / program, os.X_OK), program)
                else:
                    self.fail(f"no way to test: {line}")
        self.assertGreaterEqual(seen, {"ptbench", "scripts/bench.sh", "scripts/test.sh", "cmake"})

    def test_links_lead_somewhere(self):
        for document in SOURCE.glob("**/*.md"):
            if "build" in document.relative_to(SOURCE).parts:
                continue
            for target in re.findall(r"\]\((?!https?:)([^)#]+)", document.read_text()):
                with self.subTest(document=document.name, target=target):
                    self.assertTrue((document.parent / target).exists())

    def test_the_readme_is_one_screen_and_leads_to_every_document(self):
        readme = (SOURCE / "README.md").read_text()
        self.assertLessEqual(len(readme.splitlines()), SCREEN)
        linked = set(re.findall(r"\]\((docs/[^)#]+)\)", readme))
        self.assertEqual(linked, {name for name in DOCUMENTS if name.startswith("docs/")})

    def test_the_board_is_that_of_the_archive(self):
        """Remade by: scripts/readme.py build/release/bin/ptbench"""
        sys.path.insert(0, str(SOURCE / "scripts"))
        from readme import board_rows
        rows = re.search(r"<!-- board -->\n\n((?:\|.*\n)+)", (SOURCE / "README.md").read_text())[1].splitlines()[2:]
        self.assertEqual([[cell.strip() for cell in row.strip("|").split("|")] for row in rows], list(board_rows()))

    def test_exit_codes_are_those_of_the_help(self):
        table = set(re.findall(r"^\| (\d+) \|", (SOURCE / "docs/ci.md").read_text(), re.M))
        told = self.run_ok("--help").stdout.split("Exit codes:")[1].split("\n")[0]
        self.assertEqual(table, set(re.findall(r"\b(\d+) ", told)))


if __name__ == "__main__":
    unittest.main()
