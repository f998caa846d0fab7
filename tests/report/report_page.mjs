// The report page in a browser: node report_page.mjs CHROMIUM FOLDER, where FOLDER has single.html, compare.html, torn.html. Screenshots go to
// FOLDER/report_screenshots.
import assert from 'node:assert/strict';
import { mkdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [executablePath, folder] = process.argv.slice(2);
const { chromium } = createRequire(join(folder, 'package.json'))('playwright-core');
const screenshots = join(folder, 'report_screenshots');
mkdirSync(screenshots, { recursive: true });

const browser = await chromium.launch({
  executablePath,
  args: ['--headless', '--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'],
});

// Opens a page that must not complain, nor ask for anything but itself; `check` gets it when it is ready.
async function withPage(name, options, check) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
  const page = await context.newPage();
  const problems = [];
  // That the test reads pixels back is its own affair.
  const isOurs = (message) => ['error', 'warning'].includes(message.type()) && !/readback/.test(message.text());
  page.on('console', (message) => isOurs(message) && problems.push(message.text()));
  page.on('pageerror', (error) => problems.push(error.stack));
  page.on('request', (request) => /^(file|data|blob):/.test(request.url()) || problems.push(`asks for ${request.url()}`));
  await page.goto(pathToFileURL(join(folder, `${name}.html`)).href);
  await page.waitForSelector('body[data-ready=true]', { timeout: 60000 });
  await check(page);
  assert.deepEqual(problems, [], `${name}.html complains`);
  await context.close();
}

const shoot = (page, name) => page.screenshot({ path: join(screenshots, `${name}.png`) });
const time = (page) => page.evaluate(() => incognitaReport.player.time);
const seek = (page, part) => page.evaluate((at) => incognitaReport.player.seek(at * incognitaReport.player.duration), part);

// What a map shows, as a number that differs when a pixel does.
const picture = (page, pane = 0) => page.evaluate((index) => {
  const { map } = incognitaReport.panes[index];
  map.drawNow();
  const { data } = map.context.getImageData(0, 0, map.canvas.width, map.canvas.height);
  let hash = 0;
  for (const byte of data) hash = (Math.imul(hash, 31) + byte) | 0;
  return hash;
}, pane);

// The page forbids what page.waitForFunction needs.
async function until(page, condition, argument) {
  const end = Date.now() + 30000;
  while (!await page.evaluate(condition, argument)) {
    assert.ok(Date.now() < end, `waited in vain for ${condition}`);
    await page.waitForTimeout(50);
  }
}

const near = (value, expected, tolerance, what) => assert.ok(Math.abs(value - expected) <= tolerance, `${what}: ${value} is not ${expected} ± ${tolerance}`);

const tests = {
  async 'loads, and starts at the end of the run'() {
    await withPage('single', {}, async (page) => {
      const { at, duration, frames } = await page.evaluate(() => ({
        at: incognitaReport.player.time, duration: incognitaReport.player.duration, frames: incognitaReport.runs[0].frames }));
      assert.ok(frames > 20, `only ${frames} frames`);
      assert.equal(at, duration);
      assert.match(await page.textContent('.stop-title'), /The time was up/);
      assert.match(await page.textContent('#metrics'), /translation rmse/);
      assert.match(await page.textContent('#parameters'), /mission\.alpha/);
      await seek(page, 0.6);
      await shoot(page, 'desktop_light');
    });
  },

  async 'plots have a point for each frame'() {
    await withPage('single', {}, async (page) => {
      const counts = await page.evaluate(() => incognitaReport.plots.map((plot) => plot.chart.data.datasets.map((set) => set.data.length)));
      const frames = await page.evaluate(() => incognitaReport.runs[0].frames);
      assert.deepEqual(counts, [[frames], [frames], [frames, frames], [frames]]);
      // And they are drawn: a plot has more colours than its grid.
      for (const plot of await page.$$('.plot canvas')) {
        const isDrawn = await plot.evaluate((canvas) => {
          const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
          const colors = new Set();
          for (let i = 0; i < data.length; i += 4) if (data[i + 3] > 0) colors.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
          return colors.size > 3;
        });
        assert.ok(isDrawn, 'an empty plot');
      }
    });
  },

  async 'the scrubber moves the robot'() {
    await withPage('single', {}, async (page) => {
      const slider = page.locator('#timeline');
      const box = await slider.boundingBox();
      await page.mouse.click(box.x + 0.25 * box.width, box.y + box.height / 2);
      const first = { picture: await picture(page), x: await page.textContent('.now > div:nth-child(2) dd'), time: await time(page) };
      await page.mouse.click(box.x + 0.9 * box.width, box.y + box.height / 2);
      const second = { picture: await picture(page), x: await page.textContent('.now > div:nth-child(2) dd'), time: await time(page) };
      assert.ok(second.time > first.time + 5);
      assert.notEqual(first.picture, second.picture);
      assert.notEqual(first.x, second.x);
      const { shown, pose } = await page.evaluate(() => {
        const { frame, run } = incognitaReport.panes[0];
        return { shown: run.times[frame], pose: run.columns.pose[3 * frame] };
      });
      near(shown, second.time, 0.6, 'the time of the frame');
      near(parseFloat(second.x.replaceAll(',', '')), pose, 0.001, 'the x that is shown');
    });
  },

  async 'any frame shows the belief that replaying from the start gives'() {
    await withPage('single', {}, async (page) => {
      const wrong = await page.evaluate(() => {
        const { belief, run } = incognitaReport.panes[0].map;
        const { places, shades, starts } = run.cells;
        const differs = [];
        for (const frame of [run.frames - 1, 0, 40, 3, run.frames - 2, 17, 18, 90, 89, 33, 31, 32]) {
          const expected = new Uint8Array(belief.shades.length).fill(4);
          for (let i = 0; i < starts[frame + 1]; ++i) expected[places[i]] = shades[i];
          belief.seek(frame);
          const { data } = belief.context.getImageData(0, 0, belief.canvas.width, belief.canvas.height);
          const pixels = new Uint32Array(data.buffer);
          if (expected.some((shade, i) => belief.shades[i] !== shade || pixels[i] !== belief.table[shade])) differs.push(frame);
        }
        return differs;
      });
      assert.deepEqual(wrong, []);
    });
  },

  async 'walls lie where the belief has them'() {
    await withPage('single', {}, async (page) => {
      const { near, all } = await page.evaluate(() => {
        const { run, belief, floor } = incognitaReport.panes[0].map;
        const { wall_starts: starts, wall_m: points } = run.columns;
        belief.seek(run.frames - 1);
        let all = 0;
        let near = 0;
        belief.shades.forEach((shade, i) => {
          if (shade < 6) return;
          const { x, y, width } = run.belief;
          const [cx, cy] = [(x + (i % width) + 0.5) * run.resolution_m, (y + Math.floor(i / width) + 0.5) * run.resolution_m];
          const [px, py] = [floor[0] + floor[2] * cx - floor[3] * cy, floor[1] + floor[3] * cx + floor[2] * cy];
          let best = Infinity;
          for (let line = 0; line + 1 < starts.length; ++line) {
            for (let k = starts[line]; k + 1 < starts[line + 1]; ++k) {
              const [ax, ay, bx, by] = points.subarray(2 * k, 2 * k + 4);
              const length2 = (bx - ax) ** 2 + (by - ay) ** 2;
              const part = length2 > 0 ? Math.min(1, Math.max(0, ((px - ax) * (bx - ax) + (py - ay) * (by - ay)) / length2)) : 0;
              best = Math.min(best, Math.hypot(px - ax - part * (bx - ax), py - ay - part * (by - ay)));
            }
          }
          ++all;
          if (best < 0.25) ++near;
        });
        return { near, all };
      });
      assert.ok(all > 200, `only ${all} occupied cells`);
      assert.ok(near > 0.97 * all, `${near} of ${all} occupied cells are near a wall`);
    });
  },

  async 'play advances, and pauses'() {
    await withPage('single', {}, async (page) => {
      await page.click('#play');
      assert.equal(await page.getAttribute('#play', 'aria-label'), 'Pause');
      const start = await time(page);
      await until(page, (from) => incognitaReport.player.time > from + 1, start);
      await page.click('#play');
      const stopped = await time(page);
      await page.waitForTimeout(300);
      assert.equal(await time(page), stopped);
      assert.equal(await page.getAttribute('#play', 'aria-label'), 'Play');
    });
  },

  async 'keys'() {
    await withPage('single', {}, async (page) => {
      const times = await page.evaluate(() => [...incognitaReport.runs[0].times]);
      const press = async (key) => {
        await page.keyboard.press(key);
        return time(page);
      };
      assert.equal(await press('Home'), 0);
      const afterFirst = times.findIndex((at) => at > 0);
      near(await press('ArrowRight'), times[afterFirst], 1e-6, 'one frame on');
      near(await press('ArrowRight'), times[afterFirst + 1], 1e-6, 'two frames on');
      near(await press('ArrowLeft'), times[afterFirst], 1e-6, 'one frame back');
      near(await press('Shift+ArrowRight'), times[afterFirst] + 10, 1e-6, '10 s on');
      near(await press('Shift+ArrowLeft'), times[afterFirst], 1e-6, '10 s back');
      near(await press('End'), times.at(-1), 1e-6, 'the end');
      const speed = () => page.evaluate(() => incognitaReport.player.speed);
      const before = await speed();
      await press('+');
      assert.ok(await speed() > before);
      await press('-');
      assert.equal(await speed(), before);
      const follow = () => page.getAttribute('[data-action=follow]', 'aria-pressed');
      await press('f');
      assert.equal(await follow(), 'true');
      const center = await page.evaluate(() => {
        const { map } = incognitaReport.panes[0];
        map.drawNow();
        const { pose } = map.run.columns;
        const [x, y, cos, sin] = map.floor;
        const [rx, ry] = pose.subarray(3 * map.frame, 3 * map.frame + 2);
        const robot = [x + cos * rx - sin * ry, y + sin * rx + cos * ry];
        return Math.hypot(map.view.center[0] - robot[0], map.view.center[1] - robot[1]);
      });
      near(center, 0, 1e-6, 'the robot in the middle');
      await shoot(page, 'follow');
      await press('f');
      assert.equal(await follow(), 'false');
      await press('?');
      assert.ok(await page.isVisible('#help'));
      await press('Escape');
      assert.ok(!await page.isVisible('#help'));
      await press('Home');
      await press(' ');
      await until(page, () => incognitaReport.player.time > 0.5);
      await press(' ');
      // Where the timeline has the focus, too.
      await page.focus('#timeline');
      assert.equal(await press('Home'), 0);
      near(await press('ArrowRight'), times[afterFirst], 1e-6, 'one frame on, from the timeline');
    });
  },

  async 'a click in a plot moves the timeline'() {
    await withPage('single', {}, async (page) => {
      const { area, duration } = await page.evaluate(() => ({ area: incognitaReport.plots[0].chart.chartArea, duration: incognitaReport.player.duration }));
      const box = await page.locator('[data-plot=explored] canvas').boundingBox();
      await page.mouse.click(box.x + area.left + 0.4 * (area.right - area.left), box.y + (area.top + area.bottom) / 2);
      near(await time(page), 0.4 * duration, 0.01 * duration, 'the time');
      const cursor = await page.locator('[data-plot=nees] .plot-cursor').boundingBox();
      near(cursor.x + 1, box.x + area.left + 0.4 * (area.right - area.left), 2, 'the line of another plot');
    });
  },

  async 'layers can be hidden, the map moved and fitted'() {
    await withPage('single', {}, async (page) => {
      await seek(page, 0.5);
      for (const layer of await page.$$('#layers input')) {
        const before = await picture(page);
        await layer.uncheck();
        const name = await layer.getAttribute('value');
        // The ellipse has no size before the pose is uncertain; half way through it has.
        assert.notEqual(await picture(page), before, `${name} is not seen`);
        await layer.check();
        assert.equal(await picture(page), before, `${name} does not come back`);
      }
      const fitted = await picture(page);
      await page.locator('canvas.map').hover();
      await page.mouse.wheel(0, -400);
      assert.notEqual(await picture(page), fitted);
      await page.click('[data-action=fit]');
      assert.equal(await picture(page), fitted);
      await page.click('[data-action=zoomIn]');
      await page.click('[data-action=zoomIn]');
      await shoot(page, 'zoomed');
      const box = await page.locator('canvas.map').boundingBox();
      const zoomed = await picture(page);
      await page.mouse.move(box.x + 200, box.y + 200);
      await page.mouse.down();
      await page.mouse.move(box.x + 260, box.y + 230);
      await page.mouse.up();
      assert.notEqual(await picture(page), zoomed);
    });
  },

  async 'side by side, of other lengths and floors'() {
    await withPage('compare', {}, async (page) => {
      const { frames, sets } = await page.evaluate(() => ({
        frames: incognitaReport.runs.map((run) => run.frames),
        sets: incognitaReport.plots.map((plot) => plot.chart.data.datasets.map(({ role, run, data, borderDash }) => ({ role, run, length: data.length, dash: borderDash.join() }))),
      }));
      assert.notEqual(frames[0], frames[1]);
      for (const plot of sets) {
        for (const set of plot) assert.equal(set.length, frames[set.run]);
        const [a, b] = plot.filter((set) => set.role === 'values');
        assert.notEqual(a.dash, b.dash);
      }
      const shortest = await page.evaluate(() => Math.min(...incognitaReport.runs.map((run) => run.duration)));
      const seekTo = (at) => page.evaluate((seconds) => incognitaReport.player.seek(seconds), at);
      await seekTo(0.3 * shortest);
      const before = [await picture(page, 0), await picture(page, 1)];
      await seekTo(0.9 * shortest);
      assert.notEqual(await picture(page, 0), before[0]);
      assert.notEqual(await picture(page, 1), before[1]);
      await seek(page, 1);
      const shorter = frames[0] < frames[1] ? 0 : 1;
      const shown = await page.locator('.now').nth(shorter).textContent();
      assert.match(shown, /over/);
      assert.match(await page.locator('.differs').allTextContents().then((texts) => texts.join()), /mission\.alpha/);
      assert.match(await page.locator('.pane-distinction').first().textContent(), /alpha/);
      const boxes = await Promise.all([0, 1].map((i) => page.locator('.pane').nth(i).boundingBox()));
      assert.ok(boxes[1].x >= boxes[0].x + boxes[0].width && Math.abs(boxes[0].y - boxes[1].y) < 1, 'the maps are not side by side');
      await seek(page, 0.4);
      await shoot(page, 'compare');
    });
  },

  async 'a recording that was cut short says so'() {
    await withPage('torn', {}, async (page) => {
      assert.match(await page.textContent('.stop-title'), /Cut short/);
      assert.match(await page.textContent('.stop-words'), /The last \d+ bytes/);
      assert.ok(await page.isVisible('#no-metrics'));
      assert.ok(await page.evaluate(() => incognitaReport.runs[0].frames) > 5);
      await shoot(page, 'torn');
    });
  },

  async 'a phone, without scrolling sideways'() {
    for (const name of ['single', 'compare']) {
      await withPage(name, { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true }, async (page) => {
        await page.locator('.how summary').click();
        const { width, outside } = await page.evaluate(() => ({
          width: document.documentElement.scrollWidth,
          outside: [...document.querySelectorAll('body *')].filter((element) => {
            const box = element.getBoundingClientRect();
            return box.width > 0 && box.right > 390.5 && !element.closest('.table-box, .speed-word');
          }).map((element) => `${element.tagName}.${element.className}`),
        }));
        assert.ok(width <= 390, `the page is ${width} wide`);
        assert.deepEqual(outside, []);
        await page.locator('.how summary').click();
        await seek(page, 0.6);
        await shoot(page, `phone_${name}`);
        await page.locator('#plots').scrollIntoViewIfNeeded();
        await shoot(page, `phone_${name}_plots`);
        const before = await time(page);
        await page.tap('#play');
        await until(page, (from) => incognitaReport.player.time !== from, before);
      });
    }
  },

  async 'dark and light, with enough contrast in both'() {
    await withPage('single', { colorScheme: 'dark' }, async (page) => {
      const contrasts = () => page.evaluate(() => {
        const style = getComputedStyle(document.documentElement);
        const luminance = (name) => {
          const hex = style.getPropertyValue(`--${name}`).trim();
          const [r, g, b] = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255).map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
          return 0.2126 * r + 0.7152 * g + 0.0722 * b;
        };
        const contrast = (a, b) => (Math.max(luminance(a), luminance(b)) + 0.05) / (Math.min(luminance(a), luminance(b)) + 0.05);
        const texts = [['text', 'card'], ['muted', 'card'], ['text', 'page'], ['muted', 'page'], ['accent', 'page'], ['accent-text', 'accent'], ['warn', 'card']];
        const marks = [['estimate', 'free-4'], ['wall', 'free-4'], ['ellipse', 'free-4'], ['series-a', 'card'], ['series-b', 'card'], ['occupied-4', 'unknown']];
        return {
          isDark: luminance('page') < 0.1,
          low: [...texts.map((pair) => [pair, contrast(...pair), 4.5]), ...marks.map((pair) => [pair, contrast(...pair), 3])].filter(([, value, least]) => value < least),
          // Told apart in grey.
          greys: [contrast('free-4', 'unknown'), contrast('unknown', 'occupied-4')],
        };
      });
      for (const isDark of [true, false]) {
        const { isDark: is, low, greys } = await contrasts();
        assert.equal(is, isDark);
        assert.deepEqual(low, []);
        assert.ok(greys.every((value) => value > 1.5), `unknown is hardly told apart: ${greys}`);
        assert.equal(await page.getAttribute('#theme', 'aria-pressed'), String(isDark));
        await seek(page, 0.6);
        if (isDark) await shoot(page, 'desktop_dark');
        await page.click('#theme');
      }
    });
  },

  async 'controls have names, and can be reached by keyboard'() {
    await withPage('single', {}, async (page) => {
      const nameless = await page.evaluate(() => [...document.querySelectorAll('button, select, input, canvas[role], [role=region]')]
        .filter((element) => !element.ariaLabel && !element.labels?.length && !element.textContent.trim() && !element.getAttribute('aria-labelledby'))
        .map((element) => element.outerHTML));
      assert.deepEqual(nameless, []);
      const reached = new Set();
      for (let i = 0; i < 40; ++i) {
        await page.keyboard.press('Tab');
        reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.dataset.action || document.activeElement.value || ''));
      }
      for (const id of ['theme', 'zoomIn', 'fit', 'follow', 'walls', 'candidates', 'back', 'play', 'forward', 'timeline', 'speed']) {
        assert.ok(reached.has(id), `${id} is not reached`);
      }
    });
  },

  async 'who wants little motion gets a picture every half second'() {
    await withPage('single', { reducedMotion: 'reduce' }, async (page) => {
      await page.evaluate(() => {
        window.shown = [];
        const { player } = incognitaReport;
        const seek = player.seek.bind(player);
        player.seek = (at) => {
          shown.push(performance.now());
          seek(at);
        };
      });
      await page.click('#play');
      await until(page, () => shown.length >= 4);
      const steps = await page.evaluate(() => shown.slice(1).map((at, i) => at - shown[i]));
      assert.ok(steps.every((step) => step > 450), `pictures after ${steps.map(Math.round)} ms`);
    });
  },
};

let failed = 0;
for (const [name, test] of Object.entries(tests)) {
  try {
    await test();
    console.log(`ok      ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAILED  ${name}\n${error.stack}`);
  }
}
await browser.close();
console.log(`${Object.keys(tests).length - failed} passed, ${failed} failed; screenshots are in ${screenshots}`);
process.exit(failed > 0 ? 1 : 0);
