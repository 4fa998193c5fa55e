// Density through the thickness.
import {cornersOfCell, valueOf, type Film, type Frame} from './frames';

export interface Profile {
  y_mm: number[];  // middle of each slice
  density_kg_m3: number[];
}

// Mean density of slices of a frame, voids included: each cell's mass is spread evenly over the heights it covers.
export function profileOf(film: Film, frame: Frame, slices: number): Profile {
  const index = film.fields.findIndex(field => field.key === 'density_kg_m3');
  const field = film.fields[index];
  const bytes = frame.fields[index];
  const height = (frame.top_mm - frame.bottom_mm) / slices;
  const mass = new Float64Array(slices);
  if (field && bytes) {
    const {corners} = frame;
    for (const strand of film.strands) {
      for (let cell = strand.firstCell; cell < strand.firstCell + strand.along * strand.through; ++cell) {
        const q = cornersOfCell(strand, cell);
        const x = q.map(c => corners[2 * c]!), y = q.map(c => corners[2 * c + 1]!);
        const area = Math.abs((x[2]! - x[0]!) * (y[3]! - y[1]!) - (x[3]! - x[1]!) * (y[2]! - y[0]!)) / 2;
        const low = (Math.min(...y) - frame.bottom_mm) / height;
        const span = Math.max(1e-9, (Math.max(...y) - frame.bottom_mm) / height - low);
        const m = area * valueOf(field, bytes[cell]!);
        const last = Math.min(slices - 1, Math.floor(low + span));
        for (let s = Math.max(0, Math.floor(low)); s <= last; ++s) {
          mass[s]! += (m * Math.max(0, Math.min(s + 1, low + span) - Math.max(s, low))) / span;
        }
      }
    }
  }
  return {
    y_mm: Array.from(mass, (_, s) => frame.bottom_mm + (s + 0.5) * height),
    density_kg_m3: Array.from(mass, m => m / (height * film.length_mm)),
  };
}
