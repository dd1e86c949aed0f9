"""Makes assets/vehicles/*.glb.

Run: blender -b --factory-startup -P assets/author/vehicles.py -- [name ...]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import (  # noqa: E402
    agv, body, bus, car, cyclist, forklift, order_picker, pallet_jack, reach_truck, scrubber, tow_train,
)

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
CLEANER = body.Person(
    name="cleaner",
    seed=12,
    height_m=1.68,
    shoulders=0.96,
    girth=1.0,
    belly=0.01,
    top="shirt",
    head_wear="none",
    skin=(0.50, 0.34, 0.26),
    hair_colour=(0.06, 0.05, 0.05),
    helmet_colour=(0.12, 0.20, 0.36),
)
PICKER = body.Person(
    name="picker",
    seed=19,
    height_m=1.78,
    shoulders=1.0,
    girth=0.97,
    belly=0.0,
    top="jacket",
    head_wear="helmet",
    skin=(0.78, 0.58, 0.47),
    hair_colour=(0.30, 0.22, 0.14),
    helmet_colour=(0.85, 0.70, 0.12),
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
    "car_white": ("hatch", (0.86, 0.86, 0.85), 51),
    "car_red": ("hatch", (0.50, 0.05, 0.06), 52),
    "car_dark": ("saloon", (0.10, 0.115, 0.15), 53),
    "car_silver": ("saloon", (0.62, 0.63, 0.64), 54),
    "car_van": ("van", (0.80, 0.80, 0.78), 55),
}
VEHICLES = {
    **{name: lambda *a, look=look: car.build(*a, *look) for name, look in CARS.items()},
    "cyclist": lambda *a: cyclist.build(*a, RIDER),
    "forklift": forklift.build,
    "forklift_driver": lambda *a: forklift.build(*a, driver=DRIVER),
    "reach_truck": lambda *a: reach_truck.build(*a, driver=DRIVER),
    "bus": lambda *a: bus.build(*a, (0.86, 0.85, 0.80), (0.10, 0.33, 0.30), 61),
    "tow_tractor": lambda *a: tow_train.tractor(*a, DRIVER),
    "tow_trailer": lambda *a: tow_train.trailer(*a, "cage"),
    "tow_trailer_totes": lambda *a: tow_train.trailer(*a, "totes"),
    "scrubber": lambda *a: scrubber.build(*a, CLEANER),
    "order_picker": lambda *a: order_picker.build(*a, PICKER),
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
