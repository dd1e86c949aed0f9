"""Makes assets/vehicles/*.glb.

Run: blender -b --factory-startup -P assets/author/vehicles.py -- [name ...]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import agv, body, car, cyclist, forklift, pallet_jack, reach_truck  # noqa: E402

DRIVER = body.Person(
    name="driver",
    seed=3,
    height_m=1.74,
    shoulders=1.02,
    girth=1.05,
    belly=0.02,
    top="jacket",
    head_wear="cap",
    skin=(0.74, 0.54, 0.43),
    hair_colour=(0.12, 0.09, 0.07),
    helmet_colour=(0.12, 0.20, 0.36),
)
RIDER = body.Person(
    name="rider",
    seed=8,
    height_m=1.76,
    shoulders=0.98,
    girth=0.98,
    belly=0.0,
    top="jacket",
    head_wear="helmet",
    skin=(0.80, 0.60, 0.48),
    hair_colour=(0.20, 0.13, 0.08),
    helmet_colour=(0.80, 0.80, 0.82),
)
CARS = {
    "car_white": ("hatch", (0.82, 0.82, 0.80), 51),
    "car_red": ("hatch", (0.48, 0.06, 0.07), 52),
    "car_dark": ("saloon", (0.07, 0.08, 0.10), 53),
    "car_silver": ("saloon", (0.55, 0.56, 0.57), 54),
    "car_van": ("van", (0.74, 0.74, 0.70), 55),
}
VEHICLES = {
    **{name: lambda *a, look=look: car.build(*a, *look) for name, look in CARS.items()},
    "cyclist": lambda *a: cyclist.build(*a, RIDER),
    "forklift": forklift.build,
    "forklift_driver": lambda *a: forklift.build(*a, driver=DRIVER),
    "reach_truck": lambda *a: reach_truck.build(*a, driver=DRIVER),
    "pallet_jack": pallet_jack.build,
    "agv": agv.build,
}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    for name, build in VEHICLES.items():
        if not wanted or name in wanted:
            path = os.path.abspath(os.path.join(HERE, "..", "vehicles", name + ".glb"))
            with tempfile.TemporaryDirectory() as folder:
                build(name, folder, path)


if __name__ == "__main__":
    main()
