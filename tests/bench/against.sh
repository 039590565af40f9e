#!/usr/bin/env bash
# Holds the benchmarks of this tree against those of another commit: `./zstep bench --against REV [PROGRAM [ARGUMENT...]]`.
# The other commit is built beside this build. Both take turns, so that what the machine does besides falls on both, and
# each figure's median is compared. A figure more than 1.25 times as bad is marked.
#
#     tests/bench/against.sh BUILD_FOLDER REV [PROGRAM [ARGUMENT...]]        default: zstep_bench_trace, all of it
#     ZSTEP_GOES=N                                                            how often each of both runs; default 3
set -eu
build=$1 rev=$2
shift 2
[ $# -gt 0 ] || set -- zstep_bench_trace
cd "$(dirname "$0")/../.."
say() { printf 'zstep: %s\n' "$*" >&2; }

commit=$(git rev-parse --verify --quiet --short "$rev^{commit}") || { say "$rev is no commit of this clone: git log names some"; exit 2; }
tree=$build/against/$commit
if [ ! -d "$tree" ]; then
  git worktree prune
  git worktree add --quiet --detach "$tree" "$commit"
fi
if [ ! -x "$tree/build/release/bin/$1" ]; then
  say "building $1 of $commit in $tree"
  (cd "$tree" && cmake --preset release -DZSTEP_TESTS=ON -DZSTEP_BENCH=ON >/dev/null && cmake --build build/release --target "$1" >&2) ||
    { say "$commit has no $1 that can be built"; exit 2; }
fi

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
here=() there=()
for go in $(seq "${ZSTEP_GOES:-3}"); do
  say "$*: go $go of ${ZSTEP_GOES:-3}"
  "$build/bin/$1" "${@:2}" >"$folder/here$go"
  "$tree/build/release/bin/$1" "${@:2}" >"$folder/there$go"
  here+=("$folder/here$go") there+=("$folder/there$go")
done
printf '%s of this tree (%s) against %s, medians of %d\n\n' "$*" "$(git rev-parse --short HEAD)" "$commit" "${#here[@]}"
awk -v limit=1.25 -f tests/bench/ratios.awk side=here "${here[@]}" side=there "${there[@]}"
