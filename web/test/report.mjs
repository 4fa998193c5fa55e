// Opens reports in headless Chromium as a reader would: node report.mjs RUN_FOLDER HOSTILE_REPORT HOT_RUN_FOLDER STUDY_FOLDER. Prints what does not hold.
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import axe from 'axe-core';
import {chromium} from 'playwright-core';

const [folder, hostile, hot, studied] = process.argv.slice(2).map(path => resolve(path));
const browserPath = process.env.STRANDLAB_CHROMIUM ?? '/usr/bin/chromium';
const profile = mkdtempSync(join(tmpdir(), 'strandlab_chromium_'));

let failures = 0;
function check(holds, message) {
  if (holds) return;
  ++failures;
  console.log('FAILED:', message);
}

// A table of numbers and plain words.
function csv(name, from = folder) {
  const [head, ...rows] = readFileSync(join(from, name), 'utf8').trim().split('\n').map(line => line.split(','));
  return rows.map(row => Object.fromEntries(head.map((column, i) => [column, row[i]])));
}

const near = (a, b) => Math.abs(a - b) <= 1e-12 * Math.max(1, Math.abs(a), Math.abs(b));
function same(what, shown, expected) {
  check(shown.length === expected.length, `${what}: ${shown.length} points, the table has ${expected.length}`);
  const i = expected.findIndex((value, k) => !near(value[0], shown[k]?.[0]) || !near(value[1], shown[k]?.[1]));
  check(i < 0, `${what}: point ${i} is ${shown[i]}, the table says ${expected[i]}`);
}

const context = await chromium.launchPersistentContext(profile, {
  executablePath: browserPath, headless: true, acceptDownloads: true, viewport: {width: 1280, height: 900},
  args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
         '--disable-component-update', '--disable-sync'],
});

async function open(file, options = {}) {
  const page = await context.newPage();
  if (options.width) await page.setViewportSize({width: options.width, height: 800});
  await page.emulateMedia({colorScheme: options.scheme ?? 'light', reducedMotion: 'reduce'});
  page.on('console', message => check(false, `${file}: the console says ${message.type()}: ${message.text()}`));
  page.on('pageerror', error => check(false, `${file}: ${error}`));
  page.on('dialog', dialog => {
    check(false, `${file}: a dialog: ${dialog.message()}`);
    dialog.dismiss();
  });
  page.on('request', request => check(request.url() === `file://${file}` || /^(data|blob):/.test(request.url()),
    `${file}: a request for ${request.url().slice(0, 100)}`));
  await page.goto(`file://${file}`);
  await page.waitForFunction(drawn => document.querySelector(drawn), options.drawn ?? 'canvas.section[data-frame]');
  await settled(page);
  return page;
}

// Two frames of the browser: what was asked for is drawn.
const settled = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
// Names, points and rendered paths of a chart.
const chart = (page, id) => page.evaluate(name => {
  const host = document.querySelector(`[data-chart="${name}"]`);
  const shown = window.strandlab.charts.get(name);
  return host && shown && {
    series: shown.chart.getOption().series.map(s => ({name: s.name, data: s.data})),
    start: [shown.chart.getOption().xAxis[0].min, shown.chart.getOption().yAxis[0].min],
    paths: host.querySelectorAll('svg path').length,
    label: host.querySelector('[aria-label]')?.getAttribute('aria-label') ?? '',
  };
}, id);
// A number that stands for the picture.
const picture = async page => {
  await settled(page);
  return page.evaluate(() => {
    const canvas = document.querySelector('canvas.section');
    const url = canvas.toDataURL();
    let hash = url.length;
    for (let i = 0; i < url.length; ++i) hash = (31 * hash + url.charCodeAt(i)) | 0;
    return hash;
  });
};

async function downloaded(page, button) {
  const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
  return readFileSync(await download.path());
}

// WCAG contrast of the text that is seen, and the lowest of all.
const leastContrast = page => page.evaluate(() => {
  const parse = text => (text.match(/[\d.]+/g) ?? [0, 0, 0, 0]).map(Number);
  const luminance = ([r, g, b]) => [r, g, b].map(v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const background = element => {
    for (let e = element; e; e = e.parentElement) {
      const colour = parse(getComputedStyle(e).backgroundColor);
      if (colour.length < 4 || colour[3] > 0.99) return colour;
    }
    return [255, 255, 255];
  };
  let worst = {ratio: 99};
  for (const element of document.querySelectorAll('main *, footer')) {
    const words = [...element.childNodes].filter(n => n.nodeType === 3 && n.data.trim() !== '').map(n => n.data.trim()).join(' ');
    const box = element.getBoundingClientRect();
    if (!words || box.width < 2 || element.closest('.sr, .bubble[hidden], .layup')) continue;
    const style = getComputedStyle(element);
    const ink = parse(element instanceof SVGElement ? style.fill : style.color);
    const [a, b] = [luminance(ink), luminance(background(element))].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < worst.ratio) worst = {ratio, words: words.slice(0, 40)};
  }
  return worst;
});

// ---- charts against the tables

const report = join(folder, 'report.html');
const run = JSON.parse(readFileSync(join(folder, 'mat.json'), 'utf8'));
const page = await open(report);

async function chartsShowTheTables() {
  const press = csv('press.csv');
  const stress = await chart(page, 'stress');
  const column = name => press.map(row => [100 * row.compaction, Number(row[name])]);
  same('top platen', stress.series[0].data, column('force_top_N').map(([c, f]) => [c, f / run.length_mm]));
  same('bottom platen', stress.series[1].data, column('force_bottom_N').map(([c, f]) => [c, f / run.length_mm]));
  same('mean stress', stress.series[2].data, column('stress_MPa'));
  const board = await page.textContent('.board');
  check(board.includes(`${Number(run.length_mm.toFixed(3))} mm long`), `the page says how long the mat is: ${board}`);
  check(/stress/i.test(stress.label), `the stress chart says what it is: ${stress.label}`);
  const energies = await chart(page, 'energies');
  ['platen_work', 'plastic', 'elastic', 'friction', 'contact', 'filter', 'kinetic'].forEach((name, i) =>
    same(name, energies.series[i].data, column(`${name}_mJ`)));

  const moduli = csv('moduli.csv'), theory = csv('theory.csv');
  const density = new Map(moduli.map(row => [row.compaction, Number(row.density_kg_m3)]));
  for (const test of new Set(moduli.map(row => row.test))) {
    const id = `modulus-${test}`;
    const rows = moduli.filter(row => row.test === test);
    const compactions = [...new Set(rows.map(row => row.compaction))];
    const compliances = [...new Set(rows.map(row => row.compliance_t_mm_per_MPa))];
    const ofTest = theory.filter(row => row.test === test);
    const models = [...new Set(ofTest.map(row => row.model))];
    const glue = await chart(page, id);
    compactions.forEach((c, i) => same(`${test} at ${c}`, glue.series[i].data,
      rows.filter(row => row.compaction === c).map(row => [Number(row.compliance_t_mm_per_MPa), Number(row.modulus_MPa)])));
    const last = compactions[compactions.length - 1];
    models.forEach((model, i) => same(`${model} at ${last}`, glue.series[compactions.length + i]?.data ?? [],
      ofTest.filter(row => row.model === model && row.compaction === last).map(row => [Number(row.compliance_t_mm_per_MPa), Number(row.modulus_MPa)])));
    check(glue.series.length === compactions.length + models.length && glue.series.every(s => s.name), `${test}: models of the last state only, all with names`);
    for (const [axis, x] of [['density', c => density.get(c)], ['compaction', c => 100 * c]]) {
      await page.locator(`#chart-${id}`).getByLabel(axis, {exact: true}).check({force: true});
      const over = await chart(page, id);
      compliances.forEach((d, i) => same(`${test} of ${d} over ${axis}`, over.series[i].data,
        rows.filter(row => row.compliance_t_mm_per_MPa === d).map(row => [x(row.compaction), Number(row.modulus_MPa)])));
      check(over.paths > 10 && over.start.every(v => v === 0), `${test} over ${axis} is drawn from zero: ${over.start}`);
      const model = ofTest.filter(row => row.model !== 'shear-lag' && row.compliance_t_mm_per_MPa === compliances[0]);
      same(`theory of ${test}`, over.series[compliances.length].data, model.map(row => [x(row.compaction), Number(row.modulus_MPa)]));
    }
    const names = (await chart(page, id)).series.map(s => s.name);
    check(names[0] === 'perfect bond' && names[1].startsWith('PF 25'), `lines have the names of glues: ${names}`);
    await page.locator(`#chart-${id}`).getByLabel('glue', {exact: true}).check({force: true});
    const shown = await page.locator(`#chart-${id} table tbody tr`).count();
    check(shown === compactions.length, `${id}: a row of the table below for each state: ${shown}`);
  }
  const profiles = csv('profile.csv');
  const shown = await chart(page, 'profile');
  [...new Set(profiles.map(row => row.compaction))].forEach((c, i) => same(`profile at ${c}`, shown.series[i].data,
    profiles.filter(row => row.compaction === c).map(row => [Number(row.density_kg_m3), Number(row.relative_height)])));
  for (const id of ['histogram-grain_angle_deg', 'histogram-strand_thickness_strain', 'section-profile']) {
    const any = await chart(page, id);
    check(any && any.paths > 3 && any.series.some(s => s.data.length > 2), `${id} is drawn`);
  }
}

// The profile beside the section is that of its frame: same mean density as the table's at the last compaction (to 2 %:
// slices of lumped cells, a byte a value).
async function frameProfileAgrees() {
  const rows = csv('profile.csv');
  const last = rows.filter(row => row.compaction === rows[rows.length - 1].compaction);
  const expected = last.reduce((sum, row) => sum + (row.to_mm - row.from_mm) * row.density_kg_m3, 0) /
                   last.reduce((sum, row) => sum + (row.to_mm - row.from_mm), 0);
  const {series} = await chart(page, 'section-profile');
  const mean = series[0].data.reduce((sum, point) => sum + point[0], 0) / series[0].data.length;
  check(Math.abs(mean / expected - 1) < 0.02, `mean density of the last frame ${mean}, of profile.csv ${expected}`);
}

async function downloads() {
  const button = (id, label) => page.locator(`[data-chart="${id}"]`).getByRole('button', {name: label});
  const expected = ['compaction,time_ms,stress_MPa,force_top_N,force_bottom_N',
    ...csv('press.csv').map(row => [row.compaction, row.time_ms, row.stress_MPa, row.force_top_N, row.force_bottom_N].join(','))].join('\n') + '\n';
  check((await downloaded(page, button('stress', 'CSV'))).toString() === expected, 'the CSV of the stress chart is the table');
  const density = new Map(csv('moduli.csv').map(row => [row.compaction, row.density_kg_m3]));
  const cells = (model, row) => [model, row.compaction, density.get(row.compaction), row.compliance_t_mm_per_MPa, row.modulus_MPa].join(',');
  const tension = ['model,compaction,density_kg_m3,compliance_t_mm_per_MPa,modulus_MPa',
    ...csv('moduli.csv').filter(row => row.test === 'tension').map(row => cells('simulated', row)),
    ...csv('theory.csv').filter(row => row.test === 'tension').map(row => cells(row.model, row))].join('\n') + '\n';
  check((await downloaded(page, button('modulus-tension', 'CSV'))).toString() === tension, 'the CSV of a modulus chart has both tables');
  check(/^<svg[^>]*xmlns/.test((await downloaded(page, button('stress', 'SVG'))).toString()), 'the SVG of a chart');
  check(/^<svg[^>]*xmlns/.test((await downloaded(page, button('layup', 'SVG'))).toString()), 'the SVG of the layup');
  const png = await downloaded(page, page.getByRole('button', {name: 'Download this picture as PNG'}));
  check(png.subarray(1, 4).toString() === 'PNG' && png.length > 3000, 'the PNG of the section');
}

// ---- the section view

async function sliderMovesThePicture() {
  const slider = page.getByRole('slider', {name: 'Compaction'});
  const last = Number(await slider.getAttribute('max'));
  const pictures = new Set();
  for (const frame of [0, Math.floor(last / 2), last]) {
    await slider.fill(String(frame));
    pictures.add(await picture(page));
  }
  check(pictures.size === 3, `${pictures.size} different pictures at three compactions`);
  const press = csv('press.csv');
  const words = await page.locator('.status').textContent();
  const stress = Number(press[press.length - 1].stress_MPa).toFixed(2);
  check(words.includes('4.0 % compaction') && words.includes(`${stress} MPa`), `the last frame says "${words}", press.csv ${stress} MPa`);
  // Keys on the slider, and the play button by keyboard, from the end on again to the end.
  await slider.focus();
  await page.keyboard.press('ArrowLeft');
  await settled(page);
  check(await slider.inputValue() === String(last - 1), 'the left arrow goes back a frame');
  await page.getByRole('button', {name: 'Play the pressing'}).focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction(end => document.querySelector('canvas.section').dataset.frame === end, String(last), {timeout: 20000});
  await page.getByRole('button', {name: 'Play the pressing'}).waitFor();
}

async function colourings() {
  const select = page.getByLabel('Colour by');
  const values = await select.locator('option').evaluateAll(options => options.map(o => o.value));
  check(values.length === 6, `colourings: ${values}`);
  const pictures = new Set();
  for (const value of values) {
    await select.selectOption(value);
    pictures.add(await picture(page));
  }
  check(pictures.size === values.length, 'every colouring is a picture of its own');
  const before = await picture(page);
  await page.getByLabel('Glue lines').check();
  check(await picture(page) !== before, 'glue lines are drawn');
  const bar = await page.locator('.colour-bar').textContent();
  check(bar.includes('Slip of glue lines of PF 25 % (1/Dₜ 0.0105 mm/MPa)'), `the last state was tested: its glue lines tell their slip: ${bar}`);
  await page.getByRole('slider', {name: 'Compaction'}).fill('10');
  await settled(page);
  const between = await page.locator('.colour-bar').textContent();
  check(!between.includes('Slip') && between.includes('near enough to be glued'), `a state between tests has no slip, its lines a key: ${between}`);
  await page.getByLabel('Glue lines').uncheck();
  await select.selectOption('density_kg_m3');
  await page.getByRole('slider', {name: 'Compaction'}).fill('0');
  const all = await picture(page);
  await page.getByLabel('Fit colours').check();
  check(await picture(page) !== all, 'colours fitted to one state');
  await page.getByLabel('Fit colours').uncheck();
  await select.selectOption(values[0]);
  await page.getByRole('slider', {name: 'Compaction'}).fill('40');
}

async function pointerAndKeys() {
  const canvas = page.locator('canvas.section');
  const box = await canvas.boundingBox();
  await canvas.hover({position: {x: box.width / 3, y: box.height * 0.7}});
  await settled(page);
  const bubble = await page.locator('.bubble').textContent();
  for (const part of ['Strand', 'surface', 'row 0', 'grain angle', 'kg/m³', 'plastic strain', 'MPa']) {
    check(bubble.includes(part), `the strand under the pointer tells its ${part}: ${bubble}`);
  }
  await page.mouse.move(5, 5);
  await canvas.focus();
  const whole = await picture(page);
  await page.keyboard.press('+');
  const near = await picture(page);
  check(near !== whole, 'plus magnifies');
  await page.keyboard.press('ArrowRight');
  check(await picture(page) !== near, 'an arrow key moves the section');
  await page.keyboard.press('0');
  check(await picture(page) === whole, 'zero shows all of it again');
  await page.keyboard.press('n');
  check((await page.locator('.readout').textContent()).startsWith('Strand 0: surface'), 'N steps to the first strand');
  await page.keyboard.press('Escape');
  await canvas.dblclick({position: {x: box.width / 2, y: box.height / 2}});
  check(await picture(page) !== whole, 'a double click magnifies');
  await page.keyboard.press('0');
}

// Everything that acts is reached by the tab key, and has a name.
async function tabbing() {
  await page.evaluate(() => document.activeElement?.blur());
  const reached = new Set();
  for (let i = 0; i < 90; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => {
      const e = document.activeElement;
      return e === document.body ? '' : e.getAttribute('aria-label') ?? e.labels?.[0]?.textContent ?? e.textContent;
    }));
  }
  for (const name of ['Light or dark', 'Play the pressing', 'Compaction', 'Magnify more', 'Pressing stress: download the data as CSV']) {
    check(reached.has(name), `the tab key reaches "${name}"`);
  }
}

// The tooltip of a chart tells every line under the pointer by its name, and lies within the window.
async function pointingAtCharts() {
  const host = page.locator('#chart-modulus-tension .plot');
  await host.scrollIntoViewIfNeeded();
  const box = await host.boundingBox();
  await host.hover({position: {x: 100, y: box.height / 2}});
  await host.hover({position: {x: 66, y: box.height / 2}});
  await page.waitForFunction(() => document.querySelector('.pointed')?.getBoundingClientRect().width > 0);
  await settled(page);
  const told = await page.locator('.pointed').last().evaluate(e => ({rows: e.querySelectorAll('b').length, text: e.textContent,
    box: e.parentElement.getBoundingClientRect().toJSON(), width: innerWidth, height: innerHeight}));
  const {series} = await chart(page, 'modulus-tension');
  check(told.rows === series.length && series.every(s => told.text.includes(s.name)), `the tooltip tells ${told.rows} of ${series.length} lines: ${told.text}`);
  check(told.box.left >= 0 && told.box.right <= told.width && told.box.bottom <= told.height, `the tooltip is cut: ${JSON.stringify(told.box)}`);
  await page.mouse.move(5, 5);
}

// What must be read without scripts, as in a mail's preview.
async function withoutScripts() {
  const browser = await chromium.launch({executablePath: browserPath, args: ['--no-sandbox', '--disable-gpu']});
  const bare = await (await browser.newContext({javaScriptEnabled: false})).newPage();
  await bare.goto(`file://${report}`);
  for (const [what, selector] of [['the name', 'h1'], ['the layup', '.board'], ['the limits', '.limit'], ['headlines', '.tile b'],
    ['findings of the board', '#findings li'], ['moduli', '#table-modulus-tension td'], ['states', '#table-states td']]) {
    check(await bare.locator(selector).first().isVisible(), `without scripts ${what} can be read`);
  }
  const groups = await bare.locator('#findings h3').allTextContents();
  check(groups.join() === 'The board,The calculation', `groups of findings: ${groups}`);
  const tension = csv('moduli.csv').filter(row => row.test === 'tension');
  const cell = (await bare.locator('#table-modulus-tension tbody td').first().textContent()).replace(/\u202f/g, '');
  check(Math.abs(Number(cell) - tension[0].modulus_MPa) <= 0.5, `the first modulus is ${tension[0].modulus_MPa}, the page says ${cell}`);
  check(await bare.locator('abbr[title]').count() > 2, 'words have their meaning on hover');
  check(await bare.title() === `${await bare.textContent('h1')} – Strandlab`, `title: ${await bare.title()}`);
  await browser.close();
}

// The chip leads to the findings, findings to their charts.
async function links() {
  const broken = await page.evaluate(() => [...document.querySelectorAll('a[href^="#"]')].map(a => a.getAttribute('href'))
    .filter(href => !document.querySelector(href)));
  check(broken.length === 0, `links that lead nowhere: ${broken}`);
  check(await page.locator('#findings a').count() > 4, 'findings lead to their charts');
  const section = page.locator('#findings cite a').first();
  const target = page.locator(await section.getAttribute('href'));
  check(!await target.isVisible(), 'sections of the documentation wait folded');
  await section.click();
  await target.waitFor();
  check((await target.textContent()).length > 100, 'a finding leads to what the documentation says');
  await page.locator('.background > summary').click();
}

// Rules of WCAG 2 and good practice, by axe; canvas and chart contents have checks of their own above.
async function accessible() {
  for (const [scheme, width] of [['light', 1280], ['dark', 390]]) {
    const other = await open(report, {scheme, width});
    await other.locator('.background > summary').click();
    await other.evaluate(axe.source);
    const {violations, passes} = await other.evaluate(() => window.axe.run());
    check(passes.length > 20, `axe, ${scheme}: only ${passes.length} rules had anything to look at`);
    for (const v of violations) check(false, `axe, ${scheme}, ${width} px: ${v.id}: ${v.help}: ${v.nodes.slice(0, 3).map(n => n.html.slice(0, 120)).join(' | ')}`);
    await other.close();
  }
}

// The page's head is on screen before its scripts work: the browser's own first contentful paint, .2 s as measured, below
// the .3 s that a reader does not notice. The limit is three times that, as other tests run beside this one.
async function firstPaint() {
  let best = Infinity;
  for (let i = 0; i < 3; ++i) {
    const other = await open(report);
    best = Math.min(best, await other.evaluate(() => performance.getEntriesByName('first-contentful-paint')[0]?.startTime ?? Infinity));
    await other.close();
  }
  console.log(`first contentful paint: ${best.toFixed(0)} ms`);
  check(best < 900, `the first paint comes after ${best.toFixed(0)} ms`);
}

// Every line stands out from its card by 3:1 (WCAG 1.4.11).
async function linesAreSeen(other, where) {
  const worst = await other.evaluate(() => {
    const parse = text => /^#/.test(text) ? [1, 3, 5].map(i => parseInt(text.slice(i, i + 2), 16)) : text.match(/[\d.]+/g).map(Number);
    const luminance = colour => colour.slice(0, 3).map(v => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
      .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
    const card = luminance(parse(getComputedStyle(document.querySelector('.card')).backgroundColor));
    let least = {ratio: 99};
    for (const [id, chart] of window.strandlab.charts) for (const s of chart.chart.getOption().series) {
      const line = luminance(parse(s.itemStyle.color));
      const ratio = (Math.max(line, card) + 0.05) / (Math.min(line, card) + 0.05);
      if (ratio < least.ratio) least = {ratio, name: `${s.name} of ${id}`};
    }
    return least;
  });
  check(worst.ratio >= 3, `${where}: ${worst.name} has a contrast of ${worst.ratio.toFixed(2)} only`);
}

// ---- light, dark, narrow, paper

async function legible(file, scheme, width) {
  const other = await open(file, {scheme, width});
  const where = `${scheme}, ${width} px`;
  const page_ = await other.evaluate(() => [document.scrollingElement.scrollWidth, window.innerWidth,
                                            getComputedStyle(document.body).backgroundColor]);
  const wide = await other.evaluate(() => [...document.querySelectorAll('main *')].filter(e => !e.closest('svg, pre, .sr') && e.checkVisibility() &&
    e.getBoundingClientRect().right > window.innerWidth + 0.5).map(e => `${e.tagName}.${e.className}`).slice(0, 4));
  check(page_[0] <= page_[1] && wide.length === 0, `${where}: the page is ${page_[0]} px wide: ${wide}`);
  const dark = page_[2].match(/\d+/g).map(Number).every(v => v < 60);
  check(dark === (scheme === 'dark'), `${where}: background ${page_[2]}`);
  const worst = await leastContrast(other);
  check(worst.ratio >= 4.5, `${where}: "${worst.words}" has a contrast of ${worst.ratio.toFixed(2)} only`);
  await linesAreSeen(other, where);
  const [film, tiles] = await other.evaluate(() => ['.film', '.tiles'].map(name => document.querySelector(name).getBoundingClientRect().top));
  check((film < tiles) === (width === 390), `${where}: the film is at ${film}, the headlines at ${tiles}`);
  check(await other.getByRole('button', {name: 'Magnify more'}).isVisible() === (width !== 390), `${where}: buttons behind a menu on a phone only`);
  return other;
}

async function themes() {
  for (const width of [1280, 390]) for (const scheme of ['light', 'dark']) await (await legible(report, scheme, width)).close();
  await page.getByRole('button', {name: 'Light or dark'}).click();
  check(await page.evaluate(() => document.documentElement.dataset.theme) === 'dark', 'the button turns the page dark');
  await page.getByRole('button', {name: 'Light or dark'}).click();
}

async function paper() {
  await page.emulateMedia({media: 'print'});
  check(!await page.locator('.toolbar').isVisible() && await page.locator('canvas.section').isVisible(), 'paper shows pictures, not buttons');
  await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
  check(await page.locator('main pre').first().isVisible(), 'paper shows the case');
  await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
  const pdf = await page.pdf({format: 'A4'});
  check(pdf.subarray(0, 4).toString() === '%PDF' && pdf.length > 30000, 'the page prints');
  await page.emulateMedia({media: 'screen'});
}

async function hostileNames() {
  for (const width of [1280, 390]) {
    const other = await legible(hostile, 'light', width);
    const name = JSON.parse(await other.locator('#data').textContent()).run.record.case_name;
    check(name.includes('<script>') && await other.locator('h1').textContent() === name, 'the name is shown as it is');
    const made = await other.evaluate(() => [...document.querySelectorAll('main script, main img, main b')]
      .filter(e => e.tagName !== 'B' || e.textContent.startsWith('"')).length);
    check(made === 0, `no name becomes an element: ${made}`);
    check((await other.locator('.legend').textContent()).includes('</script><script>'), 'a strand kind is shown as it is');
    await other.locator('canvas.section').focus();
    await other.keyboard.press('n');
    check((await other.locator('.readout').textContent()).includes('<script>'), 'the strand says its kind');
    await other.close();
  }
}

// The map of the mat through the press: one quantity of transfer_profiles.csv at a time, told with the least and the most of the table.
async function hotPress() {
  const other = await legible(join(hot, 'report.html'), 'dark', 390);
  const [head, ...rows] = readFileSync(join(hot, 'transfer_profiles.csv'), 'utf8').trim().split('\n').map(line => line.split(','));
  const seen = new Set();
  for (const [column, label, unit] of [['T_C', 'temperature', '°C'], ['M', 'moisture content', '%'], ['gas_kPa', 'gas pressure', 'kPa'], ['cure', 'cure', ''],
                                       ['density_kg_m3', 'density', 'kg/m³']]) {
    await other.getByLabel('Shown').selectOption({label});
    const values = rows.map(row => Number(row[head.indexOf(column)]) * (column === 'M' ? 100 : 1));
    const told = await other.locator('.depth-map svg').getAttribute('aria-label');
    const range = told.match(/: (\S+) to (\S+) (\S*)$/);
    const numbers = range?.slice(1, 3).map(text => Number(text.replace('\u202f', '').replace('·10^', 'e')));
    const agrees = numbers?.every((number, i) => Math.abs(number - [Math.min(...values), Math.max(...values)][i]) <= 1e-2 * Math.abs(number));
    check(told.startsWith(label) && agrees && range[3] === unit, `the map of ${label} says "${told}"`);
    seen.add(await other.locator('.depth-map image').getAttribute('href'));
  }
  check(seen.size === 5, `five quantities, ${seen.size} pictures`);
  await other.close();
}

// A study of two axes: what is drawn is what its tables say, at the last state and the glue in the middle.
async function study() {
  const other = await open(join(studied, 'report.html'), {drawn: '#chart-tornado rect'});
  const summary = csv('summary.csv', studied).filter(row => row.contrast === ''), effects = csv('effects.csv', studied);
  const last = String(Math.max(...summary.map(row => Number(row.state)))), test = summary[0].test;
  const shown = summary.filter(row => row.test === test && row.state === last);
  const keys = ['press.speed_m_s', 'kinds.core.law'];
  const cells = [...new Set(shown.map(row => keys.map(key => row[key]).join(' · ')))];
  const means = await chart(other, 'means-glue');
  cells.forEach((cell, i) => {
    const rows = shown.filter(row => keys.map(key => row[key]).join(' · ') === cell);
    check(means.series[i].name === cell, `the line of a cell has its name: ${means.series[i].name}, ${cell}`);
    same(`means of ${cell}`, means.series[i].data, rows.map(row => [Number(row.compliance_t_mm_per_MPa), Number(row.mean_MPa)]));
    const [low, wide] = means.series.slice(cells.length + 2 * i, cells.length + 2 * i + 2).map(s => s.data);
    same(`band of ${cell}, low`, low, rows.map(row => [Number(row.compliance_t_mm_per_MPa), Number(row.low_MPa)]));
    same(`band of ${cell}, high`, wide.map(([x, y], k) => [x, y + low[k][1]]), rows.map(row => [Number(row.compliance_t_mm_per_MPa), Number(row.high_MPa)]));
  });
  const glues = new Set(shown.map(row => row.compliance_t_mm_per_MPa)).size;
  const wanted = effects.filter(row => row.test === test && row.state === last).filter((_, i) => i % glues === Math.floor((glues - 1) / 2))
    .map(row => 100 * row.effect_MPa / row.reference_MPa).sort((a, b) => Math.abs(b) - Math.abs(a));
  const told = await other.locator('#chart-tornado text.value').evaluateAll(texts => texts.map(t => Number(t.textContent.replace('−', '-').replace(' %', ''))));
  check(wanted.length === 2 && wanted.every((value, i) => Math.abs(value - told[i]) <= 5.1e-3 * Math.abs(value)), `effects ${told}, of effects.csv ${wanted}`);
  await other.getByLabel('Tension', {exact: true}).check({force: true});
  const tension = await chart(other, 'means-glue');
  const first = summary.filter(row => row.test === 'tension' && row.state === last)[0];
  check(near(tension.series[0].data[0][1], Number(first.mean_MPa)), 'the switch shows the other test');
  for (const id of ['means-density', 'stress', 'profile', 'multiple-0', 'multiple-3']) check((await chart(other, id))?.paths > 3, `${id} is drawn`);
  check((await other.locator('tbody a').first().getAttribute('href')).startsWith('items/'), 'a panel leads to its case');
  check((await other.locator('#findings li').count()) > 3 && (await other.locator('#table-means-tension tbody tr').count()) === cells.length, 'findings and means as HTML');
  const broken = await other.evaluate(() => [...document.querySelectorAll('a[href^="#"]')].map(a => a.getAttribute('href')).filter(href => !document.querySelector(href)));
  check(broken.length === 0, `links of a study that lead nowhere: ${broken}`);
  await other.evaluate(axe.source);
  for (const v of (await other.evaluate(() => window.axe.run())).violations) check(false, `axe, study: ${v.id}: ${v.nodes.slice(0, 2).map(n => n.html.slice(0, 120))}`);
  await linesAreSeen(other, 'study');
  await other.close();
  const narrow = await open(join(studied, 'report.html'), {drawn: '#chart-tornado rect', width: 390, scheme: 'dark'});
  check(await narrow.evaluate(() => document.scrollingElement.scrollWidth <= window.innerWidth), 'a study on a phone is not wider than it');
  check((await leastContrast(narrow)).ratio >= 4.5, `a study in the dark: ${JSON.stringify(await leastContrast(narrow))}`);
  await narrow.close();
}

const steps = [firstPaint, chartsShowTheTables, frameProfileAgrees, downloads, sliderMovesThePicture, colourings, pointerAndKeys, pointingAtCharts, links, accessible, withoutScripts, tabbing, themes, paper, hostileNames, hotPress, study];
try {
  for (const step of steps) await step().catch(error => check(false, `${step.name}: ${error.stack}`));
} finally {
  await context.close();
  rmSync(profile, {recursive: true, force: true});
}
console.log('failures:', failures);
process.exit(failures ? 1 : 0);
