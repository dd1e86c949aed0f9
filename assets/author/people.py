"""Makes assets/people/*.glb.

Run: blender -b --factory-startup -P assets/author/people.py -- [name ...]
"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import body, clips, figure  # noqa: E402

Person = body.Person
PEOPLE = [
    Person(name="worker_anton", seed=1, height_m=1.78),
    Person(
        name="worker_bea",
        seed=2,
        height_m=1.66,
        shoulders=0.90,
        hips=1.05,
        girth=0.90,
        bust=0.028,
        top="hoodie",
        head_wear="none",
        hair="bun",
        skin=(0.86, 0.68, 0.58),
        hair_colour=(0.42, 0.27, 0.13),
        top_colour=(0.40, 0.41, 0.43),
        trouser_colour=(0.13, 0.15, 0.20),
        vest_colour=(0.95, 0.42, 0.10),
    ),
    Person(
        name="picker_carl",
        seed=4,
        height_m=1.88,
        shoulders=1.05,
        girth=1.06,
        top="shirt",
        vest=False,
        head_wear="cap",
        beard=True,
        skin=(0.76, 0.56, 0.44),
        hair_colour=(0.10, 0.08, 0.07),
        top_colour=(0.47, 0.10, 0.10),
        trouser_colour=(0.33, 0.29, 0.22),
        helmet_colour=(0.14, 0.15, 0.18),
    ),
    Person(
        name="manager_dora",
        seed=5,
        height_m=1.72,
        shoulders=0.91,
        hips=1.04,
        girth=0.92,
        bust=0.03,
        top="jacket",
        vest=False,
        head_wear="none",
        hair="bob",
        glasses=True,
        skin=(0.66, 0.47, 0.36),
        hair_colour=(0.07, 0.05, 0.045),
        top_colour=(0.55, 0.50, 0.42),
        trouser_colour=(0.12, 0.12, 0.14),
    ),
    Person(
        name="driver_emil",
        seed=7,
        height_m=1.70,
        shoulders=1.06,
        girth=1.16,
        belly=0.065,
        hips=1.06,
        top="jacket",
        vest=False,
        head_wear="none",
        hair="bald",
        skin=(0.84, 0.62, 0.54),
        hair_colour=(0.45, 0.42, 0.40),
        top_colour=(0.50, 0.13, 0.11),
        trouser_colour=(0.20, 0.24, 0.33),
    ),
    Person(
        name="visitor_fay",
        seed=9,
        height_m=1.55,
        shoulders=0.88,
        hips=1.02,
        girth=0.88,
        bust=0.024,
        top="shirt",
        head_wear="helmet",
        hair="bob",
        glasses=True,
        skin=(0.83, 0.66, 0.53),
        hair_colour=(0.06, 0.05, 0.05),
        top_colour=(0.80, 0.80, 0.79),
        trouser_colour=(0.21, 0.27, 0.40),
        vest_colour=(0.95, 0.45, 0.12),
        helmet_colour=(0.20, 0.42, 0.72),
    ),
    Person(
        name="fitter_gus",
        seed=10,
        height_m=1.95,
        shoulders=1.02,
        girth=0.95,
        top="hoodie",
        head_wear="helmet",
        beard=True,
        skin=(0.40, 0.27, 0.20),
        hair_colour=(0.05, 0.04, 0.04),
        top_colour=(0.17, 0.17, 0.18),
        trouser_colour=(0.42, 0.38, 0.30),
        helmet_colour=(0.94, 0.74, 0.10),
    ),
    Person(
        name="coat_hana",
        seed=11,
        height_m=1.64,
        shoulders=0.90,
        hips=1.0,
        girth=0.92,
        bust=0.02,
        top="coat",
        vest=False,
        head_wear="none",
        hair="short",
        skin=(0.85, 0.69, 0.60),
        hair_colour=(0.30, 0.24, 0.20),
        top_colour=(0.60, 0.60, 0.59),
        trouser_colour=(0.30, 0.30, 0.31),
        shoe_colour=(0.2, 0.2, 0.2),
        plain=True,
    ),
    Person(
        name="worker_ivo",
        seed=14,
        height_m=1.61,
        shoulders=1.0,
        girth=1.08,
        belly=0.02,
        top="jacket",
        head_wear="helmet",
        skin=(0.58, 0.40, 0.29),
        hair_colour=(0.05, 0.05, 0.05),
        top_colour=(0.78, 0.36, 0.08),
        trouser_colour=(0.17, 0.20, 0.17),
        helmet_colour=(0.72, 0.12, 0.10),
    ),
    Person(
        name="clerk_jon",
        seed=16,
        height_m=1.83,
        shoulders=0.97,
        girth=0.94,
        top="coat",
        head_wear="none",
        vest=False,
        hair="short",
        glasses=True,
        skin=(0.87, 0.70, 0.62),
        hair_colour=(0.55, 0.42, 0.24),
        top_colour=(0.20, 0.33, 0.52),
        trouser_colour=(0.26, 0.25, 0.24),
    ),
]


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    for person in PEOPLE:
        if not wanted or person.name in wanted:
            path = os.path.join(HERE, "..", "people", person.name + ".glb")
            figure.build(person, clips.everything, os.path.abspath(path))


if __name__ == "__main__":
    main()
