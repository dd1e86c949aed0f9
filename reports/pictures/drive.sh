#!/bin/sh
# drive.sh [FOLDER]: makes drive.webp, the moving picture of the README, out of the films that two closed
# drives leave beside their report: orbslam2's above, robust's beneath. Minutes. Needs ffmpeg with libwebp,
# as Debian has it.
set -eu
cd "$(dirname "$0")/../.."
out=${1:-out/first_sight}
./aisle run scenes/drive/close_behind.yaml --systems orbslam2,robust --out "$out"
films=$out/runs/drive.close_behind/live
# From 5 s on, every third picture of ten a second, six a second: 1.8 times the pace of the drives. Who
# has come to his end waits for the other.
ffmpeg -v error -y -i "$films/orbslam2/1/drive.mp4" -i "$films/robust/1/drive.mp4" -filter_complex \
  "[0]tpad=stop_mode=clone:stop_duration=20[a];[a][1]vstack=shortest=1,trim=start_frame=50,setpts=PTS-STARTPTS,select='not(mod(n\,3))',setpts=N/6/TB,scale=640:-2" \
  -r 6 -c:v libwebp_anim -lossless 0 -q:v 30 -compression_level 6 -loop 0 reports/pictures/drive.webp
ls -l reports/pictures/drive.webp
