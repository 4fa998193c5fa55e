// What the section can be coloured by.
import {blueWhiteRed, cividis, interpolate, mix, ofHex, pixel, viridis, type Rgb} from './colour';
import {valueOf, type Film, type Frame} from './frames';

export interface Colouring {
  key: string;
  label: string;
  unit: string;
  digits: number;
  map: Rgb[];
  low: number;
  high: number;
  cutsLow: boolean;  // values lie beyond this end of the scale, in its colour
  cutsHigh: boolean;
}

// Colours of a field: those of one kind of quantity that can be told apart from the other maps on the page.
const maps: Record<string, Rgb[]> = {density_kg_m3: [...viridis].reverse(), plastic_strain: cividis};
function mapOf(field: {key: string; diverging: boolean}): Rgb[] {
  return field.diverging ? blueWhiteRed : maps[field.key] ?? viridis;
}

export const byStrand = 'strand';

function roundUp(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  for (const factor of [1, 1.5, 2, 3, 4, 5, 6, 8]) if (factor * power >= value * (1 - 1e-9)) return factor * power;
  return 10 * power;
}

// Round ends that leave out the extreme 2 % of all cells of these frames.
function shownRange(film: Film, frames: Frame[], index: number, diverging: boolean): [number, number] {
  const field = film.fields[index]!;
  const counts = new Float64Array(256);
  let total = 0;
  for (const frame of frames) {
    for (const byte of frame.fields[index]!) counts[byte]!++;
    total += film.cells;
  }
  const at = (share: number) => {
    let sum = 0;
    for (let byte = 0; byte < 256; ++byte) if ((sum += counts[byte]!) >= share * total) return valueOf(field, byte);
    return field.high;
  };
  const low = at(0.02), high = at(0.98);
  const least = (8 * (field.high - field.low)) / 255;  // steps of a byte are not to be seen
  if (diverging) {
    const limit = roundUp(Math.max(-low, high, least));
    return [-limit, limit];
  }
  const step = roundUp(Math.max(high - low, least) / 8);
  return [Math.floor(low / step + 1e-9) * step, Math.max(Math.ceil(high / step - 1e-9), Math.floor(low / step) + 1) * step];
}

// Colourings with ranges that suit these frames.
export function colouringsOf(film: Film, frames = film.frames): Colouring[] {
  return film.fields.map((field, index) => {
    const [low, high] = shownRange(film, frames, index, field.diverging);
    let least = 255, most = 0;
    for (const frame of frames) {
      for (const byte of frame.fields[index]!) {
        least = Math.min(least, byte);
        most = Math.max(most, byte);
      }
    }
    return {key: field.key, label: field.label, unit: field.unit, digits: field.digits, map: mapOf(field), low, high,
            cutsLow: valueOf(field, least) < low, cutsHigh: valueOf(field, most) > high};
  });
}

// Pixel colour of every byte of a field.
export function fieldPixels(film: Film, index: number, c: Colouring): Uint32Array {
  return Uint32Array.from({length: 256}, (_, byte) =>
    pixel(interpolate(c.map, (valueOf(film.fields[index]!, byte) - c.low) / (c.high - c.low))));
}

// Kinds of strands in colours of Okabe & Ito, wood-like first.
const kindColours = ['#e69f00', '#0072b2', '#009e73', '#cc79a7', '#d55e00', '#56b4e9'];
export function kindColour(kind: number): string {
  return kindColours[Math.max(0, kind) % kindColours.length]!;
}

// Strands in the colour of their kind, neighbours in a row in different shades.
export function strandPixels(film: Film, kinds: string[]): Uint32Array {
  const shades: [Rgb, number][] = [[[255, 255, 255], 0.15], [[0, 0, 0], 0.12], [[255, 255, 255], 0.5], [[0, 0, 0], 0.32]];
  return Uint32Array.from(film.strands, (strand, i) => {
    const [towards, share] = shades[(i + strand.row) % shades.length]!;
    return pixel(mix(ofHex(kindColour(kinds.indexOf(strand.kind))), towards, share));
  });
}

// Colour of every cell of a frame.
export function cellPixels(film: Film, frame: Frame, index: number, table: Uint32Array): Uint32Array {
  const out = new Uint32Array(film.cells);
  if (index < 0) for (let cell = 0; cell < film.cells; ++cell) out[cell] = table[film.strandOfCell[cell]!]!;
  else {
    const bytes = frame.fields[index]!;
    for (let cell = 0; cell < film.cells; ++cell) out[cell] = table[bytes[cell]!]!;
  }
  return out;
}
