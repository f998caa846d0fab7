// One run's map: a canvas that is drawn when something has changed, and moved by mouse, touch, wheel and buttons.

class MapView {
  // `onMove` is called when the reader has moved the view.
  constructor(run, canvas, hiddenLayers, onMove) {
    this.run = run;
    this.canvas = canvas;
    this.context = canvas.getContext('2d');
    this.hiddenLayers = hiddenLayers;
    this.onMove = onMove;
    this.view = new View(floorBounds(run));
    this.belief = new Belief(run);
    this.floor = floorFromMap(run);
    this.walls = run.plan ? wallPath(run.columns) : null;
    this.follows = false;
    this.frame = this.belief.frame;
    this.#listen();
    new ResizeObserver(() => this.#resize()).observe(canvas);
  }

  show(frame, decision) {
    this.frame = frame;
    this.decision = decision;
    this.draw();
  }

  // `palette` as themeColors makes it.
  paint(palette) {
    this.colors = { ...palette, hatch: hatchPattern(this.context, palette) };
    this.belief.paint(palette.shades);
    this.draw();
  }

  draw() {
    if (this.isWaiting) return;
    this.isWaiting = true;
    requestAnimationFrame(() => {
      this.isWaiting = false;
      this.drawNow();
    });
  }

  drawNow() {
    if (!this.colors || this.run.frames === 0) return;
    this.belief.seek(this.frame);
    if (this.follows) {
      const { pose } = this.run.columns;
      this.view.center = moved(this.floor, pose[3 * this.frame], pose[3 * this.frame + 1]);
      this.view.isFitted = false;
    }
    const ratio = this.ratio ?? 1;
    const { run, frame, decision, view, belief, walls, colors, floor } = this;
    const scene = { run, frame, decision, view, belief, walls, colors, floor, ratio };
    for (const [name, layer] of mapLayers) {
      if (!this.hiddenLayers.has(name)) layer(this.context, scene);
    }
  }

  // Nearer, where more than half of the floor was seen.
  follow(follows) {
    this.follows = follows;
    if (follows && this.view.isFitted) this.view.zoom(Math.max(1, 28 / this.view.scale));
    this.draw();
  }

  fit() {
    this.follows = false;
    this.view.fit();
    this.#moved();
  }

  zoom(factor, at) {
    this.view.zoom(factor, at);
    this.#moved();
  }

  #moved() {
    this.draw();
    this.onMove(this);
  }

  #resize() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth === 0) return;
    this.ratio = Math.min(3, window.devicePixelRatio || 1);
    this.canvas.width = Math.round(clientWidth * this.ratio);
    this.canvas.height = Math.round(clientHeight * this.ratio);
    this.view.resize(clientWidth, clientHeight);
    this.drawNow();
  }

  #listen() {
    const pointers = new Map();
    const place = (event) => [event.offsetX, event.offsetY];
    const middle = () => [...pointers.values()].reduce((sum, [x, y]) => [sum[0] + x / pointers.size, sum[1] + y / pointers.size], [0, 0]);
    const spread = () => {
      const [a, b] = [...pointers.values()];
      return b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
    };
    const { canvas } = this;
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, place(event));
    });
    canvas.addEventListener('pointermove', (event) => {
      if (!pointers.has(event.pointerId)) return;
      const before = middle();
      const spreadBefore = spread();
      pointers.set(event.pointerId, place(event));
      const after = middle();
      if (!this.follows) this.view.pan(after[0] - before[0], after[1] - before[1]);
      if (spreadBefore > 0) this.view.zoom(spread() / spreadBefore, after);
      this.#moved();
    });
    for (const name of ['pointerup', 'pointercancel']) canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), this.follows ? undefined : place(event));
    }, { passive: false });
    canvas.addEventListener('dblclick', (event) => this.zoom(2, place(event)));
  }
}

function wallPath({ wall_starts, wall_m }) {
  const path = new Path2D();
  for (let line = 0; line + 1 < wall_starts.length; ++line) {
    for (let i = wall_starts[line]; i < wall_starts[line + 1]; ++i) {
      if (i === wall_starts[line]) path.moveTo(wall_m[2 * i], wall_m[2 * i + 1]);
      else path.lineTo(wall_m[2 * i], wall_m[2 * i + 1]);
    }
    path.closePath();
  }
  return path;
}

// Unknown floor is hatched, so that it is told from free and occupied without colour.
function hatchPattern(context, palette) {
  const tile = document.createElement('canvas');
  tile.width = tile.height = 8;
  const paint = tile.getContext('2d');
  paint.fillStyle = palette.unknown;
  paint.fillRect(0, 0, 8, 8);
  paint.strokeStyle = palette.unknownLine;
  paint.lineWidth = 1;
  for (const shift of [-8, 0, 8]) {
    paint.beginPath();
    paint.moveTo(shift - 1, 9);
    paint.lineTo(shift + 9, -1);
    paint.stroke();
  }
  return context.createPattern(tile, 'repeat');
}

// The colours of the page's theme, which report.css has.
function themeColors() {
  const style = getComputedStyle(document.documentElement);
  const value = (name) => style.getPropertyValue(`--${name}`).trim();
  const rgba = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)).concat(255);
  const names = { unknown: 'unknown', unknownLine: 'unknown-line', wall: 'wall', truth: 'truth', truthBand: 'truth-band', estimate: 'estimate',
    frontier: 'frontier', frontierEdge: 'frontier-edge', casing: 'casing', scan: 'scan', fan: 'fan', ellipse: 'ellipse', halo: 'halo', ink: 'map-ink',
    text: 'text', muted: 'muted', grid: 'line', seriesA: 'series-a', seriesB: 'series-b', bandA: 'band-a', bandB: 'band-b', reference: 'reference' };
  const colors = Object.fromEntries(Object.entries(names).map(([key, name]) => [key, value(name)]));
  colors.shades = [];
  for (let shade = -4; shade <= 4; ++shade) {
    const name = shade < 0 ? `free-${-shade}` : `occupied-${shade}`;
    colors.shades.push(shade === 0 ? [0, 0, 0, 0] : rgba(value(name)));
  }
  return colors;
}
