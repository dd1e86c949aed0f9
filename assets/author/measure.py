"""Measures the people: slip and floor penetration of every clip, and the body's proportions.

Run: /usr/bin/python3 assets/author/measure.py [file.glb ...]; exits 1 where a limit is broken.
"""

import glob
import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)

from lib import feet, gltf, proportions  # noqa: E402

SLIP_LIMIT_M, SINK_LIMIT_M = 0.02, 0.01


def main():
    files = sys.argv[1:] or sorted(glob.glob(os.path.join(HERE, "..", "people", "*.glb")))
    worst = 0
    for path in files:
        glb = gltf.Glb(path)
        found = proportions.measure(glb)
        wrong = proportions.wrong(found)
        worst |= bool(wrong)
        print(
            f"{os.path.basename(path):24} head 1/{1 / found['head']:.2f} of the height, shoulders "
            f"{found['shoulders']:.3f} {'LIMIT BROKEN: ' + ', '.join(wrong) if wrong else ''}"
        )
        for clip, info in glb.facts()["clips"].items():
            m = feet.measure(glb, clip, info.get("stride_m", 0.0), info.get("turn_deg", 0.0))
            bad = m["slip_m"] > SLIP_LIMIT_M or m["sink_m"] > SINK_LIMIT_M
            worst |= bad
            print(
                f"{os.path.basename(path):24} {clip:16} slip {1000 * m['slip_m']:5.1f} mm "
                f"(one vertex {1000 * m['slip_point_m']:5.1f})  sink {1000 * m['sink_m']:5.1f} mm  "
                f"gap {1000 * m['gap_m']:5.1f} mm {'LIMIT BROKEN' if bad else ''}"
            )
    return worst


if __name__ == "__main__":
    sys.exit(main())
