// A run as the program packed it (examples/support/report_data.hpp), unpacked.

// The columns of a run by name, and what its head says of it.
async function unpackRun(base64) {
  const letters = atob(base64.trim());
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; ++i) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = await new Response(stream).arrayBuffer();
  const headSize = new DataView(bytes).getUint32(0, true);
  const about = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 4, headSize)));
  const types = { Float64Array, Float32Array, Uint8Array, Int16Array, Int32Array, Uint32Array };
  const columns = {};
  for (const [name, [type, offset, length]] of Object.entries(about.columns)) {
    columns[name] = new types[type](bytes, 4 + headSize + offset, length);
  }
  return makeRun(about, columns);
}

function makeRun(about, columns) {
  const frames = columns.time_s.length;
  const run = {
    ...about,
    frames,
    times: columns.time_s,
    columns,
    metrics: parsedObject(about.metrics_json),
    parameters: flattened(parsedObject(about.parameters_json)),
    duration: frames > 0 ? columns.time_s[frames - 1] : 0,
    hasTruth: frames > 0 && !Number.isNaN(columns.truth[0]),
  };
  undoDifferences(columns.ranges, about.beam_angles_rad.length);
  run.series = Object.fromEntries(about.metric_names.map((name, i) => [name, columns[`metric${i}`]]));
  run.cells = expandedCells(run);
  run.touchedCells = touchedCount(run);
  run.frontierCells = expandedFrontiers(columns);
  run.everyNth = frames > 1 ? Math.ceil((about.frames_recorded - 1) / (frames - 1)) : 1;
  return run;
}

function parsedObject(text) {
  try {
    const value = JSON.parse(text);
    return value !== null && typeof value === 'object' ? value : {};
  } catch {
    return {};
  }
}

// { a: { b: 1 } } as { 'a.b': 1 }.
function flattened(object, prefix = '') {
  const flat = {};
  for (const [key, value] of Object.entries(object)) {
    const isNested = value !== null && typeof value === 'object' && !Array.isArray(value);
    Object.assign(flat, isNested ? flattened(value, `${prefix}${key}.`) : { [prefix + key]: value });
  }
  return flat;
}

// Each row starts anew.
function undoDifferences(values, width) {
  for (let i = 0; i < values.length; ++i) {
    if (i % width !== 0) values[i] += values[i - 1];
  }
}

// For each frame, which cells of the belief's image change, and to what shade: -4 to 4, plus 4.
function expandedCells(run) {
  const { tile_counts, tile_places, tile_low, tile_high, shades } = run.columns;
  const { x, y, width } = run.belief;
  const places = new Uint32Array(shades.length);
  const starts = new Uint32Array(run.frames + 1);
  let tile = 0;
  let cell = 0;
  for (let frame = 0; frame < run.frames; ++frame) {
    let column = 0;
    let row = 0;
    for (let i = 0; i < tile_counts[frame]; ++i, ++tile) {
      column += tile_places[2 * tile];
      row += tile_places[2 * tile + 1];
      const corner = (row * 8 - y) * width + column * 8 - x;
      for (let bit = 0; bit < 64; ++bit) {
        const word = bit < 32 ? tile_low[tile] : tile_high[tile];
        if ((word >>> (bit & 31)) & 1) places[cell++] = corner + (bit >> 3) * width + (bit & 7);
      }
    }
    starts[frame + 1] = cell;
  }
  return { places, shades, starts };
}

// Cells of which anything was ever known.
function touchedCount({ cells, belief }) {
  const isTouched = new Uint8Array(belief.width * belief.height);
  for (const place of cells.places) isTouched[place] = 1;
  return isTouched.reduce((sum, value) => sum + value, 0);
}

function expandedFrontiers({ frontier_starts, frontier_cells }) {
  const cells = new Int32Array(frontier_cells);
  for (let decision = 0; decision + 1 < frontier_starts.length; ++decision) {
    for (let i = 2 * frontier_starts[decision] + 2; i < 2 * frontier_starts[decision + 1]; ++i) cells[i] += cells[i - 2];
  }
  return cells;
}

// The last of ascending times that is not after `time`, or -1.
function lastAt(times, time) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

function frameAt(run, time) {
  return Math.max(0, lastAt(run.times, time));
}

// A decision of a run with its candidates, the chosen one first; null before there is one.
function decisionAt(run, frame) {
  if (run.frames === 0) return null;
  const index = lastAt(run.columns.decision_s, run.times[frame] + 1e-9);
  return index < 0 ? null : decisionOf(run, index);
}

function decisionOf(run, index) {
  const c = run.columns;
  const candidates = [];
  for (let i = c.candidate_starts[index]; i < c.candidate_starts[index + 1]; ++i) {
    candidates.push({
      frontier: [c.candidate_frontier_m[2 * i], c.candidate_frontier_m[2 * i + 1]],
      path: c.path_m.subarray(2 * c.path_starts[i], 2 * c.path_starts[i + 1]),
      gain: c.candidate_gain_nats[i],
      information: c.candidate_information[i],
      cost: c.candidate_cost[i],
      utility: c.candidate_utility[i],
    });
  }
  return {
    index,
    time: c.decision_s[index],
    reason: run.reasons[c.decision_reason[index]] ?? '',
    stop: run.stop_reasons[c.decision_stop[index]] ?? '',
    candidates,
    frontier: run.frontierCells.subarray(2 * c.frontier_starts[index], 2 * c.frontier_starts[index + 1]),
  };
}
