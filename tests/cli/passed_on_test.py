"""`ptbench report --format`: what it writes is taken by those it is for: by their own readers where Debian has them, else
by their published rules."""

import copy
import json
import math
import re
import statistics
import subprocess
import tempfile
import unittest

from ptbench import TINY, Scratch, changed, undisturbed

COMPARE = "/usr/share/benchmark/compare.py"
HOSTILE = "</a>\"'&\x1b[31m=1+1|`,\n x 9"


def debian_python(program, *words):
    """Of Debian's own Python, which sees Debian's packages."""
    ran = subprocess.run(["/usr/bin/python3", "-c", program, *map(str, words)], capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


class PassedOn(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        """A real run of four cases: two timed ones, of which one's device has a hostile name, one that broke, one skipped."""
        cls.scratch = Scratch()
        cls.addClassCleanup(cls.scratch.remove)
        ran = cls.scratch.run(*changed(TINY, spp="2,3", samples=9), "--out", "out", "-q")
        assert ran.returncode == 0, ran.stdout + ran.stderr
        cls.result = undisturbed(cls.scratch.result())
        cls.result["devices"][1]["name"] = HOSTILE
        for case in cls.result["cases"]:
            case["samples"][0]["cause"] = "first"
            case["work"]["renders"] = 2
        cls.result["cases"][1].update(status="crash", reason=HOSTILE, statistics=None, samples=[])
        cls.result["cases"][3].update(status="skipped", reason="budget", statistics=None, samples=[])
        cls.file = cls.scratch.write("out/changed.json", cls.result)
        cls.timed = [cls.result["cases"][0], cls.result["cases"][2]]
        cls.times = [[sample["kernel_ns"] / 2 for sample in case["samples"][1:]] for case in cls.timed]

    def report(self, name, file=None):
        ran = self.scratch.run("report", file or self.file, "--format", name)
        self.assertEqual((ran.returncode, ran.stderr), (0, ""))
        self.assertNotIn("\x1b", ran.stdout)
        return ran.stdout

    def path(self, name, text):
        return self.scratch.work / self.scratch.write(name, text)

    def test_google_benchmark_s_own_compare_takes_it(self):
        slower = copy.deepcopy(self.result)
        for case in slower["cases"]:
            for sample in case["samples"]:
                sample["kernel_ns"] *= 2
        old = self.path("old.json", self.report("google-benchmark"))
        new = self.path("new.json", self.report("google-benchmark", self.scratch.write("out/slower.json", slower)))
        with tempfile.NamedTemporaryFile(suffix=".json") as found:
            subprocess.run(["/usr/bin/python3", COMPARE, "-d", found.name, "benchmarks", old, new], check=True,
                           stdout=subprocess.DEVNULL)
            rows = [row for row in json.load(found) if row["run_type"] == "iteration"]
        self.assertEqual([len(row["measurements"]) for row in rows], [8, 8])
        for row, times in zip(rows, self.times):
            for measurement, ns in zip(row["measurements"], times):
                self.assertAlmostEqual(measurement["real_time"], ns)
                self.assertAlmostEqual(measurement["time"], 1.0)

    def test_compare_reads_google_benchmark_s_and_nvbench_s_back(self):
        for name in ("google-benchmark", "nvbench"):
            file = self.path(f"{name}.json", self.report(name))
            ran = self.scratch.run("compare", file, file, "--json", "compared.json")
            rows = json.loads((self.scratch.work / "compared.json").read_text())["rows"]
            measured = [row["finding"]["base_ns"] for row in rows if row["finding"]["base_ns"] > 0]
            # compare takes the median of logarithms; nvbench's file has means
            middle = (lambda times: math.exp(statistics.median(map(math.log, times)))) if name == "google-benchmark" \
                else statistics.mean
            self.assertEqual(len(rows), 2 if name == "google-benchmark" else 4, ran.stdout)
            for ns, times in zip(measured, self.times, strict=True):
                self.assertAlmostEqual(ns, middle(times), delta=1)

    def test_a_junit_reader_counts_what_failed(self):
        xml = self.path("junit.xml", self.report("junit"))
        suites = debian_python("""if 1:
            import json, sys
            from junitparser import JUnitXml
            suites = [suite for suite in JUnitXml.fromfile(sys.argv[1])]
            print(json.dumps([[s.tests, s.failures, s.errors, s.skipped,
                               [[c.name, c.classname, c.time, [type(r).__name__ for r in c.result]] for c in s]]
                              for s in suites]))""", xml)
        self.assertEqual(len(suites), 1)
        tests, failures, errors, skipped, cases = suites[0]
        self.assertEqual((tests, failures, errors, skipped), (4, 0, 1, 1))
        self.assertEqual([case[3] for case in cases], [[], ["Error"], [], ["Skipped"]])
        self.assertAlmostEqual(cases[0][2], self.timed[0]["statistics"]["median_ns"] / 1e9, places=8)
        self.assertIn("</a>\"'&?[31m=1+1|`,", cases[2][1])

    def test_pandas_reads_the_long_csv(self):
        table = debian_python("""if 1:
            import pandas, sys
            frame = pandas.read_csv(sys.argv[1])
            counted = frame[frame.cause.isna()]
            print((counted.kernel_ns / counted.renders).groupby([counted.device, counted.spp]).median().to_json(orient="values"))
            """, self.path("long.csv", self.report("long-csv")))
        self.assertEqual(sorted(table), sorted(statistics.median(times) for times in self.times))

    def test_github_action_benchmark_s_rules(self):
        for name, unit, field, scale in (("github-action-smaller", "ms", "median_ns", 1e6),
                                         ("github-action-bigger", "Msamples/s", "msamples_per_s", 1)):
            entries = json.loads(self.report(name))
            self.assertEqual(len({entry["name"] for entry in entries}), 2)
            for entry, case in zip(entries, self.timed, strict=True):
                self.assertLessEqual(entry.keys(), {"name", "unit", "value", "range", "extra"})
                self.assertEqual(entry["unit"], unit)
                self.assertAlmostEqual(entry["value"], case["statistics"][field] / scale)

    def test_bencher_s_schema(self):
        metrics = json.loads(self.report("bencher"))
        for (name, measures), case in zip(metrics.items(), self.timed, strict=True):
            self.assertLess(len(name), 1024)
            self.assertEqual(measures.keys(), {"latency", "throughput", "efficiency"})
            for measure in measures.values():
                self.assertLessEqual(measure["lower_value"], measure["value"] * (1 + 1e-12))
                self.assertGreaterEqual(measure["upper_value"], measure["value"] * (1 - 1e-12))
            self.assertEqual(measures["latency"]["value"], case["statistics"]["median_ns"])
            self.assertEqual(measures["efficiency"]["value"], case["efficiency"]["all"]["efficiency"])

    def test_go_s_lines(self):
        """A name of no spaces from a capital, a count, then values with units; keys start small."""
        head, lines = self.report("go").split("\n\n")
        for line in head.splitlines():
            self.assertRegex(line, r"^[a-z][^\sA-Z]*: ")
        lines = lines.splitlines()
        self.assertEqual(len(lines), 16)
        for line, ns in zip(lines, self.times[0] + self.times[1]):
            match = re.fullmatch(r"(Benchmark[A-Z]\S*) (\d+) (\d+) ns/op (\S+) Msamples/s (\S+) efficiency", line)
            self.assertEqual(float(match[3]), round(ns), line)
            self.assertFalse(re.search(r"-\d+$", match[1]))

    def test_hyperfine_s_results(self):
        results = json.loads(self.report("hyperfine"))["results"]
        for entry, times in zip(results, self.times, strict=True):
            self.assertEqual(len(entry["times"]), len(entry["exit_codes"]))
            for key, value in (("mean", statistics.mean(times)), ("stddev", statistics.stdev(times)), ("min", min(times)),
                               ("max", max(times))):
                self.assertTrue(math.isclose(entry[key] * 1e9, value, rel_tol=1e-9), key)

    def test_a_step_summary_is_small_and_says_what_failed(self):
        large = copy.deepcopy(self.result)
        large["cases"] = [{**copy.deepcopy(self.timed[0]), "samples": [], "params": {**self.timed[0]["params"], "spp": i + 1}}
                          for i in range(5000)]
        text = self.report("step-summary", self.scratch.write("out/large.json", large))
        self.assertLess(len(text.encode()), 1 << 20)
        self.assertRegex(text, r"\d+ of 5000 rows; the result file has all")
        text = self.report("step-summary")
        self.assertIn("2 of 4 cases have no time", text)
        self.assertNotIn("<a", text)

    def test_an_unknown_format_names_those_there_are(self):
        ran = self.scratch.run("report", self.file, "--format", "jnuit")
        self.assertEqual(ran.returncode, 2)
        self.assertIn("did you mean junit?; allowed: google-benchmark, ", ran.stderr)


if __name__ == "__main__":
    unittest.main()
