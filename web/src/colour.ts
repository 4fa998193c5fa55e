// Colours that are even to the eye and safe for the colour-blind.

export type Rgb = [number, number, number];

function rgb(hex: string): Rgb {
  const n = parseInt(hex, 16);
  return [n >> 16, (n >> 8) & 255, n & 255];
}

function stops(text: string): Rgb[] {
  return text.split(' ').map(rgb);
}

// viridis (Smith & van der Walt 2015), cividis (Nunez et al. 2018), RdBu turned round (Brewer 2003), with a
// middle of the colour of wood.
export const viridis = stops('440154 472c7a 3b518b 2c718e 21908d 27ad81 5cc863 aadc32 fde725');
export const cividis = stops('00224e 123570 3b496c 575d6d 707173 8a8678 a59c74 c3b369 e1cc55 fee838');
export const blueWhiteRed = stops('053061 2166ac 4393c3 98c6dc dbe4df f4ead6 f8d5b8 f2a582 d6604d b2182b 67001f');

// plasma (Smith & van der Walt 2015), for lines over the others.
export const plasma = stops('3b049a 7201a8 9c179e bd3786 d8576b ed7953 fb9f3a fdca26 f0f921');

// Okabe & Ito (2008): distinct for every common kind of colour vision.
export const okabeIto = ['#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8c6bb1'];

export function interpolate(map: Rgb[], t: number): Rgb {
  const place = Math.min(1, Math.max(0, t)) * (map.length - 1);
  const i = Math.min(map.length - 2, Math.floor(place));
  const f = place - i;
  const a = map[i] ?? [0, 0, 0];
  const b = map[i + 1] ?? a;
  return [a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])];
}

export function css([r, g, b]: Rgb): string {
  return `rgb(${Math.round(r)} ${Math.round(g)} ${Math.round(b)})`;
}

export function hex([r, g, b]: Rgb): string {
  return '#' + [r, g, b].map(v => Math.round(v).toString(16).padStart(2, '0')).join('');
}

// Pixel of an ImageData's buffer, opaque (browsers run on little-endian machines).
export function pixel([r, g, b]: Rgb): number {
  return ((255 << 24) | (Math.round(b) << 16) | (Math.round(g) << 8) | Math.round(r)) >>> 0;
}

export function ofHex(colour: string): Rgb {
  return rgb(colour.slice(1));
}

export function mix(a: Rgb, b: Rgb, share: number): Rgb {
  return [a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2])];
}

// Colours of an ordered family of `count` lines: viridis without the end that is lost on the background.
export function family(count: number, dark: boolean): string[] {
  const [low, high] = dark ? [0.3, 1] : [0, 0.78];
  return Array.from({length: count}, (_, i) =>
    hex(interpolate(viridis, count < 2 ? (low + high) / 2 : low + ((high - low) * i) / (count - 1))));
}

// WCAG's relative luminance, and the contrast of two colours: 1 (the same) to 21 (black on white).
export function luminance(colour: Rgb): number {
  const [r, g, b] = colour.map(v => (v / 255 <= 0.03928 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)) as Rgb;
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

export function contrast(a: Rgb, b: Rgb): number {
  const [light, dark] = [luminance(a), luminance(b)].sort((p, q) => q - p) as [number, number];
  return (light + 0.05) / (dark + 0.05);
}

// The colour itself where it stands out from its background by the contrast, else the nearest darker one on a light
// background, or lighter one on a dark one, that does.
export function readable(colour: string, background: string, least: number): string {
  const ground = ofHex(background);
  const end: Rgb = luminance(ground) > 0.18 ? [0, 0, 0] : [255, 255, 255];
  for (let share = 0; share < 1; share += 0.02) {
    const tried = mix(ofHex(colour), end, share);
    if (contrast(tried, ground) >= least) return hex(tried);
  }
  return hex(end);
}
