// The section of a panel through its pressing: drawn on a canvas, moved and magnified by pointer, touch and keys, played as a
// film, coloured by what the reader chooses, with the density profile beside it at the same height scale.
import {Chart} from './chart';
import {css, interpolate, plasma} from './colour';
import {byStrand, cellPixels, colouringsOf, fieldPixels, kindColour, strandPixels, type Colouring} from './colouring';
import {button, choice, download, downloadText, el, menu} from './dom';
import {valueOf, type Film, type Frame} from './frames';
import {profileOf} from './profile';
import {drawCells, type Canvas} from './raster';
import type {SlipState} from './slip';
import {Table} from './table';
import {colour, onThemeChange} from './theme';

export interface SectionOptions {
  id: string;       // names the downloads
  kinds: string[];  // in the order of the case, for their colours
  stressAt?: (time_ms: number) => number | undefined;  // MPa
  slips?: SlipState[];  // of the states that were tested
  // Density profile of the full state at a compaction, heights over the bottom face.
  measuredProfile?: (compaction: number) => {label: string; y_mm: number[]; density_kg_m3: number[]} | undefined;
}

const margin = {left: 42, right: 10, top: 14, bottom: 38};  // css pixels around the plot
const platen = 9;
const secondsPerFrame = 0.12;
const slices = 80;
const hint = 'Point at a strand to read its values. Double click or + magnifies, dragging or the arrow keys move the section; ' +
             'N and P step through the strands.';
const glueColour = '#ff2d95';

// A scale of colours. Values beyond an end that is cut have the colour of that end.
type Ramp = Pick<Colouring, 'label' | 'map' | 'low' | 'high' | 'cutsLow' | 'cutsHigh'>;

function ticks(low: number, high: number, count: number): number[] {
  const raw = (high - low) / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = ([1, 2, 5, 10].find(f => f * power >= raw) ?? 10) * power;
  const at: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) at.push(Number((k * step).toPrecision(12)));
  return at;
}

export class SectionView {
  readonly element: HTMLElement;
  readonly canvas: HTMLCanvasElement;
  private readonly raster = document.createElement('canvas');
  private readonly slider: HTMLInputElement;
  private readonly status: HTMLOutputElement;
  private readonly playButton: HTMLButtonElement;
  private readonly readout: HTMLElement;
  private readonly bubble: HTMLElement;
  private readonly bar: HTMLElement;
  private readonly stage: HTMLElement;
  private readonly profile: Chart;
  private colourings: Colouring[];
  private fitColours = false;  // to the frame, else to the film
  private cells: Canvas = {width: 0, height: 0, pixels: new Uint32Array(0), cells: new Int32Array(0)};
  private index: number;
  private colouring = 0;  // index of colourings, -1 by strand
  private showGlue = false;
  private stretch = 1;
  private stretchChosen = false;
  private zoom = 1;
  private centre = {x: 0, y: 0};  // mm
  private selected = -1;
  private timer = 0;
  private pending = 0;

  constructor(private readonly film: Film, private readonly options: SectionOptions) {
    this.colourings = colouringsOf(film);
    this.index = film.frames.length - 1;
    this.canvas = el('canvas', {
      class: 'section', tabindex: 0, role: 'application', 'aria-roledescription': 'section view',
      'aria-label': 'Section of the panel. Arrow keys move it, plus and minus magnify, 0 shows all of it, N and P step through ' +
                    'the strands, comma and full stop through the compactions.',
    });
    this.bubble = el('div', {class: 'bubble', hidden: true});
    this.readout = el('p', {class: 'readout', 'aria-live': 'polite'}, hint);
    this.bar = el('div', {class: 'colour-bar'});
    this.status = el('output', {class: 'status'});
    this.slider = el('input', {
      type: 'range', min: 0, max: film.frames.length - 1, step: 1, value: this.index, 'aria-label': 'Compaction',
      input: () => this.show(Number(this.slider.value)),
    });
    this.playButton = button('▶', 'Play the pressing', () => (this.timer ? this.stop() : this.play()));
    this.playButton.classList.add('play');
    this.profile = new Chart({
      id: `${options.id}-profile`, title: 'Density through the thickness', xLabel: 'density, kg/m³', yLabel: '', series: [],
      table: new Table([], []), summary: 'Mean density of slices of the panel, voids included.', bare: true, item: true,
      grid: {left: 8, right: 12, top: margin.top + platen, bottom: margin.bottom + platen},
    });
    this.profile.host.className = 'plot profile';
    this.profile.host.dataset['chart'] = `${options.id}-profile`;
    this.stage = el('div', {class: 'stage'}, this.canvas, this.profile.host, this.bubble);
    this.element = el('div', {class: 'card section-view'}, this.toolbar(), this.stage,
      el('div', {class: 'player'}, this.playButton, this.slider, this.status), this.bar, this.readout);
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.stage);
    onThemeChange(() => this.redraw());
    this.reset();
  }

  private get frame(): Frame {
    return this.film.frames[this.index]!;
  }

  private toolbar(): HTMLElement {
    const select = el('select', {change: () => this.colourBy(select.value)},
      ...this.colourings.map(c => el('option', {value: c.key}, c.label)), el('option', {value: byStrand}, 'Strand'));
    const fit = el('input', {type: 'checkbox', change: () => {
      this.fitColours = fit.checked;
      if (!fit.checked) this.colourings = colouringsOf(this.film);
      this.redraw();
    }});
    const glue = el('input', {type: 'checkbox', change: () => {
      this.showGlue = glue.checked;
      this.redraw();
    }});
    this.stretch = 0;
    return el('div', {class: 'toolbar'},
      el('label', {}, 'Colour by ', select),
      choice('Heights', [1, 2, 4].map(n => ({value: String(n), label: n === 1 ? 'true' : `×${n}`})), '', value => {
        this.stretch = Number(value);
        this.stretchChosen = true;
        this.resize();
      }),
      el('label', {class: 'check', title: 'Colours span the values of this compaction, not of the whole pressing'}, fit, 'Fit colours'),
      el('label', {class: 'check'}, glue, 'Glue lines'),
      menu('Picture: magnify, download',
        button('−', 'Magnify less', () => this.magnify(1 / 1.5)), button('+', 'Magnify more', () => this.magnify(1.5)),
        button('Fit', 'Fit: show the whole section', () => this.reset()),
        button('PNG', 'Download this picture as PNG', () => this.downloadPng()),
        button('Profile CSV', 'Profile CSV: download the density profile', () => this.profile.downloadCsv()),
        button('Profile SVG', 'Profile SVG: download the density profile', () =>
          downloadText(`${this.profile.spec.id}.svg`, 'image/svg+xml', this.profile.svg()))));
  }

  // ---- what is shown

  show(index: number): void {
    this.index = Math.min(this.film.frames.length - 1, Math.max(0, index));
    this.redraw();
  }

  colourBy(key: string): void {
    this.colouring = this.colourings.findIndex(c => c.key === key);
    this.redraw();
  }

  private play(): void {
    if (this.index === this.film.frames.length - 1) this.show(0);
    let last = performance.now();
    const tick = (now: number) => {
      this.timer = requestAnimationFrame(tick);
      if (now - last < 1000 * secondsPerFrame) return;
      last = now;
      if (this.index === this.film.frames.length - 1) this.stop();
      else this.show(this.index + 1);
    };
    this.timer = requestAnimationFrame(tick);
    this.namePlayButton();
  }

  private stop(): void {
    cancelAnimationFrame(this.timer);
    this.timer = 0;
    this.namePlayButton();
  }

  private namePlayButton(): void {
    const title = this.timer ? 'Stop' : 'Play the pressing';
    this.playButton.textContent = this.timer ? '❚❚' : '▶';
    this.playButton.title = title;
    this.playButton.setAttribute('aria-label', title);
  }

  private reset(): void {
    this.zoom = 1;
    this.centre = {x: this.film.length_mm / 2, y: this.film.initial_thickness_mm / 2};
    this.resize();
  }

  // ---- geometry, css pixels

  private get width(): number {
    return this.canvas.clientWidth;
  }
  private get height(): number {
    return this.canvas.clientHeight;
  }
  private get xScale(): number {
    return (Math.max(50, this.width - margin.left - margin.right) / this.film.length_mm) * this.zoom;
  }
  private get yScale(): number {
    return this.xScale * this.stretch;
  }
  private toX(mm: number): number {
    return (margin.left + this.width - margin.right) / 2 + (mm - this.centre.x) * this.xScale;
  }
  private toY(mm: number): number {
    return (margin.top + this.height - margin.bottom) / 2 - (mm - this.centre.y) * this.yScale;
  }
  private fromX(px: number): number {
    return this.centre.x + (px - (margin.left + this.width - margin.right) / 2) / this.xScale;
  }
  private fromY(px: number): number {
    return this.centre.y - (px - (margin.top + this.height - margin.bottom) / 2) / this.yScale;
  }

  private plotHeight(stretch: number): number {
    const wide = Math.max(50, this.width - margin.left - margin.right);
    return (wide / this.film.length_mm) * this.film.initial_thickness_mm * stretch;
  }

  private resize(): void {
    if (this.width === 0) return;
    if (!this.stretchChosen) {
      this.stretch = [4, 2].find(s => this.plotHeight(s) <= 340) ?? 1;
      const radio = this.element.querySelector<HTMLInputElement>(`.choice input[value="${this.stretch}"]`);
      if (radio) radio.checked = true;
    }
    const plot = Math.min(560, Math.max(70, this.plotHeight(this.stretch)));
    this.stage.style.height = `${Math.round(plot + margin.top + margin.bottom + 2 * platen)}px`;
    this.clamp();
    this.redraw();
  }

  // Keeps part of the panel in sight.
  private clamp(): void {
    const within = (value: number, size: number) => Math.min(size, Math.max(0, value));
    this.centre.x = within(this.centre.x, this.film.length_mm);
    this.centre.y = within(this.centre.y, this.film.initial_thickness_mm);
  }

  private magnify(factor: number, px = this.width / 2, py = (margin.top + this.height - margin.bottom) / 2): void {
    const x = this.fromX(px), y = this.fromY(py);
    this.zoom = Math.min(60, Math.max(1, this.zoom * factor));
    if (this.zoom === 1) return this.reset();
    this.centre.x += x - this.fromX(px);
    this.centre.y += y - this.fromY(py);
    this.clamp();
    this.redraw();
  }

  private pan(dx: number, dy: number): void {
    this.centre.x -= dx / this.xScale;
    this.centre.y += dy / this.yScale;
    this.clamp();
    this.redraw();
  }

  // ---- reader's hands

  private listen(): void {
    const pointers = new Map<number, {x: number; y: number}>();
    const spread = () => {
      const [a, b] = [...pointers.values()];
      return a && b ? {size: Math.hypot(a.x - b.x, a.y - b.y), x: (a.x + b.x) / 2, y: (a.y + b.y) / 2} : undefined;
    };
    const canvas = this.canvas;
    canvas.addEventListener('pointerdown', event => {
      canvas.setPointerCapture(event.pointerId);
      pointers.set(event.pointerId, {x: event.offsetX, y: event.offsetY});
      this.hover(event.offsetX, event.offsetY);
    });
    canvas.addEventListener('pointermove', event => {
      const before = pointers.get(event.pointerId);
      const now = {x: event.offsetX, y: event.offsetY};
      if (!before) return this.hover(now.x, now.y);
      const old = spread();
      pointers.set(event.pointerId, now);
      const pinch = spread();
      if (old && pinch) this.magnify(pinch.size / Math.max(1, old.size), pinch.x, pinch.y);
      else if (this.zoom > 1) this.pan(now.x - before.x, now.y - before.y);
      if (!pinch) this.hover(now.x, now.y);
    });
    const up = (event: PointerEvent) => pointers.delete(event.pointerId);
    canvas.addEventListener('pointerup', up);
    canvas.addEventListener('pointercancel', up);
    canvas.addEventListener('pointerleave', () => this.select(-1));
    canvas.addEventListener('dblclick', event => this.magnify(2, event.offsetX, event.offsetY));
    canvas.addEventListener('wheel', event => {
      // The page scrolls unless the reader is at work in the picture.
      if (!event.ctrlKey && document.activeElement !== canvas) return;
      event.preventDefault();
      this.magnify(Math.exp(-event.deltaY * (event.ctrlKey ? 0.01 : 0.0015)), event.offsetX, event.offsetY);
    }, {passive: false});
    canvas.addEventListener('keydown', event => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 40;
    const act: Record<string, () => void> = {
      ArrowLeft: () => this.pan(step, 0), ArrowRight: () => this.pan(-step, 0),
      ArrowUp: () => this.pan(0, step), ArrowDown: () => this.pan(0, -step),
      '+': () => this.magnify(1.5), '=': () => this.magnify(1.5), '-': () => this.magnify(1 / 1.5), '0': () => this.reset(),
      n: () => this.stepStrand(1), p: () => this.stepStrand(-1),
      '.': () => this.show(this.index + 1), ',': () => this.show(this.index - 1),
      Escape: () => this.select(-1),
    };
    const action = act[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action) return;
    event.preventDefault();
    action();
  }

  private stepStrand(step: number): void {
    const count = this.film.strands.length;
    const strand = this.selected < 0 ? (step > 0 ? 0 : count - 1) : (this.selected + step + count) % count;
    const s = this.film.strands[strand]!;
    this.select(strand);
    this.readout.textContent = this.describe(s.firstCell + Math.floor(s.through / 2) * s.along + Math.floor(s.along / 2));
  }

  private select(strand: number): void {
    this.bubble.hidden = true;
    if (strand < 0) this.readout.textContent = hint;
    if (strand === this.selected) return;
    this.selected = strand;
    this.redraw();
  }

  private hover(x: number, y: number): void {
    const ratio = this.cells.width / Math.max(1, this.width);
    const column = Math.floor(x * ratio), row = Math.floor(y * ratio);
    const inside = column >= 0 && row >= 0 && column < this.cells.width && row < this.cells.height;
    const cell = inside ? (this.cells.cells[row * this.cells.width + column] ?? -1) : -1;
    if (cell < 0) return this.select(-1);
    this.select(this.film.strandOfCell[cell]!);
    const text = this.describe(cell);
    this.readout.textContent = text;
    this.bubble.textContent = text.replace(/ · /g, '\n');
    this.bubble.hidden = false;
    const left = Math.min(x + 14, this.stage.clientWidth - this.bubble.offsetWidth - 4);
    this.bubble.style.left = `${Math.max(4, left)}px`;
    this.bubble.style.top = `${y + 18}px`;
  }

  // The strand and its values at a cell, parts separated by " · ".
  private describe(cell: number): string {
    const number = this.film.strandOfCell[cell]!;
    const strand = this.film.strands[number]!;
    const values = this.colourings.map((c, i) => {
      const field = this.film.fields[i]!;
      const byte = this.frame.fields[i]![cell]!;
      const beyond = byte === 255 ? '≥ ' : byte === 0 && field.low !== 0 ? '≤ ' : '';
      return `${c.label.toLowerCase()} ${beyond}${valueOf(field, byte).toFixed(c.digits).replace('-', '−')}${c.unit === '°' ? '' : ' '}${c.unit}`.trim();
    });
    return [`Strand ${number}: ${strand.kind}, row ${strand.row}, laid at ${strand.angle_deg}°`, ...values].join(' · ');
  }

  // ---- drawing

  private redraw(): void {
    if (this.pending) return;
    this.pending = requestAnimationFrame(() => {
      this.pending = 0;
      if (this.width > 0) this.draw();
    });
  }

  private draw(): void {
    const ratio = Math.min(2, window.devicePixelRatio || 1);
    const width = Math.round(this.width * ratio), height = Math.round(this.height * ratio);
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = this.raster.width = width;
      this.canvas.height = this.raster.height = height;
    }
    if (this.fitColours) this.colourings = colouringsOf(this.film, [this.frame]);
    this.drawRaster(width, height, ratio);
    const context = this.canvas.getContext('2d')!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.save();
    context.beginPath();
    context.rect(margin.left, margin.top, this.width - margin.left - margin.right, this.height - margin.top - margin.bottom);
    context.clip();
    this.drawPress(context);
    context.drawImage(this.raster, 0, 0, this.width, this.height);
    this.drawOutlines(context);
    if (this.showGlue) this.drawGlue(context);
    context.restore();
    this.drawAxes(context);
    this.drawProfile();
    this.drawBar();
    this.say();
  }

  private drawRaster(width: number, height: number, ratio: number): void {
    const image = new ImageData(width, height);
    const index = this.colouring;
    const table = index < 0 ? strandPixels(this.film, this.options.kinds)
                            : fieldPixels(this.film, index, this.colourings[index]!);
    this.cells = {width, height, pixels: new Uint32Array(image.data.buffer), cells: new Int32Array(width * height).fill(-1)};
    drawCells(this.cells, this.film, this.frame,
      {x0: this.toX(0) * ratio, y0: this.toY(0) * ratio, xScale: this.xScale * ratio, yScale: -this.yScale * ratio},
      cellPixels(this.film, this.frame, index, table));
    this.raster.getContext('2d')!.putImageData(image, 0, 0);
  }

  // Platens, and the colour of voids between them.
  private drawPress(context: CanvasRenderingContext2D): void {
    const left = this.toX(0), wide = this.toX(this.film.length_mm) - left;
    const top = this.toY(this.frame.top_mm), bottom = this.toY(this.frame.bottom_mm);
    context.fillStyle = colour('void');
    context.fillRect(left, top, wide, bottom - top);
    context.fillStyle = colour('platen');
    context.fillRect(left, top - platen, wide, platen);
    context.fillRect(left, bottom, wide, platen);
  }

  private outline(context: CanvasRenderingContext2D, strand: number): void {
    const s = this.film.strands[strand]!;
    const {corners} = this.frame;
    const row = s.along + 1;
    const to = (i: number, j: number) => {
      const c = 2 * (s.firstCorner + j * row + i);
      context.lineTo(this.toX(corners[c]!), this.toY(corners[c + 1]!));
    };
    const first = 2 * s.firstCorner;
    context.moveTo(this.toX(corners[first]!), this.toY(corners[first + 1]!));
    for (let i = 1; i <= s.along; ++i) to(i, 0);
    for (let j = 1; j <= s.through; ++j) to(s.along, j);
    for (let i = s.along - 1; i >= 0; --i) to(i, s.through);
    for (let j = s.through - 1; j > 0; --j) to(0, j);
    context.closePath();
  }

  private drawOutlines(context: CanvasRenderingContext2D): void {
    context.beginPath();
    for (let i = 0; i < this.film.strands.length; ++i) this.outline(context, i);
    context.lineWidth = Math.min(1.2, 0.35 + 0.05 * this.yScale * 0.4);
    context.strokeStyle = 'rgb(20 20 20 / 0.75)';
    context.stroke();
    if (this.selected < 0) return;
    context.beginPath();
    this.outline(context, this.selected);
    for (const [width, paint] of [[4, '#000'], [2, '#fff']] as const) {
      context.lineWidth = width;
      context.strokeStyle = paint;
      context.stroke();
    }
  }

  // The tested state that is on show, if it is one.
  private get slip(): SlipState | undefined {
    return this.options.slips?.find(state => Math.abs(state.compaction - this.frame.compaction) < 0.005);
  }

  private drawSlip(context: CanvasRenderingContext2D, state: SlipState): void {
    const width = Math.min(6, 1.6 + 0.07 * this.yScale);
    context.lineCap = 'round';
    for (const {points, slip_um} of state.lines) {
      for (let i = 0; i + 1 < slip_um.length; ++i) {
        context.beginPath();
        context.moveTo(this.toX(points[2 * i]!), this.toY(points[2 * i + 1]!));
        context.lineTo(this.toX(points[2 * i + 2]!), this.toY(points[2 * i + 3]!));
        context.strokeStyle = css(interpolate(plasma, (slip_um[i]! + slip_um[i + 1]!) / 2 / state.highest_um));
        context.lineWidth = width;
        context.stroke();
      }
    }
  }

  private drawGlue(context: CanvasRenderingContext2D): void {
    const state = this.slip;
    if (state) return this.drawSlip(context, state);
    context.beginPath();
    for (const line of this.frame.glue) {
      const {points} = line;
      for (let i = 0; i < points.length; i += 2) {
        const x = this.toX(points[i]!), y = this.toY(points[i + 1]!);
        if (i === 0) context.moveTo(x, y);
        else context.lineTo(x, y);
      }
    }
    context.lineWidth = Math.min(3, 1 + 0.04 * this.yScale);
    context.strokeStyle = glueColour;
    context.stroke();
  }

  private drawAxes(context: CanvasRenderingContext2D): void {
    const foot = this.height - margin.bottom;
    context.fillStyle = context.strokeStyle = colour('ink-soft');
    context.font = '12px system-ui, sans-serif';
    context.lineWidth = 1;
    context.beginPath();
    context.textAlign = 'center';
    context.textBaseline = 'top';
    const x0 = Math.max(0, this.fromX(margin.left)), x1 = Math.min(this.film.length_mm, this.fromX(this.width - margin.right));
    for (const x of ticks(x0, x1, Math.max(2, (this.width - margin.left) / 90))) {
      context.moveTo(this.toX(x), foot);
      context.lineTo(this.toX(x), foot + 5);
      context.fillText(String(x), this.toX(x), foot + 7);
    }
    context.fillText('x, mm', (margin.left + this.width - margin.right) / 2, foot + 22);
    context.textAlign = 'right';
    context.textBaseline = 'middle';
    for (const y of ticks(this.fromY(foot), this.fromY(margin.top), (foot - margin.top) / 40)) {
      if (y < -1e-9) continue;
      context.moveTo(margin.left, this.toY(y));
      context.lineTo(margin.left - 5, this.toY(y));
      context.fillText(String(y), margin.left - 8, this.toY(y));
    }
    context.stroke();
    context.save();
    context.translate(9, (margin.top + foot) / 2);
    context.rotate(-Math.PI / 2);
    context.textAlign = 'center';
    context.fillText('y, mm', 0, 0);
    context.restore();
  }

  private drawProfile(): void {
    const now = profileOf(this.film, this.frame, slices);
    const measured = this.options.measuredProfile?.(this.frame.compaction);
    const bottom = this.frame.bottom_mm;
    const row = (of: string, y: number, density: number) => [of, ...[this.frame.compaction, y, density].map(v => String(Number(v.toPrecision(6))))];
    const rows = [...now.y_mm.map((y, i) => row('film', y, now.density_kg_m3[i]!)),
                  ...(measured?.y_mm.map((y, i) => row(measured.label, y + bottom, measured.density_kg_m3[i]!)) ?? [])];
    const highest = Math.max(...this.film.fields.filter(f => f.key === 'density_kg_m3').map(f => f.high), 1);
    this.profile.update({
      series: [
        {name: 'film', x: now.density_kg_m3, y: now.y_mm, colour: colour('accent')},
        ...(measured ? [{name: measured.label, x: measured.density_kg_m3, y: measured.y_mm.map(y => y + bottom), style: 'dashed' as const, ink: true}] : []),
      ],
      table: new Table(['of', 'compaction', 'y_mm', 'density_kg_m3'], rows),
      x: {min: 0, max: Math.ceil(highest / 200) * 200},
      xLabel: this.width < 420 ? 'kg/m³' : 'density, kg/m³',
      y: {min: this.fromY(this.height - margin.bottom - platen), max: this.fromY(margin.top + platen), hidden: true},
    });
  }

  private say(): void {
    const frame = this.frame;
    this.slider.value = String(this.index);
    const parts = [`${(100 * Math.max(0, frame.compaction)).toFixed(1)} % compaction`, `${(frame.top_mm - frame.bottom_mm).toFixed(2)} mm thick`];
    const stress = this.options.stressAt?.(frame.time_ms);
    if (stress !== undefined) parts.push(`${stress.toFixed(2)} MPa`);
    this.status.textContent = parts.join(' · ');
    this.slider.setAttribute('aria-valuetext', parts.join(', '));
    this.canvas.dataset['frame'] = String(this.index);
  }

  private ramp(r: Ramp): HTMLElement {
    const strip = el('div', {class: 'strip'});
    strip.style.background = `linear-gradient(90deg, ${Array.from({length: 17}, (_, i) => css(interpolate(r.map, i / 16))).join(', ')})`;
    const scale = el('div', {class: 'scale'}, ...ticks(r.low, r.high, 5).map(value => {
      const tick = el('span', {}, String(value).replace('-', '−'));
      tick.style.left = `${(100 * (value - r.low)) / (r.high - r.low)}%`;
      return tick;
    }));
    const arrow = (shown: boolean, end: 'low' | 'high') => shown &&
      el('span', {class: `beyond ${end}`, title: `Values ${end === 'low' ? 'below' : 'above'} the scale have this colour`}, end === 'low' ? '◀' : '▶');
    return el('div', {class: 'key'}, el('span', {class: 'quantity'}, r.label),
      el('div', {class: 'ramp'}, arrow(r.cutsLow, 'low'), strip, arrow(r.cutsHigh, 'high'), scale));
  }

  // Scales and swatches of what is drawn, for the page and for the exported picture.
  private legends(): {ramps: Ramp[]; swatches: [colour: string, name: string][]} {
    const c = this.colourings[this.colouring];
    const ramps: Ramp[] = c ? [{...c, label: c.unit ? `${c.label}, ${c.unit}` : c.label}] : [];
    const swatches = c ? [] : this.options.kinds.map((kind, i): [string, string] => [kindColour(i), kind]);
    const state = this.showGlue ? this.slip : undefined;
    if (state) {
      ramps.push({label: `Slip of glue lines of ${state.glue ?? `1/Dₜ ${state.compliance_t_mm_per_MPa} mm/MPa`} in tension, µm at ${100 * state.strain} % strain`,
                  map: plasma, low: 0, high: state.highest_um, cutsLow: false, cutsHigh: true});
    } else if (this.showGlue) {
      swatches.push([glueColour, 'faces near enough to be glued']);
    }
    return {ramps, swatches};
  }

  // What the colours mean.
  private drawBar(): void {
    const {ramps, swatches} = this.legends();
    this.bar.replaceChildren(...ramps.map(r => this.ramp(r)), ...swatches.map(([paint, name]) => {
      const swatch = el('i', {});
      swatch.style.background = paint;
      return el('span', {class: 'kind'}, swatch, name);
    }));
  }

  // The picture as it is shown, with its legends and caption.
  downloadPng(): void {
    const ratio = this.canvas.width / this.width;
    const {ramps, swatches} = this.legends();
    const line = 36;
    const extra = 22 + line * (ramps.length + (swatches.length > 0 ? 1 : 0));
    const picture = el('canvas', {width: this.canvas.width, height: this.canvas.height + Math.round(extra * ratio)});
    const context = picture.getContext('2d')!;
    context.fillStyle = colour('card');
    context.fillRect(0, 0, picture.width, picture.height);
    context.drawImage(this.canvas, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.fillStyle = colour('ink');
    context.font = '13px system-ui, sans-serif';
    context.fillText(this.status.textContent ?? '', margin.left, this.height + 14);
    const left = margin.left + 12, wide = 220;
    let top = this.height + 24;
    for (const r of ramps) {
      this.paintRamp(context, r, left, top, wide);
      top += line;
    }
    let x = left;
    for (const [paint, name] of swatches) {
      context.fillStyle = paint;
      context.fillRect(x, top, 12, 12);
      context.fillStyle = colour('ink');
      context.fillText(name, x + 18, top + 11);
      x += 34 + context.measureText(name).width;
    }
    picture.toBlob(blob => blob && download(`${this.options.id}-${this.index}.png`, blob));
  }

  private paintRamp(context: CanvasRenderingContext2D, r: Ramp, left: number, top: number, wide: number): void {
    for (let i = 0; i < wide; ++i) {
      context.fillStyle = css(interpolate(r.map, i / wide));
      context.fillRect(left + i, top, 1.5, 10);
    }
    context.fillStyle = colour('ink');
    context.fillText(String(Number(r.low.toPrecision(3))), left, top + 24);
    context.fillText(r.label, left + wide + 20, top + 10);
    if (r.cutsHigh) context.fillText('▶', left + wide + 2, top + 10);
    context.textAlign = 'right';
    context.fillText(String(Number(r.high.toPrecision(3))), left + wide, top + 24);
    if (r.cutsLow) context.fillText('◀', left - 1, top + 10);
    context.textAlign = 'left';
  }
}
