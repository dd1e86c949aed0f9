"""Makes assets/kit/*.glb: goods and furniture of the warehouse. Origin on the floor below the middle.

Run: blender -b --factory-startup -P assets/author/kit.py -- [name ...]
"""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import kit_furniture as furniture, kit_goods as goods  # noqa: E402
from lib.solid import Machine  # noqa: E402

KIT = {
    f.__name__: f
    for f in (
        goods.drum,
        goods.tote,
        goods.pallet,
        goods.pallet_cartons,
        goods.pallet_wrapped,
        furniture.conveyor,
        furniture.conveyor_loaded,
        furniture.dock_door,
        furniture.bollard,
        furniture.guard_rail,
        furniture.roll_cage,
        furniture.floor_sign,
        furniture.cone,
        furniture.step_ladder,
        furniture.waste_bin,
    )
}


def main():
    wanted = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    for name, build in KIT.items():
        if wanted and name not in wanted:
            continue
        with tempfile.TemporaryDirectory() as folder:
            m = Machine(name, folder)
            build(m)
            m.finish(
                os.path.abspath(os.path.join(HERE, "..", "kit", name + ".glb")),
                {"origin": "floor below the middle"},
            )


if __name__ == "__main__":
    main()
