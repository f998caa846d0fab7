#!/usr/bin/env bash
# The report page in a browser. Skipped (77) where there is no Chromium or Node.js.
# Usage: report_page.sh PATH_OF_KTH_EXPLORER PATH_OF_REPORT FOLDER, where recordings, pages, screenshots and playwright-core go
set -eu
kth_explorer=$(realpath "$1")
report=$(realpath "$2")
sources=$(dirname "$(realpath "$0")")
mkdir -p "$3"
cd -- "$3"

browser=
for name in chromium chromium-browser google-chrome-stable; do
  ! command -v $name >/dev/null || { browser=$(command -v $name) && break; }
done
if [[ -z $browser ]]; then
  echo "Skipped: there is no Chromium (Debian's package: chromium)"
  exit 77
fi
for name in node npm; do
  if ! command -v $name >/dev/null; then
    echo "Skipped: there is no $name (Debian's packages: nodejs, npm)"
    exit 77
  fi
done

# Installed again only when another version is asked for.
if ! cmp -s "$sources/package-lock.json" package-lock.json || [[ ! -f node_modules/playwright-core/package.json ]]; then
  rm -f package-lock.json
  cp "$sources/package.json" .
  cp "$sources/package-lock.json" lock.new
  mv lock.new package-lock.json
  npm ci --no-audit --no-fund --ignore-scripts >npm.log 2>&1 || { cat npm.log; rm -f package-lock.json; exit 1; }
fi

# A floor of two rooms, 9 x 6 m, 0.1 m a pixel.
awk 'BEGIN {
  print "P2\n90 60\n255"
  for (y = 0; y < 60; ++y) {
    line = ""
    for (x = 0; x < 90; ++x) {
      wall = x < 2 || y < 2 || x > 87 || y > 57 || (x >= 44 && x < 46 && (y < 24 || y > 36))
      line = line (wall ? "0 " : "255 ")
    }
    print line
  }
}' >rooms.pgm
printf 'image: rooms.pgm\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n' >rooms.yaml
"$kth_explorer" --quiet --record --output office --duration 50 --alpha 0.2 --threads 1
"$kth_explorer" --quiet --record --output rooms --duration 25 --alpha 3 --threads 1 --map rooms.yaml
size=$(wc -c <office/recording.incognita)
head -c $((size * 2 / 3)) office/recording.incognita >torn.incognita
"$report" --quiet office/recording.incognita --output single.html
"$report" --quiet torn.incognita --output torn.html
"$report" --quiet --compare office/recording.incognita rooms/recording.incognita --output compare.html

node "$sources/report_page.mjs" "$browser" "$PWD"
