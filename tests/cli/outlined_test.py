"""The loop of a kernel of many lanes stays a function of its own, outside of what PoCL makes of the kernel: in machine code."""

import re
import subprocess
import unittest

from ptbench import SOURCE, CliTest

LOOP, KERNEL = "trace_units", "pt_render"
WIDE = (4, 8, 16, 32)
HEADER = (SOURCE / "kernels/lib/outlined.h").read_text()


def function_bytes(machine_code):
    """Sizes of the functions in a shared object, by name."""
    text = subprocess.run(["nm", "--print-size", machine_code], capture_output=True, text=True, check=True).stdout
    return {name: int(size, 16) for size, name in re.findall(r"^\w+ (\w+) [tT] (\w+)$", text, re.MULTILINE)}


class Outlined(CliTest):
    def made_of_the_kernel(self, lanes, *words):
        """What PoCL, with an empty cache, makes of pt: sizes of functions, one for each local size it compiles for."""
        cache = self.scratch.work / f"cache-{lanes}"
        cache.mkdir()
        self.run_ok("render", "-d", "pocl:0", "--kernel", "pt", "--size", "16", "--spp", "2", "--path-length", "2",
                    "--lanes", lanes, *words, "-o", "picture.pfm", POCL_CACHE_DIR=str(cache), timeout=300)
        made = [function_bytes(file) for file in cache.rglob(f"{KERNEL}.so")]
        self.assertGreater(len(made), 0, f"no {KERNEL}.so in PoCL's cache")
        return made

    def test_the_loop_is_a_function_for_every_lane_width(self):
        for lanes in WIDE:
            for functions in self.made_of_the_kernel(lanes):
                with self.subTest(lanes=lanes):
                    self.assertIn(LOOP, functions, "inlined: PoCL then keeps the loop's variables in memory")
                    self.assertGreater(functions[LOOP], max(functions[name] for name in functions if KERNEL in name))

    def test_a_loop_that_is_inlined_is_seen(self):
        inlined = HEADER.replace("__attribute__((noinline))", "__attribute__((always_inline))")
        inlined = inlined.replace("POCL_DEVICE_ADDRESS_BITS", "NO_COMPILER_SAYS_SO")
        self.scratch.write("kernels/lib/outlined.h", inlined)
        for functions in self.made_of_the_kernel(4, "--kernel-dir", "kernels"):
            self.assertNotIn(LOOP, functions)


if __name__ == "__main__":
    unittest.main()
