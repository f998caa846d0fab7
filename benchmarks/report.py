#!/usr/bin/env python3
"""Writes the report of a benchmark run: report.py RESULTS --output DIR, or the README's table: --readme-table.

RESULTS is what benchmarks/run leaves in build/benchmark-results: Google Benchmark's files in a folder for each preset,
metrics of kth_explorer, the output of compile_time, and what is known of the machine. Any of them may be missing.
"""

import argparse
import json
import pathlib
import re
import statistics
import subprocess

NATIVE = "benchmark-native"
V3 = "benchmark-v3"
SEEN = ["fresh", "revisited"]
SECONDS_PER = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
NAME_SUFFIXES = re.compile(r"/(real_time|manual_time|iterations:\d+|repeats:\d+|min_time:[\d.]+)")
NOT_COUNTERS = {"name", "run_name", "run_type", "time_unit", "family_index", "per_family_instance_index", "repetitions",
                "repetition_index", "threads", "iterations", "real_time", "cpu_time", "error_occurred", "error_message"}
IN_SECONDS = re.compile(r"^per_|(?<!per)_s$")


class Results:
    """Every figure is a list, a value for each repetition."""

    def __init__(self, folder):
        self.runs = {}  # preset -> program -> benchmark -> what -> values
        self.errors = []
        for file in sorted(folder.glob("benchmark-*/*.json")):
            content = json.loads(file.read_text())
            program = self.runs.setdefault(file.parent.name, {}).setdefault(file.stem, {})
            # As they are written in the program, not in the order in which they took turns.
            for run in sorted(content["benchmarks"], key=lambda run: run["family_index"]):
                if run.get("run_type") == "aggregate":
                    continue
                name = NAME_SUFFIXES.sub("", run["run_name"])
                if run.get("error_occurred"):
                    self.errors.append(f"{file.stem} ({file.parent.name}), {name}: {run['error_message']}")
                    continue
                clock = "real_time" if re.search("/(real|manual)_time", run["run_name"]) else "cpu_time"
                figures = {"time_s": run[clock] * SECONDS_PER[run["time_unit"]]}
                figures |= {key: value for key, value in run.items() if key not in NOT_COUNTERS}
                for what, value in figures.items():
                    program.setdefault(name, {}).setdefault(what, []).append(value)
        self.machine = {}
        if (file := folder / "machine.txt").exists():
            self.machine = dict(line.split(": ", 1) for line in file.read_text().splitlines() if ": " in line)
        self.compile_time = file.read_text().strip() if (file := folder / "compile_time.txt").exists() else ""
        self.real_time_factors = []
        self.processor_time_factors = []  # what they would be if the machine did nothing else
        for file in sorted(folder.glob("kth_explorer.*.json")):
            metrics = json.loads(file.read_text())
            self.real_time_factors.append(metrics["real_time_factor"])
            if (times := file.with_suffix(".processor_s")).exists():
                seconds = sum(float(part) for part in times.read_text().split())
                self.processor_time_factors.append(metrics["duration_s"] / seconds)

    def program(self, preset, program):
        return self.runs.get(preset, {}).get(program, {})

    def median(self, preset, program, name, what="time_s"):
        values = self.program(preset, program).get(name, {}).get(what)
        return statistics.median(values) if values else None

    def ratio(self, preset, program, of, to, what="time_s"):
        above = self.median(preset, program, of, what)
        below = self.median(preset, program, to, what)
        return above / below if above is not None and below else None


def shown(value, what):
    """A figure with its unit; in seconds are times and what is `per` something."""
    if not IN_SECONDS.search(what):
        return f"{value:.4g}" if abs(value) < 1e5 else f"{value / 1e6:.4g} M"
    for unit in ("s", "ms", "us"):
        if abs(value) >= SECONDS_PER[unit]:
            return f"{value / SECONDS_PER[unit]:.3g} {unit}"
    return f"{value / 1e-9:.3g} ns"


def best(results, preset, program, pattern, what, pick):
    """The best of the benchmarks whose names match."""
    values = [results.median(preset, program, name, what)
              for name in results.program(preset, program) if re.search(pattern, name)]
    values = [value for value in values if value is not None]
    return pick(values) if values else None


def bars(results):
    """(what is asked, 'at most' or 'at least', bound, [(where, measured)]) of each bar; nothing is measured as None."""
    resolutions = ["0.20", "0.05"]
    places = [f"{seen}/{resolution}" for seen in SEEN for resolution in resolutions]

    def cell(policy, preset):
        return [(place, results.ratio(preset, "cell_update", f"{policy}/{place}", f"plain/{place}", "per_touch"))
                for place in places]

    def peer(of, to, what):
        return [(place, results.ratio(NATIVE, "peers", f"{of}/{place}", f"{to}/{place}", what)) for place in places]

    def milliseconds(program, name):
        value = results.median(NATIVE, program, name)
        return [(name, value * 1e3 if value else None)]

    def thousands(program, name, what):
        value = results.median(NATIVE, program, name, what)
        return value / 1e3 if value else None

    def of_entropy(what, scale):
        """The worst measure of each kind of cells and size of map."""
        worst = {}
        for name in results.program(NATIVE, "entropy"):
            if match := re.fullmatch(r"table/[^/]+/(?P<cells>[^/]+)/(?P<side>\d+)", name):
                place = f"{match['cells']}, {match['side']} x {match['side']}"
                value = results.median(NATIVE, "entropy", name, what)
                worst[place] = max(worst.get(place, 0.0), value * scale)
        return list(worst.items())

    ours = best(results, NATIVE, "peers", r"^ray/incognita.*/0\.20$", "rays_per_s", max)
    theirs = best(results, NATIVE, "peers", r"^ray/mrpt.*/0\.20$", "rays_per_s", max)
    scan_s = [(f"{count} at a time" if count == 1 else f"{count} at once",
               results.median(NATIVE, "candidate", f"evaluate/{count}_candidates/1_threads", "per_scan"))
              for count in (1, 40)]
    parsed = re.search(r"([\d.]+) times", results.compile_time)
    factors = results.real_time_factors
    return [
        ("T-BayesMap's update of a cell against plain, native", "at most", 0.95, cell("TBayes", NATIVE)),
        ("T-BayesMap's update of a cell against plain, x86-64-v3", "at most", 1.5, cell("TBayes", V3)),
        ("log-odds update of a cell against plain, native", "at most", 0.65, cell("LogOdds", NATIVE)),
        ("T-BayesMap's update with a scan against MRPT's", "at most", 0.9,
         peer("incognita_TBayes", "mrpt", "per_scan")),
        ("OctoMap's update of a cell (default) against T-BayesMap's", "at least", 30.0,
         peer("octomap_default", "incognita_TBayes", "per_touch")),
        ("Exact rays a second at 0.2 m against MRPT's better simulator", "at least", 2.0,
         [("0.20", ours / theirs if ours and theirs else None)]),
        ("Entropy of a map, ns a cell", "at most", 0.35, of_entropy("cell", 1e9)),
        ("Entropy of a map, relative error of the sum", "at most", 1e-4, of_entropy("error", 1.0)),
        ("Evaluation of candidates on one thread, us a predicted scan", "at most", 10.0,
         [(where, value * 1e6 if value else None) for where, value in scan_s]),
        ("Evaluation of 40 candidates, one thread against two", "at least", 1.85,
         [("40", results.ratio(NATIVE, "candidate", "evaluate/40_candidates/1_threads",
                               "evaluate/40_candidates/2_threads"))]),
        ("Occupancy, frontier and information after a scan, on 4000 x 4000 cells against 800 x 800", "at most", 1.2,
         [("follow", results.ratio(NATIVE, "growth", "area/follow/4000x4000", "area/follow/800x800")),
          ("map and obstacle layer", results.ratio(NATIVE, "growth", "area/update/4000x4000", "area/update/800x800"))]),
        ("Planning over 132 x 44 m of cells of 0.1 m, ms: erosion, distances and one field of travel costs", "at most", 15.0,
         milliseconds("action_aware", "spaces")),
        ("Planning over 132 x 44 m of cells of 0.1 m, ms: viewpoints of all frontiers and what they see", "at most", 50.0,
         milliseconds("action_aware", "views")),
        ("MPPI, thousands of samples a second on one thread, of 25 steps each", "at least", 400.0,
         [("a way through an office", thousands("mppi", "command/1_threads", "samples_per_s"))]),
        ("MPPI on one thread against two", "at least", 1.8,
         [("a way through an office", results.ratio(NATIVE, "mppi", "command/1_threads", "command/2_threads"))]),
        ("A run with a recorder that is absent, against one without", "at most", 1.01,
         [("off", results.median(NATIVE, "observer", "run/off", "ratio"))]),
        ("A recorded run, against one without a recorder", "at most", 1.05,
         [("each half second", results.median(NATIVE, "observer", "run/0.5_s", "ratio"))]),
        ("kth_explorer on one thread, times real time, no -march", "at least", 200.0,
         [("default run", statistics.median(factors) if factors else None)]),
        ("Parsing everything against Eigen and the standard headers", "at most", 1.4,
         [("g++", float(parsed[1]) if parsed else None)]),
    ]


def table(header, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [header, ["---"] * len(header), *rows]) + "\n"


def bar_rows(results):
    rows = []
    for what, direction, bound, measured in bars(results):
        measured = [(where, value) for where, value in measured if value is not None]
        values = ", ".join(f"{value:.3g} ({where})" for where, value in measured)
        if not measured:
            rows.append([what, f"{direction} {bound:g}", "not measured", ""])
            continue
        pick = max if direction == "at most" else min
        worst = pick(value for _, value in measured)
        excess = worst / bound if direction == "at most" else bound / worst if worst > 0 else float("inf")
        verdict = "holds" if excess <= 1.0 else f"**missed**, at worst by a factor of {excess:.2f}"
        rows.append([what, f"{direction} {bound:g}", values, verdict])
    return rows


def cell_table(results, preset):
    """The cost of a touched cell, fresh / revisited, as the README shows it."""
    resolutions = ["0.20", "0.10", "0.05"]
    contestants = [("floor", "floor: exact walk and one addition"), ("plain", "plain"), ("LogOdds", "`LogOdds`"),
                   ("TBayes", "`TBayes`"), ("TBayes_literal", "`TBayes`, literal")]
    rows = []
    for name, label in contestants:
        medians = [[results.median(preset, "cell_update", f"{name}/{seen}/{resolution}", "per_touch") for seen in SEEN]
                   for resolution in resolutions]
        if any(value is None for pair in medians for value in pair):
            continue
        ratios = [results.ratio(preset, "cell_update", f"{name}/{seen}/{resolution}", f"plain/{seen}/{resolution}",
                                "per_touch") for resolution in resolutions for seen in SEEN]
        rows.append([label, *(" / ".join(f"{value * 1e9:.1f}" for value in pair) for pair in medians),
                     f"{min(ratios):.2f}-{max(ratios):.2f}" if name != "plain" else "1"])
    return table(["cell", *(f"{float(resolution):g} m" for resolution in resolutions), "against plain"], rows)


def peer_table(results, preset):
    """The cost of a scan in maps of the library and of others."""
    names = sorted({name.split("/")[0] for name in results.program(preset, "peers") if not name.startswith("ray/")})
    rows = []
    for name in sorted(names, key=lambda name: (not name.startswith("incognita"), name)):
        row = [f"`{name}`"]
        for resolution in ["0.20", "0.05"]:
            scan = [results.median(preset, "peers", f"{name}/{seen}/{resolution}", "per_scan") for seen in SEEN]
            touch = [results.median(preset, "peers", f"{name}/{seen}/{resolution}", "per_touch") for seen in SEEN]
            touches = results.median(preset, "peers", f"{name}/fresh/{resolution}", "touches_per_scan")
            if None in scan + touch + [touches]:
                row += ["", "", ""]
                continue
            row += [" / ".join(f"{value * 1e6:.0f}" for value in scan),
                    " / ".join(f"{value * 1e9:.1f}" for value in touch), f"{touches:.0f}"]
        rows.append(row)
    header = ["map"]
    for resolution in ["0.2 m", "0.05 m"]:
        header += [f"{resolution}: us a scan", "ns a touch", "touches a scan"]
    return table(header, rows)


def program_table(results, program):
    """Medians of everything that a program measured."""
    presets = [preset for preset in (NATIVE, V3) if results.program(preset, program)]
    names = list(dict.fromkeys(name for preset in presets for name in results.program(preset, program)))
    rows = []
    for name in names:
        row = [f"`{name}`"]
        for preset in presets:
            figures = results.program(preset, program).get(name)
            if not figures:
                row.append("")
                continue
            times = figures["time_s"]
            middle, low, high = (shown(pick(times), "_s") for pick in (statistics.median, min, max))
            row.append(f"{middle} ({low} to {high})")
        figures = results.program(presets[0], program).get(name, {})
        row.append(", ".join(f"{what} {shown(statistics.median(values), what)}" for what, values in figures.items()
                             if what != "time_s"))
        rows.append(row)
    columns = [preset.removeprefix("benchmark-") for preset in presets]
    return table(["benchmark", *(f"{column}: median (range)" for column in columns), f"counters, {columns[0]}"], rows)


def plot(file, title, unit, bars_by_group, logarithmic=False):
    """A bar for each series in each group; bars_by_group: group -> series -> value."""
    series = list(dict.fromkeys(name for values in bars_by_group.values() for name in values))
    if not series:
        return None
    rows = [" ".join(['"' + group.replace("_", " ") + '"', *(str(values.get(name, "NaN")) for name in series)])
            for group, values in bars_by_group.items()]
    columns = ", ".join(f"$data using {column + 2}:xtic(1) title '{name.replace('_', ' ')}'"
                        for column, name in enumerate(series))
    script = "\n".join(["$data << END", *rows, "END", "set terminal pngcairo size 1200,520 font 'DejaVu Sans,10'",
                        f"set output '{file}'", f"set title '{title}'", f"set ylabel '{unit}'", "set grid ytics",
                        "set style data histograms", "set style fill solid 0.85", "set boxwidth 0.9",
                        "set key outside right top", "set logscale y" if logarithmic else "set yrange [0:]",
                        f"plot {columns}", ""])
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
    return file.name


def groups(results, program, what, scale, pattern):
    """group -> series -> value of the native medians; `pattern` finds both in a benchmark's name."""
    found = {}
    for name in results.program(NATIVE, program):
        value = results.median(NATIVE, program, name, what)
        if value is not None and (match := re.fullmatch(pattern, name)):
            found.setdefault(f"{match['group']} m", {})[match["series"]] = value * scale
    return found


def plots(results, output, date):
    at_place = r"(?P<series>[^/]+)/(?P<group>\w+/[\d.]+)"
    drawn = [
        plot(output / f"{date}-cell_update.png", "Update of a touched cell, native", "ns",
             groups(results, "cell_update", "per_touch", 1e9, at_place)),
        plot(output / f"{date}-peers.png", "Update with a scan of 360 beams, native", "us",
             groups(results, "peers", "per_scan", 1e6, at_place), logarithmic=True),
        plot(output / f"{date}-ray_cast.png", "Rays, native", "million a second",
             groups(results, "ray_cast", "rays_per_s", 1e-6, r"(?P<series>[^/]+)/(?P<group>[\d.]+)")),
        plot(output / f"{date}-peer_rays.png", "Rays beside MRPT, native", "million a second",
             groups(results, "peers", "rays_per_s", 1e-6, r"ray/(?P<series>[^/]+)/(?P<group>[\d.]+)")),
    ]
    return [name for name in drawn if name]


def notes_on_load(results):
    """What the machine's other work did to the bars that are measured in time on the wall."""
    notes = []
    control = results.ratio(NATIVE, "candidate", "control/1_threads", "control/2_threads")
    if control:
        def at_best(name):
            figures = results.program(NATIVE, "candidate")
            return min(figures[f"{name}/1_threads"]["time_s"]) / min(figures[f"{name}/2_threads"]["time_s"])

        notes.append(f"Arithmetic that shares nothing became {control:.2f} times as fast by a second thread in the "
                     "same run: no more can be asked of candidates. The fastest repetitions alone: "
                     f"{at_best('control'):.2f}, and {at_best('evaluate/40_candidates'):.2f} for candidates.")
    if results.processor_time_factors:
        factor = statistics.median(results.processor_time_factors)
        notes.append(f"By the processor's time kth_explorer runs {factor:.0f} times as fast as real time, reading and "
                     "drawing included.")
    return " ".join(notes) + "\n" if notes else ""


def report(results, output):
    date = results.machine.get("date", "undated")
    part = [f"# Benchmarks, {date}\n",
            "What `benchmarks/run` measured: medians over repetitions, which take turns at random within a program. "
            "Ratios are those of medians of the same program in the same run.\n",
            table(["machine", ""], [[key, value] for key, value in results.machine.items() if key != "date"]),
            "## Bars\n", table(["what", "bar", "measured", ""], bar_rows(results)),
            notes_on_load(results),
            "OctoMap keeps one layer of an octree, the library and MRPT a dense plane.\n",
            (pathlib.Path(__file__).parent / "obstacles.md").read_text()]
    if results.errors:
        part += ["Failed:\n", "\n".join(f"- {error}" for error in dict.fromkeys(results.errors)) + "\n"]
    if results.program(NATIVE, "cell_update"):
        part += ["## Update of a touched cell\n",
                 "ns, fresh / revisited map. `floor` is an exact traversal and one addition to a 4-byte float in each "
                 "cell met, in the same binary. A map that steps over tiles of cells which ignore passes may be faster "
                 "than the floor: it leaves cells alone.\n"]
        for preset in (NATIVE, V3):
            if results.program(preset, "cell_update"):
                part += [f"{preset.removeprefix('benchmark-')}:\n", cell_table(results, preset)]
    if results.program(NATIVE, "peers"):
        part += ["## Beside MRPT and OctoMap\n",
                 "The same scans at the same poses, 360 beams of 10 m that end where they were measured (the library's "
                 "hits are not pushed), one thread, fresh / revisited map, native. MRPT and OctoMap are Debian's, "
                 "OctoMap's templates compiled with the library's flags. A touch is a cell met by a beam, by each "
                 "contestant's own walk. MRPT steps along the longer axis in whole cells, so it "
                 "meets fewer, and not always those that the beam passes; its cells have 8 bits. OctoMap writes a cell "
                 "at most once a scan, except by `insertPointCloudRays`; its ns are by the touches of all beams.\n",
                 peer_table(results, NATIVE)]
    if results.compile_time:
        part += ["## Compiling\n", results.compile_time.replace("\n", "\n\n") + "\n"]
    part += [f"![{name}]({name})\n" for name in plots(results, output, date)]
    part.append("## Everything\n")
    programs = dict.fromkeys(program for preset in (NATIVE, V3) for program in results.runs.get(preset, {}))
    for program in programs:
        if any(results.program(preset, program) for preset in (NATIVE, V3)):
            part += [f"### {program}\n", program_table(results, program)]
    (output / f"{date}.md").write_text("\n".join(part))


def readme_table(results):
    machine = results.machine
    lines = [f"{machine.get('processor', 'Unknown processor')}, {machine.get('compiler', 'unknown compiler')}, "
             f"-O3 -march=native, medians of {machine.get('repetitions', '?')}, ns a touched cell, "
             "fresh / revisited map:\n",
             cell_table(results, NATIVE)]
    if results.program(NATIVE, "peers"):
        lines += ["Beside others, on one thread, fresh / revisited:\n", peer_table(results, NATIVE)]
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("results", type=pathlib.Path)
    task = parser.add_mutually_exclusive_group(required=True)
    task.add_argument("--output", type=pathlib.Path, help="folder for the report and its plots")
    task.add_argument("--readme-table", action="store_true", help="print the README's table")
    arguments = parser.parse_args()
    results = Results(arguments.results)
    if arguments.readme_table:
        print(readme_table(results), end="")
    else:
        report(results, arguments.output)


if __name__ == "__main__":
    main()
