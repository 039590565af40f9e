#!/usr/bin/env bash
# What a program records and says of scenes with odd cameras, formulas and options, a line each with its checksum:
# bits.sh COUNT FOLDER PROGRAM...  The same COUNT gives the same scenes, so two lists are to be the same:
#   tests/web/bits.sh 200 /tmp/native build/release/zstep >native.txt
#   tests/web/bits.sh 200 /tmp/node node build/web/zstep.js >node.txt
#   diff native.txt node.txt
set -eu
count=$1 folder=$2
shift 2
mkdir -p "$folder"

state=20241
draw() {  # a number below $1, in `drawn`
  state=$(((state * 1103515245 + 12345) & 0x7fffffff))
  drawn=$(((state >> 8) % $1))
}
one_of() { draw $#; drawn=${*:drawn+1:1}; }
decimal() { draw "$2"; drawn=$(($1 + drawn / 1000)).$(printf %03d $((drawn % 1000))); }  # from $1, over $2 thousandths

lit=lessons/scenes/lamp.toml
scenes=(pyramid pyramid-behind foley delhi cyclic intersecting cube dodecahedron teapot:2)
surfaces=('y = sin(x) * cos(z)' 'y = exp(-x^2 - z^2)' 'y = sqrt(x^2 + z^2 + 0.1)' 'y = sin(3 * x + z) / (1 + z^2)'
  'y = x^3 - 3 * x * z^2' 'y = ln(10 + x * z) * tan(x / 4)' 'y = atan(x * z) + cosh(x / 2)')
methods=$("$@" list methods | awk 'NR > 1 || /^z-buffer/ { print $1 }' | grep -E '^[a-z-]+$')

for ((k = 0; k < count; ++k)); do
  one_of $methods z-buffer z-buffer z-buffer; method=$drawn
  draw ${#scenes[@]}; scene=${scenes[drawn]}
  draw 3
  if [ "$method" = floating-horizon ] || [ "$drawn" = 0 ]; then draw ${#surfaces[@]}; scene=${surfaces[drawn]}; fi
  if [ "$method" = shadow-buffer ]; then scene=$lit; fi
  if [ "$scene" = delhi ]; then method=z-buffer; fi  # it has a coverage that the others do not take
  options=(--algorithm "$method")
  case $scene in
    foley | delhi) ;;
    *)
      decimal 2 9000; options+=(--rho "$drawn")
      decimal -180 360000; options+=(--theta "$drawn")
      decimal 1 178000; options+=(--phi "$drawn")
      decimal 1 4000; options+=(--d "$drawn")
      draw 4; [ "$drawn" -gt 0 ] || options+=(--ortho)
      draw 2; [ "$drawn" = 0 ] || options+=(--fit)
      one_of 32x32 33x17 64x48; options+=(--size "$drawn")
      ;;
  esac
  if [ "$method" = z-buffer ]; then  # the others have conventions of their own
    case $scene in
      foley | delhi) ;;
      *) one_of pseudodepth view corrected reciprocal reversed foley; options+=(--depth "$drawn") ;;
    esac
    one_of direct increments plane plane-increments; options+=(--interpolation "$drawn")
    one_of top-left inclusive round round-half-open ceil-floor; options+=(--coverage "$drawn")
    one_of float64 float32 fixed16 fixed24; options+=(--number-format "$drawn")
  fi
  trace=$folder/$k.ztrace
  rm -f "$trace"
  "$@" record "$scene" "${options[@]}" -o "$trace" >"$folder/said.txt" 2>&1 && code=0 || code=$?
  said=$(sed "s|$folder/||g" "$folder/said.txt" | tr '\n' ' ')
  if [ -e "$trace" ]; then
    sum=$(sha256sum <"$trace" | cut -c 1-16)
    # Without how far it is, which node has said as on a terminal.
    checked=$("$@" check "$trace" 2>&1 | sed -E "s|$folder/||g; s/\r\x1b\[K(checking[^\r]*)?//g" | sha256sum | cut -c 1-16)
    described=$("$@" dump "$trace" 2>&1 | sed "s|$folder/||g" | sha256sum | cut -c 1-16)
  else sum=none checked=- described=-; fi
  echo "$k $sum check $checked dump $described exit $code: '$scene' ${options[*]}: $said"
done
