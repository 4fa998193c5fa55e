// The hot press of a run: its answers, and how heat, moisture, gas and cure went.
import {Chart, formatNumber, type Series} from './chart';
import type {HotPressRecord} from './data';
import {el} from './dom';
import type {Table} from './table';

const places = [['face', 'faces'], ['quarter', 'quarters'], ['core', 'core']] as const;
const states = [['closed', 'closed'], ['held', 'end of the hold'], ['opened', 'opened']] as const;

const seconds = (value: number | null | undefined) => (value === null || value === undefined ? 'not in this cycle' : `${Math.round(value)} s`);

function risk(blow: number): string {
  return blow < 0.5 ? 'low' : blow <= 1 ? 'watch' : 'blow likely';
}

export function hotPressTiles(record: HotPressRecord): HTMLElement {
  const band = (low: number, high: number) => `${formatNumber(low)} to ${formatNumber(high)}`;
  const facts: [string, string, string][] = [
    ['Press time to cure', seconds(record.press_time_to_cure_s), record.press_factor_s_per_mm ? `${record.press_factor_s_per_mm.toFixed(1)} s per mm` : ''],
    ['Core at 100 °C', seconds(record.core_100C_s), 'since first contact'],
    ['Gas in the core', formatNumber(record.gas_core_peak_kPa),
     `kPa at most; ${band(record.gas_core_peak_kPa_K_times_3, record.gas_core_peak_kPa_K_over_3)} with three times and a third of the permeability`],
    ['Blow risk', risk(record.blow_risk),
     `${record.blow_risk.toFixed(2)}, relative; ${band(record.blow_risk_K_times_3, record.blow_risk_K_over_3)} with permeability as before`],
    ['Densest layer', formatNumber(record.density_peak_over_core), `times the core's, ${record.density_peak_depth_mm.toFixed(1)} mm below the face`],
    ['Springback', record.springback_percent.toFixed(1), '% of the thickness, at least'],
  ];
  return el('dl', {class: 'tiles'}, ...facts.map(([name, value, unit]) =>
    el('div', {class: 'tile'}, el('dt', {}, name), el('dd', {}, el('b', {}, value), ' ', el('span', {}, unit)))));
}

export function hotPressCharts(series: Table, profiles: Table | undefined, measured: Series[]): Chart[] {
  const time = series.numbers('time_s');
  const line = (name: string, column: string, factor = 1): Series => ({name, x: time, y: series.numbers(column).map(v => factor * v)});
  const at = (quantity: string, unit: string, factor = 1) => places.map(([key, label]) => line(label, `${quantity}_${key}${unit}`, factor));
  const columns = (...names: string[]) => series.select(['time_s', 'phase', ...names]);
  const x = {min: Math.min(0, ...time), max: Math.max(...time)};
  const common = {xLabel: 'time since first contact, s', x};
  const charts = [
    new Chart({
      ...common, id: 'hot-pressure', title: 'Platen pressure', note: 'Of the platens; wood: what the strands bear, the rest is gas.', yLabel: 'pressure, MPa',
      series: [line('platens', 'pressure_MPa'), {...line('wood', 'wood_stress_MPa'), style: 'dashed', ink: true}],
      table: columns('gap_mm', 'pressure_MPa', 'wood_stress_MPa'), summary: 'Pressure of the platens against time.',
    }),
    new Chart({
      ...common, id: 'hot-gap', title: 'Thickness', yLabel: 'thickness, mm', series: [line('mat', 'thickness_mm')],
      table: columns('gap_mm', 'thickness_mm'), summary: 'Thickness of the mat against time.',
    }),
    new Chart({
      ...common, id: 'hot-temperature', title: 'Temperature', yLabel: 'temperature, °C',
      series: [...at('T', '_C'), {...line('top platen', 'platen_top_C'), style: 'dashed', ink: true}],
      table: columns('platen_top_C', 'platen_bottom_C', 'T_face_C', 'T_quarter_C', 'T_core_C'),
      summary: 'Temperature of faces, quarters and core against time.',
    }),
    new Chart({
      ...common, id: 'hot-moisture', title: 'Moisture content', yLabel: 'moisture content, %', series: at('M', '', 100),
      table: columns('M_face', 'M_quarter', 'M_core'), summary: 'Moisture content of faces, quarters and core against time.',
    }),
    new Chart({
      ...common, id: 'hot-gas', title: 'Gas pressure', note: "Above the room's, in the middle of the panel.", yLabel: 'gas pressure, kPa', series: at('gas', '_kPa'),
      table: columns('gas_face_kPa', 'gas_quarter_kPa', 'gas_core_kPa', 'gas_mean_kPa'), summary: 'Gas pressure of faces, quarters and core against time.',
    }),
    new Chart({
      ...common, id: 'hot-cure', title: 'Cure', note: 'Of the least cured layer that carries the resin.', yLabel: 'degree of cure',
      series: [line('resin of the faces', 'cure_face'), line('resin of the core', 'cure_core')], y: {min: 0, max: 1},
      table: columns('cure_face', 'cure_core'), summary: 'Degree of cure of the resins against time.',
    }),
  ];
  const kept = states.flatMap(([state, name]) => {
    const rows = profiles?.where('state', state);
    if (!rows || rows.rows.length === 0) return [];
    const last = rows.where('time_s', rows.text('time_s')[rows.rows.length - 1]!);
    return [{name, rows: last}];
  });
  if (profiles && kept.length > 0) {
    charts.push(new Chart({
      id: 'hot-density', title: 'Density as the press left it', note: 'By layers of equal mass; oven-dry mass over volume.',
      xLabel: 'depth below the top face, mm', yLabel: 'density, kg/m³',
      series: kept.map(({name, rows}): Series => ({name, x: rows.numbers('depth_mm'), y: rows.numbers('density_kg_m3')})).concat(measured),
      table: profiles, summary: 'Density against depth when the press had closed, at the end of the hold and when it had opened.',
    }));
  }
  return charts;
}
