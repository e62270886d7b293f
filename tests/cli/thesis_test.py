"""docs/thesis.md is what scripts/thesis.py makes of it: every command runs, and tables and pictures are where it puts them."""

import re
import subprocess
import sys
import unittest

from formats import png_size
from ptbench import BINARY, SOURCE, CliTest

sys.path.insert(0, str(SOURCE / "scripts"))
from thesis import PICTURES, pictures_of, steps  # noqa: E402

DOCUMENT = SOURCE / "docs/thesis.md"
SMALL = ((r"--size \d+", "--size 16"), (r"--spp \d+", "--spp 4"), (r"--time \d+", "--time 0.2"), (r"--path-length 10", "--path-length 3"), (r"knot,hair", "cornell,knot"),
         (r"--config thesis", "--config thesis --size 16 --spp 2,4 --path-length 2"))
MOST_BYTES = 150_000


def in_small(text):
    """The document with commands that take a moment. Pictures keep their names."""
    def shorter(line):
        for found, put in SMALL:
            line = re.sub(found, put, line)
        return line
    return "".join(shorter(line) if line.startswith("ptbench") else line for line in text.splitlines(keepends=True))


def prose(text):
    """The document without what was made."""
    return re.sub(r"(<!-- made: \w+ -->).*?(<!-- end -->)", r"\1\2", text, flags=re.S)


def shapes(text):
    """Of each thing made: its kind, its lines, and how many cells they have."""
    return [(step["kind"], [line.count("|") for line in step["made"].splitlines()]) for step, _ in steps(text) if step["kind"]]


class Thesis(CliTest):
    def test_the_script_makes_the_document(self):
        text = DOCUMENT.read_text()
        copy = self.scratch.work / self.scratch.write("docs/thesis.md", in_small(text))
        pictures = copy.parent / PICTURES
        made = subprocess.run([sys.executable, "-B", SOURCE / "scripts/thesis.py", BINARY, "-d", "pocl:0", "--document", copy], cwd=self.scratch.work,
                              env=self.scratch.environment(), capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        again = copy.read_text()
        self.assertEqual(prose(again), prose(in_small(text)))
        self.assertEqual(shapes(again), shapes(text), "made by other commands than stand there")
        named = set(re.findall(rf"\({PICTURES}/([^)]+)\)", text))
        self.assertEqual({file.name for file in pictures.iterdir()}, named)
        self.assertTrue(all(png_size((pictures / name).read_bytes()) == (16, 16) for name in named))

    def test_pictures_are_there_and_small(self):
        for _, commands in steps(DOCUMENT.read_text()):
            for file in pictures_of(commands):
                with self.subTest(file):
                    self.assertLess((DOCUMENT.parent / PICTURES / file).stat().st_size, MOST_BYTES)

    def test_a_command_that_fails_ends_it_and_leaves_the_document(self):
        text = "```sh\nptbench render -d 0 --kernel nothing -o x.png\n```\n\n<!-- made: pictures -->\n<!-- end -->\n"
        copy = self.scratch.work / self.scratch.write("docs/thesis.md", text)
        made = subprocess.run([sys.executable, "-B", SOURCE / "scripts/thesis.py", BINARY, "--document", copy], cwd=self.scratch.work,
                              env=self.scratch.environment(), capture_output=True, text=True, check=False)
        self.assertEqual(made.returncode, 1)
        self.assertIn("--kernel nothing", made.stderr)
        self.assertEqual(copy.read_text(), text)


if __name__ == "__main__":
    unittest.main()
