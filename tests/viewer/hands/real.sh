#!/bin/bash
# real.sh PROGRAM FOLDER OPENED...: opens the window, does what FOLDER/script says to xdotool, and leaves what is shown
# in FOLDER/shown.png. The window closes by its own key, or by the id of its process.
program=$1 folder=$2
shift 2
export XDG_CONFIG_HOME=$folder/kept
mkdir -p "$folder/kept" && cd "$folder" || exit 1
"$program" "$@" --size-window 1280x720 2>"$folder/said" &
window=$!
trap 'kill $window 2>/dev/null' EXIT
timeout 10 xdotool search --sync --onlyvisible --name "zstep" >/dev/null || exit 1
sleep 0.3
while read -r line; do
  eval "xdotool $line" || exit 1
  sleep 0.06
done <"$folder/script"
sleep 0.4
xdotool key ctrl+s
for _ in $(seq 50); do
  picture=$(ls zstep-*.png 2>/dev/null | head -1)
  [ -n "$picture" ] && break
  sleep 0.1
done
sleep 0.1
mv "$picture" shown.png || exit 1
xdotool key ctrl+q
for _ in $(seq 30); do
  kill -0 $window 2>/dev/null || exit 0
  sleep 0.1
done
exit 0
