// One run: its map, what is the case at the time shown, and what was decided between.

class Pane {
  constructor(run, label, distinction, parent, options) {
    this.run = run;
    this.element = fragmentOf('pane-template');
    parent.append(this.element);
    this.part('.pane-title').textContent = label ? `${label}: ${run.name}` : run.name;
    this.part('.pane-distinction').textContent = distinction;
    this.#say();
    const canvas = this.part('canvas');
    canvas.setAttribute('aria-label', `Map of ${run.name} at the time shown: the belief with the robot, its scan and its candidates`);
    this.map = new MapView(run, canvas, options.hiddenLayers, (map) => {
      this.#showFollow();
      options.onMove(map);
    });
    const buttons = { zoomIn: () => this.map.zoom(1.5), zoomOut: () => this.map.zoom(1 / 1.5), fit: () => this.map.fit(), follow: options.onFollow };
    for (const [name, action] of Object.entries(buttons)) this.part(`[data-action=${name}]`).addEventListener('click', action);
  }

  part(selector) {
    return this.element.querySelector(selector);
  }

  follow(follows) {
    this.map.follow(follows);
    this.#showFollow();
  }

  show(time) {
    const { run } = this;
    if (run.frames === 0) return;
    const frame = frameAt(run, time);
    const decision = decisionAt(run, frame);
    this.frame = frame;
    this.map.show(frame, decision);
    this.#showNow(frame, time);
    if (decision?.index !== this.decision?.index || decision === null) this.#showDecision(decision);
    this.decision = decision;
  }

  #showFollow() {
    this.part('[data-action=follow]').setAttribute('aria-pressed', String(this.map.follows));
  }

  // Why it ended, and what is missing.
  #say() {
    const { run } = this;
    const [title, words] = run.is_whole
      ? stopReasons[run.stop_reason] ?? [run.stop_reason || 'Ended', 'The run gave no reason that this page knows.']
      : ['Cut short', `The recording has no end: the program was stopped or killed while it ran. What it had recorded up to then is shown, and there are no final metrics.${run.torn_bytes > 0 ? ` The last ${run.torn_bytes} bytes are of a record that is not whole, and are left out.` : ''}`];
    this.part('.stop-title').textContent = title;
    this.part('.stop-name').textContent = run.is_whole ? run.stop_reason : 'no end';
    this.part('.stop-words').textContent = words;
    this.part('.stop').classList.toggle('is-torn', !run.is_whole);
    if (run.frames === 0) this.part('.stop-words').textContent += ' It has no frame, so that there is nothing to show.';
  }

  #showNow(frame, time) {
    const { run } = this;
    const { pose, truth, covariance, flags, error_m } = run.columns;
    const [x, y, yaw] = pose.subarray(3 * frame, 3 * frame + 3);
    const [xx, , yy, turn] = covariance.subarray(4 * frame, 4 * frame + 4);
    const sigma = (variance) => 3 * Math.sqrt(Math.max(0, variance));
    const degrees = (radians) => (radians * 180) / Math.PI;
    const plusMinus = (value, spread, digits, unit) => `${number(value, digits)} ± ${number(spread, digits)} ${unit}`;
    const rows = [
      ['time', `${clock(run.times[frame])} (${number(run.times[frame], 1)} s)${time > run.duration + 1e-6 ? ', over' : ''}`],
      ['x', plusMinus(x, sigma(xx), 3, 'm')],
      ['y', plusMinus(y, sigma(yy), 3, 'm')],
      ['heading', plusMinus(degrees(yaw), degrees(sigma(turn)), 2, '°')],
    ];
    if (run.hasTruth && !Number.isNaN(truth[3 * frame])) rows.push(['position error', `${number(error_m[frame], 3)} m`]);
    for (const name of run.metric_names) {
      const value = run.series[name][frame];
      const isShown = /explored|entropy|information|error|sigma|nees/.test(name);
      if (!isShown) rows.push([plainName(name), `${shortNumber(Number(value.toPrecision(5)))} ${unitOf(name)}`]);
    }
    const state = [flags[frame] & 2 ? 'lost' : '', flags[frame] & 1 ? 'scan not trusted, not written' : '', flags[frame] & 4 ? 'map drawn anew' : ''].filter(Boolean);
    rows.push(['scan', state.length > 0 ? `⚠ ${state.join(', ')}` : 'written into the map']);
    const list = this.part('.now');
    if (list.children.length !== rows.length) list.replaceChildren(...rows.map(() => fragmentOf('now-template')));
    rows.forEach(([name, text], i) => {
      const [term, value] = list.children[i].children;
      term.textContent = name;
      value.textContent = text;
    });
  }

  #showDecision(decision) {
    const body = this.part('.candidates tbody');
    body.replaceChildren();
    this.part('.candidates').hidden = !decision || decision.candidates.length === 0;
    if (!decision) {
      this.part('.decision-time').textContent = 'Nothing decided yet';
      this.part('.decision-reason').textContent = 'The robot looks around first.';
      this.part('.decision-gain').textContent = '';
      return;
    }
    this.part('.decision-time').textContent = `Decision ${decision.index + 1} of ${this.run.columns.decision_s.length}, at ${clock(decision.time)}`;
    const words = decisionReasons[decision.reason] ?? decision.reason;
    const stop = decision.stop ? ` The explorer stopped: ${(stopReasons[decision.stop]?.[0] ?? decision.stop).toLowerCase()}.` : '';
    this.part('.decision-reason').textContent = words + stop;
    this.part('.decision-gain').textContent = decision.candidates.length > 0
      ? `BIG of the chosen one: ${number(decision.candidates[0].gain, 1)} nats, of ${decision.candidates.length} candidate${decision.candidates.length > 1 ? 's' : ''}`
      : 'There was no candidate.';
    const [low, high] = gainBounds(decision);
    this.part('.scale-low').textContent = number(low, 0);
    this.part('.scale-high').textContent = `${number(high, 1)} nats`;
    decision.candidates.slice(0, 6).forEach(({ gain, cost, utility }, i) => {
      const row = makeRow([i === 0 ? '★ 1' : `● ${i + 1}`, number(gain, 1), shortNumber(cost), shortNumber(utility)], false);
      row.firstChild.style.setProperty('--mark', viridisColor((gain - low) / (high - low)));
      if (i === 0) row.classList.add('is-chosen');
      body.append(row);
    });
  }
}
