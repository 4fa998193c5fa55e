// How far glue lines slide in a virtual test of the panel (slip_C.csv of a run folder).
import type {GlueLine} from './frames';
import {parseCsv} from './table';

export interface SlipLine extends GlueLine {
  slip_um: Float32Array;  // a number per point
}

export interface SlipState {
  compaction: number;
  glue?: string;  // what this glue is called
  compliance_t_mm_per_MPa: number;
  strain: number;      // mean strain of the tension test
  highest_um: number;  // that 99 % of the points stay below
  lines: SlipLine[];
}

const strain = 1e-3;

// `text` has a row per glue point, line after line: the two strands, the point, its slip per unit mean strain.
export function slipState(compaction: number, text: string): SlipState | undefined {
  const table = parseCsv(text);
  if (table.rows.length === 0) return undefined;
  const [complianceT, a, b, x, y, slip] = ['compliance_t_mm_per_MPa', 'strand_a', 'strand_b', 'x_mm', 'y_mm', 'slip_mm_per_strain']
    .map(name => table.numbers(name)) as [number[], number[], number[], number[], number[], number[]];
  const um = slip.map(s => 1000 * strain * Math.abs(s));
  const lines: SlipLine[] = [];
  for (let first = 0, end = 0; first < a.length; first = end) {
    end = first + 1;
    const spacing = end < a.length ? Math.hypot(x[end]! - x[first]!, y[end]! - y[first]!) : 0;
    while (end < a.length && a[end] === a[first] && b[end] === b[first] &&
           Math.hypot(x[end]! - x[end - 1]!, y[end]! - y[end - 1]!) < 3 * spacing + 1e-6) ++end;
    const count = end - first;
    const points = new Float32Array(2 * count);
    for (let i = 0; i < count; ++i) {
      points[2 * i] = x[first + i]!;
      points[2 * i + 1] = y[first + i]!;
    }
    lines.push({a: a[first]!, b: b[first]!, points, slip_um: Float32Array.from(um.slice(first, end))});
  }
  const sorted = [...um].sort((p, q) => p - q);
  return {compaction, compliance_t_mm_per_MPa: complianceT[0]!, strain, highest_um: sorted[Math.floor(0.99 * (sorted.length - 1))] || 1, lines};
}
