// The belief at any frame, as an image: changes forwards, and what it was every so often, so that any frame is near.

const unknownShade = 4;
const snapshotBytes = 32 * 1024 * 1024;

class Belief {
  constructor(run) {
    this.run = run;
    const { width, height } = run.belief;
    this.shades = new Uint8Array(width * height).fill(unknownShade);
    this.every = Math.max(32, Math.ceil((run.frames * width * height) / snapshotBytes));
    this.snapshots = [];
    for (let frame = 0; frame < run.frames; ++frame) {
      this.#apply(frame);
      if (frame % this.every === 0) this.snapshots.push(this.shades.slice());
    }
    this.frame = run.frames - 1;
    this.canvas = document.createElement('canvas');
    this.canvas.width = width;
    this.canvas.height = height;
    this.context = this.canvas.getContext('2d');
    this.image = this.context.createImageData(width, height);
    this.pixels = new Uint32Array(this.image.data.buffer);
  }

  // `colors` are nine of [red, green, blue, alpha].
  paint(colors) {
    this.table = new Uint32Array(new Uint8Array(colors.flat()).buffer);
    this.#paintAll();
  }

  seek(frame) {
    if (frame === this.frame || this.run.frames === 0) return;
    const snapshot = Math.floor(frame / this.every);
    const isNear = frame > this.frame && snapshot * this.every <= this.frame;
    if (!isNear) {
      this.shades.set(this.snapshots[snapshot]);
      this.frame = snapshot * this.every;
    }
    const { places, starts } = this.run.cells;
    const { width, height } = this.run.belief;
    let top = height;
    let bottom = -1;
    const first = starts[this.frame + 1];
    const last = starts[frame + 1];
    while (this.frame < frame) this.#apply(++this.frame);
    if (!isNear) {
      this.#paintAll();
      return;
    }
    for (let i = first; i < last; ++i) {
      const place = places[i];
      const row = (place / width) | 0;
      if (row < top) top = row;
      if (row > bottom) bottom = row;
      this.pixels[place] = this.table[this.shades[place]];
    }
    if (bottom >= top) this.context.putImageData(this.image, 0, 0, 0, top, width, bottom - top + 1);
  }

  #apply(frame) {
    const { places, shades, starts } = this.run.cells;
    for (let i = starts[frame]; i < starts[frame + 1]; ++i) this.shades[places[i]] = shades[i];
  }

  #paintAll() {
    for (let i = 0; i < this.shades.length; ++i) this.pixels[i] = this.table[this.shades[i]];
    this.context.putImageData(this.image, 0, 0);
  }
}
