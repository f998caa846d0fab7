// The time that is shown: it is played, scrubbed, and stepped through by keys.

const speeds = [1, 2, 5, 10, 20, 50, 100, 200];

class Player {
  // `onShow(time)` draws it.
  constructor(runs, onShow, onFollow) {
    this.runs = runs;
    this.onShow = onShow;
    this.onFollow = onFollow;
    this.duration = Math.max(...runs.map((run) => run.duration));
    this.slider = document.getElementById('timeline');
    this.slider.max = String(this.duration);
    this.playButton = document.getElementById('play');
    this.clock = document.getElementById('clock');
    this.speedSelect = document.getElementById('speed');
    this.speedSelect.append(...speeds.map((speed) => new Option(`${speed} ×`, String(speed))));
    // A whole run in about a minute.
    this.setSpeed(speeds.find((speed) => speed * 60 >= this.duration) ?? speeds.at(-1));
    this.isPlaying = false;
    this.stillness = window.matchMedia('(prefers-reduced-motion: reduce)');
    this.#listen();
    this.seek(this.duration);
  }

  seek(time) {
    this.time = Math.min(this.duration, Math.max(0, time));
    this.slider.value = String(this.time);
    this.slider.setAttribute('aria-valuetext', `${clock(this.time)} of ${clock(this.duration)}`);
    this.clock.textContent = `${clock(this.time)} / ${clock(this.duration)}`;
    this.onShow(this.time);
  }

  play() {
    if (this.time >= this.duration) this.seek(0);
    this.isPlaying = true;
    let last = performance.now();
    const advance = (now) => {
      if (!this.isPlaying) return;
      // Who wants little motion gets a picture every half second.
      if (!this.stillness.matches || now - last >= 500) {
        this.seek(this.time + ((now - last) / 1000) * this.speed);
        last = now;
      }
      if (this.time >= this.duration) this.pause();
      else requestAnimationFrame(advance);
    };
    requestAnimationFrame((now) => {
      last = now;
      advance(now);
    });
    this.#showPlaying();
  }

  pause() {
    this.isPlaying = false;
    this.#showPlaying();
  }

  toggle() {
    if (this.isPlaying) this.pause();
    else this.play();
  }

  // To the nearest time, later or earlier, at which a run has another frame.
  step(direction) {
    this.pause();
    const times = this.runs.filter((run) => run.frames > 0).map((run) => {
      const at = lastAt(run.times, this.time + 1e-9) + (direction > 0 ? 1 : 0);
      if (direction > 0) return run.times[at] ?? this.duration;
      return run.times[at] < this.time - 1e-9 ? run.times[at] : run.times[at - 1] ?? 0;
    });
    this.seek(direction > 0 ? Math.min(...times) : Math.max(...times));
  }

  setSpeed(speed) {
    this.speed = speed;
    this.speedSelect.value = String(speed);
  }

  changeSpeed(by) {
    this.setSpeed(speeds[Math.min(speeds.length - 1, Math.max(0, speeds.indexOf(this.speed) + by))]);
  }

  #showPlaying() {
    this.playButton.setAttribute('aria-label', this.isPlaying ? 'Pause' : 'Play');
    this.playButton.dataset.playing = String(this.isPlaying);
  }

  #listen() {
    this.playButton.addEventListener('click', () => this.toggle());
    this.slider.addEventListener('input', () => this.seek(Number(this.slider.value)));
    this.speedSelect.addEventListener('change', () => this.setSpeed(Number(this.speedSelect.value)));
    for (const [name, direction] of [['back', -1], ['forward', 1]]) {
      document.getElementById(name).addEventListener('click', () => this.step(direction));
    }
    const keys = {
      ' ': () => this.toggle(),
      ArrowLeft: (event) => (event.shiftKey ? this.seek(this.time - 10) : this.step(-1)),
      ArrowRight: (event) => (event.shiftKey ? this.seek(this.time + 10) : this.step(1)),
      ArrowUp: () => this.seek(this.time + 10),
      ArrowDown: () => this.seek(this.time - 10),
      Home: () => this.seek(0),
      End: () => this.seek(this.duration),
      '+': () => this.changeSpeed(1),
      '=': () => this.changeSpeed(1),
      '-': () => this.changeSpeed(-1),
      f: () => this.onFollow(),
      '?': () => toggleHelp(),
    };
    const onTimeline = new Set(['ArrowUp', 'ArrowDown']);
    document.addEventListener('keydown', (event) => {
      const action = keys[event.key];
      if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
      const target = event.target;
      // Buttons and boxes keep the keys that are theirs; up and down scroll the page unless the timeline has the focus.
      if (target.matches('select, a, summary, input:not([type=range]), button, [tabindex]') && [' ', 'Enter'].includes(event.key)) return;
      if (target.matches('select') || document.getElementById('help').open && event.key !== '?') return;
      if (target !== this.slider && onTimeline.has(event.key)) return;
      event.preventDefault();
      action(event);
    });
  }
}

function toggleHelp() {
  const help = document.getElementById('help');
  if (help.open) help.close();
  else help.showModal();
}
