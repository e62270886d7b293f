#!/usr/bin/env python3
"""How often the validation rejects a right kernel: validates it with one seed after another until the time is up.

usage: false_alarms.py PTBENCH DEVICE KERNEL SECONDS [OPTION OF ptbench...]
"""

import json
import subprocess
import sys
import tempfile
import time


def validation(ptbench, device, kernel, seed, options):
    """Of one process with one seed; the case itself is one pixel."""
    with tempfile.TemporaryDirectory() as folder:
        run = [ptbench, "-q", "-d", device, "--kernel", kernel, "--size", "1", "--spp", "1", "--wg", "implicit",
               "--skip-time", "--seed", str(seed), "--out", folder, "--json", "-", *options]
        result = subprocess.run(run, check=False, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    (record,) = json.loads(result.stdout)["cases"]
    return record["validation"]


def main(ptbench, device, kernel, seconds, *options):
    end = time.monotonic() + float(seconds)
    found = []
    while time.monotonic() < end:
        found.append(validation(ptbench, device, kernel, len(found) + 1, options))
        if not found[-1]["valid"]:
            print(f"seed {len(found)} rejected: {found[-1]['reason']}", flush=True)
    rejected = sum(not each["valid"] for each in found)
    beyond = [sum(abs(each["mean_z"]) > z for each in found) for z in (1, 2, 3)]
    worst = max(each["max_abs_z"] / each["z_limit"] for each in found)
    print(f"{found[0]['against']}: {found[0]['samples'] / 1e6:.1f} million samples each, {', '.join(found[0]['checks'])}")
    print(f"{rejected} of {len(found)} seeds rejected; worst block at {100 * worst:.0f} % of its limit; image mean "
          f"beyond 1, 2, 3 standard errors: {beyond[0]}, {beyond[1]}, {beyond[2]}")


if __name__ == "__main__":
    main(*sys.argv[1:])
