"""Which devices are found and chosen, and what is said when there is none, or a driver that cannot be used."""

import json
import os
import shutil
import unittest
from unittest import mock

from ptbench import ONE, TINY, CliTest


class NoDriver(CliTest):
    def setUp(self):
        super().setUp()
        (self.scratch.icds / "pocl.icd").unlink()

    def test_no_driver_at_all_says_what_to_install(self):
        for words in ((), ("-d", "gpu"), ("render", "-o", "x.png"), ("--dry-run",), ("tune",)):
            with self.subTest(words):
                self.assert_refused(*words, code=77, says=["no OpenCL device", "apt-get install pocl-opencl-icd"])

    def test_list_still_shows_what_needs_no_device(self):
        result = self.run_ok("list", "--json", code=77)
        self.assertIn("pocl-opencl-icd", result.stderr)
        listing = json.loads(result.stdout)
        self.assertEqual(listing["devices"], [])
        self.assertIn("pt", listing["kernels"])

    def test_a_driver_that_does_not_load_is_named(self):
        (self.scratch.icds / "bad.icd").write_text("libmissing.so.1\n")
        self.assert_refused(code=77, says=["bad.icd", "libmissing.so.1", "cannot open shared object file"])

    def test_a_driver_without_devices_is_named(self):
        shutil.copy("/dev/null", self.scratch.icds / "empty.icd")
        self.assert_refused(code=77, says=["empty.icd", "no device here"])


class NoCache(CliTest):
    @mock.patch.dict(os.environ)
    def test_pocl_without_a_cache_it_can_write_is_told_from_no_driver(self):
        self.scratch.write("file", "")
        for name in ("POCL_CACHE_DIR", "XDG_CACHE_HOME", "HOME"):
            os.environ.pop(name, None)
        for variable in ("HOME", "XDG_CACHE_HOME", "POCL_CACHE_DIR"):  # each goes before those before it
            os.environ[variable] = "file/x"
            for words in ((), ("render", "-o", "x.png"), ("list",)):
                with self.subTest(variable=variable, words=words):
                    err = self.run_ok(*words, code=77).stderr
                    self.assertRegex(err, r'pocl\.icd: PoCL cannot write its cache "file/x[^"]*": Not a directory; '
                                          r'set POCL_CACHE_DIR')
                    self.assertNotIn("install", err)


class OddDrivers(CliTest):
    def setUp(self):
        super().setUp()
        (self.scratch.icds / "bad.icd").write_text("libmissing.so.1\n")
        shutil.copy(self.scratch.icds / "pocl.icd", self.scratch.icds / "pocl_again.icd")

    def test_the_run_goes_on_without_them_and_says_why(self):
        result = self.run_ok(*ONE, "--out", "out")
        self.assertRegex(result.stdout, r"bad.icd is not usable: libmissing.so.1: cannot open shared object file")
        self.assertRegex(result.stdout, r"pocl@2:1 is not used: the same device as pocl:1, found again")
        written = self.scratch.result()
        (broken,) = written["broken_icds"]
        self.assertTrue(broken["icd"].endswith("bad.icd"))
        self.assertIn("libmissing.so.1", broken["reason"])
        self.assertEqual([case["params"]["device"] for case in written["cases"]], ["pocl:1"])
        excluded = {device["key"]: device["excluded"] for device in written["devices"]}
        self.assertEqual(excluded["pocl:1"], "")
        self.assertIn("the same device as pocl:1", excluded["pocl@2:1"])

    def test_list_shows_each_device_once_and_the_reasons(self):
        text = self.run_ok("list").stdout
        self.assertIn("not usable: ", text)
        self.assertEqual(text.count("compute units"), 2, text)
        self.assertEqual(text.count("not used: the same device as"), 2, text)

    def test_what_is_not_used_cannot_be_chosen(self):
        self.assert_refused("-d", "pocl@2:1", says=["pocl@2:1", "not used", "the same device as pocl:1"])

    def test_verbose_says_what_is_left_out(self):
        text = self.run_ok(*ONE, "-v", "--dry-run").stderr
        self.assertIn("not usable: ", text)
        self.assertIn("not used: pocl@2:0", text)


class Selectors(CliTest):
    def chosen(self, *words):
        lines = self.run_ok(*words, *TINY, "--dry-run", "-q").stdout.splitlines()
        return [line.split()[0] for line in lines]

    def test_words_indices_keys_and_patterns(self):
        both = ["pocl:0", "pocl:1"]
        for words, devices in [
            ((), both),
            (("--all-devices",), both),
            (("-d", "cpu"), both),
            (("-d", "1"), ["pocl:1"]),
            (("-d", "0:1"), ["pocl:1"]),
            (("-d", "pocl:0", "-d", "0"), ["pocl:0"]),
            (("-d", "1,pocl:0"), both),
            (("-d", "/^(PTHREAD|CPU-(?!MINIMAL))/"), ["pocl:1"]),  # as PoCL 3, and as PoCL 6 call it
            (("-d", "1", "--all-devices"), both),
        ]:
            with self.subTest(words):
                self.assertEqual(self.chosen(*words), devices)

    def test_a_selector_that_matches_nothing_lists_what_there_is(self):
        there_is = ["0 = pocl:0", "1 = pocl:1", "all, cpu, gpu, accelerator"]
        line = self.assert_refused("-d", "gpu", says=['"gpu" matches none', *there_is])
        self.assertNotIn("did you mean", line)
        self.assert_refused("-d", "pocl:7", says=["did you mean pocl:0?", *there_is])
        self.assert_refused("-d", "cpuu", says=["did you mean cpu?", *there_is])
        self.assert_refused("-d", "/[/", says="no regular expression")
        self.assert_refused("render", "-d", "gpu", "-o", "x.png", says=['"gpu" matches none', *there_is])

    def test_render_takes_all_that_are_selected(self):
        small = ("render", "--size", "8", "--spp", "1", "--path-length", "2", "-o", "x.png")
        for words, devices in [(("-d", "cpu"), 2), (("-d", "0,1"), 2), (("-d", "pocl:1"), 0), ((), 0)]:
            with self.subTest(words):
                said = self.run_ok(*small, *words).stderr
                self.assertEqual(said.count("pocl:"), devices, said)

    def test_a_launcher_that_does_not_start(self):
        self.assert_refused(*ONE, "--launcher", "/missing/srun", says=["--launcher", "/missing/srun"])


class Listing(CliTest):
    def test_json_holds_what_a_run_can_name(self):
        listing = json.loads(self.run_ok("list", "--json").stdout)
        self.assertEqual([device["key"] for device in listing["devices"]], ["pocl:0", "pocl:1"])
        self.assertLessEqual({"pt", "thesis"}, set(listing["kernels"]))
        self.assertLessEqual({"thesis", "furnace", "free_light"}, set(listing["scenes"]))
        self.assertLessEqual({"quick", "thesis", "cards", "ci", "ladder", "rays", "speed", "memory", "queues", "quality", "workgroups"}, set(listing["configs"]))
        self.assertIn("work_group", listing["axes"])
        self.assertEqual(listing["broken_icds"], [])
        self.assertEqual(listing["peaks"], [])

    def test_text_has_the_facts_that_matter(self):
        text = self.run_ok("list").stdout
        for word in ("pocl:0", "pocl:1", "CPU", "compute units", "memory", "work-groups up to", "lanes", "driver"):
            self.assertIn(word, text)
        self.assertEqual(text, self.run_ok("-l").stdout)


if __name__ == "__main__":
    unittest.main()
