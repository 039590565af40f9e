#!/usr/bin/env bash
# Holds `zstep check` against a renderer that others wrote: Burning's Video of the Irrlicht engine, spans in float32 with
# 1/w in the depth buffer. By hand:
#   tests/irrlicht/held_against.sh SOURCE [SCENES] [ZSTEP]
# SOURCE: the unpacked source of the engine (of Debian, `apt-get source irrlicht`); libirrlicht-dev must be installed. Its
# CTRGouraud2.cpp gets the calls of `zstep emit cpp` put in and takes the place of the library's own. Prints how many
# scenes are doubted as it is, how many with the viewport declared that it does not have, and for each line of faults.txt
# in how many of the first eight runs it shows and is found.
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
source="$(cd "$1" && pwd)" scenes="${2:-200}" zstep="$(realpath "${3:-$here/../../build/release/zstep}")"
width=40 height=30
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work"

printf 'coordinates = "screen"\n[[polygon]]\npoints = [[0, 0, 1], [4, 0, 1], [0, 4, 1]]\n' > any.toml
"$zstep" emit cpp any.toml -o . > /dev/null
sed -e 's/if ( line.w\[0\] >= z\[i\] )/if ( tested ( xStart + i, line.y, line.w[0], line.w[0] >= z[i] ) )/' \
    -e 's/^\t\t\tz\[i\] = line.w\[0\];/\t\t\tz[i] = line.w[0]; kept ( xStart + i, line.y, line.w[0] );/' \
    -e '/#include "IBurningShader.h"/r /dev/stdin' "$source/source/Irrlicht/CTRGouraud2.cpp" > right.cpp << 'CALLS'
#include "zstep.hpp"
extern int polygon_at_work;
static bool tested(int x, int y, float w, bool wins, zstep::Place at = {__builtin_FILE(), __builtin_LINE()}) {
  zstep::compare(x, y, w, wins, at);
  return wins;
}
static void kept(int x, int y, float w, zstep::Place at = {__builtin_FILE(), __builtin_LINE()}) {
  zstep::write_depth(x, y, w, at), zstep::write_pixel(x, y, polygon_at_work, at);
}
CALLS

build() {  # NAME: NAME.cpp in place of the library's
  g++ -O1 -w -rdynamic -I. -I"$source/source/Irrlicht" -I"$source/include" "$here/draw.cpp" "$1.cpp" -o "$1" -lIrrlicht
}
run() {  # NAME SEED [plain]: run.jsonl, and what check says of it
  python3 "$here/scene.py" "$2" $width $height "$zstep" ${3:+"$3"}
  "./$1" triangles.txt $width $height "$1.jsonl" > /dev/null
  cat head.jsonl "$1.jsonl" > run.jsonl
  "$zstep" check run.jsonl > said.txt 2>&1
}

build right
doubted=0 plain=0
for seed in $(seq 1 "$scenes"); do
  run right "$seed" || doubted=$((doubted + 1))
  [ "$seed" -gt 20 ] || run right "$seed" plain || plain=$((plain + 1))
done
echo "as it is: $doubted of $scenes doubted; with another viewport declared: $plain of 20 found wrong"
changed_all=0 found_all=0
while IFS='|' read -r name edit; do
  sed -e "$edit" right.cpp > fault.cpp
  build fault
  changed=0 found=0
  for seed in 1 2 3 4 5 6 7 8; do
    run right "$seed" || true
    code=0
    run fault "$seed" || code=$?
    if cmp -s <(sed 's/,"at":"[^"]*"//' right.jsonl) <(sed 's/,"at":"[^"]*"//' fault.jsonl); then continue; fi
    changed=$((changed + 1))
    [ "$code" != 1 ] || found=$((found + 1))
  done
  changed_all=$((changed_all + changed)) found_all=$((found_all + found))
  echo "$name: found in $found of $changed runs that it changes"
done < "$here/faults.txt"
echo "all: $found_all of $changed_all"
