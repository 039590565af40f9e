#!/usr/bin/env bash
# Parts the page's program in two, so that there is less to fetch before the first picture: the functions that are called
# until then, and all others. split.sh WHOLE LESSONS SITE
#
# WHOLE has the program as it was linked; SITE gets zstep.wasm and zstep.rest.wasm, and WHOLE page.wasm: all of it, without
# names. Which functions come first is found by running an instrumented copy, for each lesson and for the start page.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) whole=$1 lessons=$2 site=$3
work=$whole/split
rm -rf "$work"
mkdir -p "$work" "$site"
wasm-split --instrument -all "$whole/zstep.wasm" -o "$work/watched.wasm"

links=('' '#scene=teapot' '#scene=teapot&method=warnock&step=50%25')
for file in "$lessons"/[0-9]*-*.md; do
  name=$(basename "$file" .md)
  links+=("#lesson=${name#*-}" "#lesson=${name#*-}&stop=3" "#lesson=${name#*-}&step=50%25&pixel=1,1" "#lesson=${name#*-}&step=20")
done
printf '%s\n' "${!links[@]}" | links=$(printf '%s\n' "${links[@]}") xargs -P "$(nproc)" -I NUMBER bash -c '
  mapfile -t all <<<"$links"
  node "$0" "$1" "$2/watched.wasm" "$2/NUMBER.profile" "${all[NUMBER]}" >"$2/NUMBER.log" 2>&1 || { cat "$2/NUMBER.log" >&2; exit 255; }
' "$here/first_functions.mjs" "$whole" "$work"

wasm-split --merge-profiles "$work"/*.profile -o "$work/all"
# Without -g no name is left in either part.
wasm-split --split -all "$whole/zstep.wasm" --profile="$work/all" -o1 "$work/zstep.wasm" -o2 "$work/zstep.rest.wasm"
wasm-opt -all --strip-debug "$whole/zstep.wasm" -o "$whole/page.wasm"
mv "$work/zstep.wasm" "$work/zstep.rest.wasm" "$site"
cp "$whole/zstep.js" "$whole/zstep.data" "$site"
rm -rf "$work"
