#!/usr/bin/env bash
# Which lines of the product the tests run, by folder: builds all with clang's counters (build/coverage), runs the tests
# of each binary once, in one process each, and prints the table of CONTRIBUTING.md.
#
#     tests/coverage.sh [FILTER]        FILTER: as doctest's -tc
set -eu
cd "$(dirname "$0")/.."
build=$PWD/build/coverage
find_tool() { command -v "$1" || command -v "$1-14" || { printf 'coverage: %s is missing; install llvm\n' "$1" >&2; exit 2; }; }
profdata=$(find_tool llvm-profdata) cov=$(find_tool llvm-cov)
cmake --preset coverage -DZSTEP_TESTS=ON >/dev/null
cmake --build "$build" --target zstep zstep_tests zstep_cli_tests zstep_viewer_tests zstep_words_tests

rm -f "$build"/*.profraw
binaries=()
for tests in zstep_tests zstep_cli_tests zstep_words_tests zstep_viewer_tests; do
  # %m: processes of one program add to one file.
  LLVM_PROFILE_FILE=$build/%m.profraw SDL_VIDEODRIVER=dummy "$build/bin/$tests" ${1:+"-tc=$1"} -m >/dev/null ||
    printf 'coverage: some of %s failed; what they ran counts\n' "$tests" >&2
  binaries+=(-object "$build/bin/$tests")
done
"$profdata" merge -sparse "$build"/*.profraw -o "$build/all.profdata"
"$cov" export "$build/zstep" "${binaries[@]}" -instr-profile "$build/all.profdata" -summary-only \
  -ignore-filename-regex='(/tests/|/usr/|/build/)' >"$build/coverage.json"
python3 - "$build/coverage.json" "$PWD/" <<'PY'
import collections, json, sys
lines = collections.defaultdict(lambda: [0, 0])
for file in json.load(open(sys.argv[1]))["data"][0]["files"]:
    path = file["filename"].removeprefix(sys.argv[2]).split("/")
    folder = "/".join(path[:2]) if len(path) > 2 else path[0]
    for name in (folder, "all"):
        lines[name][0] += file["summary"]["lines"]["covered"]
        lines[name][1] += file["summary"]["lines"]["count"]
print("| folder | lines | run by the tests |\n|---|---|---|")
for name, (run, count) in sorted(lines.items(), key=lambda item: (item[0] == "all", item[0])):
    print(f"| {name} | {count} | {100 * run / max(1, count):.1f} % |")
PY
