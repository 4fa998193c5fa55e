// How much each factor changes a number: a bar from nothing to the effect, its interval across it, the largest on top.
import {formatNumber} from './chart';
import {button, downloadText, el, menu, svg} from './dom';
import {Table} from './table';

export interface Effect {
  name: string;    // "press.speed_m_s: 16 against 4"
  percent: number; // of the reference
  low: number;     // NaN: no interval
  high: number;
  n: number;
}

const rowHeight = 30, labelWidth = 280, width = 790, right = 70;

export class Tornado {
  readonly element: HTMLElement;
  private readonly host: HTMLElement;
  private readonly note: HTMLElement;
  private effects: Effect[] = [];

  constructor(id: string, title: string) {
    this.host = el('div', {class: 'tornado', tabindex: 0, role: 'group', 'aria-label': title});
    this.note = el('p', {class: 'note'});
    this.element = el('figure', {class: 'card chart wide', id: `chart-${id}`, 'data-chart': id},
      el('figcaption', {}, el('h3', {}, title), menu(`${title}: downloads`,
        button('CSV', `${title}: download the data as CSV`, () => downloadText(`${id}.csv`, 'text/csv', this.table().csv())),
        button('SVG', `${title}: download the picture as SVG`, () =>
          downloadText(`${id}.svg`, 'image/svg+xml', new XMLSerializer().serializeToString(this.host.querySelector('svg')!))))),
      this.note, this.host);
  }

  table(): Table {
    return new Table(['effect', 'percent', 'low_percent', 'high_percent', 'n'],
      this.effects.map(e => [e.name, ...[e.percent, e.low, e.high, e.n].map(String)]));
  }

  show(effects: Effect[], note: string): void {
    this.effects = [...effects].sort((a, b) => Math.abs(b.percent) - Math.abs(a.percent));
    this.note.textContent = note;
    const ends = this.effects.flatMap(e => [e.percent, e.low, e.high]).filter(Number.isFinite);
    const low = Math.min(0, ...ends), high = Math.max(0, ...ends);
    const scale = (width - labelWidth - right) / Math.max(1e-9, high - low);
    const x = (percent: number) => labelWidth + (percent - low) * scale;
    const height = rowHeight * this.effects.length + 26;
    const words = this.effects.map(e => `${e.name} ${formatNumber(e.percent)} %`).join('; ');
    const picture = svg('svg', {viewBox: `0 0 ${width} ${height}`, width, height, role: 'img', 'aria-label': `Effects: ${words}`, xmlns: 'http://www.w3.org/2000/svg',
                                'font-family': 'system-ui, sans-serif', 'font-size': 13});
    this.effects.forEach((e, i) => {
      const y = rowHeight * i + rowHeight / 2 + 4;
      const sure = Number.isFinite(e.low) && (e.low > 0 || e.high < 0);
      const from = Math.min(x(0), x(e.percent));
      picture.append(
        svg('text', {x: labelWidth - 10, y: y + 4, 'text-anchor': 'end', class: 'label'}, e.name.length > 38 ? `${e.name.slice(0, 37)}…` : e.name),
        svg('rect', {x: from, y: y - 8, width: Math.max(1, Math.abs(x(e.percent) - x(0))), height: 16, class: sure ? 'bar' : 'bar unsure'}));
      if (Number.isFinite(e.low)) picture.append(svg('path', {d: `M${x(e.low)} ${y}H${x(e.high)}M${x(e.low)} ${y - 5}v10M${x(e.high)} ${y - 5}v10`, class: 'whisker'}));
      const end = Math.max(x(0), x(e.percent), Number.isFinite(e.high) ? x(e.high) : 0);
      picture.append(svg('text', {x: end + 6, y: y + 4, class: 'value'}, `${e.percent > 0 ? '+' : ''}${formatNumber(Number(e.percent.toPrecision(3)))} %`.replace('-', '−')));
    });
    picture.append(svg('path', {d: `M${x(0)} 2V${height - 20}`, class: 'zero'}),
                   svg('text', {x: x(0), y: height - 6, 'text-anchor': 'middle', class: 'value'}, 'no effect'));
    this.host.replaceChildren(picture);
  }
}
