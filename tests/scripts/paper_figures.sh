#!/usr/bin/env bash
# Figures 2 to 10 of the paper from synthetic runs and a synthetic study: each is there and not empty,
# and the numbers behind it are those of the known flow and dune.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

numbers() {  # numbers FIGURE FOLDER: the CSV behind it against what was put in
  "$python" "$root/tests/support/check_paper_figures.py" "$@" > "$dir/why" 2>&1 ||
    fail "$1: $(tail -n 1 "$dir/why")"
}

# One run.
fake "$dir/run" --average --without fields --frames 4
plot 0 "$dir/run" fig2 fig3
for figure in fig2 fig3; do is_figure "$dir/run/$figure"; done
quiet
numbers profiles "$dir/run"

# A movie: numbered pictures with no ffmpeg that works, else every pixel of every frame goes to it.
mkdir "$dir/programs" "$dir/broken"
printf '#!/bin/bash\nexit 1\n' > "$dir/broken/ffmpeg"
chmod +x "$dir/broken/ffmpeg"
programs="$dir/broken:$PATH"
plot 0 "$dir/run" fig10
[ "$(find "$dir/run/movie" -name '[0-9]*.png' -size +8k | wc -l)" = 4 ] || fail "not 4 pictures of a movie"
[ "$(du -sk "$dir/run/movie" | cut -f 1)" -lt 3000 ] || fail "the pictures take $(du -sh "$dir/run/movie")"
[ ! -e "$dir/run/movie.mp4" ] || fail "a film without ffmpeg"
numbers movie "$dir/run"
cat > "$dir/programs/ffmpeg" <<'FFMPEG'
#!/bin/bash
for last in "$@"; do :; done
size=$(sed -E 's/.* -s ([0-9]+)x([0-9]+) .*/\1*\2/' <<< "$*")
echo "$((size)) $(wc -c)" > "$last"
FFMPEG
chmod +x "$dir/programs/ffmpeg"
programs="$dir/programs:$PATH"
numbers add_tracks "$dir/run"  # from here on the finer frames of tracks.h5
plot 0 "$dir/run" movie
numbers tracks "$dir/run"
grep -qx "$dir/run/movie.mp4" "$dir/out" || fail "the film is not named"
awk '{ exit !($1 > 100000 && $2 == 7 * 3 * $1) }' "$dir/run/movie.mp4" ||
  fail "not 7 frames: $(cat "$dir/run/movie.mp4")"
[ -z "$(find "$dir/run" -name '*.part*')" ] || fail "a part of a film is left"
programs=$PATH

# A study with a case that is not there and one that failed: what there is, and a line on the rest.
fake "$dir/study" --study
plot 0 "$dir/study"
says_only "sliding_friction-0.4 is not there, restitution-0.5 failed, restitution-0.9 is unfinished"
for figure in fig2 fig4 fig5 fig7 fig8; do is_figure "$dir/study/$figure"; done
for figure in fig6 fig9; do
  [ ! -e "$dir/study/$figure.png" ] || fail "$figure of a key that is not varied"
done
numbers morphology "$dir/study"
numbers topviews "$dir/study"
[ "$(grep -c '^base,' "$dir/study/figures_data/channel.csv")" = 30 ] || fail "no curves of the channel"

# A study of named cases: compared by their names, with the height and the grains of their dunes.
sed -E 's/"varied": "[^"]*"/"varied": null/g' "$dir/study/study.json" > "$dir/study/cases.json"
mv "$dir/study/cases.json" "$dir/study/study.json"
plot 0 "$dir/study" topviews morphology
for figure in topviews_case morphology_case; do
  [ -s "$dir/study/$figure.png" ] && [ -s "$dir/study/figures_data/$figure.csv" ] || fail "no $figure"
done
numbers cases "$dir/study"

# What bad input says.
echo '{"title": "gone", "cases": []}' > "$dir/run/study.json"
refused "fig9 needs a study of grains.rolling_friction" "$dir/run" fig9
echo '{"cases": [{"name"' > "$dir/run/study.json"
refused "cannot read $dir/run/study.json" "$dir/run" fig4
echo '{"cases": [1]}' > "$dir/run/study.json"
refused "does not list its cases as a study does" "$dir/run" fig4
rm "$dir/run/study.json" "$dir/run/flow_average.h5"
refused "profiles_over_dune needs flow_average.h5" "$dir/run" profiles-over-dune
refused "no figure \"fig1\"" "$dir/run" fig1

finish "figures 2 to 10 as expected"
