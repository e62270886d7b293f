"""A mistake in flags, axes, configs or scenes: exit code 2, one line that says what and what is allowed, no file."""

import json
import re
import unittest

from ptbench import ONE, SOURCE, CliTest

THESIS_SCENE = (SOURCE / "configs/scenes/thesis.json").read_text()


class Flags(CliTest):
    def refused(self, *words, says):
        return self.assert_refused(*words, says=["error: ", *says])

    def test_an_unknown_flag_gets_the_nearest_match(self):
        self.refused("--sppp", "10", says=["--sppp", "did you mean --spp?"])
        self.refused("render", "--outptu", "x.png", says=["--outptu", "did you mean --output?"])
        self.refused("list", "--jsn", says=["--jsn", "did you mean --json?"])

    def test_an_unknown_command_gets_the_nearest_match(self):
        self.refused("rendr", says=["rendr", "did you mean render?", "run, list, render, compare, ab"])
        self.refused("list", "extra", says=['unexpected word "extra"'])
        self.refused("--spp", "1", "2", says=['unexpected word "2"'])

    def test_a_flag_before_the_command_is_not_dropped(self):
        self.refused("-d", "gpu", "render", "-o", "x.png", says=["render", "comes first"])
        self.refused("run", "list", says=["list", "comes first"])

    def test_values_out_of_range(self):
        for words, allowed in [
            (("--size", "0"), "N or WIDTHxHEIGHT"),
            (("--size", "16x"), "N or WIDTHxHEIGHT"),
            (("--size", "100000x100000"), "pixels in all"),
            (("--spp", "0"), "an integer from 1"),
            (("--spp", "99999999999"), "an integer from 1"),
            (("--path-length", "0"), "an integer from 1"),
            (("--path-length", "-3"), "an integer from 1"),
            (("--wg", "0"), "implicit"),
            (("--wg", "8y8"), "implicit"),
            (("--lanes", "5"), "auto, 1, 4, 8, 16"),
            (("--samples", "0"), "an integer from 1 to 1000000"),
            (("--samples", "1.5"), "an integer from 1 to 1000000"),
            (("--warmup", "-1"), "an integer from 0"),
            (("--seed", "4294967296"), "to 4294967295"),
            (("--max-time", "nan"), "more than 0"),
            (("--max-time", "1e10"), "at most 1e9"),
            (("--timeout", "0"), "more than 0"),
            (("--max-total-time", "-1"), "0 or more"),
            (("--timer", "sun"), "auto"),
            (("--color", "pink"), "never"),
            (("--kernel-dir", "missing"), "missing"),
        ]:
            with self.subTest(words):
                axis = {"--wg": "work_group"}.get(words[0], words[0].strip("-").replace("-", "_"))
                line = self.refused(*words, says=[allowed])
                self.assertTrue(words[0] in line or axis in line, line)

    def test_an_empty_value_of_any_option_that_help_lists(self):
        """What a script passes on from a variable that nobody set must not switch a gate off."""
        tried = 0
        for command in ("run", "list", "render", "compare", "ab", "tune", "doctor", "report"):
            listed = self.run_ok(command, "--help").stdout
            for flag in re.findall(r"^ +(?:-\w,)?(--[a-z-]+) (?:TEXT|VALUES|INT|UINT|FLOAT)", listed, re.MULTILINE):
                with self.subTest(command=command, flag=flag):
                    self.refused(command, flag, "", says=[f'{flag}: found ""; allowed: '])
                    tried += 1
        self.assertGreater(tried, 80)
        self.refused("--dry-run", "--baseline=", "--csv", "x", says=['--baseline: found ""', "a name or a result file"])
        self.assert_refused("--dry-run", PTBENCH_BASELINE="", says=['--baseline: found ""', "PTBENCH_BASELINE"])
        self.assert_refused("--dry-run", PTBENCH_QUIET="", says=['--quiet: found ""', "true, false"])

    def test_more_samples_at_least_than_at_most(self):
        self.refused("--min-samples", "20", "--max-samples", "10", says=["--min-samples: found 20", "--max-samples, 10"])
        self.refused("--samples", "3", "--min-samples", "4", says=["--min-samples: found 4", "at most --max-samples, 3"])
        listed = self.run_ok("--max-samples", "4", "--dump-config").stdout
        self.assertEqual([json.loads(listed)[key] for key in ("min_samples", "max_samples")], [4, 4])
        name = self.scratch.write("my.json", {"min_samples": 9, "max_samples": 8})
        self.refused("--config", name, says=["my.json: /min_samples: found 9", "at most max_samples, 8"])

    def test_what_the_file_system_refuses_is_said_in_our_words(self):
        long = "x" * 5000
        for words, says in [(("--scene", long), "scene: found"), (("--baseline", long), "--baseline: found"),
                            (("--out", long), "--out: cannot create"), (("--config", long), "config: found"),
                            (("--resume", long), "--resume"), (("--csv", long), "--csv: cannot write"),
                            (("--tune-file", long), "cannot read"), (("--kernel-dir", long), "--kernel-dir")]:
            with self.subTest(words[0]):
                line = self.assert_refused(*ONE, *words, says=says)
                self.assertNotIn("filesystem error", line)
        line = self.assert_refused(*ONE, TMPDIR="/missing", says="TMPDIR: found /missing, which is no folder")
        self.assertNotIn("filesystem error", line)

    def test_work_that_no_counter_holds(self):
        self.refused("--spp", "2147483647", says=["spp x path_length", "2147483647 x 128", "4294967296"])

    def test_repeated_and_contradictory_flags(self):
        self.refused("--spp", "1", "--spp", "2", says=["--spp: given twice"])
        self.refused("-a", "spp=1", "--spp", "2", "--dry-run", says=["spp: given twice"])
        self.refused("-a", "spp=1", "-a", "(spp,size)=[(1,8)]", "--dry-run", says=["spp: given twice"])
        self.refused("--csv", says=["--csv: its value is missing"])
        self.refused("--json", "-", "--csv", "-", says=["only one", "stdout"])
        self.refused("--json", "x", "--csv", "./x", says=["both json and csv"])

    def test_a_variable_is_named_when_the_value_came_from_it(self):
        line = self.assert_refused("--dry-run", PTBENCH_SAMPLES="none", says=["--samples", '"none"', "PTBENCH_SAMPLES"])
        self.assertTrue(line.startswith("error: "))

    def test_a_data_folder_that_is_none(self):
        self.assert_refused("list", PTBENCH_DATA_DIR="/missing", says=["/missing has no configs/", "PTBENCH_DATA_DIR"])

    def test_no_control_characters_reach_the_terminal(self):
        self.assertNotIn("\x1b", self.refused("--\x1b[31m", says=["unknown option"]))
        self.assertNotIn("\x1b", self.refused("--scene", "\x1b[31m", says=["scene"]))


class Axes(CliTest):
    def refused(self, text, *says):
        self.assert_refused("-a", text, says=["error: ", *says])

    def test_bad_axis_text(self):
        self.refused("foo", '"foo"', "NAME=VALUE")
        self.refused("spp=[1,", "spp", "a list in brackets")
        self.refused("spp=[]", "spp", "at least one value")
        self.refused("spp=[10:1:2]", "10:1:2", "ascending")
        self.refused("spp=[1:9:x1]", "1:9:x1", "FIRST:LAST:xFACTOR")
        self.refused("spp=[1:1000000:1]", "at most 4096 values")
        self.refused("(spp,size)=[(1,2,3)]", "(spp,size)", "2 values")
        self.refused("(spp,spp)=[(1,2)]", "spp", "twice")

    def test_a_comma_in_a_value(self):
        self.refused("scene=a,b.json", "scene", "one value, or a list in brackets; a comma in a value is \\,")
        text = (SOURCE / "configs/scenes/furnace.json").read_text()
        for name in ("a,b.json", "c.json"):
            self.scratch.write(name, text)

        def scenes(*words):
            config = json.loads(self.run_ok(*words, "--dump-config").stdout)
            return {scene for series in config["series"] for scene in series["scene"]}
        self.assertEqual(scenes("--scene", "a,b.json"), {"a,b.json"})
        self.assertEqual(scenes("--scene", "a\\,b.json,c.json"), {"a,b.json", "c.json"})
        self.assertEqual(scenes("-a", "scene=[a\\,b.json,c.json]"), {"a,b.json", "c.json"})
        for name in ("a,b.json", "a\\,b.json"):
            self.run_ok("render", "-d", "pocl:1", "--scene", name, "--size", "4", "--spp", "1", "-o", "x.ppm", "-q")
        self.assert_refused("render", "--spp", "1,2", "-o", "y.ppm", says='spp: found "1,2"; allowed: one value')
        self.assertEqual(scenes("--config", self.scratch.write("my.json", {"series": [{"scene": ["a,b.json"]}]})), {"a,b.json"})

    def test_unknown_axis_name(self):
        self.refused("spq=3", '"spq"', "did you mean spp?", "path_length")
        self.refused("device=cpu", "not an axis", "-d")

    def test_unknown_names_get_the_nearest_and_what_there_is(self):
        for words, says in [
            (("--kernel", "ptt"), ('"ptt"', "did you mean pt?", "thesis, whitted, direct, pt, pt_nee")),
            (("--scene", "thesi"), ('"thesi"', "did you mean thesis?", "furnace, gap, hair, knot, lamp_in_glass, lamps, menger, slivers, terrain, thesis")),
            (("--config", "quik"), ('"quik"', "did you mean quick?", "cards, ci, doctor, ladder, memory, quality, queues, quick, rays, speed, thesis, tune, workgroups")),
            (("--config", "."), ("no file", "cards, ci, doctor, ladder, memory, quality, queues, quick, rays, speed, thesis, tune, workgroups")),
        ]:
            with self.subTest(words):
                self.assert_refused(*words, says=says)
        self.assert_refused("render", "--kernel", "ptt", "-o", "x.png", says="did you mean pt?")


class Configs(CliTest):
    def refused(self, content, *says):
        name = self.scratch.write("my.json", content)
        self.assert_refused("--config", name, "--dry-run", says=["my.json", *says])

    def test_unknown_keys_are_named_by_their_pointer(self):
        self.refused({"serie": []}, "/serie", "did you mean series?")
        self.refused({"series": [{"spp": 1}, {"spq": 3}]}, "/series/1/spq", "did you mean spp?")

    def test_values_are_named_by_their_pointer(self):
        self.refused({"max_time": -1}, "/max_time", "-1", "more than 0")
        self.refused({"samples": 0}, "/samples", "from 1")
        self.refused({"series": [{"spp": [4, 0]}]}, "/series/0/spp", '"0"', "from 1")
        self.refused({"series": []}, "/series", "at least one")
        self.refused({"series": [{"kernel": "pt", "(kernel,spp)": [["pt", 1]]}]}, "/series/0", "kernel")

    def test_paths_are_from_the_config(self):
        text = (SOURCE / "configs/scenes/furnace.json").read_text()
        for name in ("conf/near.json", "conf/both.json", "both.json", "far.json"):
            self.scratch.write(name, text)
        (self.scratch.work / "conf/kernels").mkdir()
        scenes = ["near.json", "both.json", "far.json", "thesis"]
        name = self.scratch.write("conf/my.json", {"kernel_dir": "kernels", "series": [{"scene": scenes}]})
        config = json.loads(self.run_ok("--config", name, "--dump-config").stdout)
        self.assertEqual(config["series"][0]["scene"], ["conf/near.json", "conf/both.json", "far.json", "thesis"])
        self.assertEqual(config["kernel_dir"], "conf/kernels")

    def test_what_is_no_json(self):
        self.refused('{"max_time": NaN}', "line 1")
        self.refused('{"max_time": 1,', "end of input")
        self.refused("", "not JSON")
        self.refused('{"name": "x", "name": "y"}', '"name"', "twice")
        self.refused("[" * 100_000, "")


class Scenes(CliTest):
    def refused(self, content, *says, command=("--dry-run",)):
        name = self.scratch.write("my.json", content)
        self.assert_refused(*command, "--scene", name, says=["my.json", *says])

    def changed(self, change):
        scene = json.loads(THESIS_SCENE)
        change(scene)
        return scene

    def test_unknown_keys_are_named_by_their_pointer(self):
        self.refused(self.changed(lambda s: s.update(sphere=[])), "/sphere", "spheres")
        self.refused(self.changed(lambda s: s["spheres"][3].update(radios=1)), "/spheres/3/radios", "radius")

    def test_undefined_material(self):
        self.refused(self.changed(lambda s: s["spheres"][3].update(material="pinkk")), "/spheres/3/material", "pinkk",
                     "pink")

    def test_negative_radius_and_no_spheres(self):
        self.refused(self.changed(lambda s: s["spheres"][3].update(radius=-2)), "/spheres/3/radius", "-2", "> 0")
        self.refused(self.changed(lambda s: s.update(spheres=[])), "/spheres", "at least one sphere")

    def test_what_is_no_json(self):
        self.refused(self.changed(lambda s: s["spheres"][3].update(radius=float("nan"))), "N")
        self.refused(THESIS_SCENE.replace('"name"', '"name": "a", "name"', 1), '"name"', "twice")

    def test_render_refuses_the_same(self):
        bad = self.changed(lambda s: s["spheres"][3].update(radius=-2))
        self.refused(bad, "/spheres/3/radius", command=("render", "-o", "x.png"))


if __name__ == "__main__":
    unittest.main()
