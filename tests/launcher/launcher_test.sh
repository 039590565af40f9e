#!/usr/bin/env bash
# The launcher, on a system made of stand-ins: a clone of a few files, and a PATH on which only a few tools and scripts
# that play apt-get, sudo, cmake and dpkg-query lie. Each stand-in writes into $calls what it was asked.
#
#   launcher_test.sh SOURCE [CASE]    runs one case, or all; a case is a function below whose name starts with case_
set -u
source_dir=$1
failures=0
box=$(mktemp -d "${TMPDIR:-/tmp}/zstep launcher.XXXXXX")  # with a space, as in people's folders
trap 'rm -rf "$box"' EXIT

tell() { printf "%s\n" "$@"; }
expect() {  # WHAT TEXT PATTERN
  grep -qE -- "$3" <<<"$2" && return
  failures=$((failures + 1))
  tell "FAILED: $1" "  expected: $3" "  in:" "$2"
}
refuse() {  # WHAT TEXT PATTERN
  grep -qE -- "$3" <<<"$2" || return 0
  failures=$((failures + 1))
  tell "FAILED: $1" "  not expected: $3" "  in:" "$2"
}
same() {  # WHAT GOT WANTED
  [ "$2" = "$3" ] && return
  failures=$((failures + 1))
  tell "FAILED: $1: got '$2', wanted '$3'"
}

stand_in() {  # NAME, body from stdin
  { printf '#!/bin/bash\necho "%s $*" >>"$calls"\n' "$1"; cat; } >"$box/bin/$1"
  chmod +x "$box/bin/$1"
}

# A fresh clone on a bare system: no compiler, no cmake, nothing installed; root's id, no sudo.
fresh() {
  rm -rf "${box:?}"/*
  clone="$box/a clone"
  export box calls=$box/calls dpkg_list=$box/installed
  mkdir -p "$clone"/{traces,algorithms,sim,lessons} "$box/bin" "$box/tools"
  cp "$source_dir/zstep" "$clone/"
  : >"$clone/CMakeLists.txt"
  : >"$clone/sim/main.cpp"
  : >"$calls"
  : >"$dpkg_list"
  local tool
  for tool in bash env sed cat cut tr wc grep find dirname id mkdir rm mv df awk paste flock cp chmod nproc head true sleep; do
    ln -s "$(type -P "$tool")" "$box/tools/"
  done
  stand_in id <<<'[ "${1-}" = -u ] && echo "${as_id:-0}"'
  stand_in dpkg-query <<<'sed "s/$/ installed/" "$dpkg_list"'
  stand_in apt-cache <<<'[ "$2" = "${absent-}" ] && echo "  Candidate: (none)" || echo "  Candidate: 1.0"'
  stand_in apt-get <<'APT'
[ -z "${offline-}" ] || { echo "E: Temporary failure resolving 'deb.debian.org'"; exit 100; }
[ -z "${full-}" ] || { echo "E: You don't have enough free space in /var/cache/apt/archives/."; exit 100; }
case " $* " in *" --assume-no "*) echo "0 upgraded, 370 newly installed, 0 to remove"; exit 1 ;; esac
case " $* " in *" install "*) ;; *) exit 0 ;; esac
for word; do
  case $word in -* | *::* | install) ;; *) echo "$word" >>"$dpkg_list"; echo "Setting up $word (1.0) ..." ;; esac
done
for tool in cmake ninja c++ pkg-config ctest; do [ ! -e "$box/kit/$tool" ] || cp "$box/kit/$tool" "$box/bin/$tool"; done
APT
  mkdir -p "$box/kit"
  stand_in cmake <<'CMAKE'
case " $* " in
  *" --preset "*)
    [ -z "${broken-}" ] || { printf '%s\n' "-- looking" "CMake Error at CMakeLists.txt:1 (find_package):" "  Could not find OpenMesh"; exit 1; }
    folder=; previous=
    for word; do [ "$previous" = -B ] && folder=$word; previous=$word; done
    : >"$folder/build.ninja" ;;
  *" --build "*)
    [ -z "${fails-}" ] || exit 1
    printf '#!/bin/bash\nprintf "program:"; printf " <%%s>" "$@"; echo; pwd\n' >"$2/zstep"
    chmod +x "$2/zstep" ;;
esac
CMAKE
  stand_in ninja <<<':'
  stand_in c++ <<<':'
  stand_in pkg-config <<<':'
  stand_in ctest <<<'echo "Total Test time (real) = 0.01 sec"'
  mv "$box"/bin/{cmake,ninja,c++,pkg-config,ctest} "$box/kit/"
  unset as_id offline full absent broken fails
}
zstep() { PATH=$box/bin:$box/tools "$clone/zstep" "$@"; }
tools_there() {
  cp "$box"/kit/* "$box/bin/"
  packages_there
}
packages_there() { zstep packages | while read -r _ _ name _; do printf '%s\n' "$name"; done >"$dpkg_list"; }
start() { output=$(zstep "$@" 2>&1 </dev/null); status=$?; }
# On a terminal, with the given text typed in.
on_terminal() {  # TYPED ARGS...
  local typed=$1
  shift
  output=$(printf '%s' "$typed" | script -qec "PATH='$box/bin:$box/tools' '$clone/zstep' $*" /dev/null 2>&1)
  status=$?
}

case_installs_without_a_terminal_and_without_a_question() {
  start
  same status "$status" 0
  expect "says what is missing and why" "$output" 'libopenmesh-dev +half-edge meshes'
  refuse "does not ask" "$output" '\[Y/n\]'
  expect "installs" "$(cat "$calls")" 'apt-get .*install .*libsdl2-dev'
  refuse "leaves the tests' packages alone" "$(cat "$dpkg_list")" 'doctest-dev'
  expect "updates the list first" "$(grep -n 'apt-get' "$calls" | head -n 1)" 'update'
  expect "builds without tests" "$(cat "$calls")" 'cmake --preset release .*-DZSTEP_TESTS=OFF'
  expect "runs the program" "$output" '^program:'
}

case_web_installs_what_it_is_made_with() {
  unset ZSTEP_WEB_CACHE ZSTEP_WEB_ROOT
  mkdir "$clone/sim/web"
  cp "$source_dir"/sim/web/*.sh "$clone/sim/web/"
  start web --help
  same status "$status" 0
  refuse "help installs nothing" "$(cat "$calls")" 'apt-get'
  HOME=$box start web -o "$box/site"
  # Emscripten, where this system's packages have one that is new enough, and else what makes a system that has.
  expect "installs it" "$(cat "$calls")" 'apt-get .*install .*(emscripten|mmdebstrap)'
}

case_asks_once_on_a_terminal() {
  on_terminal $'\n'
  same "questions" "$(grep -c 'Y/n' <<<"$output")" 1
  expect "says how much" "$output" '370 packages with what they need'
  expect "installs after Return" "$(cat "$calls")" 'apt-get .* install .*cmake'
  expect "runs the program" "$output" '^program:'
}

case_does_not_install_after_no() {
  on_terminal $'n\n'
  refuse "installs nothing" "$(cat "$calls")" 'apt-get .* update'
  expect "says so" "$output" 'nothing was installed'
  expect "says what stops it" "$output" 'cmake is missing'
  refuse "does not run" "$output" '^program:'
}

case_yes_does_not_ask() {
  on_terminal '' --yes list
  refuse "does not ask" "$output" 'Y/n'
  expect "passes the rest on" "$output" '^program: <list>'
}

case_uses_sudo_when_not_root() {
  export as_id=1000
  stand_in sudo <<<'[ "$1" = -n ] && shift; exec "$@"'
  start
  expect "asks sudo" "$(cat "$calls")" '^sudo env .*apt-get .*install'
  same status "$status" 0
}

case_says_whom_to_ask_without_sudo() {
  export as_id=1000
  start
  expect "says why" "$output" 'there is no sudo here'
  expect "gives the line" "$output" 'apt-get install --no-install-recommends cmake ninja-build g\+\+'
  refuse "tries nothing" "$(cat "$calls")" 'apt-get'
  same status "$status" 1
}

case_goes_on_without_root_when_only_optional_ones_are_missing() {
  export as_id=1000
  tools_there
  sed -i '/fonts-dejavu-core/d' "$dpkg_list"
  start
  same status "$status" 0
  refuse "no alarm" "$output" 'in case they came'
  expect "runs the program" "$output" '^program:'
}

case_says_when_there_is_no_network() {
  export offline=1
  start
  expect "says so" "$output" 'package server cannot be reached'
  expect "names the packages" "$output" 'libimgui-dev'
  same status "$status" 1
}

case_says_when_the_disk_is_full() {
  export full=1
  start
  expect "says so" "$output" 'disk is full'
  same status "$status" 1
}

case_leaves_out_what_the_release_does_not_have() {
  export absent=libosmesa6-dev
  start test
  expect "says so" "$output" 'no package libosmesa6-dev'
  expect "installs the rest" "$(cat "$dpkg_list")" 'doctest-dev'
  same "the last line is ctest's" "$(tail -n 1 <<<"$output")" 'Total Test time (real) = 0.01 sec'
}

case_goes_on_where_cmake_finds_everything_without_apt() {
  tools_there
  rm "$box"/bin/{apt-get,dpkg-query}
  start info
  expect "runs the program" "$output" '^program: <info>'
}

case_hints_for_other_systems() {
  rm "$box"/bin/{apt-get,dpkg-query}
  stand_in dnf <<<':'
  start
  expect "names what dnf knows" "$output" "dnf install .*'cmake\(OpenMesh\)' .*'pkgconfig\(libzstd\)'"
  same status "$status" 1
}

case_starts_at_once_when_nothing_changed() {
  start
  : >"$calls"
  start lesson "two words" --at 3
  same "calls nothing but the program" "$(cat "$calls")" ''
  expect "passes arguments as they are" "$output" '^program: <lesson> <two words> <--at> <3>'
}

case_builds_again_when_a_source_changed() {
  start
  : >"$calls"
  sleep 0.05
  echo >>"$clone/sim/main.cpp"
  start
  expect "builds" "$(cat "$calls")" 'cmake --build'
  refuse "does not configure" "$(cat "$calls")" 'preset'
  : >"$calls"
  sleep 0.05
  rm "$clone/sim/main.cpp"
  start
  expect "builds when a file is gone" "$(cat "$calls")" 'cmake --build'
}

case_goes_on_after_a_build_that_failed() {
  export fails=1
  start
  same status "$status" 1
  expect "says so" "$output" 'building failed'
  unset fails
  : >"$calls"
  start
  same status "$status" 0
  refuse "does not configure again" "$(cat "$calls")" 'preset'
}

case_says_how_it_goes_on_after_an_interruption() {
  tools_there
  stand_in cmake <<<'case " $* " in *" --build "*) sleep 5 ;; *) : >"$folder/build.ninja" ;; esac'
  export folder=$clone/build/release
  # Where ctest itself was started in the background, the signal is ignored unless it is put back.
  output=$({
    until grep -q -- --build "$calls"; do sleep 0.1; done
    printf '\003'
    sleep 1
  } | env --default-signal=INT script -qec "PATH='$box/bin:$box/tools' exec '$clone/zstep'" /dev/null 2>&1)
  status=$?
  expect "says so" "$output" 'stopped; run it again'
  refuse "no other alarm" "$output" 'failed'
  same "the usual status" "$status" 130
}

case_shows_why_configuring_failed() {
  export broken=1
  start
  same status "$status" 1
  expect "CMake's own words" "$output" 'Could not find OpenMesh'
  refuse "without its chatter" "$output" 'looking'
  unset broken
  start
  same "goes on when mended" "$status" 0
}

case_configures_afresh_when_moved() {
  start
  mv "$clone" "$box/moved"
  clone=$box/moved
  : >"$calls"
  start
  expect "configures" "$(cat "$calls")" 'cmake --preset release'
  expect "runs" "$output" '^program:'
}

case_runs_from_another_folder_and_through_a_relative_path() {
  start
  output=$(cd "$box" && PATH=$box/bin:$box/tools './a clone/zstep' view x.ztrace </dev/null 2>&1)
  expect "stays where the user is" "$output" "^$box\$"
  expect "passes the path on" "$output" '<view> <x.ztrace>'
}

case_says_when_it_may_not_write() {
  # Root may write anywhere, so a file stands where the folder should come.
  : >"$clone/build"
  start
  same status "$status" 1
  expect "says where" "$output" "cannot write to $clone/build/release"
  output=$(ZSTEP_BUILD=$box/elsewhere zstep list 2>&1 </dev/null)
  expect "builds elsewhere on request" "$output" '^program: <list>'
}

case_help_needs_no_build() {
  start --help
  same status "$status" 0
  expect "names the commands" "$output" './zstep test'
  same "calls nothing" "$(cat "$calls")" ''
  start help
  expect "help too" "$output" './zstep clean'
}

case_clean_removes_the_build() {
  start
  start clean
  same "nothing is left" "$([ -e "$clone/build" ] && echo there)" ''
}

# Whatever CMake looks for is in the table of packages, and nothing else.
case_the_table_has_what_cmake_looks_for() {
  local wanted listed name
  listed=$(zstep packages | while read -r _ how _; do printf '%s\n' "${how#*:}"; done)
  wanted=$(find "$source_dir" -name build -prune -o -name CMakeLists.txt -exec cat {} + |
    sed -nE 's/^ *find_package\(([A-Za-z0-9_]+).*/\1/p; s/^ *pkg_check_modules\([A-Z0-9_]+ ([^)]*)\).*/\1/p' | tr ' ' '\n' |
    grep -vxE 'REQUIRED|QUIET|IMPORTED_TARGET|GLOBAL|PkgConfig|Threads|')
  [ "$(wc -l <<<"$wanted")" -gt 8 ] || same "libraries found in the tree" few many
  for name in $wanted; do expect "has a row for $name" "$listed" "^$name$"; done
  listed=$(zstep packages | sed -nE 's/.* (package|module):([^ ]*) .*/\2/p')
  for name in $listed; do expect "$name is used" "$wanted" "^$name$"; done
}

# What is no library: programs, and what a compiler brings. A row is there as long as something calls for it: each line is
# NEED HOW FILE and what stands in that file then.
case_the_table_has_what_scripts_call() {
  local need how file pattern rows called=""
  as_pattern() { sed 's/[+?.]/\\&/g' <<<"$1"; }
  rows=$(zstep packages)
  while read -r need how file pattern; do
    expect "what needs $how still stands in $file" "$(cat "$source_dir/$file")" "$pattern"
    expect "the row of $how" "$rows" "^$(as_pattern "$need") +$(as_pattern "$how") "
    called+="$need $how"$'\n'
  done <<'CALLS'
test? program:ccache CMakeLists.txt find_program\(CCACHE ccache\)
test? program:bwrap sim/homework/sandbox_process.hpp "/usr/bin/bwrap"
test? program:python3 tests/zoo/runs.cpp python3 -c
test? program:node tests/zoo/runs.cpp node -p
test? program:clang-format-14 tests/CMakeLists.txt find_program\(CLANG_FORMAT clang-format-14\)
test? program:Xvfb tests/viewer/CMakeLists.txt xvfb-run
test? program:xauth tests/viewer/CMakeLists.txt xvfb-run
test? program:xdotool tests/viewer/hands/real.sh ^xdotool
web program:em++ sim/web/build.sh emcmake cmake
web program:make sim/web/dependencies.sh && make sqlite3.c
web program:tclsh sim/web/dependencies.sh && make sqlite3.c
web program:patch sim/web/dependencies.sh apt-get .* source
web program:dpkg-source sim/web/dependencies.sh apt-get .* source
web program:xz sim/web/dependencies.sh tar xf .*orig.tar
web program:fonttools sim/web/fonts.py from fontTools import
beside program:mmdebstrap sim/web/build.sh ^ *mmdebstrap
beside program:bwrap sim/web/build.sh ^ *bwrap
check program:clang++ CMakePresets.json "clang\+\+"
check runtime:clang CMakeLists.txt -fsanitize=address
CALLS
  # And there is none for which nothing does.
  while read -r need how _; do
    case $need/$how in build*) continue ;; *program:* | *runtime:*) ;; *) continue ;; esac
    expect "something calls for $need $how" "$called" "^$(as_pattern "$need $how")$"
  done <<<"$rows"
}

# The stand-in for CMake puts the program where the real one does: ZSTEP_PROGRAM, when ctest runs this, is the real one.
case_the_program_is_where_the_launcher_looks() {
  [ -n "${ZSTEP_PROGRAM-}" ] || { tell "only ctest knows the real program"; return; }
  local seen
  seen=$(cd "$clone" && ZSTEP_BUILD=${ZSTEP_BINARY_DIR:?} bash -c 'exec() { printf "%s\n" "$1"; exit; }; up_to_date() { :; }
    source <(sed "/^up_to_date()/,/^}/d" ./zstep)')
  same "the program" "$seen" "$ZSTEP_PROGRAM"
}

# Windows and macOS get the same libraries, under their own names.
case_vcpkg_and_homebrew_have_the_same_libraries() {
  local plain='s/.*/\L&/; s/[^a-z0-9\n]//g; s/^lib//' need how name
  local vcpkg brew
  vcpkg=$(tr ',{}[]' '\n' <"$source_dir/vcpkg.json" | grep -oE '"[a-z0-9-]+" *$' | sed -E "$plain; s|^boost.*|boost|")
  brew=$(sed -nE 's/^brew "(.*)"/\1/p' "$source_dir/Brewfile" | sed -E "$plain")
  while read -r need how _; do
    case $need/$how in *\?/* | *program:* | *font:* | *runtime:*) continue ;; esac
    name=$(sed -E "$plain" <<<"${how#*:}")
    expect "vcpkg.json has $how" "$vcpkg" "^$name$"
    expect "Brewfile has $how" "$brew" "^$name$"
  done < <(zstep packages)
}

# Where a comment of a precompiled header changes, g++ 12 takes the header for another one and reads it twice.
case_a_header_of_which_a_comment_changed_is_precompiled_anew() {
  [ -n "${ZSTEP_COMPILE-}" ] || return 0  # another compiler than g++
  rm -rf "${box:?}"/*
  cd "$box" || return
  export CCACHE_DIR=$box/cache
  printf '#pragma once\nenum class Here { one };\n' >part.hpp
  printf '#include "part.hpp"\n' >all.hpp
  local comment
  for comment in "first" "second one"; do
    sed -i "2s,;.*,;  // $comment," part.hpp
    printf '#include "part.hpp"\nconst char* comment = "%s";\n' "$comment" >it.cpp
    rm -f all.hpp.gch
    same "precompiled with: $comment" "$($ZSTEP_COMPILE -x c++-header -MD -MF all.d -c all.hpp -o all.hpp.gch 2>&1)" ""
    same "compiled with: $comment" "$($ZSTEP_COMPILE -Winvalid-pch -include all.hpp -MD -MF it.d -c it.cpp -o it.o 2>&1)" ""
  done
}

# Benchmarks that are stand-ins: what they print goes into the pages, and of two of them each figure is compared.
case_the_pages_quote_what_the_benchmarks_print() {
  mkdir -p "$box/programs"
  printf '#!/bin/bash\n[ "$1" = fails ] && exit 1\nprintf "| | ms |\\n|---|---|\\n| %%s | 1.5 |\\n" "$*"\n' >"$box/programs/zstep_bench_x"
  chmod +x "$box/programs/zstep_bench_x"
  local page=$box/page.md page_of="$source_dir/tests/bench/page.sh"
  printf '# Before\n<!-- bench: zstep_bench_x a b -->\nold\n<!-- end -->\nAfter\n' >"$page"
  bash "$page_of" "$box/programs" "$page" 2>/dev/null
  expect "the table" "$(<"$page")" '^\| a b \| 1.5 \|$'
  expect "of which commit, day and machine" "$(<"$page")" '^Commit .+, [0-9]+ [A-Z][a-z]+ 20[0-9][0-9], .+ processors, .+:$'
  refuse "what was there" "$(<"$page")" '^old$'
  expect "what stands around it" "$(<"$page")" '^# Before$'
  expect "what stands around it" "$(<"$page")" '^After$'
  local once
  once=$(<"$page")
  bash "$page_of" "$box/programs" "$page" 2>/dev/null
  same "written once more" "$(<"$page")" "$once"
  printf '<!-- bench: zstep_bench_x fails -->\n<!-- end -->\n' >>"$page"
  once=$(<"$page")
  bash "$page_of" "$box/programs" "$page" 2>/dev/null && same "a program that fails" "is taken" "is refused"
  same "a page when a program fails" "$(<"$page")" "$once"
}

case_a_figure_that_is_worse_than_elsewhere_is_marked() {
  local head='| | one | two |\n|---|---|---|\n'
  # shellcheck disable=SC2059
  {
    printf "$head| seek, median; p99 | 4.0 ms; 9.0 ms | 1 ms; 2 ms |\n| rate | 5 M/s | 6 M/s |\n" >"$box/a1"
    printf "$head| seek, median; p99 | 6.0 ms; 9.0 ms | 1 ms; 2 ms |\n| rate | 5 M/s | 6 M/s |\n" >"$box/a2"
    printf "$head| seek, median; p99 | 5.0 ms; 9.0 ms | 1 ms; 2 ms |\n| rate | 5 M/s | 6 M/s |\n" >"$box/a3"
    printf "$head| seek, median; p99 | 2.5 ms; 9.0 ms | 1 ms; 2 ms |\n| rate | 5 M/s | 9 M/s |\n| gone | 1 s | 1 s |\n" >"$box/b"
  }
  local said
  said=$(awk -v limit=1.25 -f "$source_dir/tests/bench/ratios.awk" side=here "$box/a1" "$box/a2" "$box/a3" side=there "$box/b")
  expect "medians and their ratio" "$said" '^\| seek, median; p99 \| one \| 1 \| 5 \| 2.5 \| 2.00 \| above 1.25 \|$'
  expect "an equal one" "$said" '^\| seek, median; p99 \| one \| 2 \| 9 \| 9 \| 1.00 \|  \|$'
  expect "a rate, worse when smaller" "$said" '^\| rate \| two \| 6 \| 9 \| 1.50 \| above 1.25 \|$'
  expect "what only one has" "$said" '^not compared: gone \| one \(only there\)$'
  expect "how many" "$said" '^2 above 1.25$'
}

if [ $# -gt 1 ]; then
  fresh
  "case_$2"
else
  for name in $(declare -F | sed -n 's/^declare -f \(case_.*\)/\1/p'); do
    fresh
    tell "${name#case_}"
    "$name"
  done
fi
exit $((failures > 0))
