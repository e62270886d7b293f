"""Scenes with meshes as users meet them: what is refused, left out, and told apart."""

import json
import unittest

from ptbench import ONE, SOURCE, CliTest, changed, ended
from validate_schema import schema_errors

TRIANGLE = "v 0 0 0\nv 4 0 0\nv 0 3 0\nf 1 2 3\n"


def scene(**mesh):
    return {
        "name": "mine",
        "camera": {"position": [1, 1, -9], "look_at": [1, 1, 0], "up": [0, 1, 0], "fov_deg": 40},
        "materials": {"grey": {"type": "matte", "albedo": [0.5, 0.5, 0.5]}, "glass": {"type": "dielectric", "ior": 1.5}},
        "spheres": [],
        "meshes": [{"file": "mine.obj", "material": "grey", **mesh}],
    }


class MeshScenes(CliTest):
    def write(self, text, folder="", **mesh):
        self.scratch.write(f"{folder}mine.json", scene(**mesh))
        self.scratch.write(f"{folder}mine.obj", text)

    def run_thesis(self, out):
        words = (*changed(ONE, kernel="thesis"), "--scene", "mine.json", "--out", out, "--json", f"{out}.json")
        self.scratch.run(*words)
        return json.loads((self.scratch.work / f"{out}.json").read_text())

    def test_a_bad_mesh_is_refused_with_its_file_and_pointer(self):
        self.write("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
        for words in (ONE, ("render", "-o", "x.png"), ("tune", "--kernel", "pt"), ("--dry-run",)):
            with self.subTest(words):
                self.assert_refused(*words, "--scene", "mine.json",
                                    says=["error: mine.json: /meshes/0/file: cannot read mine.obj: it has no faces"])

    def test_open_glass_is_refused_with_the_edge(self):
        self.write(TRIANGLE, material="glass")
        self.assert_refused(*ONE, "--scene", "mine.json",
                            says=["/meshes/0: the mesh is open", "the edge (0, 0, 0) - (4, 0, 0)", "wound outwards"])

    def test_a_kernel_that_sees_no_meshes_says_so_and_what_is_left_out_is_a_warning(self):
        self.write(TRIANGLE + "f 1 1 2\n")
        result = self.run_thesis("a")
        self.assertEqual([(case["status"], case["reason"]) for case in result["cases"]],
                         [("unsupported", "scene mine has meshes: thesis sees spheres alone")])
        self.assertIn("scene mine.json: mine.obj: left out 1 triangle without an area", result["warnings"])

    def test_a_record_tells_of_its_tree_and_cases_that_share_one_share_its_build(self):
        self.write(TRIANGLE)
        words = changed(ONE, kernel="pt", path_length=1, wg="implicit,16")
        ran = self.run_ok(*words, "-a", "bvh=[bvh2,bvh2q,wide8]", "--scene", "mine.json", "--skip-time", "--out", "run")
        trees = {}
        for case in self.scratch.result("run")["cases"]:
            trees.setdefault(case["params"]["bvh"], []).append(case["tree"])
        self.assertEqual({bvh: {tree["layout"] for tree in each} for bvh, each in trees.items()},
                         {"bvh2": {"bvh2"}, "bvh2q": {"bvh2q"}, "wide8": {"wide8"}})
        for each in trees.values():
            self.assertEqual(each[0], each[1])
            self.assertEqual((each[0]["triangles"], each[0]["references"], each[0]["depth"]), (1, 1, 1))
            self.assertGreater(each[0]["build_ms"], 0)
        self.assertIn("trees of triangles", ran.stdout)
        self.assertEqual(schema_errors(SOURCE / "configs/schema/result.schema.json", self.scratch.work / "run/result.json"), "")

    def test_lanes_that_wait_for_each_other_trace_the_same_paths(self):
        for kernel in ("pt", "direct", "pt_nee", "pt_lt"):
            text = (SOURCE / f"kernels/{kernel}/{kernel}.cl").read_text()
            self.scratch.write(f"kernels/{kernel}/{kernel}.cl", "#define SCENE_PAUSES\n" + text)  # as on GPUs
            words = (*changed(ONE, kernel=kernel, path_length=5, spp=16), "--scene", "cornell", "-a", "roulette=albedo",
                     "-a", "bvh=bvh2q")
            whole, waiting = self.only_case(*words), self.only_case(*words, "--kernel-dir", "kernels")
            with self.subTest(kernel):
                self.assertEqual((ended(whole), ended(waiting)), ("ok", "ok"), waiting["reason"])
                for count in ("segments", "full_length_paths", "shadow_rays", "light_segments"):
                    self.assertEqual(waiting["work"][count], whole["work"][count], count)

    def test_an_edited_mesh_is_another_scene(self):
        hashes = []
        for text in (TRIANGLE, TRIANGLE, TRIANGLE + "f 3 2 1\n"):
            self.write(text)
            hashes += self.run_thesis(f"run{len(hashes)}")["run"]["scenes"]
        self.assertEqual(hashes[0], hashes[1])
        self.assertNotEqual(hashes[0], hashes[2])

    def test_shipped_scenes_with_meshes_are_found(self):
        for file in (SOURCE / "configs/scenes").glob("*.json"):
            if "meshes" in json.loads(file.read_text()):
                with self.subTest(file.stem):
                    self.run_ok(*changed(ONE, kernel="thesis"), "--scene", file.stem, "--dry-run")


if __name__ == "__main__":
    unittest.main()
