"""assets/manifest.json tells the truth: files, hashes, budgets, clips. Standard library only."""

import hashlib
import json
import pathlib
import struct
import sys

TOTAL_BYTES = 90_000_000
VOCABULARY_BYTES = 8_000_000
TRIANGLES = {"person": (8_000, 30_000), "vehicle": (2_000, 60_000), "kit": (12, 20_000), "street": (12, 40_000)}
CLIPS = {
    "stand",
    "walk_creep",
    "walk_slow",
    "walk",
    "walk_fast",
    "walk_backwards",
    "turn_left",
    "turn_right",
    "wave",
    "look_around",
    "pick",
    "walk_carry",
    "stand_carry",
    "walk_push",
}


def glb_json(data):
    magic, version, length, size, _ = struct.unpack("<4sIIII", data[:20])
    assert magic == b"glTF" and version == 2 and length == len(data), "not a whole glTF 2.0 file"
    return json.loads(data[20 : 20 + size])


def wrong_with(name, asset, root):
    """Sentences that say what is wrong with one asset."""
    path = root / asset["file"]
    if not path.is_file():
        return [f"{name}: {asset['file']} is missing"]
    data, bad = path.read_bytes(), []
    if hashlib.sha256(data).hexdigest() != asset["sha256"]:
        bad.append(f"{name}: hash differs; rebuild with assets/author/manifest.py")
    if asset["licence"] != "BSD-3-Clause" or not (root.parent / asset["author"]).is_file():
        bad.append(f"{name}: licence or author script")
    if asset["kind"] == "vocabulary":
        if not data.startswith(b"aislevoc") or len(data) > VOCABULARY_BYTES:
            bad.append(f"{name}: no vocabulary of at most {VOCABULARY_BYTES} bytes")
        return bad
    if asset["kind"] == "texture":
        size = struct.unpack(">II", data[16:24])
        if any(s > 2048 or s & (s - 1) for s in size):
            bad.append(f"{name}: {size} is not a power of two up to 2048")
        return bad
    low, high = TRIANGLES[asset["kind"]]
    if not low <= asset["triangles"] <= high:
        bad.append(f"{name}: {asset['triangles']} triangles, expected {low} to {high}")
    document = glb_json(data)
    nodes = {n.get("name") for n in document["nodes"]}
    if asset["kind"] == "person":
        present = {a["name"] for a in document.get("animations", [])}
        if present != set(asset["clips"]) or not CLIPS <= present:
            bad.append(f"{name}: clips {sorted(present ^ CLIPS)}")
        tall = asset["bounds_m"]["max"][2]
        if not -0.05 < tall - asset["height_m"] < 0.10:
            bad.append(f"{name}: {tall} m tall, {asset['height_m']} m stated")
        for clip, facts in asset["clips"].items():
            if facts["slip_m"] > 0.02 or facts["sink_m"] > 0.01:
                bad.append(f"{name}: {clip} slips {facts['slip_m']} m, sinks {facts['sink_m']} m")
    if asset["kind"] == "vehicle":
        wanted = set(asset["wheel_radius_m"]) | set(asset["steer_nodes"])
        wanted |= {k for k in asset.get("lift", {}) if not k.endswith(("_m", "_mps"))}
        if wanted - nodes:
            bad.append(f"{name}: nodes {sorted(wanted - nodes)} are missing")
    return bad


def main(source_dir):
    root = pathlib.Path(source_dir) / "assets"
    manifest = json.loads((root / "manifest.json").read_text(encoding="utf-8"))
    bad = []
    for name, asset in manifest["assets"].items():
        bad += wrong_with(name, asset, root)
    listed = {a["file"] for a in manifest["assets"].values()}
    for path in root.glob("*/*"):
        if path.suffix in (".glb", ".png", ".voc") and path.parent.name != "contact":
            if f"{path.parent.name}/{path.name}" not in listed:
                bad.append(f"{path.name} is not in the manifest")
    total = sum(
        p.stat().st_size for p in root.rglob("*") if p.is_file() and "__pycache__" not in p.parts
    )
    if total > TOTAL_BYTES:
        bad.append(f"assets take {total} bytes, more than {TOTAL_BYTES}")
    print("\n".join(bad) or f"{len(listed)} assets, {total / 1e6:.1f} MB: all as stated")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
