"""ptbench behind the fault layer; `fault` is PTB_FAULT (README.md)."""

import os

from ptbench import ONE, SOURCE, CliTest, changed, ended
from validate_schema import schema_errors

LAYER = os.environ["PTB_FAULT_LAYER"]
SCHEMA = SOURCE / "configs/schema/result.schema.json"

# Three cases of one worker; a fault with BY_EIGHT hits only the second.
THREE = changed(ONE, wg="4,8,16")
BY_EIGHT = "kernel=pt_render local=8"


class FaultTest(CliTest):
    def layered(self, fault, *words, code=0, **variables):
        return self.run_ok(*words, code=code, OPENCL_LAYERS=LAYER, PTB_FAULT=fault, **variables)

    def records(self, fault, *words, code=0, **variables):
        """The records of a run; the file that they are in keeps to its schema."""
        self.layered(fault, *words, "--out", "out", "-q", code=code, **variables)
        self.assertEqual(schema_errors(SCHEMA, self.scratch.work / "out/result.json"), "")
        return self.scratch.result()["cases"]

    def record(self, fault, *words, code=0):
        (record,) = self.records(fault, *words, code=code)
        return record

    def one_of_three(self, fault, status, code=1, words=THREE):
        """The record of the case that was hit, which none of the others suffered from."""
        before, hit, after = self.records(fault, *words, code=code)
        self.assertEqual([ended(before), hit["status"], ended(after)], ["ok", status, "ok"],
                         [before["reason"], hit["reason"], after["reason"]])
        self.assertEqual((hit["samples"], hit["statistics"]), ([], None))
        return hit
