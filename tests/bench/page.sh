#!/usr/bin/env bash
# Writes what the benchmarks print into the pages that quote it: `./zstep bench --page`. A page marks the place by
#
#     <!-- bench: PROGRAM ARGUMENT... -->
#     <!-- end -->
#
# and what stands between the two lines is replaced: a line that says of which commit, day and machine the figures are,
# and the program's table. A program that fails leaves all pages as they are.
#
#     tests/bench/page.sh FOLDER_OF_THE_PROGRAMS [PAGE...]        default: README.md and all pages of docs/ with a mark
set -eu
programs=$1
shift
cd "$(dirname "$0")/../.."
[ $# -gt 0 ] || mapfile -t pages < <(grep -l '^<!-- bench: ' README.md docs/*.md)
[ $# -eq 0 ] || pages=("$@")

commit=$(git rev-parse --short HEAD 2>/dev/null || echo "no commit")
[ -z "$(git status --porcelain --untracked-files=no 2>/dev/null)" ] || commit+=" with changes"
machine=$(sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1 | tr -s ' ')
compiler=$("${CXX:-c++}" -dumpfullversion -dumpversion 2>/dev/null || echo "?")
head="Commit $commit, $(LC_ALL=C date '+%-d %B %Y'), ${machine:-$(uname -m)}, $(nproc) processors, $(basename "${CXX:-c++}") $compiler:"

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
number=0
declare -A printed
while IFS= read -r command; do
  [ -z "${printed[$command]-}" ] || continue
  number=$((number + 1))
  printed[$command]=$folder/$number
  printf 'zstep: %s\n' "$command" >&2
  read -r -a words <<<"$command"
  "$programs/${words[0]}" "${words[@]:1}" >"$folder/$number" || { printf 'zstep: %s failed; no page was changed\n' "$command" >&2; exit 1; }
done < <(sed -n 's/^<!-- bench: \(.*\) -->$/\1/p' "${pages[@]}")

for page in "${pages[@]}"; do
  inside=no
  while IFS= read -r line; do
    case $line in
      '<!-- bench: '*' -->')
        command=${line#<!-- bench: }
        printf '%s\n\n%s\n\n' "$line" "$head"
        sed -e :a -e '/^\n*$/{$d;N;ba' -e '}' "${printed[${command% -->}]}"
        printf '\n'
        inside=yes
        ;;
      '<!-- end -->') inside=no ;;
    esac
    [ "$inside" = yes ] || printf '%s\n' "$line"
  done <"$page" >"$folder/page"
  cat "$folder/page" >"$page"
  printf 'zstep: %s\n' "$page" >&2
done
