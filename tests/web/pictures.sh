#!/usr/bin/env bash
# What the native program draws, for page_test.mjs: every stop of every lesson; runs published with the page of SITE, where
# that is named; and what is embedded: pictures.sh PROGRAM FOLDER [SITE]
set -eu
program=$(realpath "$1") folder=$2 site=${3:+$(realpath "$3")}
lessons=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../../lessons")
mkdir -p "$folder"
cd "$folder"
count=0 index=''
# A picture of what words of a command line open, and what of a page is to be the same.
picture() {
  local what=$1
  shift
  "$program" "$@" --screenshot "$count.png" >/dev/null || [ $? = 1 ]  # 1: a run that is judged wrong
  index+="${index:+,}{$what, \"file\": \"$count.png\"}"
  count=$((count + 1))
}

if [ -n "$site" ]; then
  "$program" record pyramid-behind -o run.ztrace >/dev/null
  "$program" dump run.ztrace --jsonl | sed '0,/"nearer":true/s//"nearer":false/' >wrong.jsonl
  publish() { "$program" publish "$@" --site "$site" >/dev/null; }
  publish run.ztrace --at 900 --pixel 14,12 --lead depth -o place.html
  picture '"page": "place.html"' view run.ztrace --at 900 --pixel 14,12 --lead depth
  picture '"page": "place.html#embed=1"' view run.ztrace --at 900 --pixel 14,12 --lead depth --embed
  publish wrong.jsonl --check -o judged.html
  picture '"page": "judged.html"' check wrong.jsonl --view
  publish run.ztrace --against wrong.jsonl --dark -o both.html
  picture '"page": "both.html"' diff run.ztrace wrong.jsonl --view --dark
  picture '"page": "place.html#lesson=bsp&stop=2"' '#lesson=bsp&stop=2'
fi
link='#embed=1&lesson=z-buffer&step=867&pane=slice'
picture "\"link\": \"$link\"" "$link"
printf '[%s]\n' "$index" >pages.json

index=''
for file in "$lessons"/[0-9]*-*.md; do
  lesson=$(basename "$file" .md)
  lesson=${lesson#*-}
  for stop in $(seq "$(grep -c '^## ' "$file")"); do
    link="#lesson=$lesson&stop=$stop"
    picture "\"link\": \"$link\"" "$link"
  done
done
printf '[%s]\n' "$index" >index.json
echo "$count pictures"
