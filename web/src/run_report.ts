// The report of one run.
import {Chart, formatNumber, type Series} from './chart';
import type {Run} from './data';
import {DepthMap} from './depth_map';
import {downloadText, button, choice, el, fileName} from './dom';
import {unpack} from './frames';
import {hotPressCharts, hotPressTiles} from './hotpress';
import {layupFigure} from './layup';
import {SectionView, type SectionOptions} from './section';
import {slipState, type SlipState} from './slip';
import {parseCsv, Table} from './table';
import {toggleTheme} from './theme';

function nameOf(run: Run, test: string): string {
  return run.words.tests[test] ?? test;
}

function glueName(run: Run, compliance: string): string {
  return run.words.glues.find(glue => glue.compliance_t_mm_per_MPa === Number(compliance))?.name ?? `1/Dₜ ${compliance}`;
}

// Its name, with the compliance where that is not the name itself.
function glueOf(run: Run, compliance: number): string {
  const name = glueName(run, String(compliance));
  return compliance <= 0 || name.startsWith('1/D') ? name : `${name} (1/Dₜ ${compliance} mm/MPa)`;
}

function percent(compaction: number): string {
  return `${Number((100 * compaction).toFixed(1))} %`;
}

// A kept state by its density, or by its compaction where that is not known; and by both.
function stateName(run: Run, compaction: number): string {
  const density = run.case.densities_kg_m3[run.case.compactions.indexOf(compaction)];
  return density === undefined ? percent(compaction) : `${Math.round(density)} kg/m³`;
}

function fullStateName(run: Run, compaction: number): string {
  const name = stateName(run, compaction), share = percent(compaction);
  return name === share ? share : `${share} (${name})`;
}

function table(run: Run, name: string): Table | undefined {
  const text = run.tables[name];
  const parsed = text ? parseCsv(text) : undefined;
  return parsed && parsed.rows.length > 0 ? parsed : undefined;
}

function section(title: string, ...children: (Node | null | undefined)[]): HTMLElement {
  return el('section', {}, el('h2', {}, title), ...children.map(child => child ?? null));
}

// ---- charts

// Stress of a platen is its force over the mat's face, 1 mm deep in a section. The mat's length is its own: a mat file
// need not have that of the case.
function pressCharts(run: Run): Chart[] {
  const press = table(run, 'press.csv');
  if (!press || !run.mat) return [];
  const {length_mm} = run.mat;
  const compaction = press.numbers('compaction');
  const stress = press.numbers('stress_MPa');
  const platen = (name: string) => press.numbers(name).map(force => force / length_mm);
  const percents = compaction.map(c => 100 * c);
  const x = {min: 0, max: Math.max(1, Math.round(Math.max(...percents)))};
  const hot = ([['softening_mJ', 'softening'], ['damping_mJ', 'damping']] as const).filter(([column]) => press.has(column));
  const energy = (name: string, label: string): Series => ({name: label, x: percents, y: press.numbers(name)});
  return [
    new Chart({
      id: 'stress', title: 'Pressing stress', note: 'Compression positive; each point is the mean since the point before.',
      xLabel: 'compaction, %', yLabel: 'stress, MPa',
      series: [
        {name: 'top platen', x: percents, y: platen('force_top_N')},
        {name: 'bottom platen', x: percents, y: platen('force_bottom_N')},
        {name: 'mean', x: percents, y: stress, style: 'dashed', ink: true},
      ],
      table: press.select(['compaction', 'time_ms', 'stress_MPa', 'force_top_N', 'force_bottom_N']),
      x, summary: `Platen stress against compaction; it reaches ${formatNumber(Math.max(...stress))} MPa.`,
    }),
    new Chart({
      id: 'energies', title: 'Where the work goes', note: 'Energies since the start, for a section 1 mm deep.',
      xLabel: 'compaction, %', yLabel: 'energy, mJ',
      series: [
        {name: "platens' work", x: percents, y: press.numbers('platen_work_mJ'), style: 'dashed', ink: true},
        energy('plastic_mJ', 'plastic'), energy('elastic_mJ', 'elastic'), energy('friction_mJ', 'friction'),
        energy('contact_mJ', 'contact'), energy('filter_mJ', 'filter'), energy('kinetic_mJ', 'kinetic'),
        ...hot.map(([column, name]) => energy(column, name)),
      ],
      table: press.select(['compaction', 'platen_work_mJ', 'plastic_mJ', 'elastic_mJ', 'friction_mJ', 'contact_mJ', 'filter_mJ', 'kinetic_mJ', ...hot.map(([column]) => column)]),
      x, summary: "The platens' work and the energies it turns into, against compaction.",
    }),
  ];
}

// What a modulus is drawn against.
interface Axis {
  key: string;
  label: string;  // of the switch
  xLabel: string;
  note: string;
  x: (row: Table) => number[];
}

const compactionAxis: Axis = {key: 'compaction', label: 'compaction', xLabel: 'compaction, %', note: 'One line per glue; dashed: closed-form models.',
                              x: row => row.numbers('compaction').map(c => 100 * c)};
const glueAxis: Axis = {key: 'glue', label: 'glue', xLabel: 'glue compliance 1/Dₜ, mm/MPa', note: '', x: row => row.numbers('compliance_t_mm_per_MPa')};
const densityAxis: Axis = {key: 'density', label: 'density', xLabel: 'density, kg/m³', x: row => row.numbers('density_kg_m3'),
                           note: 'A modulus that only follows density is a straight line through the origin; dashed: closed-form models.'};

// Models of these rows, a dashed line each; they repeat their values for every 1/Dₜ or state that they do not know.
function theorySeries(theory: Table, axis: Axis, of: string): Series[] {
  return theory.distinct('model').map((model): Series => {
    const rows = theory.where('model', model);
    const points = new Map(axis.x(rows).map((value, i) => [value, rows.numbers('modulus_MPa')[i]!]));
    const sorted = [...points].sort((a, b) => a[0] - b[0]);
    return {name: `${model}${of}`, x: sorted.map(p => p[0]), y: sorted.map(p => p[1]), style: 'dashed', ink: true};
  });
}

const drawnColumns = ['compaction', 'density_kg_m3', 'compliance_t_mm_per_MPa', 'modulus_MPa'];

// Rows of moduli.csv and theory.csv of a test as one table: what the chart's lines are.
function drawnTable(moduli: Table, theory: Table | undefined): Table {
  const density = new Map(moduli.text('compaction').map((c, i) => [c, moduli.text('density_kg_m3')[i]!]));
  const rows = moduli.select(drawnColumns).rows.map(row => ['simulated', ...row]);
  theory?.text('compaction').forEach((c, i) => rows.push([theory.text('model')[i]!, c, density.get(c) ?? '',
    theory.text('compliance_t_mm_per_MPa')[i]!, theory.text('modulus_MPa')[i]!]));
  return new Table(['model', ...drawnColumns], rows);
}

function modulusSpec(run: Run, axis: Axis, all: Table) {
  const simulated = all.where('model', 'simulated');
  const theory = new Table(all.columns, all.rows.filter(row => row[0] !== 'simulated'));
  const states = simulated.distinct('compaction'), glues = simulated.distinct('compliance_t_mm_per_MPa');
  const line = (column: string, value: string, i: number, count: number, name: string): Series => {
    const rows = simulated.where(column, value);
    return {name, x: axis.x(rows), y: rows.numbers('modulus_MPa'), style: 'marked', family: [i, count]};
  };
  const last = states[states.length - 1]!;
  const byGlue = axis.key === 'glue';
  const series = byGlue
    ? [...states.map((c, i) => line('compaction', c, i, states.length, stateName(run, Number(c)))), ...theorySeries(theory.where('compaction', last), axis, '')]
    : [...glues.map((d, i) => line('compliance_t_mm_per_MPa', d, i, glues.length, glueName(run, d))),
       ...theorySeries(new Table(theory.columns, theory.rows.filter(row => row[0] !== 'shear-lag')), axis, '')];
  return {
    xLabel: axis.xLabel, series, x: {min: 0}, note: byGlue ? `One line per kept state; dashed: closed-form models at ${stateName(run, Number(last))}.` : axis.note,
    summary: byGlue ? 'Modulus against glue compliance, one line per kept state, with closed-form models.'
                    : `Modulus against ${axis.label}, one line per glue compliance, with closed-form models.`,
  };
}

// One chart a test, with a switch of its axis; below it the static table of its moduli.
function modulusCharts(run: Run): Chart[] {
  const moduli = table(run, 'moduli.csv');
  if (!moduli) return [];
  const axes = moduli.has('density_kg_m3') ? [glueAxis, densityAxis, compactionAxis] : [glueAxis];
  return moduli.distinct('test').map(test => {
    const all = drawnTable(moduli.where('test', test), table(run, 'theory.csv')?.where('test', test));
    const start = axes.find(axis => new Set(axis.x(all)).size > 1) ?? glueAxis;
    const title = `${nameOf(run, test)} modulus`;
    const spec = (axis: Axis) => modulusSpec(run, axis, all);
    const chart = new Chart({id: `modulus-${fileName(test)}`, title, yLabel: 'modulus, MPa', table: all, y: {min: 0}, labels: true, ...spec(start)});
    const against = choice('Against', axes.map(axis => ({value: axis.key, label: axis.label})), start.key, key =>
      chart.update(spec(axes.find(axis => axis.key === key)!)));
    chart.element.insertBefore(against, chart.host);
    const numbers = document.getElementById(`table-modulus-${test}`);
    if (numbers) {
      numbers.classList.remove('card');
      chart.element.append(numbers);
    }
    return chart;
  });
}

// The last specimen of measured.csv, the mean where there are several, as `strandlab report --measured` keeps them.
function measuredBoard(run: Run, axes: (place: number[], density: number[]) => {x: number[]; y: number[]}, column: string): Series[] {
  const specimens = table(run, 'measured.csv');
  const name = specimens?.distinct('specimen').pop();
  if (!specimens || name === undefined) return [];
  const board = specimens.where('specimen', name);
  return [{name: `measured, ${name}`, ...axes(board.numbers(column), board.numbers('density_kg_m3')), style: 'dashed', ink: true}];
}

// Density through the thickness, heights over those of the panel so that states can be compared.
function profileChart(run: Run): Chart[] {
  const profile = table(run, 'profile.csv');
  if (!profile) return [];
  const compactions = profile.distinct('compaction');
  return [new Chart({
    id: 'profile', title: 'Density profile', note: 'Voids included; one line per kept state.', xLabel: 'density, kg/m³',
    yLabel: 'relative height',
    series: compactions.map((value, i): Series => {
      const state = profile.where('compaction', value);
      return {name: stateName(run, Number(value)), x: state.numbers('density_kg_m3'), y: state.numbers('relative_height'),
              family: [i, compactions.length]};
    }).concat(measuredBoard(run, (height, density) => ({x: density, y: height}), 'relative_height')),
    table: profile, y: {min: 0, max: 1}, item: true,
    summary: 'Density against height in the panel, one line per compaction.',
  })];
}

// glue_lines/slip_C.csv of each compaction C that was tested.
function slips(run: Run): SlipState[] {
  return run.case.compactions.flatMap(c => {
    const text = run.tables[`glue_lines/slip_${c}.csv`];
    const state = text === undefined ? undefined : slipState(c, text);
    return state ? [{...state, glue: glueOf(run, state.compliance_t_mm_per_MPa)}] : [];
  });
}

// The profile of profile.csv at the compaction nearest to a frame, where there is one within half a percent.
function measuredProfile(run: Run): SectionOptions['measuredProfile'] {
  const profile = table(run, 'profile.csv');
  if (!profile) return undefined;
  const states = profile.distinct('compaction').map(value => ({compaction: Number(value), rows: profile.where('compaction', value)}));
  return at => {
    const state = states.find(s => Math.abs(s.compaction - at) < 0.005);
    if (!state) return undefined;
    const from = state.rows.numbers('from_mm'), to = state.rows.numbers('to_mm');
    return {label: 'profile.csv', y_mm: from.map((v, i) => (v + to[i]!) / 2), density_kg_m3: state.rows.numbers('density_kg_m3')};
  };
}

// A step line through the bins that hold anything, over all states, with an empty bin at each end.
function histogramCharts(run: Run): Chart[] {
  const histograms = table(run, 'histograms.csv');
  if (!histograms) return [];
  return histograms.distinct('quantity').map(quantity => {
    const {title, axis: xLabel, factor} = run.words.quantities[quantity] ?? {title: quantity, axis: quantity, factor: 1};
    const rows = histograms.where('quantity', quantity);
    const compactions = rows.distinct('compaction');
    const from = rows.numbers('from'), to = rows.numbers('to'), fraction = rows.numbers('fraction');
    const used = fraction.flatMap((f, i) => (f > 1e-3 ? [i] : []));
    const width = (to[0]! - from[0]!) * factor;
    const low = Math.min(...used.map(i => from[i]! * factor)) - width, high = Math.max(...used.map(i => to[i]! * factor)) + width;
    const series = compactions.map((value, i): Series => {
      const state = rows.where('compaction', value);
      const x = state.numbers('to').map(v => v * factor), y = state.numbers('fraction').map(v => 100 * v);
      const shown = x.flatMap((v, k) => (v >= low - 1e-9 && v <= high + 1e-9 ? [k] : []));
      return {name: stateName(run, Number(value)), x: shown.map(k => x[k]!), y: shown.map(k => y[k]!), style: 'steps', family: [i, compactions.length]};
    });
    // A mat as laid is one bar that would dwarf the rest.
    const rest = series.filter(s => s.y.filter(v => v > 0).length > 1);
    return new Chart({
      id: `histogram-${fileName(quantity)}`, title, note: 'Share of the wood in each bin, one line per kept state.', xLabel,
      yLabel: 'share of the wood, %', series: rest.length > 0 ? rest : series, table: rows,
      summary: `Histogram of ${xLabel}, one line per compaction.`, x: {min: low, max: high}, y: {min: 0},
    });
  });
}

// ---- tables of words

function facts(title: string, rows: [string, string][]): HTMLElement {
  return el('div', {class: 'card'}, el('h3', {}, title), el('table', {class: 'facts'}, el('tbody', {}, ...rows.map(([name, value]) =>
    el('tr', {}, el('th', {scope: 'row'}, name), el('td', {}, value))))));
}

function caseFacts(run: Run): HTMLElement {
  const c = run.case;
  const glue = c.compliances_t_mm_per_MPa.map(v => `${v} (${glueName(run, String(Math.max(v, 0)))})`.replace(/ \(1\/D.*\)/, '')).join(', ');
  const derived = run.record.derived_constants ?? [];
  return el('div', {class: 'grid'},
    ...derived.map(line => el('p', {class: 'note'}, `${line[0]?.toUpperCase() ?? ''}${line.slice(1)}.`)),
    ...c.materials.map(m => facts(`Material: ${m.name}`, [
      ['Density', `${m.density_kg_m3} kg/m³`],
      ['Moduli E_L, E_R, E_T', `${m.E_L_MPa}, ${m.E_R_MPa}, ${m.E_T_MPa} MPa`],
      ['Law of yielding', m.law === 'crushing' ? 'crushing: cells collapse' : 'Hill: volume is kept'],
      ['Yield across the grain Y_R', `${m.Y_R_MPa} MPa`],
      ...(m.hardening_K_MPa === undefined ? [] : [['Hardening K', `${m.hardening_K_MPa} MPa`] as [string, string]]),
    ])),
    facts('Press', [
      ['Closing speed', `${c.speed_m_s} m/s`],
      ['Friction between strands', String(c.friction)],
      ['States kept at', c.compactions.map(value => fullStateName(run, value)).join(', ')],
    ]),
    facts('Glue', [
      ['Glue compliance 1/Dₜ', `${glue} mm/MPa`],
      ['Glue compliance 1/Dₙ', c.compliance_n_mm_per_MPa === 0 ? '0 (perfect)' : `${c.compliance_n_mm_per_MPa} mm/MPa`],
      ['Faces bond up to a gap of', `${c.max_gap_mm} mm`],
    ]));
}

function openOnPaper(details: HTMLDetailsElement): HTMLDetailsElement {
  let before = details.open;
  window.addEventListener('beforeprint', () => {
    before = details.open;
    details.open = true;
  });
  window.addEventListener('afterprint', () => {
    details.open = before;
  });
  return details;
}

function duration(seconds: number): string {
  if (seconds < 90) return `${seconds.toFixed(seconds < 10 ? 1 : 0)} s`;
  return seconds < 5400 ? `${(seconds / 60).toFixed(1)} min` : `${(seconds / 3600).toFixed(1)} h`;
}

function provenance(run: Run): HTMLElement {
  const {record} = run;
  const {press, test} = record.steps;
  const m = record.machine ?? {};
  const rows: [string, string | undefined][] = [
    ['Program', record.strandlab && `strandlab ${record.strandlab} (${record.git ?? 'unknown commit'})`],
    ['Run begun', record.date],
    run.case.mat_file ? ['Mat', `read from ${run.case.mat_file}`] : ['Seed of the mat', String(run.case.seed)],
    ['Machine', [m.host, m.cpu, m.cores && `${m.cores} cores`, m.system].filter(Boolean).join(', ')],
    ['Pressing', press?.wall_s !== undefined ? `${press.particles ?? '?'} particles, ${press.steps ?? '?'} steps, ${duration(press.wall_s)} on ` +
      `${press.threads ?? '?'} thread(s), ${formatNumber((press.particle_steps_per_s ?? 0) / 1e6)} million particle-steps/s` : undefined],
    ['Virtual tests', test?.wall_s !== undefined ? duration(test.wall_s) : undefined],
  ];
  return section('Provenance',
    facts('How this was made', rows.filter((row): row is [string, string] => !!row[1])),
    openOnPaper(el('details', {class: 'card'}, el('summary', {}, 'The case, as it was run'), el('pre', {tabindex: 0}, run.case_text),
      el('div', {class: 'tools'}, button('TOML', 'Download the case file', () =>
        downloadText('case.toml', 'text/plain', run.case_text))))));
}

function hotPress(run: Run, grid: (charts: Chart[]) => HTMLElement | null): HTMLElement | null {
  const series = table(run, 'hotpress.csv');
  if (!series || !run.record.hotpress) return null;
  const profiles = table(run, 'transfer_profiles.csv');
  const charts = grid(hotPressCharts(series, profiles, measuredBoard(run, (position, density) => ({x: position, y: density}), 'position_mm')));
  if (charts && profiles && profiles.rows.length > 0) charts.append(new DepthMap(profiles).element);
  return section('The hot press', hotPressTiles(run.record.hotpress), charts);
}

// ---- all of it

function stressAt(run: Run): ((time_ms: number) => number | undefined) | undefined {
  const press = table(run, 'press.csv');
  if (!press) return undefined;
  const time = press.numbers('time_ms'), stress = press.numbers('stress_MPa');
  return at => {
    const i = time.findIndex(t => t >= at * (1 - 1e-9));
    return i < 0 ? stress[stress.length - 1] : stress[i];
  };
}

// Builds on what the page says without scripts: the film behind the headlines, charts behind the findings, tables where
// they belong.
export function runReport(run: Run, place: HTMLElement): SectionView | undefined {
  const film = unpack(run.frames);
  const view = film.frames.length > 0 ? new SectionView(film, {
    id: 'section', kinds: run.case.kinds.map(kind => kind.name), stressAt: stressAt(run), measuredProfile: measuredProfile(run), slips: slips(run),
  }) : undefined;
  const grid = (charts: Chart[]) => (charts.length > 0 ? el('div', {class: 'grid'}, ...charts.map(chart => chart.element)) : null);
  const press = pressCharts(run), moduli = modulusCharts(run), histograms = [...profileChart(run), ...histogramCharts(run)];
  place.querySelector('header')?.append(button('◐', 'Light or dark', toggleTheme));
  if (view) {
    const head = place.querySelector('.tiles') ?? place.querySelector('header');
    const shown = section('The section through the pressing', view.element);
    shown.classList.add('film');
    if (head) head.after(shown);
    else place.prepend(shown);
  }
  const content = [
    hotPress(run, grid),
    press.length > 0 ? section('Pressing', grid(press)) : null,
    moduli.length > 0 ? section('Stiffness', grid(moduli)) : null,
    histograms.length > 0 ? section('Density and shape', grid(histograms)) : null,
    section('The case', run.mat ? layupFigure(run.mat, run.case, run.record) : null, caseFacts(run)),
    provenance(run),
    document.getElementById('background'),
    el('footer', {}, `strandlab ${run.record.strandlab ?? ''}. The numbers are in the CSV files of the run folder.`),
  ];
  place.append(...content.filter((node): node is HTMLElement => node !== null));
  const tables = document.getElementById('tables');
  const states = document.getElementById('table-states');
  if (states && histograms.length > 0) histograms[0]!.element.parentElement!.before(states);
  if (tables && !tables.querySelector('table')) tables.remove();
  return view;
}
