// Puts the page together.

// A copy of a template's only element.
function fragmentOf(id) {
  return document.getElementById(id).content.firstElementChild.cloneNode(true);
}

// Decisions, and where scans were not trusted, above the timeline: a line for each run.
function drawMarks(canvas, runs, duration, colors) {
  const ratio = window.devicePixelRatio || 1;
  const { clientWidth: width, clientHeight: height } = canvas;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const context = canvas.getContext('2d');
  context.scale(ratio, ratio);
  const at = (time) => 8 + ((width - 16) * time) / Math.max(duration, 1e-9);
  const row = height / runs.length;
  runs.forEach((run, i) => {
    context.fillStyle = colors.wall;
    for (let frame = 0; frame < run.frames; ++frame) {
      if (run.columns.flags[frame] & 3) context.fillRect(at(run.times[frame]), i * row, 2, row - 1);
    }
    context.fillStyle = colors.muted;
    for (const time of run.columns.decision_s) context.fillRect(at(time), i * row + row / 2, 1, row / 2 - 1);
  });
}

// The system's, until the reader chooses another.
function wireTheme(onChange) {
  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  const button = document.getElementById('theme');
  let chosen = null;
  const show = () => {
    const theme = chosen ?? (dark.matches ? 'dark' : 'light');
    document.documentElement.dataset.theme = theme;
    button.setAttribute('aria-pressed', String(theme === 'dark'));
    onChange();
  };
  button.addEventListener('click', () => {
    chosen = button.getAttribute('aria-pressed') === 'true' ? 'light' : 'dark';
    show();
  });
  dark.addEventListener('change', show);
  show();
}

function wireLayers(hiddenLayers, onChange) {
  for (const box of document.querySelectorAll('#layers input')) {
    box.checked = true;
    box.addEventListener('change', () => {
      if (box.checked) hiddenLayers.delete(box.value);
      else hiddenLayers.add(box.value);
      onChange();
    });
  }
}

function sayWhatIsShown(runs) {
  const lines = runs.map((run, i) => {
    const label = runs.length > 1 ? `${'AB'[i]}: ` : '';
    const thinned = run.everyNth > 1
      ? `every ${ordinal(run.everyNth)} of ${run.frames_recorded} recorded frames is shown, with all that has changed in between`
      : `all ${run.frames} recorded frames are shown`;
    const beams = run.beam_angles_rad.length < run.beams_recorded ? `, ${run.beam_angles_rad.length} of ${run.beams_recorded} beams of a scan` : '';
    return `${label}${thinned}${beams}.`;
  });
  document.getElementById('thinned').textContent = lines.join(' ');
}

function ordinal(n) {
  const suffix = n % 100 >= 11 && n % 100 <= 13 ? 'th' : ['th', 'st', 'nd', 'rd'][n % 10] ?? 'th';
  return `${n}${suffix}`;
}

function sameFloor(runs) {
  return runs.length === 2 && JSON.stringify(floorBounds(runs[0])) === JSON.stringify(floorBounds(runs[1]));
}

async function showReport() {
  const runs = await Promise.all([...document.querySelectorAll('script.run')].map((script) => unpackRun(script.textContent)));
  document.body.dataset.runs = String(runs.length);
  document.body.style.setProperty('--runs', String(runs.length));
  const aspects = runs.map(floorBounds).map(([left, bottom, right, top]) => (right - left) / (top - bottom));
  document.body.style.setProperty('--aspect', String(aspects.reduce((sum, aspect) => sum + aspect / runs.length, 0)));
  const hiddenLayers = new Set();
  const panes = [];
  let follows = false;
  const onFollow = () => {
    follows = !follows;
    for (const pane of panes) pane.follow(follows);
  };
  // Two maps of the same floor move together, unless each follows its own robot.
  const isLinked = sameFloor(runs);
  const onMove = (moved) => {
    follows = moved.follows;
    for (const { map } of panes) {
      if (map === moved || !isLinked || moved.follows) continue;
      map.follows = false;
      Object.assign(map.view, { center: [...moved.view.center], scale: moved.view.scale, isFitted: moved.view.isFitted });
      map.draw();
    }
  };
  const telling = distinctions(runs);
  const parent = document.getElementById('panes');
  for (const [i, run] of runs.entries()) {
    panes.push(new Pane(run, runs.length > 1 ? 'AB'[i] : '', telling[i], parent, { hiddenLayers, onMove, onFollow }));
  }
  document.getElementById('series-legend').hidden = runs.length < 2;
  let player = null;
  const plots = plotKinds.map((kind) => new Plot(kind, runs, document.getElementById('plots'), (time) => player.seek(time)));
  const show = (time) => {
    for (const pane of panes) pane.show(time);
    for (const plot of plots) plot.show(time, panes.map((pane) => pane.frame ?? 0));
  };
  const marks = document.getElementById('marks');
  const duration = Math.max(...runs.map((run) => run.duration));
  wireTheme(() => {
    const colors = themeColors();
    for (const pane of panes) pane.map.paint(colors);
    for (const plot of plots) plot.paint(colors);
    drawMarks(marks, runs, duration, colors);
  });
  new ResizeObserver(() => drawMarks(marks, runs, duration, themeColors())).observe(marks);
  wireLayers(hiddenLayers, () => panes.forEach((pane) => pane.map.draw()));
  player = new Player(runs, show, onFollow);
  for (const button of document.querySelectorAll('[data-help]')) button.addEventListener('click', toggleHelp);
  document.getElementById('no-metrics').hidden = fillMetrics(document.getElementById('metrics'), runs) > 0;
  document.getElementById('no-parameters').hidden = fillParameters(document.getElementById('parameters'), runs) > 0;
  sayWhatIsShown(runs);
  document.body.dataset.ready = 'true';
  performance.mark('ready');
  // For tests, and for who wants to look further.
  window.incognitaReport = { runs, panes, plots, player };
}

showReport().catch((error) => {
  const old = typeof DecompressionStream === 'undefined' ? ' It needs a browser of 2023 or later.' : '';
  const problem = document.getElementById('problem');
  problem.hidden = false;
  problem.textContent = `This page cannot be shown.${old} (${error.message})`;
  console.error(error);
});
