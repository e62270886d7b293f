"""ptbench_micro takes Google Benchmark's flags, and its JSON is what compare.py and others read."""

import json
import os
import subprocess
import unittest

MICRO = os.environ["PTBENCH_MICRO"]


def micro(*flags):
    return subprocess.run([MICRO, *flags], capture_output=True, text=True, timeout=120, check=False)


def names():
    return micro("--benchmark_list_tests=true").stdout.split()


class Micro(unittest.TestCase):
    def test_json_of_a_host_benchmark(self):
        result = micro("--benchmark_filter=host/statistics", "--benchmark_min_time=0.001", "--benchmark_format=json")
        self.assertEqual(result.returncode, 0, result.stderr)
        document = json.loads(result.stdout)
        self.assertIn("ptbench_version", document["context"])
        (benchmark,) = document["benchmarks"]
        self.assertEqual(benchmark["name"], "host/statistics/times:1000")
        self.assertGreater(benchmark["real_time"], 0)

    def test_every_device_and_kernel_has_a_benchmark(self):
        for device in ("pocl:0", "pocl:1"):
            for kernel in ("pt", "thesis"):
                self.assertIn(f"render/{device}/{kernel}/spp:1/manual_time", names())

    def test_render_counts_its_work_and_names_its_clock(self):
        result = micro("--benchmark_filter=render/pocl:1/pt/spp:1/", "--benchmark_min_time=0.001",
                       "--benchmark_format=json")
        self.assertEqual(result.returncode, 0, result.stderr)
        (benchmark,) = json.loads(result.stdout)["benchmarks"]
        self.assertNotIn("error_occurred", benchmark)
        self.assertGreaterEqual(benchmark["segments/s"], benchmark["samples/s"])
        self.assertRegex(benchmark["label"], "^(events|host clock)")

    def test_unknown_flag_is_refused(self):
        self.assertEqual(micro("--no-such-flag").returncode, 2)


if __name__ == "__main__":
    unittest.main()
