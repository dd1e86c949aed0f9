#!/bin/sh
# convoy.sh [FOLDER]: makes convoy.jpg, the picture of reports/closed_loop.md, out of the films that two closed
# drives leave beside their report, 16 s after their start: orbslam2's above, robust's beneath. Minutes. Needs
# ffmpeg.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-out/convoy}
./aisle run scenes/drive/convoy.yaml --systems orbslam2,robust --set orbslam2.drive.taught=true \
  --set robust.drive.taught=true --twins live --seed 1 --out "$out"
films=$out/runs/drive.convoy/live
ffmpeg -v error -y -ss 16 -i "$films/orbslam2/1/drive.mp4" -ss 16 -i "$films/robust/1/drive.mp4" \
  -filter_complex "[0]trim=end_frame=1[a];[1]trim=end_frame=1[b];[a][b]vstack" -frames:v 1 -q:v 5 \
  reports/pictures/convoy.jpg
ls -l reports/pictures/convoy.jpg
