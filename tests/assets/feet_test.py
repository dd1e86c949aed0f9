"""Standing feet neither slide nor sink in any clip of any person. Exit 77 (skipped) without numpy."""

import json
import pathlib
import sys

SLIP_LIMIT_M, SINK_LIMIT_M = 0.02, 0.01


def main(source_dir):
    root = pathlib.Path(source_dir) / "assets"
    sys.path.insert(0, str(root / "author"))
    try:
        from lib import feet, gltf
    except ImportError as missing:
        print(f"skipped: {missing} (Debian: python3-numpy)")
        return 77
    manifest = json.loads((root / "manifest.json").read_text(encoding="utf-8"))
    people = [a for a in manifest["assets"].values() if a["kind"] == "person"]
    worst = {"slip_m": 0.0, "sink_m": 0.0}
    bad = [] if people else ["no people in the manifest"]
    for person in people:
        glb = gltf.Glb(root / person["file"])
        for clip, facts in person["clips"].items():
            if abs(glb.duration(clip) - facts["duration_s"]) > 1e-4:
                bad.append(
                    f"{person['file']} {clip}: lasts {glb.duration(clip)} s, {facts['duration_s']} s stated"
                )
            m = feet.measure(glb, clip, facts.get("stride_m", 0.0), facts.get("turn_deg", 0.0), 50)
            if m["slip_m"] > SLIP_LIMIT_M or m["sink_m"] > SINK_LIMIT_M:
                bad.append(
                    f"{person['file']} {clip}: slips {m['slip_m']:.4f} m, sinks {m['sink_m']:.4f} m"
                )
            worst = {k: max(v, m[k]) for k, v in worst.items()}
    print(
        "\n".join(bad)
        or f"{len(people)} people: slip at most {worst['slip_m']:.4f} m, sink at most {worst['sink_m']:.4f} m"
    )
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
