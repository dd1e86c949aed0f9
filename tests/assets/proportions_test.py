"""People have the proportions of people, a normal sheet, and no twin. Exit 77 (skipped) without numpy."""

import json
import pathlib
import sys

PEOPLE = 16


def shape_of(glb):
    """What no recoloured copy could change: where the vertices are."""
    mesh = glb.json["meshes"][0]
    return tuple(glb.json["accessors"][p["attributes"]["POSITION"]]["count"] for p in mesh["primitives"])


def main(source_dir):
    root = pathlib.Path(source_dir) / "assets"
    sys.path.insert(0, str(root / "author"))
    try:
        from lib import gltf, proportions
    except ImportError as missing:
        print(f"skipped: {missing} (Debian: python3-numpy)")
        return 77
    manifest = json.loads((root / "manifest.json").read_text(encoding="utf-8"))
    people = [a for a in manifest["assets"].values() if a["kind"] == "person"]
    bad, shapes = [], {}
    if len(people) < PEOPLE:
        bad.append(f"{len(people)} people, {PEOPLE} wanted")
    for person in people:
        glb = gltf.Glb(root / person["file"])
        found = proportions.measure(glb)
        for name in proportions.wrong(found):
            bad.append(f"{person['file']}: {name} is {found[name]:.3f} of the height")
        if any("normalTexture" not in m for m in glb.json["materials"]):
            bad.append(f"{person['file']}: a material without a normal sheet")
        twin = shapes.setdefault(shape_of(glb), person["file"])
        if twin != person["file"]:
            bad.append(f"{person['file']} has the mesh of {twin}")
    print("\n".join(bad) or f"{len(people)} people: heads and shoulders within the published range")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
