"""An installed tree still works after it was moved, away from the sources, without a home; and find_package finds it."""

import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["PTB_SOURCE_DIR"])
BUILD = pathlib.Path(os.environ["PTB_BINARY_DIR"])


def run(*command, cwd="/", **environment):
    words = [str(word) for word in command]
    result = subprocess.run(
        words, cwd=cwd, env={**os.environ, **environment}, capture_output=True, text=True, timeout=250, check=False
    )
    if result.returncode != 0:
        raise AssertionError(f"{words} exits {result.returncode}:\n{result.stdout}{result.stderr}")
    return result.stdout


def installed_of_build():
    """Files of the build folder that `cmake --install` insists on."""
    copied = "".join(file.read_text() for file in BUILD.rglob("cmake_install.cmake"))
    commands = [command for command in re.findall(r"file\(INSTALL[^)]*\)", copied) if " OPTIONAL " not in command]
    return set(re.findall(rf'"{re.escape(str(BUILD))}/([^"]+)"', "".join(commands)))


def made_of(target):
    """Files that ninja makes or reads for a target, relative to the build folder where they are in it."""
    graph = run("ninja", "-C", BUILD, "-t", "graph", target)
    return {label.removeprefix(f"{BUILD}/") for label in re.findall(r'label="([^"]+)"', graph)}


class PartialTree(unittest.TestCase):
    def test_the_target_ptbench_makes_whatever_is_installed(self):
        ninja_makes = made_of("all") & installed_of_build()
        self.assertIn("bench/manual/ptbench.1.gz", ninja_makes)
        self.assertEqual(ninja_makes - made_of("ptbench"), set())


class MovedTree(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.work = pathlib.Path(cls.folder.name)
        run("cmake", "--install", BUILD, "--prefix", cls.work / "first place")
        cls.prefix = cls.work / "second place"
        (cls.work / "first place").rename(cls.prefix)
        cls.home = cls.work / "home"
        cls.home.mkdir()

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_list_finds_devices_and_shipped_scenes(self):
        listing = json.loads(run(self.prefix / "bin/ptbench", "list", "--json", HOME=str(self.home)))
        self.assertTrue(listing["devices"], "no device in the list of the moved binary")
        self.assertIn("thesis", json.dumps(listing), "the moved binary does not find its own scenes")

    def test_meshes_of_shipped_scenes_are_installed(self):
        words = ("-d", "cpu", "--kernel", "thesis", "--scene", "cornell", "--dry-run")
        self.assertIn("cornell", run(self.prefix / "bin/ptbench", *words, HOME=str(self.home)))

    def test_nothing_is_written_to_an_empty_home(self):
        run(self.prefix / "bin/ptbench", "list", HOME=str(self.home))
        self.assertEqual(list(self.home.iterdir()), [])

    def test_consumer_finds_the_library_and_renders(self):
        build = self.work / "consumer"
        run("cmake", "-S", SOURCE / "tests/install/consumer", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_BUILD_TYPE=Release")
        run("cmake", "--build", build)
        scene = self.prefix / "share/ptbench/configs/scenes/furnace.json"
        self.assertEqual(run(build / "consumer", scene).strip(), "furnace 8x8: 128 samples")

    def test_kernels_are_installed_for_kernel_dir(self):
        for file in ("pt/pt.cl", "thesis/thesis.cl", "shared/engine.h", "lib/random.h"):
            self.assertTrue((self.prefix / "share/ptbench/kernels" / file).is_file(), file)


if __name__ == "__main__":
    unittest.main()
