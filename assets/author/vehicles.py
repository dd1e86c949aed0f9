"""Makes assets/vehicles/*.glb. Run: blender -b --factory-startup -P assets/author/vehicles.py -- [name]"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import forklift  # noqa: E402

VEHICLES = {"forklift": forklift.build}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
    for name, build in VEHICLES.items():
        if not wanted or name in wanted:
            path = os.path.abspath(os.path.join(HERE, "..", "vehicles", name + ".glb"))
            with tempfile.TemporaryDirectory() as folder:
                build(name, folder, path)


main()
