#!/usr/bin/env python3
"""Plots what kth_explorer has left in a folder: plot_run.py [FOLDER [PNG]]. Needs NumPy and Matplotlib."""
import json
import pathlib
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "output/kth_explorer")
log_odds = np.load(folder / "belief_log_odds.npy")
occupied = np.load(folder / "belief_probability.npy")
frame = json.loads((folder / "belief_frame.json").read_text())
progress = np.genfromtxt(folder / "progress.csv", delimiter=",", names=True, ndmin=1)

# Row 0 has the smallest y. Lower left corner of cell [0, 0] of the arrays, and what they cover, in metres:
corner = np.array(frame["origin_m"]) + np.array(frame["first_cell"]) * frame["resolution_m"]
rows, columns = frame["shape"]
extent = [corner[0], corner[0] + columns * frame["resolution_m"], corner[1], corner[1] + rows * frame["resolution_m"]]
belief = np.ma.masked_where(log_odds == 0, 1 - occupied)  # 0 is unknown

figure, (plan, curves) = plt.subplots(2, 1, figsize=(10, 9), height_ratios=[3, 1], layout="constrained")
plan.set_facecolor("lightsteelblue")
plan.imshow(belief, cmap="gray", vmin=0, vmax=1, origin="lower", extent=extent, interpolation="nearest")
for name, style, width in [("true", "g-", 3), ("estimated", "b-", 1)]:
    path = np.loadtxt(folder / f"trajectory_{name}.tum", ndmin=2)  # time x y z qx qy qz qw
    plan.plot(path[:, 1], path[:, 2], style, linewidth=width, label=f"{name} path")
plan.set(xlabel="x [m]", ylabel="y [m]", title="Belief (black occupied, white free, blue unknown) in the frame of the start")
plan.legend(loc="upper right")
curves.plot(progress["time_s"], 100 * progress["explored_fraction"], "k-")
curves.set(xlabel="simulated time [s]", ylabel="explored [%]", ylim=(0, 100))
errors = curves.twinx()
errors.plot(progress["time_s"], progress["position_error_m"], "r-", linewidth=1)
errors.set_ylabel("position error [m]", color="r")
figure.savefig(sys.argv[2] if len(sys.argv) > 2 else folder / "plot_run.png", dpi=100)
