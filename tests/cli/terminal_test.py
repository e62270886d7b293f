"""Progress on terminals: kept up to date in one line where the cursor moves, plain lines elsewhere."""

import unittest

from ptbench import ONE, CliTest

PICTURE = ("render", "-d", "pocl:1", "--size", "8", "--spp", "1", "--path-length", "2", "-o", "x.pfm")


class Terminal(CliTest):
    def shown(self, *words, **variables):
        process, terminal = self.start_in_terminal(*words, **variables)
        self.assertEqual(terminal.end_of(process), 0, terminal.text)
        return terminal.text

    def test_one_that_moves_its_cursor_has_a_live_line(self):
        for words in (PICTURE, ONE):
            with self.subTest(words[0]):
                self.assertIn("\r\033[K", self.shown(*words, TERM="xterm"))

    def test_one_that_is_dumb_or_has_no_name_gets_plain_lines(self):
        for term in ("dumb", ""):
            for words in (PICTURE, ONE):
                with self.subTest(term=term, words=words[0]):
                    text = self.shown(*words, TERM=term)
                    self.assertIn("\n", text)
                    self.assertNotRegex(text, "[\r\033]")


if __name__ == "__main__":
    unittest.main()
