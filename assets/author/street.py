"""Makes assets/street/*.glb: what stands along a street. Cars and cyclists are vehicles.

Run: blender -b --factory-startup -P assets/author/street.py -- [name ...]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import facades, street_parts, trees  # noqa: E402


def pieces():
    made = {
        name: lambda *a, look=look: facades.house(*a, **look)
        for name, look in facades.HOUSES.items()
    }
    made["tree_round"] = lambda *a: trees.tree(*a, 1, 7.5, 5.0, (0.27, 0.38, 0.15))
    made["tree_slim"] = lambda *a: trees.tree(*a, 2, 9.0, 3.8, (0.32, 0.41, 0.20), 0.15, 150, 58)
    made["hedge"] = trees.hedge
    made["lamp_post"] = street_parts.lamp_post
    for k, name in enumerate(("priority", "speed", "parking", "crossing")):
        made[f"sign_{name}"] = lambda *a, k=k: street_parts.traffic_sign(*a, k)
    return made


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    os.makedirs(os.path.join(HERE, "..", "street"), exist_ok=True)
    for name, build in pieces().items():
        if not wanted or name in wanted:
            path = os.path.abspath(os.path.join(HERE, "..", "street", name + ".glb"))
            with tempfile.TemporaryDirectory() as folder:
                build(name, folder, path)


if __name__ == "__main__":
    main()
