#!/bin/sh
# drive.sh [FOLDER]: makes drive.webp, the moving picture of the README, out of the film that a closed
# drive leaves beside its report. Minutes. Needs ffmpeg with libwebp, as Debian has it.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-out/first_sight}
./aisle run scenes/drive/follow_dock.yaml --systems robust --out "$out"
film=$out/runs/drive.follow_dock/live/robust/1/drive.mp4
# Every second picture of ten a second, eight a second: 1.6 times the pace of the drive.
ffmpeg -v error -y -i "$film" -vf "select='not(mod(n,2))',setpts=N/8/TB" -r 8 \
  -c:v libwebp_anim -lossless 0 -q:v 40 -compression_level 6 -loop 0 reports/pictures/drive.webp
ls -l reports/pictures/drive.webp
