// What went on through the mat against time: one quantity of transfer_profiles.csv as colours over time and depth.
import {css, interpolate, pixel, viridis, cividis, plasma, type Rgb} from './colour';
import {formatNumber} from './chart';
import {button, downloadText, el, menu, svg} from './dom';
import type {Table} from './table';

interface Quantity {
  column: string;
  name: string;
  unit: string;
  factor: number;
  map: Rgb[];
}

const quantities: Quantity[] = [
  {column: 'T_C', name: 'temperature', unit: '°C', factor: 1, map: plasma},
  {column: 'M', name: 'moisture content', unit: '%', factor: 100, map: cividis},
  {column: 'gas_kPa', name: 'gas pressure', unit: 'kPa', factor: 1, map: viridis},
  {column: 'cure', name: 'cure', unit: '', factor: 1, map: viridis},
  {column: 'density_kg_m3', name: 'density', unit: 'kg/m³', factor: 1, map: cividis},
];

const size = {width: 480, height: 260, left: 46, right: 12, top: 8, bottom: 40};
const inner = {width: size.width - size.left - size.right, height: size.height - size.top - size.bottom};

// Layers at one time, from the top face down.
interface Column {
  time: number;
  faces: number[];  // mm below the top face, one more than layers
  rows: number[];   // of the table
}

function columnsOf(table: Table): Column[] {
  const time = table.numbers('time_s'), depth = table.numbers('depth_mm');
  const columns: Column[] = [];
  time.forEach((t, row) => {
    let last = columns[columns.length - 1];
    if (!last || last.time !== t) columns.push(last = {time: t, faces: [0], rows: []});
    // The depth is that of a layer's middle, as far from its upper face as from its lower one.
    const upper = last.faces[last.faces.length - 1]!;
    last.faces.push(2 * depth[row]! - upper);
    last.rows.push(row);
  });
  return columns;
}

function ticks(low: number, high: number, about: number): number[] {
  const rough = (high - low) / about, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map(m => m * power).find(s => s >= rough)!;
  const list: number[] = [];
  for (let tick = Math.ceil(low / step) * step; tick <= high + 1e-9 * step; tick += step) list.push(Math.abs(tick) < 1e-9 * step ? 0 : tick);
  return list;
}

export class DepthMap {
  readonly element: HTMLElement;
  private readonly host = el('div', {class: 'depth-map'});
  private readonly columns: Column[];
  private readonly choice = el('select', {change: () => this.draw()}, ...quantities.map(({column, name}) => el('option', {value: column}, name)));

  constructor(private readonly table: Table) {
    this.columns = columnsOf(table);
    const title = 'Through the thickness';
    this.element = el('figure', {class: 'card chart', id: 'chart-depth-map', 'data-chart': 'depth-map'},
      el('figcaption', {}, el('h3', {}, title),
        menu(`${title}: downloads`, button('CSV', `${title}: download the data as CSV`, () =>
          downloadText('transfer_profiles.csv', 'text/csv', table.csv())))),
      el('label', {class: 'shown'}, 'Shown: ', this.choice),
      this.host);
    this.draw();
  }

  private draw(): void {
    const {columns} = this;
    const {column: shown, name, unit, factor, map} = quantities.find(q => q.column === this.choice.value)!;
    const values = this.table.numbers(shown).map(v => v * factor);
    const finite = values.filter(Number.isFinite);
    const low = Math.min(...finite), high = Math.max(...finite), range = high > low ? high - low : 1;
    const first = columns[0]!.time, last = columns[columns.length - 1]!.time;
    const deepest = Math.max(...columns.map(column => column.faces[column.faces.length - 1]!));
    const wide = 2 * inner.width, tall = 2 * inner.height;
    const canvas = el('canvas', {width: wide, height: tall});
    const context = canvas.getContext('2d')!;
    const image = context.createImageData(wide, tall);
    const pixels = new Uint32Array(image.data.buffer);
    const colours = values.map(value => (Number.isFinite(value) ? pixel(interpolate(map, (value - low) / range)) : 0));
    let column = 0;
    for (let i = 0; i < wide; ++i) {
      const time = first + ((i + 0.5) / wide) * (last - first);
      while (column + 1 < columns.length && columns[column + 1]!.time <= time) ++column;
      const {faces, rows} = columns[column]!;
      for (let j = 0, layer = 0; j < tall; ++j) {
        const depth = ((j + 0.5) / tall) * deepest;
        while (layer < rows.length && faces[layer + 1]! < depth) ++layer;
        if (layer === rows.length) break;
        pixels[j * wide + i] = colours[rows[layer]!]!;
      }
    }
    context.putImageData(image, 0, 0);

    const x = (time: number) => size.left + ((time - first) / (last - first)) * inner.width;
    const y = (depth: number) => size.top + (depth / deepest) * inner.height;
    const label = (at: {x: number; y: number; anchor?: string; turn?: boolean}, text: string) =>
      svg('text', {x: at.x, y: at.y, 'text-anchor': at.anchor ?? 'middle', ...(at.turn ? {transform: `rotate(-90 ${at.x} ${at.y})`} : {})}, text);
    const summary = `${name} over time, from ${formatNumber(first)} to ${formatNumber(last)} s, and depth, from 0 to ${formatNumber(deepest)} mm: ` +
      `${formatNumber(low)} to ${formatNumber(high)} ${unit}`;
    const picture = svg('svg', {viewBox: `0 0 ${size.width} ${size.height}`, role: 'img', 'aria-label': summary},
      svg('image', {href: canvas.toDataURL(), x: size.left, y: size.top, width: inner.width, height: inner.height, preserveAspectRatio: 'none'}),
      svg('path', {class: 'axes', d: `M${size.left} ${size.top}v${inner.height}h${inner.width}`}),
      ...ticks(first, last, 6).map(tick => label({x: x(tick), y: size.height - size.bottom + 14}, formatNumber(tick))),
      ...ticks(0, deepest, 4).map(tick => label({x: size.left - 5, y: y(tick) + 4, anchor: 'end'}, formatNumber(tick))),
      label({x: size.left + inner.width / 2, y: size.height - 6}, 'time since first contact, s'),
      label({x: 12, y: size.top + inner.height / 2, turn: true}, 'depth below the top face, mm'));
    const ramp = el('span', {class: 'strip'});
    ramp.style.background = `linear-gradient(90deg, ${map.map(css).join(', ')})`;
    this.host.replaceChildren(picture, el('div', {class: 'bar'}, el('span', {}, formatNumber(low)), ramp,
      el('span', {}, `${formatNumber(high)}${unit ? ` ${unit}` : ''}`)));
  }
}
