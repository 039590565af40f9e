#!/usr/bin/env bash
# What the native program draws at every stop of every lesson, for page_test.mjs: pictures.sh PROGRAM FOLDER
set -eu
program=$1 folder=$2
mkdir -p "$folder"
count=0 index=''
for file in "$(dirname "${BASH_SOURCE[0]}")"/../../lessons/[0-9]*-*.md; do
  lesson=$(basename "$file" .md)
  lesson=${lesson#*-}
  for stop in $(seq "$(grep -c '^## ' "$file")"); do
    link="#lesson=$lesson&stop=$stop"
    "$program" "$link" --screenshot "$folder/$count.png" >/dev/null
    index+="${index:+,}{\"link\": \"$link\", \"file\": \"$count.png\"}"
    count=$((count + 1))
  done
done
printf '[%s]\n' "$index" >"$folder/index.json"
echo "$count pictures"
