#!/usr/bin/env python3
"""Missions of kth_explorer over floor plans and seeds, as the tables of docs/exploration.md.

    benchmarks/missions.py PROGRAM FLOOR_PLAN... [--seeds 3] [--jobs 1]

Each floor is explored with the pose known and estimated, by the defaults and, with the pose known, by the order of
magnitude of what it would gain and by going to the nearest viewpoint.
"""
import argparse
import concurrent.futures
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

VARIANTS = {
    "known": ["--filter", "none"],
    "estimated": [],
    "magnitude": ["--filter", "none", "--information", "log-big"],
    "nearest": ["--filter", "none", "--information", "uniform"],
}
GOES_BY = {"magnitude": "log-big", "nearest": "nearness"}


def mission(program, plan, variant, seed):
    with tempfile.TemporaryDirectory() as folder:
        command = [program, "--map", plan, "--seed", str(seed), "--duration", "7200", "--threads", "1", "--quiet",
                   "--output", f"{folder}/run", *VARIANTS[variant]]
        subprocess.run(command, check=True)
        return json.loads(pathlib.Path(folder, "run", "metrics.json").read_text())


def shown(runs, key, form):
    return " ".join("-" if run[key] is None else form.format(run[key]).removeprefix("0") or "0" for run in runs)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("plans", nargs="+")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--jobs", type=int, default=1)
    arguments = parser.parse_args()
    tasks = [(plan, variant, seed) for plan in arguments.plans for variant in VARIANTS for seed in range(1, arguments.seeds + 1)]
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        results = dict(zip(tasks, pool.map(lambda task: mission(arguments.program, *task), tasks)))

    print("| floor plan | pose | goes by | explored | driven m | driven m to 90 % | position RMSE m | collisions | ends |")
    print("|---|---|---|---|---|---|---|---|---|")
    for plan in arguments.plans:
        runs = {variant: [results[plan, variant, seed] for seed in range(1, arguments.seeds + 1)] for variant in VARIANTS}
        for variant, of in runs.items():
            errors = "" if variant != "estimated" else shown(of, "translation_rmse_m", "{:.3f}")
            print(f"| {pathlib.Path(plan).stem} | {'estimated' if variant == 'estimated' else 'known'} "
                  f"| {GOES_BY.get(variant, 'big')} "
                  f"| {shown(of, 'explored_fraction', '{:.3f}')} | {shown(of, 'distance_m', '{:.0f}')} "
                  f"| {shown(of, 'distance_to_90_percent_m', '{:.0f}')} | {errors} | {sum(run['collisions'] for run in of)} "
                  f"| {', '.join(dict.fromkeys(run['stop_reason'] for run in of))} |")
        sys.stdout.flush()
    for variant in ("known", "magnitude"):
        for key, what in (("distance_to_90_percent_m", "to 90 % explored"), ("distance_m", "to the end")):
            pairs = [(results[plan, variant, seed][key], results[plan, "nearest", seed][key])
                     for plan in arguments.plans for seed in range(1, arguments.seeds + 1)]
            pairs = [(ours, nearest) for ours, nearest in pairs if ours and nearest]
            if not pairs:
                continue
            print(f"\nWay {what}, by {GOES_BY.get(variant, 'big')} against by nearness: mean of the ratios "
                  f"{statistics.mean(ours / nearest for ours, nearest in pairs):.2f}, ratio of the means "
                  f"{sum(ours for ours, _ in pairs) / sum(nearest for _, nearest in pairs):.2f}.")


if __name__ == "__main__":
    main()
