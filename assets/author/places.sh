#!/usr/bin/env bash
# Trains the visual words that the SLAM recognises places by, from our own rendered frames:
# two of the paper's scenes and the hall of the long loop, without traffic, a few frames each, every
# scene under a seed of its own. The same tree gives the same file.
set -euo pipefail
cd "$(dirname "$0")/../.."
./aisle vocabulary train \
  scenes/paper/scene1.yaml scenes/paper/scene3.yaml scenes/weakness/long_loop.yaml \
  --frames 24 --seed 101 --twin empty --out assets/places/warehouse.voc
/usr/bin/python3 assets/author/manifest.py
