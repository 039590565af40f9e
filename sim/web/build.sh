#!/usr/bin/env bash
# ./zstep web: the viewer as a folder of static files, for a web server or for this computer's browser.
#
#   ./zstep web -o FOLDER      makes them
#   ./zstep web --serve [PORT] makes them, and serves them here (port 8010)
#
# Emscripten 3.1.60 or newer compiles them. Where the system's packages have none so new, as in Debian 12, a Debian 13
# beside it does, which is made once. That, the libraries and their sources are kept in ~/.cache/zstep/web, for all checkouts.
set -eu

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
kept=${ZSTEP_WEB_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/zstep/web}
system=${ZSTEP_WEB_ROOT:-$kept/debian-13}  # where Emscripten is, unless it is here
build=$root/build/web
# What the Debian beside this system has to have.
needs=($("$root/zstep" packages | sed -nE 's/^web +[^ ]+ +([^ ]+).*/\1/p') ninja-build cmake ccache pkg-config g++
  libglm-dev libcli11-dev nlohmann-json3-dev libtomlplusplus-dev libboost-dev)

say() { printf 'zstep: %s\n' "$*" >&2; }
die() { say "$@"; exit "${code:-1}"; }
have() { command -v "$1" >/dev/null 2>&1; }
wrong() { code=2 die "$@"; }

# ---- Where Emscripten is -----------------------------------------------------------------------------------------

new_enough() {  # of `em++ --version`
  [[ $1 =~ ([0-9]+)\.([0-9]+)\.([0-9]+) ]] || return 1
  [ "${BASH_REMATCH[1]}" -gt 3 ] || { [ "${BASH_REMATCH[1]}" = 3 ] && { [ "${BASH_REMATCH[2]}" -gt 1 ] || [ "${BASH_REMATCH[3]}" -ge 60 ]; }; }
}

em_here() { if have em++; then em++ --version 2>/dev/null | head -n 1 | grep -oE '[0-9]+\.[0-9]+\.[0-9]+' | head -n 1; else echo "not installed"; fi; }

# Whether this system's packages have one: Debian from 13 on, Ubuntu from 25.04 on.
can_be_installed() {
  local ID='' VERSION_ID=''
  [ -r /etc/os-release ] && . /etc/os-release
  case $ID in debian) [ "${VERSION_ID:-99}" -ge 13 ] ;; ubuntu) [ "${VERSION_ID%%.*}" -ge 25 ] ;; *) return 1 ;; esac
}

beside=yes
if [ -z "${ZSTEP_WEB_ROOT-}" ] && { new_enough "$(em_here)" || can_be_installed; }; then beside=no; fi
if [ "${1-}" = --needs ]; then  # for the launcher, which installs it
  if [ $beside = no ]; then echo build web; elif [ ! -e "$system/usr/bin/em++" ]; then echo beside; fi
  exit
fi

output='' serve=no port=8010
while [ $# -gt 0 ]; do
  case $1 in
    -o | --output) [ $# -gt 1 ] || wrong "web: -o needs a folder; write for example ./zstep web -o site"; output=$2; shift ;;
    --serve) serve=yes; case ${2-} in '' | -*) ;; *) port=$2; shift ;; esac ;;
    -h | --help) sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit ;;
    *) wrong "web: does not know what to do with '$1'; see ./zstep web --help" ;;
  esac
  shift
done
[ -n "$output" ] || [ $serve = yes ] || wrong "web: say where to: ./zstep web -o site, or ./zstep web --serve"
case $port in *[!0-9]* | '') wrong "web: '$port' is no port; write for example ./zstep web --serve 8010" ;; esac
# Not over something that is none of ours.
if [ -n "$output" ] && [ -e "$output" ] && [ -n "$(ls -A "$output" 2>/dev/null)" ] && [ ! -e "$output/zstep.wasm" ]; then
  wrong "web: $output holds other files; name an empty or a new folder"
fi

# Runs a command where Emscripten is, with this checkout, what is kept and this system's fonts in their places.
there() {
  if [ $beside = no ]; then "$@"; else
    bwrap --bind "$system" / --dev /dev --proc /proc --tmpfs /tmp --bind "$root" "$root" --bind "$kept" "$kept" \
      --ro-bind /usr/share/fonts /usr/share/fonts --ro-bind-try /etc/resolv.conf /etc/resolv.conf --unsetenv NODE_EXTRA_CA_CERTS --setenv HOME /root --setenv LC_ALL C.UTF-8 --chdir "$root" "$@"
  fi
}

make_system() {
  have mmdebstrap && have bwrap || die "Emscripten here is $(em_here), and 3.1.60 is needed. A Debian 13 beside this system can have it;
       making that needs two packages: apt-get install mmdebstrap bubblewrap"
  [ -t 0 ] && {
    printf 'zstep: Emscripten here is %s. Make a Debian 13 for it in %s (1.6 GB, once)? [Y/n] ' "$(em_here)" "$system" >&2
    read -r answer || answer=n
    case $answer in '' | [yYjJ]*) ;; *) die "nothing was made" ;; esac
  }
  say "making a Debian 13 for Emscripten: some minutes, once"
  rm -rf "$system.new"
  mmdebstrap --variant=apt --include="$(IFS=,; echo "${needs[*]}")" --skip=check/qemu,cleanup/apt/lists trixie "$system.new" \
    'deb http://deb.debian.org/debian trixie main' 'deb-src http://deb.debian.org/debian trixie main' \
    'deb-src http://deb.debian.org/debian bookworm main' >"$kept/system.log" 2>&1 ||
    die "it could not be made: $(grep -E '^E: ' "$kept/system.log" | tail -n 1) (all of it is in $kept/system.log)"
  mv "$system.new" "$system"
}

mkdir -p "$kept"
if [ $beside = yes ]; then [ -e "$system/usr/bin/em++" ] || make_system
elif ! new_enough "$(em_here)"; then die "Emscripten here is $(em_here), and 3.1.60 is needed: apt-get install emscripten"; fi

# ---- Building ----------------------------------------------------------------------------------------------------

there bash "$root/sim/web/dependencies.sh" "$kept"

mkdir -p "$build"
if [ ! -d "$build/fonts" ]; then
  there python3 "$root/sim/web/fonts.py" "$root/sim/viewer/draw/fonts.cpp" /usr/share/fonts "$build/fonts.new" 2>"$build/fonts.log" ||
    die "the fonts could not be made: $(tail -n 1 "$build/fonts.log")"
  mv "$build/fonts.new" "$build/fonts"
fi
if [ ! -f "$build/build.ninja" ]; then
  say "configuring (log: $build/configure.log)"
  there env PKG_CONFIG_LIBDIR="$kept/prefix/lib/pkgconfig" CCACHE_DIR="$kept/ccache" emcmake cmake -G Ninja -S "$root" -B "$build" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE="-O2 -DNDEBUG" -DCMAKE_FIND_ROOT_PATH="$kept/prefix" -DCMAKE_PREFIX_PATH="$kept/prefix;$kept/prefix/lib/cmake" \
    -DCMAKE_CXX_FLAGS="-fwasm-exceptions -sSUPPORT_LONGJMP=wasm -ffile-prefix-map=$root=." \
    -DZSTEP_FONTS_FOLDER="$build/fonts" -DZSTEP_TESTS=OFF >"$build/configure.log" 2>&1 || {
    grep -A 8 '^CMake Error' "$build/configure.log" | head -n 20 >&2
    rm -f "$build/build.ninja"
    die "configuring failed (all of it is in $build/configure.log)"
  }
fi
say "building for the web"
there env CCACHE_DIR="$kept/ccache" CCACHE_COMPILERTYPE=clang cmake --build "$build" --target zstep_page zstep site >&2 || die "building failed: the first error above is the one to look at"

# ---- Where it goes -----------------------------------------------------------------------------------------------

if [ -n "$output" ]; then
  mkdir -p "$output"
  # One file after the other in its place, the page last: who loads it meanwhile gets the old one or the new one.
  for file in zstep.js zstep.rest.wasm zstep.wasm zstep.data film.js page.js page.css zstep.svg zstep.webmanifest worker.js publish.html index.html; do
    cp "$build/site/$file" "$output/.$file.new" && mv "$output/.$file.new" "$output/$file"
  done
  say "$output holds $(du -sh "$output" | cut -f 1 | tr -d ' '): put it on any web server, or ./zstep web --serve"
fi
if [ $serve = yes ]; then
  say "serving at http://localhost:$port/ (Ctrl-C ends it)"
  exec python3 "$root/sim/web/serve.py" "$build/site" "$port"
fi
