// The layers of the map, each drawn on its own: layer(context, scene). A scene has the run, its frame and decision, the view, the belief's image,
// the walls' path, the colours and `floor`, which takes the map's frame to the floor.

const tau = 2 * Math.PI;

const viridis = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142], [31, 158, 137], [53, 183, 121], [110, 206, 88],
  [181, 222, 43], [253, 231, 37]];

function viridisColor(part) {
  const at = Math.min(1, Math.max(0, part)) * (viridis.length - 1);
  const low = Math.min(viridis.length - 2, Math.floor(at));
  const mixed = viridis[low].map((value, i) => Math.round(value + (at - low) * (viridis[low + 1][i] - value)));
  return `rgb(${mixed.join(',')})`;
}

// What BIG is coloured between, in one decision.
function gainBounds(decision) {
  const gains = decision ? decision.candidates.map((candidate) => candidate.gain) : [];
  return [0, Math.max(1e-9, ...gains)];
}

// From here on, lengths are metres on the floor, y up.
function onFloor(context, { view, ratio }) {
  const [x, y] = view.toPixels([0, 0]);
  context.setTransform(view.scale * ratio, 0, 0, -view.scale * ratio, x * ratio, y * ratio);
}

function onPage(context, { ratio }) {
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
}

function polyline(context, scene, points, first, last, stride) {
  context.beginPath();
  for (let i = first; i < last; ++i) {
    const [x, y] = scene.view.toPixels(moved(scene.floor, points[stride * i], points[stride * i + 1]));
    if (i === first) context.moveTo(x, y);
    else context.lineTo(x, y);
  }
}

function drawGround(context, scene) {
  onPage(context, scene);
  context.fillStyle = scene.colors.hatch;
  context.fillRect(0, 0, ...scene.view.size);
}

function drawBelief(context, scene) {
  const { run, floor, belief, view } = scene;
  const { x, y, width, height } = run.belief;
  onFloor(context, scene);
  context.transform(floor[2], floor[3], -floor[3], floor[2], floor[0], floor[1]);
  // Cells have edges, but those that are smaller than pixels must not fall between them.
  context.imageSmoothingEnabled = run.resolution_m * view.scale * scene.ratio < 1;
  context.imageSmoothingQuality = run.resolution_m * view.scale * scene.ratio < 0.4 ? 'medium' : 'low';
  const cell = run.resolution_m;
  context.drawImage(belief.canvas, x * cell, y * cell, width * cell, height * cell);
}

function drawWalls(context, scene) {
  if (!scene.walls) return;
  onFloor(context, scene);
  context.lineWidth = Math.min(1.4, Math.max(0.7, scene.view.scale / 14)) / scene.view.scale;
  context.lineJoin = 'round';
  context.strokeStyle = scene.colors.wall;
  context.stroke(scene.walls);
}

function drawPaths(context, scene) {
  const { run, frame, colors } = scene;
  onPage(context, scene);
  context.lineJoin = context.lineCap = 'round';
  if (run.hasTruth) {
    polyline(context, scene, run.columns.truth, 0, frame + 1, 3);
    context.strokeStyle = colors.truthBand;
    context.lineWidth = 6 * markScale(scene.view);
    context.stroke();
  }
  polyline(context, scene, run.columns.pose, 0, frame + 1, 3);
  context.strokeStyle = colors.estimate;
  context.lineWidth = 1.6;
  context.stroke();
}

function drawFrontiers(context, scene) {
  const { decision, run, view, colors } = scene;
  if (!decision) return;
  onPage(context, scene);
  const size = Math.max(4 * markScale(view) - 1, run.resolution_m * view.scale * 0.9);
  const squares = (extra, color) => {
    context.fillStyle = color;
    for (let i = 0; i < decision.frontier.length; i += 2) {
      const at = moved(scene.floor, (decision.frontier[i] + 0.5) * run.resolution_m, (decision.frontier[i + 1] + 0.5) * run.resolution_m);
      const [x, y] = view.toPixels(at);
      context.fillRect(x - size / 2 - extra, y - size / 2 - extra, size + 2 * extra, size + 2 * extra);
    }
  };
  squares(markScale(view), colors.frontierEdge);
  squares(0, colors.frontier);
}

function drawCandidates(context, scene) {
  const { decision, colors, view } = scene;
  if (!decision) return;
  onPage(context, scene);
  context.lineJoin = context.lineCap = 'round';
  const [low, high] = gainBounds(decision);
  // The chosen one is last, above all others.
  for (let i = decision.candidates.length - 1; i >= 0; --i) {
    const { path, gain } = decision.candidates[i];
    if (path.length < 2) continue;
    const color = viridisColor((gain - low) / (high - low));
    const isChosen = i === 0;
    polyline(context, scene, path, 0, path.length / 2, 2);
    context.setLineDash([]);
    context.strokeStyle = isChosen ? colors.casing : colors.halo;
    context.lineWidth = (isChosen ? 7 : 4) * markScale(view);
    context.stroke();
    context.setLineDash(isChosen ? [] : [6, 3]);
    context.strokeStyle = color;
    context.lineWidth = (isChosen ? 4 : 2) * markScale(view);
    context.stroke();
    context.setLineDash([]);
    const end = path.length - 2;
    const at = view.toPixels(moved(scene.floor, path[end], path[end + 1]));
    mark(context, at, isChosen, color, colors.casing, markScale(view));
  }
}

// Marks are smaller where much of the floor is seen at once.
function markScale(view) {
  return Math.min(1, Math.max(0.6, view.scale / 15));
}

// A star for the chosen one, a disc for the others.
function mark(context, [x, y], isChosen, color, edge, size) {
  context.beginPath();
  if (isChosen) {
    for (let i = 0; i < 10; ++i) {
      const radius = (i % 2 === 0 ? 11 : 4.8) * size;
      const angle = -tau / 4 + (i * tau) / 10;
      context.lineTo(x + radius * Math.cos(angle), y + radius * Math.sin(angle));
    }
    context.closePath();
  } else {
    context.arc(x, y, 4 * size, 0, tau);
  }
  context.fillStyle = color;
  context.strokeStyle = edge;
  context.lineWidth = 2;
  context.stroke();
  context.fill();
}

function drawScan(context, scene) {
  const { run, frame, view, colors } = scene;
  const { pose, ranges } = run.columns;
  const beams = run.beam_angles_rad.length;
  if (beams === 0) return;
  onPage(context, scene);
  const [x, y, yaw] = pose.subarray(3 * frame, 3 * frame + 3);
  const ends = [];
  const fan = new Path2D();
  const origin = view.toPixels(moved(scene.floor, x, y));
  fan.moveTo(...origin);
  for (let beam = 0; beam < beams; ++beam) {
    const thousandths = ranges[frame * beams + beam];
    if (thousandths === 0) {
      fan.lineTo(...origin);
      continue;
    }
    const range = (Math.min(thousandths, 1000) / 1000) * run.range_max_m;
    const angle = yaw + run.beam_angles_rad[beam];
    const end = view.toPixels(moved(scene.floor, x + range * Math.cos(angle), y + range * Math.sin(angle)));
    fan.lineTo(...end);
    if (thousandths <= 1000) ends.push(end);
  }
  fan.closePath();
  context.fillStyle = colors.fan;
  context.fill(fan);
  const radius = Math.min(3, Math.max(1.3, view.scale / 18));
  context.fillStyle = colors.scan;
  for (const [ex, ey] of ends) {
    context.beginPath();
    context.arc(ex, ey, radius, 0, tau);
    context.fill();
  }
}

// Half the axes of the 3-sigma ellipse in metres, and the angle of the longer in the map's frame.
function ellipseOf(run, frame) {
  const [xx, xy, yy] = run.columns.covariance.subarray(4 * frame, 4 * frame + 3);
  const half = Math.hypot((xx - yy) / 2, xy);
  const mean = (xx + yy) / 2;
  return [3 * Math.sqrt(Math.max(0, mean + half)), 3 * Math.sqrt(Math.max(0, mean - half)), Math.atan2(2 * xy, xx - yy) / 2];
}

// How many times an ellipse is drawn larger than it is, so that it can be seen: 1, 2, 5, 10 and so on.
function magnification(pixels) {
  if (!(pixels > 1e-6) || pixels >= 16) return 1;
  const exponent = Math.floor(Math.log10(24 / pixels));
  const base = 10 ** exponent;
  return [5, 2, 1].map((step) => step * base).find((step) => step <= 24 / pixels) ?? 1;
}

function drawEllipse(context, scene) {
  const { run, frame, view, colors, floor } = scene;
  const [major, minor, angle] = ellipseOf(run, frame);
  if (!(major > 0)) return;
  onPage(context, scene);
  const [x, y] = view.toPixels(moved(floor, run.columns.pose[3 * frame], run.columns.pose[3 * frame + 1]));
  const times = magnification(major * view.scale);
  const turn = -(angle + Math.atan2(floor[3], floor[2]));
  context.beginPath();
  context.ellipse(x, y, major * view.scale * times, Math.max(0.5, minor * view.scale * times), turn, 0, tau);
  context.strokeStyle = colors.halo;
  context.lineWidth = 4;
  context.stroke();
  context.setLineDash(times > 1 ? [4, 3] : []);
  context.strokeStyle = colors.ellipse;
  context.lineWidth = 2;
  context.stroke();
  context.setLineDash([]);
  if (times > 1) {
    const aside = major * view.scale * times + 6;
    const hasRoom = x + aside + 70 < view.size[0];
    haloText(context, scene, `3σ × ${times}`, hasRoom ? x + aside : x - aside - 58, y - 8);
  }
}

function haloText(context, { colors }, text, x, y) {
  context.font = '600 12px system-ui, sans-serif';
  context.lineJoin = 'round';
  context.strokeStyle = colors.halo;
  context.lineWidth = 4;
  context.strokeText(text, x, y);
  context.fillStyle = colors.ink;
  context.fillText(text, x, y);
}

function drawRobot(context, scene) {
  const { run, frame, view, colors, floor } = scene;
  const radius = Math.max(7 * markScale(view), run.robot_radius_m * view.scale);
  onPage(context, scene);
  const place = (poses) => {
    const [x, y, yaw] = poses.subarray(3 * frame, 3 * frame + 3);
    return [...view.toPixels(moved(floor, x, y)), -(yaw + Math.atan2(floor[3], floor[2]))];
  };
  if (run.hasTruth) {
    const [x, y] = place(run.columns.truth);
    context.beginPath();
    context.arc(x, y, radius + 3, 0, tau);
    context.strokeStyle = colors.truth;
    context.lineWidth = 2.5;
    context.stroke();
  }
  const [x, y, angle] = place(run.columns.pose);
  context.beginPath();
  context.arc(x, y, radius, 0, tau);
  context.fillStyle = colors.estimate;
  context.fill();
  context.strokeStyle = colors.halo;
  context.lineWidth = 1.5;
  context.stroke();
  context.beginPath();
  for (const turn of [0, 2.5, -2.5]) context.lineTo(x + 0.8 * radius * Math.cos(angle + turn), y + 0.8 * radius * Math.sin(angle + turn));
  context.closePath();
  context.fillStyle = colors.halo;
  context.fill();
}

// A bar of a round length, bottom left.
function drawScaleBar(context, scene) {
  onPage(context, scene);
  const { scale, size } = scene.view;
  const metres = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200].find((length) => length * scale >= 50) ?? 500;
  const [x, y] = [14, size[1] - 14];
  context.beginPath();
  context.moveTo(x, y - 6);
  context.lineTo(x, y);
  context.lineTo(x + metres * scale, y);
  context.lineTo(x + metres * scale, y - 6);
  context.strokeStyle = scene.colors.halo;
  context.lineWidth = 5;
  context.stroke();
  context.strokeStyle = scene.colors.ink;
  context.lineWidth = 2;
  context.stroke();
  haloText(context, scene, `${metres} m`, x + 6, y - 7);
}

// In the order in which they are drawn; each but the ground and the scale can be switched off by its name.
const mapLayers = [
  ['ground', drawGround],
  ['belief', drawBelief],
  ['paths', drawPaths],
  ['walls', drawWalls],
  ['frontiers', drawFrontiers],
  ['scan', drawScan],
  ['candidates', drawCandidates],
  ['robot', drawRobot],
  ['ellipse', drawEllipse],
  ['scale', drawScaleBar],
];
