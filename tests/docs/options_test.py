#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""options_test.py: what scripts/measuring gives the program for the options and scenes of points that it does not know,
by a program made up here that writes down what it was called with."""
import json
import math
import os
import statistics
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from measuring import camera_path, options, points, scenes  # noqa: E402

FAKE = '''#!/usr/bin/python3
import json, pathlib, sys
with open(pathlib.Path(__file__).parent / "calls", "a") as calls:
    print(json.dumps(sys.argv[1:]), file=calls)
if sys.argv[1:3] == ["scene", "convert"]:
    pathlib.Path(sys.argv[4]).write_text("ply")
'''


def ring(count, focus, radius):
    """Cameras around a point that look at it, in a world whose third axis points down."""
    cameras = []
    for number in range(count):
        angle = 2 * math.pi * number / count
        forward, right = [-math.cos(angle), -math.sin(angle), 0], [math.sin(angle), -math.cos(angle), 0]
        axes = [right, [0, 0, 1], forward]
        cameras.append({"id": number, "img_name": f"{number:02}", "width": 64, "height": 48, "fx": 50, "fy": 50,
                        "position": [f - radius * a for f, a in zip(focus, forward)],
                        "rotation": [[axis[i] for axis in axes] for i in range(3)]})
    return cameras


class Given(unittest.TestCase):
    def setUp(self):
        kept = tempfile.TemporaryDirectory()
        self.addCleanup(kept.cleanup)
        self.folder = Path(kept.name)
        program = self.folder / "degs"
        program.write_text(FAKE)
        program.chmod(0o755)
        before = os.environ.get("DEGS_PROGRAM")
        self.addCleanup(lambda: os.environ.update(DEGS_PROGRAM=before) if before else os.environ.pop("DEGS_PROGRAM"))
        os.environ["DEGS_PROGRAM"] = str(program)
        for name in ("SCENES", "LARGE", "CAMERAS"):
            self.addCleanup(setattr, scenes, name, getattr(scenes, name))
            setattr(scenes, name, self.folder / name)
            (self.folder / name).mkdir()

    def calls(self):
        return [json.loads(line) for line in (self.folder / "calls").read_text().splitlines()]

    def given(self, point):
        return options.for_program(point.words(), str(self.folder))

    def test_results_have_a_place(self):
        words = self.given(points.run("degs-64", "synthetic:object", "--trace {out}/trace.json"))
        self.assertEqual(words[words.index("--trace") + 1], f"{self.folder}/trace.json")

    def test_searches_and_times_of_fidelities(self):
        words = points.speed("degs-64", "synthetic:object", "--camera 2 --seeds 3", "tile_size=16").words()
        self.assertEqual(words, ["accuracy", "--scene", "synthetic:object", "--camera", "2", "--seeds", "3",
                                 "--set", "tile_size=16", "--speed", str(ROOT / "configs/degs-64.yaml")])
        both = "--scene synthetic:object --scene synthetic:outdoor --camera 1 --width 320 --budget 4"
        point = points.search("beyond-64", both)
        self.assertEqual(point.words(), ["explore", str(ROOT / "configs/studies/beyond-64.yaml"), *both.split()])
        self.assertEqual(point.quick().words()[2:], ["--budget", "4", "--width", "160", "--camera", "1", "--scene",
                                                     points.TINY_SCENE])

    def test_a_view_is_packed_for_its_design(self):
        words = self.given(points.run("degs-64", "synthetic:object", "--camera 1 --packed --no-cache", "tile_size=16"))
        design, file = str(ROOT / "configs/degs-64.yaml"), str(self.folder / "frame.degsw")
        self.assertEqual(self.calls(), [["workload", "pack", design, "--scene", "synthetic:object", "--camera", "1",
                                         "--set", "tile_size=16", "--out", file]])
        self.assertEqual(words, ["run", design, "--no-cache", "--set", "tile_size=16", "--no-reference",
                                 "--workload", file])

    def test_a_path_is_moved_into_its_scene(self):
        (self.folder / "CAMERAS/room.json").write_text(json.dumps(ring(12, [3, 4, 5], 2)))
        for place, side in (("interior", 5.2), ("garden", 10)):
            seen = []
            for number in range(4):
                words = self.given(points.run("degs-64", f"synthetic:{place},gaussians=9",
                                              f"--path room:4 --camera {number} --width 99"))
                self.assertNotIn("--path", words)
                self.assertNotIn("--camera", words)
                self.assertIn("--width", words)
                camera, = json.loads(Path(words[words.index("--camera-file") + 1]).read_text())
                seen.append(camera["id"])
                # It looks at the middle from 0.35 of the side, with the vertical downwards.
                right, down, forward = zip(*camera["rotation"])
                for axis, middle, place_of, ahead in zip(range(3), (0, -1, 0), camera["position"], forward):
                    self.assertAlmostEqual(place_of + 0.35 * side * ahead, middle, msg=axis)
                for value, wanted in zip(down, (0, 1, 0)):
                    self.assertAlmostEqual(value, wanted)
                self.assertAlmostEqual(sum(a * b for a, b in zip(right, forward)), 0)
            self.assertEqual(seen, [0, 3, 6, 9])

    def test_the_median_of_uneven_distances_counts(self):
        file = self.folder / "uneven.json"
        file.write_text(json.dumps(ring(3, [0, 0, 0], 1) + ring(4, [0, 0, 0], 5)))
        moved = camera_path.moved_path(file, "garden", 7)
        distances = [math.dist(camera["position"], (0, -1, 0)) for camera in moved]
        self.assertAlmostEqual(statistics.median(distances), 3.5)
        self.assertAlmostEqual(min(distances), 0.7)

    def test_a_result_depends_on_the_camera_file(self):
        point = points.run("degs-64", "synthetic:garden", "--path room:4 --camera 0")
        with self.assertRaisesRegex(scenes.Missing, "no camera file .*room.json"):
            next(points.depends_on(point))
        file = self.folder / "CAMERAS/room.json"
        file.write_text("[]")
        self.assertEqual(next(points.depends_on(point)), points.content(str(file)))

    def test_the_tiny_path_stays_in_its_place(self):
        tiny = points.run("degs-64", "synthetic:garden,gaussians=1000000", "--path room:4 --camera 3 --width 1920").quick()
        words = self.given(tiny)  # needs no file of DEGS_CAMERAS
        self.assertIn("synthetic:garden,gaussians=20000", words)
        self.assertEqual(words[words.index("--width") + 1], "160")
        self.assertTrue(Path(words[words.index("--camera-file") + 1]).exists())

    def test_parts_of_a_scene_are_joined(self):
        large = self.folder / "LARGE/two-parts"
        large.mkdir()
        (large / "cameras.json").write_text("[]")
        for number, count in enumerate((5, 7)):
            with zipfile.ZipFile(large / f"part-{number}.sog", "w") as part:
                part.writestr("meta.json", json.dumps({"count": count}))
        index = Path(scenes.scene_file("two-parts"))
        self.assertEqual(json.loads(index.read_text())["count"], 12)
        self.assertTrue((index.parent / "cameras.json").exists())
        self.assertEqual(scenes.scene_file("two-parts"), str(index))
        self.assertEqual([Path(file).name for file in scenes.files_of("two-parts")],
                         ["part-0.sog", "part-1.sog", "cameras.json"])

    def test_a_synthetic_scene_can_come_from_a_file(self):
        name = "ply:synthetic:landscape,gaussians=9"
        file = scenes.scene_file(name)
        self.assertEqual(scenes.scene_file(name), file)
        self.assertEqual(self.calls(), [["scene", "convert", "synthetic:landscape,gaussians=9", file]])
        self.assertEqual(scenes.files_of(name), [])

    def test_a_missing_scene_is_named(self):
        with self.assertRaisesRegex(scenes.Missing, "no scene .*SCENES/flowers/scene.ply, and none in parts in .*LARGE"):
            scenes.scene_file("flowers")
        (self.folder / "SCENES/flowers").mkdir()
        (self.folder / "SCENES/flowers/scene.ply").write_text("ply")
        self.assertEqual(scenes.files_of("flowers"), [scenes.scene_file("flowers")])


if __name__ == "__main__":
    unittest.main()
