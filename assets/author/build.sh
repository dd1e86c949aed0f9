#!/usr/bin/env bash
# Rebuilds every asset, the manifest and the contact sheets. Needs Debian's blender (3.4.1) with numpy;
# about fifteen minutes on two cores. Usage: assets/author/build.sh
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
# One thread: Blender sums vertex normals in the order its threads arrive.
run() { blender -b -t 1 --factory-startup -noaudio --python-exit-code 1 -P "$here/$1.py"; }
run textures
run kit
run street
run vehicles
run people
/usr/bin/python3 "$here/pack.py" "$here"/../{kit,street,vehicles,people}/*.glb
/usr/bin/python3 "$here/measure.py"
/usr/bin/python3 "$here/manifest.py"
blender -b --factory-startup -noaudio --python-exit-code 1 -P "$here/contact.py"
blender -b --factory-startup -noaudio --python-exit-code 1 -P "$here/near.py"  # needs the built program
