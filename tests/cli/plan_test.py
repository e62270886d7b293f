"""The plan: the same words from flags, variables and config files give the same cases, and nothing runs before asked."""

import json
import re
import unittest

from ptbench import ONE, SOURCE, TINY, CliTest
from validate_schema import schema_errors

FLAGS = ("-d", "pocl:1", "--kernel", "pt", "--size", "16,24x8", "--spp", "1:4:x2", "--path-length", "5", "--wg",
         "implicit,64,8x8", "--lanes", "4")
CONFIG = {
    "name": "quick", "device": "pocl:1", "max_total_time": 100,
    "series": [{"kernel": "pt", "size": ["16", "24x8"], "spp": "[1:4:x2]", "path_length": 5,
                "work_group": ["implicit", 64, "8x8"], "lanes": 4}],
}


class Plan(CliTest):
    def plan(self, *words, **variables):
        return self.run_ok(*words, "--dry-run", "-q", **variables).stdout

    def test_flags_axes_variables_and_configs_give_the_same_plan(self):
        plan = self.plan(*FLAGS)
        self.assertEqual(len(plan.splitlines()), 2 * 3 * 3)
        self.scratch.write("my.json", CONFIG)
        self.assertEqual(self.plan("--config", "my.json"), plan)
        axes = ("kernel=pt", "size=[16,24x8]", "spp=[1:4:x2]", "path_length=5", "work_group=[implicit,64,8x8]",
                "lanes=4")
        self.assertEqual(self.plan("-d", "1", *(word for axis in axes for word in ("-a", axis))), plan)
        self.assertEqual(self.plan(PTBENCH_DEVICE="pocl:1", PTBENCH_KERNEL="pt", PTBENCH_SIZE="16,24x8",
                                   PTBENCH_SPP="1,2,4", PTBENCH_PATH_LENGTH="5", PTBENCH_WG="implicit,64,8x8",
                                   PTBENCH_LANES="4"), plan)
        self.assertEqual(self.plan("run", *FLAGS), plan)

    def test_flags_win_over_variables_and_variables_over_configs(self):
        self.scratch.write("my.json", CONFIG)
        from_variable = self.plan(PTBENCH_CONFIG="my.json", PTBENCH_SPP="7")
        self.assertEqual(set(re.findall(r"spp (\d+)", from_variable)), {"7"})
        from_flag = self.plan("--spp", "9", PTBENCH_CONFIG="my.json", PTBENCH_SPP="7")
        self.assertEqual(set(re.findall(r"spp (\d+)", from_flag)), {"9"})

    def test_switches_have_variables_too(self):
        result = self.run_ok(*ONE, PTBENCH_DRY_RUN="1", PTBENCH_QUIET="true")
        self.assertEqual((result.stdout, result.stderr), (self.plan(*ONE), ""))

    def test_linked_axes_go_together(self):
        plan = self.plan("-d", "1", "--kernel", "pt", "-a", "(spp,size)=[(10,64),(20,32)]", "--wg", "implicit",
                         "--max-total-time", "0")
        self.assertEqual(re.findall(r"(\d+x\d+)  spp (\d+)", plan), [("64x64", "10"), ("32x32", "20")])

    def test_a_dry_run_predicts_and_writes_nothing(self):
        result = self.run_ok(*TINY, "--dry-run", "--json", "x.json")
        self.assertEqual(len(result.stdout.splitlines()), 2)
        self.assertRegex(result.stdout, r"pocl:0  pt  thesis  16x16  spp 2 .* ~ \d")
        self.assertIn("predicted: ", result.stderr)
        self.assertEqual(self.scratch.files(), [])

    def test_the_config_of_the_thesis_is_table_1_with_its_predicted_time(self):
        result = self.run_ok("--config", "thesis", "-d", "pocl:1", "--dry-run")
        self.assertRegex(result.stderr, r"predicted: \S+ (s|min|h).*longest sample: thesis on pocl:1, spp 1000")
        lines = [re.sub(r"  ~ .*", "", line) for line in result.stdout.splitlines()]
        self.assertEqual(lines, [f"pocl:1  {kernel}  thesis  1024x1024  spp {spp}  path length 128  "
                                 "work-group implicit  lanes auto" for kernel in ("thesis", "pt")
                                 for spp in (10, 100, 1000)])

    def test_a_config_without_series_is_one_case(self):
        self.scratch.write("empty.json", {})
        self.assertEqual(len(self.plan("--config", "empty.json", "-d", "0").splitlines()), 1)

    def test_a_budget_goes_to_little_work_of_every_kernel_first(self):
        words = ("-d", "pocl:0,pocl:1", "--kernel", "pt,thesis", "--size", "16", "--wg", "implicit", "--spp", "1,4")
        order = lambda plan: re.findall(r"(pocl:\d).*?\b(pt|thesis)\b.*?spp (\d+)", plan)
        self.assertEqual(order(self.plan(*words, "--max-total-time", "0")),
                         [(device, kernel, spp)
                         for device in ("pocl:0", "pocl:1") for kernel in ("pt", "thesis") for spp in "14"])
        budget = self.plan(*words, "--max-total-time", "100")
        self.assertEqual(order(budget),
                         [(device, kernel, spp)
                         for device in ("pocl:0", "pocl:1") for spp in "14" for kernel in ("pt", "thesis")])


class DumpConfig(CliTest):
    def dump(self, *words):
        return self.run_ok(*words, "--dump-config").stdout

    def test_what_is_dumped_reads_back_to_the_same(self):
        everything = (*FLAGS, "--samples", "1000000", "--warmup", "3", "--max-time", "1.5", "--timeout", "7",
                      "--max-total-time", "1e9", "--seed", "4294967295", "--timer", "host", "--skip-time")
        for words in ((), ("--config", "thesis"), ("--config", "ci"), everything):
            with self.subTest(words):
                dumped = self.dump(*words)
                self.scratch.write("dumped.json", dumped)
                self.assertEqual(self.dump("--config", "dumped.json"), dumped)
        config = json.loads(dumped)
        self.assertEqual((config["max_samples"], config["warmup"], config["max_time"], config["timeout"]),
                         (1000000, 3, 1.5, 7))
        self.assertEqual((config["max_total_time"], config["seed"], config["timer"]), (1e9, 4294967295, "host"))
        self.assertEqual((config["device"], config["skip_time"]), (["pocl:1"], True))

    def test_the_plan_of_a_dumped_config_is_the_same(self):
        self.scratch.write("dumped.json", self.dump(*FLAGS))
        self.assertEqual(self.run_ok("--config", "dumped.json", "--dry-run", "-q").stdout,
                         self.run_ok(*FLAGS, "--dry-run", "-q").stdout)

    def test_a_dumped_config_keeps_to_its_schema(self):
        self.scratch.write("dumped.json", self.dump(*FLAGS))
        self.assertEqual(schema_errors(SOURCE / "configs/schema/config.schema.json",
                                       self.scratch.work / "dumped.json"), "")


class Help(CliTest):
    def test_every_command_has_help_and_a_version(self):
        version = self.run_ok("--version").stdout
        self.assertRegex(version, r"^ptbench \d+\.\d+\.\d+\n$")
        for command in ("run", "list", "render", "worker"):
            self.assertEqual(self.run_ok(command, "--version").stdout, version)
            text = self.run_ok(command, "--help").stdout
            self.assertEqual(text, self.run_ok(command, "-h").stdout)
            self.assertIn("Usage: ptbench" if command == "run" else f"Usage: ptbench {command}", text)
        self.assertEqual(self.run_ok("run", "--help").stdout, self.run_ok("--help").stdout)

    def test_help_names_what_there_is(self):
        text = self.run_ok("--help").stdout
        for word in ("list", "render", "--all-devices", "--axis", "--spp", "--wg", "--max-total-time", "--dry-run",
                     "PTBENCH_CONFIG", "77 no OpenCL device", "130 interrupted"):
            self.assertIn(word, text)


if __name__ == "__main__":
    unittest.main()
