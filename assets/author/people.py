"""Makes assets/people/*.glb. Run: blender -b --factory-startup -P assets/author/people.py -- [name]"""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import body, clips, figure  # noqa: E402

PEOPLE = [
    body.Person(name="worker_anton", seed=1, height_m=1.78),
]


def main():
    wanted = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for person in PEOPLE:
        if not wanted or person.name in wanted:
            path = os.path.join(HERE, "..", "people", person.name + ".glb")
            figure.build(person, clips.basic, os.path.abspath(path))


main()
