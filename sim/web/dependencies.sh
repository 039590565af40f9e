#!/usr/bin/env bash
# Compiles the libraries that zstep needs for WebAssembly, from the sources of the Debian release that this runs in:
#   dependencies.sh FOLDER      everything into FOLDER/prefix; what is there already is left as it is
# Needs emscripten. apt verifies what it fetches; where its list of sources has no lines `deb-src`, it gets a list of its own.
set -eu
folder=$1
prefix=$folder/prefix sources=$folder/sources work=$folder/work log=$folder/log
mkdir -p "$prefix"/{include,lib/pkgconfig,lib/cmake,done} "$sources" "$work" "$log"

# One arithmetic everywhere: as in the CMakeLists.txt of the whole. Exceptions are WebAssembly's own.
flags="-O2 -ffp-contract=off -fwasm-exceptions -sSUPPORT_LONGJMP=wasm"

say() { printf 'zstep: %s\n' "$*" >&2; }

# ---- Fetching ----------------------------------------------------------------------------------------------------

apt=()  # options of each of its programs
has_sources() { [ -n "$(apt-cache "${apt[@]}" showsrc --only-source zlib 2>/dev/null)" ]; }

# Lists the sources of this release for us alone, and below them those of Debian 12, for what a mirror lacks; what the
# system has stays as it is.
list_sources() {
  local ID='' VERSION_CODENAME='' where=()
  has_sources && return
  [ -r /etc/os-release ] && . /etc/os-release
  case $ID in
    debian) where=("deb-src http://deb.debian.org/debian "{"${VERSION_CODENAME:-sid}",bookworm}" main") ;;
    ubuntu) where=("deb-src http://archive.ubuntu.com/ubuntu $VERSION_CODENAME main universe") ;;
    *) echo "apt has no sources here: give its list of sources a line that begins with deb-src, and run apt-get update"; return 1 ;;
  esac
  mkdir -p "$folder/apt"/{lists,cache}/partial
  printf '%s\n' "${where[@]}" >"$folder/apt/sources.list"
  apt=(-o "Dir::Etc::SourceList=$folder/apt/sources.list" -o Dir::Etc::SourceParts=/dev/null -o "Dir::State::Lists=$folder/apt/lists"
    -o "Dir::Cache=$folder/apt/cache" -o APT::Sandbox::User=root)
  has_sources || { apt-get "${apt[@]}" -q update && has_sources; }
}

# Unpacks a source package as $sources/NAME: the newest version that can be had whole, and where a mirror lacks a release's
# own patches, what the authors wrote without them. Says which.
fetch() {  # NAME
  local version versions
  [ -e "$sources/$1/.whole" ] && return
  list_sources || return
  versions=$(apt-cache "${apt[@]}" showsrc --only-source "$1" | sed -n 's/^Version: //p' | sort -rVu)
  [ -n "$versions" ] || { echo "this release has no source package $1"; return 1; }
  for version in $versions; do
    rm -rf "${sources:?}/$1" "${sources:?}/fetched"
    mkdir "$sources/fetched"
    (
      cd "$sources/fetched"
      apt-get "${apt[@]}" source -q -o APT::Sandbox::User=root "$1=$version" && exit
      apt-get "${apt[@]}" source -q -o APT::Sandbox::User=root --download-only --tar-only "$1=$version" && tar xf ./*.orig.tar.*z* && rm ./*.orig.tar.*
    ) || continue
    mv "$sources"/fetched/*/ "$sources/$1"
    rm -rf "$sources/fetched"
    echo "$version" >"$sources/$1/.whole"
    return
  done
  echo "no version of $1 could be fetched"
  return 1
}

# ---- Compiling ---------------------------------------------------------------------------------------------------

# For libraries whose CMake files know how to be compiled without a system below.
by_cmake() {  # FOLDER OPTIONS...
  local name
  name=$(basename "${1%/build/cmake}")
  local from=$1
  shift
  emcmake cmake -G Ninja -S "$from" -B "$work/$name" -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
    -DCMAKE_FIND_ROOT_PATH="$prefix" -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" -DBUILD_SHARED_LIBS=OFF "$@" &&
    cmake --build "$work/$name" -j "$(nproc)" && cmake --install "$work/$name"
}

# For the others: these files of a folder make a library.
by_files() {  # LIBRARY FLAGS... -- FOLDER FILES...
  local library=$1 own=() objects=() from file object
  shift
  while [ "$1" != -- ]; do own+=("$1"); shift; done
  from=$2
  shift 2
  mkdir -p "$work/$library"
  for file; do
    object=$work/$library/$file.o
    # shellcheck disable=SC2086
    emcc $flags "${own[@]}" -c "$from/$file" -o "$object" || return 1
    objects+=("$object")
  done
  rm -f "$prefix/lib/lib$library.a"
  emar rcs "$prefix/lib/lib$library.a" "${objects[@]}"
}

as_module() {  # NAME VERSION INCLUDES
  printf 'Name: %s\nDescription: compiled for WebAssembly\nVersion: %s\nLibs: -L%s/lib -l%s\nCflags: -I%s/%s\n' \
    "$1" "$2" "$prefix" "${1#lib}" "$prefix" "$3" >"$prefix/lib/pkgconfig/$1.pc"
}

make_zlib() {
  local from=$sources/zlib names=(adler32 compress crc32 deflate gzclose gzlib gzread gzwrite infback inffast inflate inftrees trees uncompr zutil)
  by_files z -DHAVE_UNISTD_H -I"$from" -- "$from" "${names[@]/%/.c}" || return 1
  cp "$from"/{zlib,zconf}.h "$prefix/include"
}
make_libpng1.6() {
  local from=$sources/libpng1.6 names=(png pngerror pngget pngmem pngpread pngread pngrio pngrtran pngrutil pngset pngtrans pngwio pngwrite pngwtran pngwutil)
  cp "$from/scripts/pnglibconf.h.prebuilt" "$prefix/include/pnglibconf.h"
  by_files png -I"$prefix/include" -I"$from" -- "$from" "${names[@]/%/.c}" || return 1
  cp "$from"/{png,pngconf}.h "$prefix/include"
}
make_libzstd() { by_cmake "$sources/libzstd/build/cmake" -DZSTD_BUILD_SHARED=OFF -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_MULTITHREAD_SUPPORT=OFF; }
make_xxhash() {
  by_files xxhash -I"$sources/xxhash" -- "$sources/xxhash" xxhash.c || return 1
  cp "$sources/xxhash/xxhash.h" "$prefix/include"
  as_module libxxhash "$(sed -n 's/^#define XXH_VERSION_[A-Z]*  *//p' "$sources/xxhash/xxhash.h" | paste -sd .)" include
}
make_fmtlib() { by_cmake "$sources/fmtlib" -DFMT_TEST=OFF -DFMT_DOC=OFF; }
make_simdjson() { by_cmake "$sources/simdjson" -DSIMDJSON_ENABLE_THREADS=OFF -DSIMDJSON_DEVELOPER_MODE=OFF; }
make_muparser() { by_cmake "$sources/muparser" -DENABLE_SAMPLES=OFF -DENABLE_OPENMP=OFF; }
make_md4c() { by_cmake "$sources/md4c" -DBUILD_MD2HTML_EXECUTABLE=OFF; }
make_openmesh() {
  # Where there are no shared libraries, two static ones would have one name.
  # shellcheck disable=SC2016
  sed -i 's/OUTPUT_NAME ${_target})/OUTPUT_NAME ${_target}Static)/' "$sources/openmesh/cmake-library/VCI/VCICommon.cmake"
  by_cmake "$sources/openmesh" -DBUILD_APPS=OFF -DOPENMESH_DOCS=OFF -DOPENMESH_BUILD_UNIT_TESTS=OFF
}
make_imgui() {
  local from=$sources/imgui names=(imgui imgui_draw imgui_tables imgui_widgets)
  by_files imgui -I"$from" -- "$from" "${names[@]/%/.cpp}" || return 1
  mkdir -p "$prefix/include/imgui"
  cp "$from"/*.h "$prefix/include/imgui"
  as_module imgui "$(sed -n 's/^#define IMGUI_VERSION  *"\(.*\)"/\1/p' "$from/imgui.h")" include/imgui
}
make_sqlite3() {
  mkdir -p "$work/sqlite3"
  (cd "$work/sqlite3" && { [ -f sqlite3.c ] || { "$sources/sqlite3/configure" --disable-tcl && make sqlite3.c; }; }) || return 1
  by_files sqlite3 -DSQLITE_THREADSAFE=0 -DSQLITE_OMIT_LOAD_EXTENSION -- "$work/sqlite3" sqlite3.c || return 1
  cp "$work/sqlite3/sqlite3.h" "$prefix/include"
  as_module sqlite3 "$(sed -n 's/^#define SQLITE_VERSION  *"\(.*\)"/\1/p' "$work/sqlite3/sqlite3.h")" include
}
# A window is a canvas that pixels are put into: no OpenGL, no sound, no joystick.
make_libsdl2() {
  by_cmake "$sources/libsdl2" -DSDL_SHARED=OFF -DSDL_STATIC=ON -DSDL_TEST=OFF -DSDL_AUDIO=OFF -DSDL_JOYSTICK=OFF -DSDL_HAPTIC=OFF \
    -DSDL_SENSOR=OFF -DSDL_HIDAPI=OFF -DSDL_POWER=OFF -DSDL_OPENGL=OFF -DSDL_OPENGLES=OFF
}
# Headers alone are the same everywhere. What finds them must not lead back to the folder that has the system's own.
headers_only() {  # PACKAGE TARGET
  printf '%s\n' "include_guard(GLOBAL)" "add_library($2 INTERFACE IMPORTED GLOBAL)" \
    "set_target_properties($2 PROPERTIES INTERFACE_INCLUDE_DIRECTORIES $prefix/include)" >"$prefix/lib/cmake/$1Config.cmake"
}
make_headers() {
  local name
  for name in CLI glm nlohmann toml++ boost; do ln -sfn "/usr/include/$name" "$prefix/include/$name"; done
  headers_only CLI11 CLI11::CLI11
  headers_only glm glm::glm
  headers_only nlohmann_json nlohmann_json::nlohmann_json
  headers_only tomlplusplus tomlplusplus::tomlplusplus
  headers_only Boost Boost::headers
}

libraries=(headers zlib libpng1.6 libzstd xxhash fmtlib simdjson muparser md4c openmesh imgui sqlite3 libsdl2)
count=0
for library in "${libraries[@]}"; do
  count=$((count + 1))
  way=$(declare -f "make_$library" by_files by_cmake as_module headers_only | cat - <(echo "$flags") | sha256sum)
  [ "$(cat "$prefix/done/$library" 2>/dev/null)" = "$way" ] && continue  # made in this way before
  say "$count of ${#libraries[@]}: $library"
  if ! { { [ "$library" = headers ] || fetch "$library"; } && "make_$library"; } >"$log/$library.log" 2>&1 </dev/null; then
    tail -n 15 "$log/$library.log" >&2
    say "$library could not be compiled for the web (all of it is in $log/$library.log)"
    exit 1
  fi
  echo "$way" >"$prefix/done/$library"
done
