"""`ptbench compare`, --save-baseline and --baseline: files made from one real result, with times as a test needs."""

import copy
import json
import os
import unittest

from ptbench import ONE, SOURCE, TINY, CliTest, Scratch, changed
from validate_schema import schema_errors


SCHEMA = SOURCE / "configs/schema/compare.schema.json"


class CompareTest(CliTest):
    @classmethod
    def setUpClass(cls):
        """One real run of two cases; every file below is this one with other times."""
        scratch = Scratch()
        cls.addClassCleanup(scratch.remove)
        ran = scratch.run("-d", "pocl:1", *changed(TINY, spp="1,2"), "--out", "out", "-q")
        assert ran.returncode == 0, ran.stdout + ran.stderr
        cls.real = scratch.result()

    def file(self, name, *medians_ms, change=None, day=1):
        """A result whose cases take these times, +-0.4 %."""
        result = copy.deepcopy(self.real)
        result["run"]["started_at"] = f"2025-01-{day:02}T00:00:00Z"
        for case, median_ms in zip(result["cases"], medians_ms):
            sample = case["samples"][0]
            case["samples"] = [{**sample, "kernel_ns": round(median_ms * 1e6 * (1 + 0.001 * ((i * 3) % 9 - 4))),
                                "cause": ""} for i in range(12)]
            case["statistics"] |= {"timer": "event", "n": 12, "stop_reason": "precision", "median_ns": median_ms * 1e6}
        if change:
            change(result)
        return self.scratch.write(name, result)

    def sessions(self, name, count, *medians_ms):
        return [self.file(f"{name}{i}.json", *(ms * (1 + 0.001 * (i % 5)) for ms in medians_ms), day=i + 1)
                for i in range(count)]

    def compare(self, *words, code=0):
        """States and advisories; the file keeps to its schema."""
        self.ran = self.run_ok("compare", *words, "--json", "compared.json", code=code)
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "compared.json"), "")
        rows = json.loads((self.scratch.work / "compared.json").read_text())["rows"]
        return [(row["finding"]["state"], row["advisory"]) for row in rows]


class Sessions(CompareTest):
    def test_one_session_a_side_advises(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 12, 10)
        advised = [("regressed", "single-session"), ("same", "single-session")]
        self.assertEqual(self.compare(old, new), advised)
        self.assertIn("1.200", self.ran.stdout)
        self.assertIn("2 cases: 1 regressed, 1 same", self.ran.stdout)
        self.assertEqual(self.compare(old, new, "--gate-single-session", code=3), [("regressed", ""), ("same", "")])
        self.assertEqual(self.compare(new, old, "--gate-single-session")[0], ("improved", ""))

    def test_eight_a_side_gate(self):
        old, new = self.sessions("old", 8, 10, 10), self.sessions("new", 8, 11, 10)
        states = self.compare("--base", *old, "--new", *new, code=3)
        self.assertEqual(states, [("regressed", ""), ("same", "")])
        self.assertEqual(self.compare("--base", *old[:7], "--new", *new)[0][1], "7 and 8 sessions, 8 a side gate")

    def test_a_history_predicts(self):
        history = self.sessions("old", 10, 10, 10)
        self.assertEqual(self.compare(self.file("new.json", 10, 10), "--history", *history), [("same", "")] * 2)
        states = self.compare(self.file("new.json", 11, 10), "--history", *history, code=3)
        self.assertEqual(states, [("regressed", ""), ("same", "")])

    def test_tolerances(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 10.8, 10.8)
        gate = (old, new, "--gate-single-session")
        self.assertEqual(self.compare(*gate, code=3)[0][0], "regressed")
        self.assertEqual(self.compare(*gate, "--tolerance", "10%")[0][0], "same")
        self.scratch.write("my.json", {"series": [{"kernel": "pt", "size": 16, "path_length": 2, "spp": 1,
                                                   "tolerance": "10%"}]})
        self.assertEqual([state for state, _ in self.compare(*gate, "--config", "my.json", code=3)],
                         ["same", "regressed"])

    def test_strict_and_require_mde_want_an_answer(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 10, 10)
        self.compare(old, new, "--strict", code=5)
        self.compare(old, new, "--strict", "--gate-single-session")
        self.compare(old, new, "--require-mde", "6%")

        def noisy(result):
            for i, sample in enumerate(result["cases"][0]["samples"]):
                sample["kernel_ns"] *= 1 + i % 2
        noise = self.file("noise.json", 10, 10, change=noisy)
        self.compare(old, noise, "--require-mde", "20%", code=5)
        self.compare(old, noise)
        self.assert_refused("compare", old, new, "--require-mde", "4%", says=["more than the tolerance of 5%"])


class Coverage(CompareTest):
    def test_what_is_gone_or_failed_loses_coverage(self):
        old = self.file("old.json", 10, 10)

        def crash(result):
            result["cases"][1] |= {"status": "crash", "reason": "killed by SIGSEGV (11)", "statistics": None,
                                   "samples": []}
        for new in (self.file("gone.json", 10, change=lambda r: r["cases"].pop()),
                    self.file("crashed.json", 10, change=crash)):
            with self.subTest(new):
                self.assertEqual(self.compare(old, new, code=6)[1][0], "missing")
                self.compare(old, new, "--allow-missing")
        self.assertIn("killed by SIGSEGV", self.ran.stdout)
        self.assertEqual(self.compare("gone.json", old)[1][0], "unmeasured")

    def test_lost_coverage_outranks_a_regression(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 12, change=lambda r: r["cases"].pop())
        self.compare(old, new, "--gate-single-session", code=6)
        self.compare(old, new, "--gate-single-session", "--allow-missing", code=3)

    def test_nothing_in_common_is_not_comparable(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", change=lambda r: r["cases"].clear())
        self.compare(old, new, "--allow-missing", code=7)


class Fingerprints(CompareTest):
    def test_what_differs_is_named(self):
        def device(key, value):
            return lambda r: [d.update({key: value}) for d in r["devices"]]

        def build(key, value):
            return lambda r: [c["build"].update({key: value}) for c in r["cases"]]
        changes = {"driver": device("driver_version", "other"), "compute units": device("compute_units", 77),
                   "CPUs allowed": lambda r: r["host"].update(cpus_allowed=77),
                   "CPU quota": lambda r: r["host"].update(cpu_quota=0.7),
                   "device": device("name", "other"), "CPU": lambda r: r["host"].update(cpu="other"), "kernel hash": build("kernel_hash", "other"),
                   "build options": build("options", "other"),
                   "timer": lambda r: [c["statistics"].update(timer="host") for c in r["cases"]]}
        old = self.file("old.json", 10, 10)
        for field, change in changes.items():
            with self.subTest(field):
                new = self.file("new.json", 20, 10, change=change)
                result = self.run_ok("compare", old, new, "--gate-single-session", code=7)
                (line,) = result.stderr.splitlines()
                self.assertRegex(line, f'^not comparable: {field}: ".*" and "(other|host|77|0.7)"; --allow-cross')
                self.assertEqual(result.stdout, "")
                crossed = self.compare(old, new, "--gate-single-session", "--allow-cross")
                self.assertEqual(crossed[0][1], "not comparable")

    def test_an_edited_scene_is_another_one_and_a_moved_file_the_same(self):
        def scene(path, text_hash):
            def change(result):
                result["run"]["scenes"] = [f"{path} {text_hash}"]
                for case in result["cases"]:
                    case["params"]["scene"] = path
            return change
        old = self.file("old.json", 10, 10, change=scene("s.json", "f441de64cb66c0c9"))
        edited = self.file("edited.json", 20, 10, change=scene("s.json", "c43e2b2828bb2116"))
        result = self.run_ok("compare", old, edited, "--gate-single-session", code=7)
        self.assertIn('scene: "s.json f441de64cb66c0c9" and "s.json c43e2b2828bb2116"', result.stderr)
        moved = self.file("moved.json", 10, 10, change=scene("scenes/s.json", "f441de64cb66c0c9"))
        self.assertEqual([state for state, _ in self.compare(old, moved)], ["same", "same"])

    def test_the_scene_of_a_run_is_its_text(self):
        text = (SOURCE / "configs/scenes/furnace.json").read_text()
        self.scratch.write("s.json", text)
        self.scratch.write("elsewhere/t.json", text)
        with_scene = (*changed(ONE, spp="1"), "-q", "--scene")
        self.run_ok(*with_scene, "s.json", "--out", "a")
        self.run_ok(*with_scene, "elsewhere/t.json", "--out", "b")
        self.run_ok("compare", "a/result.json", "b/result.json")
        self.scratch.write("s.json", text + " ")
        self.run_ok(*with_scene, "s.json", "--out", "c")
        self.assertIn('scene: "s.json ', self.run_ok("compare", "a/result.json", "c/result.json", code=7).stderr)

    def test_the_same_card_under_another_number(self):
        def card(key):
            def change(result):
                for device in result["devices"]:
                    device.update(key=key, uuid="")
                for case in result["cases"]:
                    case["params"]["device"] = key
            return change
        old, new = (self.file(f"{i}.json", 10, 10, change=card(f"nvidia:{i}")) for i in (0, 4))
        self.assertEqual([state for state, _ in self.compare(old, new)], ["same", "same"])
        self.assertIn("new: device nvidia:4", self.ran.stdout)

    def test_allow_cross_never_returns_3(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 20, 20)
        self.compare(old, new, "--allow-cross", "--gate-single-session")


class Formats(CompareTest):
    def google(self, name, **times_ns):
        rows = [{"name": case, "run_name": case, "run_type": "iteration", "iterations": 9, "time_unit": "ns",
                 "real_time": time_ns * (1 + 0.001 * i), "cpu_time": 1} for case, time_ns in times_ns.items()
                for i in range(8)]
        return self.scratch.write(name, {"context": {"host_name": "h", "num_cpus": 2}, "benchmarks": rows})

    def test_google_benchmark(self):
        old, new = self.google("old.json", copy=100, fill=50), self.google("new.json", copy=150, fill=50)
        self.assertEqual([s for s, _ in self.compare(old, new, "--gate-single-session", code=3)], ["regressed", "same"])

    def test_google_benchmark_in_a_container(self):
        def file(name, host):
            rows = [{"name": "copy", "real_time": 5, "time_unit": "ns", "rays": float("nan")} for _ in range(8)]
            return self.scratch.write(name, {"context": {"host_name": host, "num_cpus": 2}, "benchmarks": rows})
        old, new = file("old.json", "9f86d081884c"), file("new.json", "7d865e959b24")
        self.assertEqual(self.compare(old, new), [("same", "single-session")])
        self.assertEqual(self.ran.stderr, 'note: host: "9f86d081884c" and "7d865e959b24"\n')
        self.run_ok("compare", old, file("other.json", "node7"), code=0)
        self.run_ok("compare", file("node8.json", "node8"), "other.json", code=7)

    def test_google_benchmark_without_a_time(self):
        old = self.google("old.json", copy=100, gpu=50)
        new = json.loads((self.scratch.work / old).read_text())
        new["benchmarks"] = [row for row in new["benchmarks"] if row["name"] == "copy"] + [
            {"name": "gpu", "real_time": 0, "time_unit": "ns", "skipped": True, "skip_message": "no device"}]
        self.assertEqual([state for state, _ in self.compare(old, self.scratch.write("new.json", new), code=6)],
                         ["same", "missing"])
        self.assertIn("no device", self.ran.stdout)

    def test_a_journal_and_stdin(self):
        old = self.file("old.json", 10, 10)
        result = json.loads((self.scratch.work / old).read_text())
        lines = [{**result, "cases": []}, *result["cases"]]
        journal = self.scratch.write("journal.jsonl", "".join(json.dumps(line) + "\n" for line in lines))
        self.assertEqual([state for state, _ in self.compare(old, journal)], ["same", "same"])
        with open(self.scratch.work / journal) as stdin:
            ran = self.run_ok("compare", old, "-", stdin=stdin)
        self.assertIn("base: old.json; new: -\n", ran.stdout)
        self.assertIn("2 same", ran.stdout)
        self.assert_refused("compare", "-", "-", says="- (stdin) twice")
        self.assert_refused("compare", old, "-", says="stdin: not JSON")

    def test_nvbench(self):
        def file(name, seconds):
            value = {"tag": "nv/cold/time/gpu/mean", "data": [{"name": "value", "type": "float64", "value": seconds}]}
            state = {"name": "Device=0", "device": 0, "is_skipped": False, "summaries": [value]}
            return self.scratch.write(name, {"devices": [{"id": 0, "name": "H200", "sm_version": 900}],
                                             "benchmarks": [{"name": "copy", "states": [state]}]})
        self.assertEqual(self.compare(file("old.json", "0.001"), file("new.json", "0.002")),
                         [("inconclusive", "single-session")])
        self.assertIn("2.000", self.ran.stdout)

    def test_nvbench_on_a_card_of_another_number(self):
        def file(number):
            value = {"tag": "nv/cold/time/gpu/mean", "data": [{"name": "value", "type": "float64", "value": "0.001"}]}
            states = [{"name": f"Device={number} N={n}", "device": number, "is_skipped": False, "summaries": [value]}
                      for n in (1, 2)]
            return self.scratch.write(f"{number}.json", {"devices": [{"id": number, "name": "H200", "sm_version": 900}],
                                                         "benchmarks": [{"name": "copy", "states": states}]})
        for words in ((), ("--allow-cross",)):
            self.assertEqual([state for state, _ in self.compare(file(0), file(4), *words)], ["inconclusive"] * 2)
        self.assertIn("copy N=2", self.ran.stdout)

    def test_outputs(self):
        old, new = self.file("old.json", 10, 10), self.file("new.json", 10, 10)
        result = self.run_ok("compare", old, new, "--md", "-")
        self.assertIn("| device | case |", result.stdout)
        self.assertIn("2 same", result.stderr)
        self.assertEqual(json.loads(self.run_ok("compare", old, new, "--json", "-").stdout)["schema"],
                         "ptbench.compare.v1")

    def test_refusals(self):
        old = self.file("old.json", 10, 10)
        os.truncate(self.scratch.work / self.scratch.write("huge.json", '{"schema": "'), 1 << 30)
        for words, says in [
            (("huge.json", old), "larger than 256 MiB"),
            ((self.scratch.write("deep.json", "[" * 100_000), old), "nested deeper"),
            ((self.scratch.write("wrong.json", {"schema": "ptbench.v1", "cases": "none"}), old), "wrong.json: "),
            ((), "OLD.json NEW.json"),
            ((old,), "OLD.json NEW.json"),
            ((old, old, old), "OLD.json NEW.json"),
            ((old, "missing.json"), "missing.json"),
            ((old, old, "--config", "nope"), "cards, ci, doctor, ladder, memory, quality, queues, quick, rays, speed, thesis, tune, workgroups"),
            ((old, "--history", old, "--base", old), "--history"),
            (("--replay", "missing.json"), "missing.json"),
            ((self.scratch.write("bad.json", "{"), old), "bad.json"),
            ((self.scratch.write("new.json", {"schema": "ptbench.v2"}), old), "ptbench.v2"),
        ]:
            with self.subTest(words):
                self.assert_refused("compare", *words, says=[says])


class Baselines(CliTest):
    def test_a_baseline_is_kept_and_compared(self):
        kept = self.run_ok(*ONE, "--out", "out", "--save-baseline", "main")
        self.assertIn("baseline written: ptbench-baselines/main.json", kept.stderr)
        self.assertEqual((self.scratch.work / "ptbench-baselines/main.json").read_text(),
                         (self.scratch.work / "out/result.json").read_text())
        compared = self.run_ok(*ONE, "--out", "out", "--baseline", "main", "-q")
        self.assertIn("single-session", compared.stdout)
        self.assertIn("base: ptbench-baselines/main.json; new: this run", compared.stdout)
        verdict = self.scratch.result()["verdict"]
        self.assertEqual([row["advisory"] for row in verdict["rows"]], ["single-session"])
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / self.scratch.write("verdict.json", verdict)), "")
        self.assertEqual(schema_errors(SCHEMA.with_name("result.schema.json"), self.scratch.work / "out/result.json"), "")
        by_file = self.run_ok(*ONE, "--out", "out", "--baseline", "ptbench-baselines/main.json", "-q", "--csv", "-")
        self.assertNotIn("single-session", by_file.stdout)
        self.assertIn("single-session", by_file.stderr)

    def test_a_case_less_loses_coverage_and_one_more_does_not(self):
        kept = ("--baseline-dir", "kept", "--out", "out", "-q")
        self.run_ok(*changed(ONE, spp="2,3"), *kept, "--save-baseline", "main")
        self.run_ok(*ONE, *kept, "--baseline", "main", code=6)
        self.run_ok(*changed(ONE, spp="2,3,4"), *kept, "--baseline", "main")
        self.run_ok(*changed(ONE, spp="5"), *kept, "--baseline", "main", code=7)

    def test_refused_before_the_run(self):
        self.assert_refused(*ONE, "--baseline", "nope", says=["--baseline", '"nope"', "ptbench-baselines"])
        self.assert_refused(*ONE, "--save-baseline", "a/b", says=["--save-baseline", "letters"])
        self.assert_refused(*ONE, "--save-baseline", "a", "--baseline-dir", "/proc/x", says=["--save-baseline", "/proc/x"])


if __name__ == "__main__":
    unittest.main()
