"""A user's own meshes: import-mesh on files that this test writes with Python's standard library,
props and a hall made of them, and truth held to what the shapes are on paper.

Usage: user_models_test.py PROGRAM SOURCE_DIR
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
sys.path.insert(0, str(SOURCE / "tests/support"))

import dataset_reader  # noqa: E402
from made_models import Glb, box, collada, inside_out, obj  # noqa: E402

CUPBOARD = ((-0.4, -0.3, 0), (0.4, 0.3, 1.9))


def aisle(*arguments, code=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, (arguments, done.returncode, done.stdout, done.stderr)
    return done.stdout if code == 0 else done.stderr


def bounds(said):
    found = re.search(r"bounds: x (\S+) to (\S+), y (\S+) to (\S+), z (\S+) to (\S+) m", said)
    return [float(number) for number in found.groups()]


def scaled(shape, factor, turn=lambda point: point):
    corners, triangles = shape
    return [[factor * n for n in turn(c)] for c in corners], triangles


class UserModels(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="aisle_models_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, data):
        path = self.folder / name
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return path

    def take_in(self, path, *more, code=0):
        return aisle("import-mesh", path, "--licence", "own", "-o",
                     path.with_suffix(".aislemesh"), *more, code=code)

    def holds(self, said, low=CUPBOARD[0], high=CUPBOARD[1]):
        for axis, (a, b) in enumerate(zip(low, high)):
            self.assertAlmostEqual(bounds(said)[2 * axis], a, delta=2e-3)
            self.assertAlmostEqual(bounds(said)[2 * axis + 1], b, delta=2e-3)

    def test_each_format_has_its_size_and_stands_up(self):
        shape = box(*CUPBOARD)
        glb = Glb()
        glb.node("Cupboard", mesh=glb.mesh(shape))
        self.holds(self.take_in(self.write("a.glb", glb.bytes())))
        inches = scaled(shape, 1 / 0.0254)
        self.holds(self.take_in(self.write("b.obj", obj(inches)), "--unit", "in", "--up", "z"))
        lying = scaled(shape, 1000, lambda p: (p[0], p[2], -p[1]))  # y up, millimetres
        self.holds(self.take_in(self.write("c.obj", obj(lying)), "--unit", "mm", "--up", "y"))
        sideways = scaled(shape, 1, lambda p: (p[2], p[1], -p[0]))  # x up
        self.holds(self.take_in(self.write("d.obj", obj(sideways)), "--unit", "m", "--up", "x"))
        said = '<unit name="centimeter" meter="0.01"/><up_axis>Z_UP</up_axis>'
        self.holds(self.take_in(self.write("e.dae", collada(scaled(shape, 100), said))))
        # What the user says stands above what the file does.
        self.holds(self.take_in(self.write("f.dae", collada(scaled(shape, 1000), said)),
                                "--unit", "mm"))
        y_said = '<unit name="meter" meter="1"/><up_axis>Y_UP</up_axis>'
        self.holds(self.take_in(self.write("g.dae", collada(shape, y_said)), "--up", "z"))

    def test_what_a_file_does_not_say_is_asked_for(self):
        shape = box(*CUPBOARD)
        plain = self.write("a.obj", obj(shape))
        said = self.take_in(plain, code=4)
        self.assertIn("--unit m, cm, mm, in or ft, and --up y, z or x", said)
        self.assertEqual(said.count("\n"), 1)
        self.assertNotIn("--unit", self.take_in(plain, "--unit", "m", code=4))
        self.assertIn("--up", self.take_in(plain, "--unit", "m", code=4))
        self.assertNotIn("--up", self.take_in(plain, "--up", "z", code=4))
        silent = self.write("b.dae", collada(shape, "<up_axis>Z_UP</up_axis>"))
        self.assertIn("does not say its unit", self.take_in(silent, code=4))
        self.holds(self.take_in(silent, "--unit", "m"))

    def test_what_is_left_out_is_named_and_the_rest_recorded(self):
        glb = Glb()
        red = glb.material((0.8, 0.1, 0.1), alphaMode="BLEND", emissiveFactor=[1, 1, 1])
        node = glb.node("Cupboard", mesh=glb.mesh(box(*CUPBOARD), red), camera=0)
        glb.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}]
        glb.json["extensionsUsed"] = ["KHR_lights_punctual", "KHR_materials_clearcoat"]
        glb.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}] * 2}}
        times = glb.accessor([0.0, 1.0], "SCALAR", "f", 5126)
        places = glb.floats([[0, 0, 0], [1, 0, 0]])
        glb.json["animations"] = [{"samplers": [{"input": times, "output": places}], "channels": [
            {"sampler": 0, "target": {"node": node, "path": "translation"}}]}]
        path = self.write("a.glb", glb.bytes())
        said = self.take_in(path)
        left_out = re.search(r"skipped: (.*)", said).group(1)
        for phrase in ("1 camera", "2 lights", "1 material's transparency", "1 animation",
                       "1 material's emission", "the extension KHR_materials_clearcoat"):
            self.assertIn(phrase, left_out)
        record = json.loads((self.folder / "a.aislemesh.json").read_text())
        self.assertEqual((record["source"], record["licence"]), ("a.glb", "own"))
        self.assertEqual(record["triangles"], 12)
        picture = dataset_reader.read_grey_png(self.folder / "a.png")
        self.assertGreater(picture.std(), 8)

    def test_coordinates_from_nowhere_are_one_error(self):
        for number in ("nan", "inf", "1e30", "-9.2e18", "1e999"):
            shape = obj(box(*CUPBOARD)).replace("v 0.4", f"v {number}", 1)
            said = self.take_in(self.write("a.obj", shape), "--unit", "m", "--up", "z", code=4)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertIn("a.obj", said)
            self.assertFalse((self.folder / "a.aislemesh").exists())

    def hall(self, turned=inside_out):
        """12 x 8 x 4 m about a way along x, with a wall at x = 10 and goods before it; its shell is
        to be seen from within, or as `turned` has it."""
        glb = Glb()
        root = glb.node("Hall")
        glb.node("Bodenplatte", root, mesh=glb.mesh(
            ([(-2, -4, 0), (10, -4, 0), (10, 4, 0), (-2, 4, 0)], [(0, 1, 2), (0, 2, 3)])))
        shell, triangles = turned(box((-2, -4, 0), (10, 4, 4)))
        glb.node("Shell walls", root, mesh=glb.mesh((shell, triangles)))
        racks = glb.node("Racks", root)
        glb.node("R1", racks, mesh=glb.mesh(box((2, 2, 0), (6, 3, 2))))
        glb.node("Kran", root, mesh=glb.mesh(box((2, -3, 0), (6, -2, 2))))
        return self.write("hall.glb", glb.bytes())

    def scene(self, mesh):
        return self.write("scene.yaml", f"""about: One's own hall.
frames: 2
camera: {{size_px: [160, 120], focal_px: [80, 80], center_px: [80, 60]}}
rig: {{start: [0, 0], camera_forward_m: 0.5, camera_height_m: 1}}
hall:
  mesh: {mesh}
  from: [-2, -4]
  to: [10, 4]
  height_m: 4
  labels: [{{nodes: "kr?n", label: goods}}]
lights: [{{height_m: 3.5}}]
props: [{{mesh: cupboard.aislemesh, label: column, at: [8, 0]}}]
""")

    def test_a_hall_and_a_prop_are_where_and_what_they_are(self):
        self.hall()
        self.take_in(self.write("cupboard.obj", obj(box(*CUPBOARD))), "--unit", "m", "--up", "z")
        self.take_in(self.folder / "hall.glb")
        for mesh in ("hall.glb", "hall.aislemesh"):
            scene = self.scene(mesh)
            said = aisle("check", scene)
            self.assertIn("licence own, from cupboard.obj", said)
            out = self.folder / mesh.replace(".", "_")
            aisle("render", scene, "--out", out, "--truth", "depth,labels", "--frames", "0:1")
            depth = dataset_reader.read_pfm(next((out / "truth/depth").glob("*.pfm")))
            self.assertAlmostEqual(float(depth[60, 80]), 8 - 0.4 - 0.5, delta=1e-4)  # the prop
            self.assertAlmostEqual(float(depth[45, 80]), 9.5, delta=1e-4)  # the wall, over the prop
            self.assertAlmostEqual(float(depth[30, 80]), 3 * 80 / 30, delta=1e-4)  # the ceiling
            self.assertAlmostEqual(float(depth[110, 80]), 1 * 80 / 50, delta=1e-4)  # the floor
            self.assertTrue((depth < 100).all())
            labels = json.loads((out / "truth/labels.json").read_text())
            classes = {one["name"]: one["class"] for one in labels}
            self.assertEqual(classes["Hall/Bodenplatte"], "floor")
            self.assertEqual(classes["Hall/Shell walls"], "wall")
            self.assertEqual(classes["Hall/Racks/R1"], "rack")
            self.assertEqual(classes["Hall/Kran"], "goods")
            self.assertEqual(classes["cupboard_0_0"], "column")

    def test_a_hall_that_is_a_shell_seen_from_outside_is_lit_within(self):
        self.take_in(self.write("cupboard.obj", obj(box(*CUPBOARD))), "--unit", "m", "--up", "z")
        pictures = []
        for turned in (inside_out, lambda shape: shape):
            self.hall(turned)
            out = self.folder / f"shell_{len(pictures)}"
            aisle("render", self.scene("hall.glb"), "--out", out, "--frames", "0:1")
            pictures.append(dataset_reader.read_grey_png(next((out / "mav0/cam0").rglob("*.png"))))
        within, outside = (picture.astype(float) for picture in pictures)
        self.assertGreater(within.mean(), 40)
        self.assertLess(abs(within - outside).mean(), 1)

    def test_a_mesh_and_its_record_belong_together(self):
        self.hall()
        self.take_in(self.folder / "hall.glb")
        self.take_in(self.write("cupboard.obj", obj(box(*CUPBOARD))), "--unit", "m", "--up", "z")
        scene = self.scene("hall.aislemesh")
        aisle("check", scene)
        kept = self.folder / "cupboard.aislemesh"
        whole = kept.read_bytes()
        kept.write_bytes(whole[:-1] + bytes([whole[-1] ^ 1]))
        said = aisle("check", scene, code=4)
        self.assertIn("scene.yaml:12", said)
        self.assertIn("import the mesh again", said)
        kept.write_bytes(whole)
        (self.folder / "cupboard.aislemesh.json").unlink()
        self.assertIn("licence", aisle("check", scene, code=4))
        kept.unlink()
        self.assertIn("no such file", aisle("check", scene, code=4))

    def test_formats_that_may_be_silent_are_imported_first(self):
        self.write("cupboard.obj", obj(box(*CUPBOARD)))
        self.hall()
        scene = self.scene("hall.glb")
        scene.write_text(scene.read_text().replace("cupboard.aislemesh", "cupboard.obj"))
        self.assertIn("aisle import-mesh cupboard.obj", aisle("check", scene, code=4))
        scene.write_text(scene.read_text().replace("mesh: cupboard.obj, label: column, ", ""))
        self.assertIn("model", aisle("check", scene, code=4))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
