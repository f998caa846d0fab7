// What changes over time, by Chart.js: one point for each frame that is shown, and a line at the time that is.

// What may be plotted. `series` gives the numbers of a run or nothing; `band` those that the first should stay below.
const plotKinds = [
  {
    id: 'explored',
    title: 'Explored',
    unit: '%',
    explanation: 'Part of the floor that can be seen at all which is known, free or occupied.',
    series: (run) => scaledBy(100, seriesNamed(run, /explored/)),
    bottom: 0,
    top: 100,
    digits: 1,
  },
  {
    id: 'entropy',
    title: 'Map entropy',
    unit: (run) => (/nats/.test(nameOf(run, /entropy|information/) ?? '') ? 'nats' : 'bits'),
    explanation: 'What is not yet known of the cells that the map touches in the end, summed.',
    series: (run) => seriesNamed(run, /entropy/) ?? entropyOf(run),
    bottom: 0,
    digits: 0,
  },
  {
    id: 'error',
    title: 'Translation error',
    unit: 'm',
    explanation: 'Distance between the estimated and the true position. An honest filter keeps it within the 3-sigma band nearly always.',
    series: (run) => (run.hasTruth ? run.columns.error_m : null),
    band: (run) => run.columns.three_sigma_m,
    bottom: 0,
    digits: 3,
  },
  {
    id: 'nees',
    title: 'NEES of the position',
    unit: '',
    explanation: 'Squared error in units of what the filter believes: 2 on average when it is honest, less when it is cautious; above 5.99 in one case of twenty.',
    series: (run) => (run.columns.nees.some((value) => !Number.isNaN(value)) ? run.columns.nees : null),
    lines: [[2, 'mean, if honest'], [5.99, '95 %']],
    bottom: 0,
    digits: 2,
  },
];

function nameOf(run, pattern) {
  return run.metric_names.find((name) => pattern.test(name));
}

function seriesNamed(run, pattern) {
  const name = nameOf(run, pattern);
  return name === undefined ? null : run.series[name];
}

// A recording has how much the map has told; cells of which nothing is known are a bit each.
function entropyOf(run) {
  const information = seriesNamed(run, /^information_bits/);
  if (!information) return null;
  const touched = run.metrics.touched_cells ?? Math.max(run.touchedCells, information.at(-1) ?? 0);
  return information.map((bits) => touched - bits);
}

function scaledBy(factor, values) {
  return values && values.map((value) => factor * value);
}

class Plot {
  // `seek` is called with the time that the reader points at.
  constructor(kind, runs, parent, seek) {
    this.kind = kind;
    this.runs = runs;
    this.values = runs.map((run) => kind.series(run));
    this.bands = runs.map((run, i) => (kind.band && this.values[i] ? kind.band(run) : null));
    this.unit = typeof kind.unit === 'function' ? kind.unit(runs[0]) : kind.unit;
    const figure = fragmentOf('plot-template');
    this.figure = figure;
    figure.dataset.plot = kind.id;
    figure.querySelector('.plot-title').textContent = kind.title + (this.unit ? ` (${this.unit})` : '');
    figure.querySelector('.plot-explanation').textContent = kind.explanation;
    this.readout = figure.querySelector('.plot-value');
    this.cursor = figure.querySelector('.plot-cursor');
    this.canvas = figure.querySelector('canvas');
    parent.append(figure);
    this.duration = Math.max(1, ...runs.map((run) => run.duration));
    this.colors = themeColors();
    this.#makeChart();
    this.#listen(seek);
  }

  paint(colors) {
    this.colors = colors;
    const { chart } = this;
    const lines = [colors.seriesA, colors.seriesB];
    const bands = [colors.bandA, colors.bandB];
    for (const set of chart.data.datasets) {
      set.borderColor = lines[set.run];
      set.backgroundColor = bands[set.run];
    }
    for (const scale of Object.values(chart.options.scales)) {
      scale.ticks.color = colors.muted;
      scale.grid.color = colors.grid;
      scale.grid.borderColor = colors.grid;
    }
    chart.update('none');
    this.#moveCursor();
  }

  show(time, frames) {
    this.time = time;
    this.#moveCursor();
    const shown = this.values.map((values, i) => (values ? number(values[frames[i]], this.kind.digits) : '–'));
    const bands = this.bands.map((band, i) => (band ? ` (3σ ${number(band[frames[i]], this.kind.digits)})` : ''));
    this.readout.textContent = shown.map((text, i) => `${this.runs.length > 1 ? `${'AB'[i]} ` : ''}${text}${bands[i]}`).join('   ');
  }

  #makeChart() {
    const datasets = [];
    this.values.forEach((values, run) => {
      if (!values) return;
      const { times } = this.runs[run];
      const points = (numbers) => Array.from(numbers, (y, i) => ({ x: times[i], y }));
      datasets.push({ role: 'values', run, data: points(values), borderWidth: run === 0 ? 1.6 : 2, borderDash: run === 0 ? [] : [6, 4] });
      const band = this.bands[run];
      if (band) {
        datasets.push({ role: 'band', run, data: points(band), borderWidth: 1, borderDash: run === 0 ? [1, 2] : [2, 5], fill: 'origin' });
      }
    });
    const { bottom, top, lines = [] } = this.kind;
    const highest = top ?? this.#highest();
    const reference = {
      id: 'reference',
      afterDatasetsDraw: ({ ctx, chartArea, scales }) => {
        for (const [value, label] of lines) {
          const y = scales.y.getPixelForValue(value);
          if (y < chartArea.top) continue;
          ctx.save();
          ctx.strokeStyle = this.colors.reference;
          ctx.setLineDash([8, 4]);
          ctx.beginPath();
          ctx.moveTo(chartArea.left, y);
          ctx.lineTo(chartArea.right, y);
          ctx.stroke();
          ctx.fillStyle = this.colors.reference;
          ctx.font = '11px system-ui, sans-serif';
          ctx.textAlign = 'right';
          ctx.fillText(label, chartArea.right - 3, y - 3);
          ctx.restore();
        }
      },
      resize: () => requestAnimationFrame(() => this.#moveCursor()),
    };
    const ticks = () => ({ font: { size: 11 }, maxRotation: 0, autoSkipPadding: 12 });
    this.chart = new Chart(this.canvas, {
      type: 'line',
      data: { datasets },
      plugins: [reference],
      options: {
        animation: false,
        responsive: true,
        maintainAspectRatio: false,
        parsing: false,
        normalized: true,
        events: [],
        elements: { point: { radius: 0, hitRadius: 0 }, line: { tension: 0 } },
        plugins: { legend: { display: false }, tooltip: { enabled: false } },
        scales: {
          x: { type: 'linear', min: 0, max: this.duration, grid: {}, ticks: { ...ticks(), callback: (value) => clock(value) }, afterBuildTicks: (scale) => { scale.ticks = timeTicks(this.duration); } },
          y: { type: 'linear', min: bottom, max: highest, grid: {}, ticks: { ...ticks(), maxTicksLimit: 5, includeBounds: false, callback: (value) => (Math.abs(value) >= 10000 ? `${shortNumber(value / 1000)}k` : shortNumber(value)) }, afterFit: (scale) => { scale.width = 46; } },
        },
      },
    });
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `${this.kind.title} over time. ${this.kind.explanation}`);
    if (datasets.length === 0) this.figure.querySelector('.plot-explanation').textContent = 'This run did not record it.';
  }

  // A few outliers must not make a flat line of the rest: then the highest are cut off, and the figure says so.
  #highest() {
    const all = [...this.values, ...this.bands].flatMap((values) => (values ? Array.from(values) : [])).filter(Number.isFinite).sort((a, b) => a - b);
    if (all.length === 0) return 1;
    const most = all[all.length - 1];
    const usual = all[Math.floor(0.99 * (all.length - 1))];
    const atLeast = Math.max(0, ...(this.kind.lines ?? []).map(([value]) => 1.3 * value));
    if (most > 3 * Math.max(usual, atLeast)) {
      const explanation = this.figure.querySelector('.plot-explanation');
      explanation.textContent += ` Cut off at the top; the highest value is ${number(most, this.kind.digits)}.`;
      return niceCeiling(Math.max(1.5 * usual, atLeast));
    }
    return niceCeiling(Math.max(1.04 * most, atLeast, 1e-6));
  }

  #moveCursor() {
    if (this.time === undefined) return;
    const { left, right, top, bottom } = this.chart.chartArea;
    const x = left + ((right - left) * this.time) / this.duration;
    this.cursor.style.transform = `translateX(${x}px)`;
    this.cursor.style.top = `${top}px`;
    this.cursor.style.height = `${bottom - top}px`;
  }

  #listen(seek) {
    const point = (event) => {
      const { left, right } = this.chart.chartArea;
      const part = (event.offsetX - left) / (right - left);
      seek(Math.min(1, Math.max(0, part)) * this.duration);
    };
    this.canvas.addEventListener('pointerdown', (event) => {
      this.canvas.setPointerCapture(event.pointerId);
      point(event);
    });
    this.canvas.addEventListener('pointermove', (event) => {
      if (event.buttons & 1) point(event);
    });
  }
}

// At most seven, at round times.
function timeTicks(duration) {
  const step = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200].find((seconds) => duration / seconds <= 7) ?? duration / 7;
  return Array.from({ length: Math.floor(duration / step + 1e-6) + 1 }, (_, i) => ({ value: i * step }));
}

function niceCeiling(value) {
  const base = 10 ** Math.floor(Math.log10(value));
  return [1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10].map((step) => step * base).find((step) => step >= value * (1 - 1e-9));
}
