// What part of the floor is seen, and how large. The floor is that of the plan where there is one, so that its walls stand upright; otherwise of
// the map. Metres, y up; the canvas counts pixels of the page, y down.

class View {
  constructor(bounds) {
    this.bounds = bounds;
    this.center = [(bounds[0] + bounds[2]) / 2, (bounds[1] + bounds[3]) / 2];
    this.scale = 10;
    this.size = [1, 1];
    this.isFitted = true;
  }

  resize(width, height) {
    this.size = [width, height];
    if (this.isFitted) this.fit();
  }

  fit() {
    const [left, bottom, right, top] = this.bounds;
    const margin = 10;
    this.scale = Math.min((this.size[0] - 2 * margin) / (right - left), (this.size[1] - 2 * margin) / (top - bottom));
    this.scale = Math.max(this.scale, 0.1);
    this.center = [(left + right) / 2, (bottom + top) / 2];
    this.isFitted = true;
  }

  toPixels([x, y]) {
    return [this.size[0] / 2 + (x - this.center[0]) * this.scale, this.size[1] / 2 - (y - this.center[1]) * this.scale];
  }

  toFloor([x, y]) {
    return [this.center[0] + (x - this.size[0] / 2) / this.scale, this.center[1] - (y - this.size[1] / 2) / this.scale];
  }

  pan(dx, dy) {
    this.center = [this.center[0] - dx / this.scale, this.center[1] + dy / this.scale];
    this.isFitted = false;
  }

  // The place under `at` stays where it is.
  zoom(factor, at = [this.size[0] / 2, this.size[1] / 2]) {
    const before = this.toFloor(at);
    this.scale = Math.min(600, Math.max(0.5, this.scale * factor));
    const after = this.toFloor(at);
    this.center = [this.center[0] + before[0] - after[0], this.center[1] + before[1] - after[1]];
    this.isFitted = false;
  }
}

// Rigid motions [x, y, cos, sin] of the plane.
function motion([x, y, yaw]) {
  return [x, y, Math.cos(yaw), Math.sin(yaw)];
}

function inverseMotion([x, y, c, s]) {
  return [-(c * x + s * y), s * x - c * y, c, -s];
}

function moved([x, y, c, s], px, py) {
  return [x + c * px - s * py, y + s * px + c * py];
}

// Of a run: from the map's frame to the floor that is shown.
function floorFromMap(run) {
  return run.plan ? inverseMotion(motion(run.plan.T_map_plan)) : [0, 0, 1, 0];
}

// All that is to be seen of a run: left, bottom, right, top.
function floorBounds(run) {
  if (run.plan) return [...run.plan.lower_m, ...run.plan.upper_m];
  const { x, y, width, height } = run.belief;
  return [x, y, x + width, y + height].map((cells) => cells * run.resolution_m);
}
