"""`ptbench doctor`: what it looks at, what it writes, and what it says without a device."""

import json
import shutil
import unittest

from validate_schema import schema_errors
from ptbench import SOURCE, CliTest


class Doctor(CliTest):
    def tiny(self):
        """A data folder whose A/A case takes milliseconds."""
        data = self.scratch.work / "data"
        shutil.copytree(SOURCE / "configs", data / "configs")
        (data / "results").symlink_to(SOURCE / "results")
        file = data / "configs/doctor.json"
        config = json.loads(file.read_text())
        config["series"][0].update(size=16, spp=2, path_length=2)
        file.write_text(json.dumps(config))
        return str(data)

    def test_each_device_is_compared_with_itself(self):
        result = self.run_ok("doctor", "-d", "pocl:1", "--json", "found.json", PTBENCH_DATA_DIR=self.tiny())
        file = self.scratch.work / "found.json"
        self.assertEqual(schema_errors(SOURCE / "configs/schema/doctor.schema.json", file), "")
        found = json.loads(file.read_text())
        (aa,) = found["aa"]
        self.assertEqual(aa["device"], "pocl:1")
        self.assertGreaterEqual(aa["finding"]["n"], 10)
        self.assertGreaterEqual(aa["smallest_change"], 0.05)
        for about in ("load", "steal", "governor", "virtualisation", "cpu limit", "driver", "timer", "A/A", "smallest change"):
            self.assertIn(about, {remark["about"] for remark in found["remarks"]})
            self.assertIn(f" {about}", result.stdout)

    def test_only_looking_starts_no_work_and_json_has_stdout_for_itself(self):
        (self.scratch.icds / "bad.icd").write_text("libmissing.so.1\n")
        result = self.run_ok("doctor", "--no-aa", "--json", "-")
        found = json.loads(result.stdout)
        self.assertEqual(found["aa"], [])
        self.assertTrue(any("bad.icd cannot be used" in remark["seen"] for remark in found["remarks"]))
        self.assertIn("bad.icd cannot be used", result.stderr)

    def test_without_a_device_it_says_what_to_install(self):
        (self.scratch.icds / "pocl.icd").unlink()
        result = self.run_ok("doctor", code=77)
        self.assertIn("apt-get install pocl-opencl-icd", result.stderr)
        self.assertIn("virtualisation", result.stdout)


if __name__ == "__main__":
    unittest.main()
