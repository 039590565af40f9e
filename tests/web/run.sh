#!/usr/bin/env bash
# The page in a browser against what the native program draws: run.sh PROGRAM SITE [NAME]
#
# SITE is what ./zstep web -o made; NAME runs the tests that have it in their names. Needs node, and chromium or what
# ZSTEP_BROWSER names: a Chromium or a Firefox.
set -eu
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
pictures=$(mktemp -d)
trap 'rm -rf "$pictures"' EXIT
bash "$here/pictures.sh" "$1" "$pictures" "$2"
node "$here/page_test.mjs" "$(realpath "$2")" "$pictures" "${3-}"
