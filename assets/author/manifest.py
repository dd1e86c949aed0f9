"""Writes assets/manifest.json from the files themselves: what each asset is, its size and its hash.

Run after the authors: /usr/bin/python3 assets/author/manifest.py (needs numpy only). Facts that a
file cannot show (clip strides, wheel radii) are written by the authors into the .glb as the extras
"aisle" of its root node and copied from there.
"""

import hashlib
import json
import os
import struct
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(HERE)
sys.path.insert(0, HERE)

from lib import feet, gltf  # noqa: E402

FOLDERS = {
    "people": "person",
    "vehicles": "vehicle",
    "kit": "kit",
    "street": "street",
    "textures": "texture",
    "places": "vocabulary",
}
CONVENTIONS = {
    "units": "metres, seconds",
    "frame": "object frame: x forward, y left, z up, origin on the floor; glTF (x, y, z) is the "
    "object's (x, -z, y)",
    "person": "clips are in place: move the object by stride_m (and turn_deg about z) per cycle of "
    "duration_s and standing feet do not slide; speed_mps = stride_m / duration_s, "
    "negative backwards. slip_m, sink_m: measured on the exported file",
    "vehicle": "origin on the floor below the axle named by `origin`; wheels turn about their local "
    "y, steered nodes about z, mast nodes slide along z. ridden: once every development_m its "
    "crank and its rider's clip go round, its pedals staying level. hitch_m: along x from the origin "
    "to what couples it, `ahead` (a drawbar's eye) and `behind` (a pin)",
}


def digest(path):
    with open(path, "rb") as f:
        return hashlib.sha256(f.read()).hexdigest()


def rounded(values):
    return [round(float(v), 4) for v in values]


def describe_glb(path, entry):
    """Triangles, bounds, textures, clips and the author's facts of one .glb."""
    glb = gltf.Glb(path)
    facts = glb.facts()
    low, high = glb.bounds(facts.get("ridden", {}).get("clip"))
    entry["triangles"] = glb.triangles()
    entry["bounds_m"] = {"min": rounded(low), "max": rounded(high)}
    entry.update(facts)
    for name, clip in entry.get("clips", {}).items():
        m = feet.measure(glb, name, clip.get("stride_m", 0.0), clip.get("turn_deg", 0.0), 120)
        clip["slip_m"], clip["sink_m"] = round(m["slip_m"], 4), round(m["sink_m"], 4)
    if "clips" in entry:
        missing = set(entry["clips"]) ^ set(glb.clips())
        if missing:
            raise SystemExit(f"{path}: clips and facts differ: {sorted(missing)}")


def describe_png(path, entry):
    with open(path, "rb") as f:
        head = f.read(33)
    width, height, _, colour = struct.unpack(">IIBB", head[16:26])
    entry.update(width=width, height=height, channels={0: 1, 2: 3}[colour])
    side = path[:-4] + ".json"
    if os.path.exists(side):
        with open(side, encoding="utf-8") as f:
            entry.update(json.load(f))


def known():
    """Entries of the present manifest by hash: unchanged files need no new measurement."""
    path = os.path.join(ROOT, "manifest.json")
    if not os.path.exists(path):
        return {}
    with open(path, encoding="utf-8") as f:
        entries = json.load(f)["assets"].values()
    return {e["sha256"]: e for e in entries if e["kind"] != "texture"}


def main():
    assets, before = {}, known()
    for folder, kind in FOLDERS.items():
        where = os.path.join(ROOT, folder)
        for file in sorted(os.listdir(where)) if os.path.isdir(where) else []:
            path, (name, ext) = os.path.join(where, file), os.path.splitext(file)
            if ext not in (".glb", ".png", ".voc"):
                continue
            entry = {
                "file": f"{folder}/{file}",
                "kind": kind,
                "licence": "BSD-3-Clause",
                "author": f"assets/author/{folder}.{'sh' if kind == 'vocabulary' else 'py'}",
                "bytes": os.path.getsize(path),
                "sha256": digest(path),
            }
            old = before.get(entry["sha256"])
            if old and old["file"] == entry["file"]:
                entry = old
            elif ext != ".voc":
                (describe_glb if ext == ".glb" else describe_png)(path, entry)
            assets[f"{folder}/{name}"] = entry
    text = json.dumps({"schema": 1, "conventions": CONVENTIONS, "assets": assets}, indent=1)
    out = os.path.join(ROOT, "manifest.json")
    with open(out + ".part", "w", encoding="utf-8") as f:
        f.write(text + "\n")
    os.replace(out + ".part", out)
    total = sum(a["bytes"] for a in assets.values())
    print(f"{len(assets)} assets, {total / 1e6:.1f} MB")


if __name__ == "__main__":
    main()
