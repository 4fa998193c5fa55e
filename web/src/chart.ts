// One generic chart: lines, dashed reference lines, points, steps or areas over a numeric axis, with its table to download. A
// report of any kind makes its charts from this.
import * as echarts from 'echarts/core';
import {LineChart, ScatterChart} from 'echarts/charts';
import {AriaComponent, GridComponent, LegendComponent, TooltipComponent} from 'echarts/components';
import {LabelLayout} from 'echarts/features';
import {SVGRenderer} from 'echarts/renderers';
import {button, downloadText, el, menu} from './dom';
import {family, okabeIto, readable} from './colour';
import type {Table} from './table';
import {colour, isDark, onThemeChange} from './theme';

echarts.use([LineChart, ScatterChart, GridComponent, LegendComponent, TooltipComponent, AriaComponent, LabelLayout, SVGRenderer]);

export interface Series {
  name: string;
  x: number[];
  y: number[];
  style?: 'line' | 'marked' | 'dashed' | 'steps' | 'area';
  // A band about the line, drawn paler: from low to high at each x.
  low?: number[];
  high?: number[];
  // Place in an ordered family (light to dark), else a colour of its own; 'ink' for references.
  family?: [index: number, count: number];
  ink?: boolean;
  colour?: string;
}

export interface ChartSpec {
  id: string;  // unique in the page; also the name of the downloads
  title: string;
  note?: string;
  xLabel: string;
  yLabel: string;
  series: Series[];
  table: Table;
  summary: string;  // for those who cannot see it
  x?: {min?: number; max?: number};
  y?: {min?: number; max?: number; hidden?: boolean};
  bare?: boolean;  // the plot alone, without title and buttons
  labels?: boolean;  // names stand at the ends of the lines, in place of a legend
  item?: boolean;  // a curve that is not a function of x: tell its points one by one
  grid?: {left?: number; right?: number; top?: number; bottom?: number};
}

// Charts of the page by id, for tests and for the curious in a console.
export const charts = new Map<string, Chart>();

const symbols = ['circle', 'rect', 'triangle', 'diamond', 'roundRect', 'pin'];
const dashes: (number[] | 'dashed')[] = [[7, 4], [2, 3], [10, 3, 2, 3], [4, 4]];

export function formatNumber(value: number): string {
  if (!Number.isFinite(value)) return '–';
  if (value !== 0 && (Math.abs(value) < 1e-3 || Math.abs(value) >= 1e6)) return value.toExponential(2).replace('e', '·10^');
  return Number(value.toPrecision(4)).toLocaleString('en', {maximumFractionDigits: 6}).replace(/,/g, narrowSpace);
}
const narrowSpace = '\u202f';  // does not break

const bandMark = '\u200b';  // ends the names of what is not told

interface Pointed {
  seriesName?: string;
  color?: string;
  value: [number, number];
}

export class Chart {
  readonly element: HTMLElement;
  readonly host: HTMLElement;
  private readonly chart: echarts.ECharts;

  constructor(public spec: ChartSpec) {
    this.host = el('div', {class: 'plot'});
    const tools = menu(`${spec.title}: downloads`,
      button('CSV', `${spec.title}: download the data as CSV`, () => this.downloadCsv()),
      button('SVG', `${spec.title}: download the picture as SVG`, () => this.downloadSvg()));
    this.element = spec.bare ? this.host : el('figure', {class: 'card chart', id: `chart-${spec.id}`, 'data-chart': spec.id},
      el('figcaption', {}, el('h3', {}, spec.title), tools),
      spec.note ? el('p', {class: 'note'}, spec.note) : null, this.host);
    this.chart = echarts.init(this.host, null, {renderer: 'svg', width: 480, height: 300});
    this.render();
    charts.set(spec.id, this);
    new ResizeObserver(() => this.fit()).observe(this.host);
    onThemeChange(() => {
      this.fit();
      this.render();
    });
  }

  private fit(): void {
    const {clientWidth: width, clientHeight: height} = this.host;
    if (width > 0 && height > 0 && (width !== this.chart.getWidth() || height !== this.chart.getHeight())) {
      this.chart.resize({width, height});
      this.render();
    }
  }

  downloadCsv(): void {
    downloadText(`${this.spec.id}.csv`, 'text/csv', this.spec.table.csv());
  }

  downloadSvg(): void {
    downloadText(`${this.spec.id}.svg`, 'image/svg+xml', this.svg());
  }

  svg(): string {
    return this.chart.renderToSVGString();
  }

  update(change: Partial<ChartSpec>): void {
    this.spec = {...this.spec, ...change};
    this.render();
  }

  private render(): void {
    this.chart.setOption(this.option(), true);
  }

  private paint(s: Series, index: number): string {
    return s.ink ? colour('ink-soft') : readable(s.colour ??
      (s.family ? family(s.family[1], isDark())[s.family[0]]! : okabeIto[index % okabeIto.length]!), colour('card'), 3);
  }

  // Two lines that cannot be seen, the area between them filled.
  private band(s: Series, index: number): object[] {
    const {low, high} = s;
    if (!low || !high || !low.some(Number.isFinite)) return [];
    const common = {type: 'line', name: `${s.name}${bandMark}`, stack: `band ${index}`, stackStrategy: 'all', symbol: 'none', silent: true,
                    lineStyle: {opacity: 0}, itemStyle: {color: this.paint(s, index)}, z: 1, step: s.style === 'steps' ? 'end' : false};
    return [{...common, data: s.x.map((x, i) => [x, low[i]])},
            {...common, data: s.x.map((x, i) => [x, high[i]! - low[i]!]), areaStyle: {opacity: 0.22}}];
  }

  private series(s: Series, index: number): object {
    const paint = this.paint(s, index);
    // References without a name continue the one before.
    const references = this.spec.series.slice(0, index + 1).filter(other => other.style === 'dashed' && other.name !== '').length - 1;
    const style = s.style ?? 'line';
    return {
      type: 'line',
      name: s.name,
      data: s.x.map((x, i) => [x, s.y[i]]),
      step: style === 'steps' ? 'end' : false,
      showSymbol: style === 'marked' || s.x.length === 1 || !!this.spec.item,
      symbol: style === 'marked' || s.x.length === 1 || this.spec.item ? symbols[index % symbols.length] : 'none',
      symbolSize: this.spec.item ? 3 : 7,
      lineStyle: {
        width: style === 'dashed' ? 1.5 : 2,
        type: style === 'dashed' ? dashes[Math.max(0, references) % dashes.length] : 'solid',
      },
      areaStyle: style === 'area' ? {opacity: 0.25} : undefined,
      itemStyle: {color: paint},
      endLabel: this.spec.labels ? {
        show: true, formatter: s.name, color: readable(s.ink ? colour('ink') : paint, colour('card'), 4.5), distance: 8, fontSize: 12,
        width: this.labelWidth() - 12, overflow: 'truncate',
      } : undefined,
      labelLayout: this.spec.labels ? {moveOverlap: 'shiftY'} : undefined,
      emphasis: {focus: 'series'},
    };
  }

  // Room for names at the ends of lines.
  private labelWidth(): number {
    const longest = Math.max(...this.spec.series.map(s => s.name.length));
    return Math.min(20 + 6.6 * longest, this.chart.getWidth() * 0.36);
  }

  private told(points: Pointed | Pointed[]): HTMLElement {
    const {spec} = this;
    const list = Array.isArray(points) ? points : [points];
    const row = (point: Pointed) => {
      const swatch = el('i', {});
      swatch.style.background = point.color ?? '';
      const value = spec.item ? `${formatNumber(point.value[0])}, ${formatNumber(point.value[1])}` : formatNumber(point.value[1]);
      return el('div', {}, swatch, point.seriesName ?? '', ' ', el('b', {}, value));
    };
    return el('div', {class: 'pointed'}, spec.item ? `${spec.xLabel}; ${spec.yLabel || 'mm'}` : `${spec.xLabel}: ${formatNumber(list[0]?.value[0] ?? NaN)}`,
      ...list.filter(point => Number.isFinite(point.value[1]) && !point.seriesName?.endsWith(bandMark)).map(row));
  }

  // Beside the pointer, within the window.
  private place(point: number[], size: {contentSize: number[]}): number[] {
    const box = this.host.getBoundingClientRect();
    const [width, height] = size.contentSize as [number, number];
    const [px, py] = point as [number, number];
    const left = box.left + px + 16 + width < window.innerWidth - 8 ? px + 16 : px - 16 - width;
    const top = Math.min(py + 16, window.innerHeight - 8 - height - box.top);
    return [Math.max(left, 8 - box.left), Math.max(top, 8 - box.top)];
  }

  private option(): Record<string, unknown> {
    const {spec} = this;
    const ink = colour('ink');
    const soft = colour('ink-soft');
    const text = {color: soft, fontSize: 12, fontFamily: 'system-ui, sans-serif'};
    const narrow = this.chart.getWidth() < 420;
    const name = (label: string) => ({name: label, nameLocation: 'middle', nameTextStyle: text});
    const axis = {
      type: 'value', scale: true, axisLabel: {...text, hideOverlap: true}, axisLine: {show: true, lineStyle: {color: soft}},
      axisTick: {show: true, lineStyle: {color: soft}}, splitLine: {lineStyle: {color: colour('line')}},
    };
    // Lines near zero start at zero.
    const values = spec.series.flatMap(s => s.y).filter(Number.isFinite);
    const fromZero = Math.min(...values) > -0.02 * Math.max(...values) && Math.min(...values) < 0.25 * Math.max(...values);
    const named = spec.series.filter(s => s.name !== '');
    const rows = named.length > 1 && !spec.labels && !spec.bare ? Math.ceil(named.reduce((sum, s) => sum + 40 + 6.2 * Math.min(s.name.length, 28), 0) /
                                              Math.max(200, this.chart.getWidth() - 16)) : 0;
    return {
      animation: false,
      backgroundColor: 'transparent',
      textStyle: {fontFamily: 'system-ui, sans-serif'},
      aria: {enabled: true, label: {description: `${spec.title}. ${spec.summary}`}},
      grid: {left: 64, right: spec.labels ? this.labelWidth() : 18, top: 14 + 21 * rows, bottom: 46, ...spec.grid},
      legend: rows === 0 ? {show: false} : {
        left: 0, top: 0, width: this.chart.getWidth() - 8, itemWidth: 22, itemHeight: 9, itemGap: narrow ? 10 : 14,
        textStyle: {...text, color: ink}, inactiveColor: soft, data: named.map(s => ({name: s.name, itemStyle: {opacity: s.style === 'marked' ? 1 : 0}})),
        formatter: (label: string) => (label.length > 28 ? label.slice(0, 27) + '…' : label),
      },
      tooltip: {
        trigger: spec.item ? 'item' : 'axis', appendTo: 'body', backgroundColor: colour('raised'), borderColor: colour('line'),
        textStyle: {color: ink, fontSize: 12}, formatter: (points: Pointed | Pointed[]) => this.told(points),
        position: (point: number[], _: unknown, __: unknown, ___: unknown, size: {contentSize: number[]}) => this.place(point, size),
        axisPointer: {type: 'line', lineStyle: {color: soft}, snap: true,
                      label: {formatter: (p: {value: number}) => `${spec.xLabel}: ${formatNumber(p.value)}`}},
      },
      xAxis: {...axis, ...name(spec.xLabel), axisLabel: {...axis.axisLabel, ...(spec.labels ? {showMaxLabel: false} : {})}, nameGap: 28, min: spec.x?.min, max: spec.x?.max},
      yAxis: {
        ...axis, ...name(spec.yLabel), nameGap: 48, min: spec.y?.min ?? (fromZero ? 0 : undefined), max: spec.y?.max,
        ...(spec.y?.hidden ? {axisLabel: {show: false}, axisTick: {show: false}, splitLine: {show: false}} : {}),
      },
      series: [...spec.series.map((s, i) => this.series(s, i)), ...spec.series.flatMap((s, i) => this.band(s, i))],
    };
  }
}
