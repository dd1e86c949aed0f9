"""Does what reports/docs/own_robot.md tells its reader to do, block by block, in an empty folder.

A block that opens with "# NAME" is that file; the others are commands, with ./aisle for the program.

Usage: own_robot_test.py PROGRAM SOURCE_DIR
"""

import pathlib
import re
import subprocess
import sys
import tempfile


def main(program, source):
    page = (pathlib.Path(source) / "reports/docs/own_robot.md").read_text()
    blocks = re.findall(r"^```[^\n]*\n(.*?)^```$", page, re.M | re.S)
    with tempfile.TemporaryDirectory(prefix="aisle_own_robot_") as name:
        folder = pathlib.Path(name)
        for block in blocks:
            file = re.match(r"# (\S+\.yaml)\n", block)
            if file:
                (folder / file[1]).write_text(block)
                continue
            script = re.sub(r"^\./aisle\b", str(program), block, flags=re.M)
            done = subprocess.run(["bash", "-euo", "pipefail", "-c", script], cwd=folder,
                                  capture_output=True, text=True)
            if done.returncode:
                print(f"{block}\nexit {done.returncode}\n{done.stdout}{done.stderr}")
                return 1
            print(done.stdout.strip())
        missing = [path for path in ("lotte.png", "out/lotte/index.html", "recorded.txt",
                                     "hall.png", "hall.aislemesh.json",
                                     "out/lotte/bags/lotte/live/1/metadata.yaml",
                                     "out/front/mav0/cam0_rgb/data.csv",
                                     "out/rear/mav0/cam1/data.csv",
                                     "out/front_bag/drive.mcap")
                   if not (folder / path).is_file()]
        if missing:
            print("the page promises what is not there:", missing)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
