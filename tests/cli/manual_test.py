"""The man page and the completions know what --help knows, and their readers take them."""

import gzip
import json
import os
import pathlib
import re
import subprocess
import unittest

from ptbench import CliTest

MANUAL = pathlib.Path(os.environ["PTB_BINARY_DIR"]).parent / "bench/manual"
PAGE = gzip.decompress((MANUAL / "ptbench.1.gz").read_bytes()).decode()
FLAG = re.compile(r"(?<![\w-])--?[a-zA-Z][\w-]*")


class Manual(CliTest):
    def help(self, *command):
        return self.run_ok(*command, "--help").stdout

    def commands(self):
        listed = self.help().split("Subcommands:")[1].split("\n\n")[0]
        return re.findall(r"^  (\w+) ", listed, re.M)

    def flags(self, *command):
        """The flags that lines of --help begin with."""
        lines = re.findall(r"^  (-\S+)", self.help(*command), re.M)
        return {flag for line in lines for flag in FLAG.findall(line)}

    def test_the_man_page_has_every_flag_of_every_command(self):
        page = PAGE.replace("\\-", "-")
        program, rest = page.split(".SH COMMANDS")
        sections = dict(re.findall(r"^\.SS (\w+)\n(.*?)(?=^\.S[SH] )", rest, re.M | re.S))
        self.assertEqual(list(sections), self.commands())
        for command, text in [(None, program), *sections.items()]:
            with self.subTest(command):
                found = {flag for bold in re.findall(r"^(\\fB-.*)$", text, re.M) for flag in
                         re.findall(r"\\fB(-[^\\ ]*)\\fR", bold)}
                self.assertEqual(found, self.flags(*([command] if command else [])))

    def test_roff_has_nothing_to_say(self):
        run = subprocess.run(["groff", "-man", "-ww", "-z"], input=PAGE, capture_output=True, text=True, check=True)
        self.assertEqual(run.stdout + run.stderr, "")

    def complete(self, *words):
        """What bash offers for the last of `words`."""
        typed = " ".join(f"'{word}'" for word in ("ptbench", *words))
        script = (f"source {MANUAL}/ptbench; COMP_WORDS=({typed}); COMP_CWORD={len(words)}; _ptbench; "
                  "printf '%s\\n' \"${COMPREPLY[@]}\"")
        run = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True)
        return set(run.stdout.split())

    def test_bash_offers_commands_flags_and_known_values(self):
        self.assertEqual(self.complete(""), {"run", *self.commands()})
        for command in self.commands():
            self.assertEqual(self.complete(command, "-"), self.flags(command), command)
        self.assertEqual(self.complete("--"), {flag for flag in self.flags() if flag.startswith("--")})
        self.assertEqual(self.complete("--timer", ""), {"auto", "event", "host"})
        self.assertEqual(self.complete("ab", "--profile", "d"), {"dedicated"})
        self.assertEqual(self.complete("report", "--format", "github-action-"),
                         {"github-action-smaller", "github-action-bigger"})
        for command, flag, listed in (("run", "--config", "configs"), ("render", "--scene", "scenes"),
                                      ("tune", "--kernel", "kernels")):
            names = json.loads(self.run_ok("list", "--json").stdout)[listed]
            self.assertLessEqual(set(names), self.complete(command, flag, ""))
        here = str(pathlib.Path(__file__))
        self.assertEqual(self.complete("--config", here[:-1]), {here})

    def test_zsh_takes_its_completions(self):
        subprocess.run(["zsh", "-n", MANUAL / "_ptbench"], check=True)


if __name__ == "__main__":
    unittest.main()
