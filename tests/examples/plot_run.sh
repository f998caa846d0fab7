#!/usr/bin/env bash
# docs/plot_run.py plots a run of kth_explorer, and NumPy reads from its arrays what map.png shows.
# Usage: plot_run.sh PATH_OF_KTH_EXPLORER PATH_OF_PLOT_RUN
set -u
program=$(realpath "$1")
script=$(realpath "$2")
python=
for candidate in python3 /usr/bin/python3; do
  if "$candidate" -c 'import numpy, matplotlib' 2>/dev/null; then
    python=$candidate
    break
  fi
done
if [ -z "$python" ]; then
  echo "plot_run: skipped, python3 with NumPy and Matplotlib is missing (python3-numpy python3-matplotlib)"
  exit 77
fi
source "$(dirname "$(realpath "$0")")/cli.sh"
export MPLCONFIGDIR="$work/matplotlib"

[ "$(wc -l <"$script")" -lt 40 ] || fail "plot_run.py has 40 lines or more"
run_quietly run --duration 20 --seed 2
"$python" "$script" run plot.png || fail "plot_run.py: exit code $?"
"$python" "$script" run || fail "plot_run.py without a name: exit code $?"
cmp -s plot.png run/plot_run.png || fail "the two plots are not the same"
"$python" "$script" absent 2>/dev/null && fail "a folder that is not there is plotted"

"$python" - <<'PYTHON' || fail "the arrays are not what map.png and the plot show"
import json
import matplotlib.image
import numpy as np

log_odds = np.load("run/belief_log_odds.npy")
probability = np.load("run/belief_probability.npy")
frame = json.load(open("run/belief_frame.json"))
assert log_odds.dtype == probability.dtype == np.dtype("float32") and log_odds.flags.c_contiguous
assert list(log_odds.shape) == list(probability.shape) == frame["shape"]
assert np.allclose(probability, 1 / (1 + np.exp(-log_odds.astype(float))), atol=1e-6)
assert (log_odds == 0).any() and (log_odds < -1).any() and (log_odds > 1).any()

# map.png has the largest y in row 0, the arrays the smallest; both are cut to the same cells.
grey = np.round(255 * matplotlib.image.imread("run/map.png")).astype(int)[::-1]
assert (grey == np.select([log_odds < -1, log_odds > 1], [254, 0], 205)).all()
origin = [line for line in open("run/map.yaml") if line.startswith("origin")][0].split("[")[1].split(",")
corner = np.array(frame["origin_m"]) + np.array(frame["first_cell"]) * frame["resolution_m"]
assert np.allclose(corner, [float(origin[0]), float(origin[1])])

# The start is the frame's origin, on floor; 20 s later the robot still stands on floor.
path = np.loadtxt("run/trajectory_estimated.tum")
for x, y in path[[0, -1], 1:3]:
    column, row = np.floor((np.array([x, y]) - corner) / frame["resolution_m"]).astype(int)
    assert log_odds[row, column] < -1

# Paths, floor, walls and what is unknown have their colours in the plot.
plot = np.round(255 * matplotlib.image.imread("plot.png")[:, :, :3]).astype(int)
assert plot.shape == (900, 1000, 3)
for colour, least in [((255, 255, 255), 50000), ((0, 0, 0), 500), ((176, 196, 222), 5000), ((0, 0, 255), 20), ((255, 0, 0), 20)]:
    assert (plot == colour).all(axis=2).sum() >= least, colour
PYTHON

[ $failures -eq 0 ] && echo "plot_run: the plot is as promised"
exit $((failures > 0))
