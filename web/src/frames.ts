// Frames of a pressing, unpacked (src/strandlab/report/frames.hpp has the format).
import type {Field, PackedFrames} from './data';

export interface FilmStrand {
  kind: string;
  row: number;
  angle_deg: number;
  along: number;    // cells
  through: number;  // cells
  firstCorner: number;
  firstCell: number;
}

// A line that would be cured: two strands, points x, y in mm.
export interface GlueLine {
  a: number;
  b: number;
  points: Float32Array;
}

export interface Frame {
  compaction: number;
  time_ms: number;
  bottom_mm: number;
  top_mm: number;
  corners: Float32Array;  // x, y in mm, strand after strand, along fastest
  fields: Uint8Array[];   // in the order of Film.fields, a byte per cell
  glue: GlueLine[];
}

export interface Film {
  length_mm: number;
  initial_thickness_mm: number;
  strands: FilmStrand[];
  cells: number;
  strandOfCell: Int32Array;
  fields: Field[];
  frames: Frame[];
}

function bytesOf(base64: string): Uint8Array {
  const binary = atob(base64);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

class Reader {
  private at = 0;
  constructor(private readonly bytes: Uint8Array) {}

  get done(): boolean {
    return this.at >= this.bytes.length;
  }

  number(): number {
    let value = 0;
    let factor = 1;
    for (;;) {
      const byte = this.bytes[this.at++];
      if (byte === undefined) throw new Error('a frame ends too early');
      value += (byte & 127) * factor;
      if (byte < 128) break;
      factor *= 128;
    }
    return value % 2 === 0 ? value / 2 : -(value + 1) / 2;
  }

  take(count: number): Uint8Array {
    if (this.at + count > this.bytes.length) throw new Error('a frame ends too early');
    return this.bytes.subarray(this.at, (this.at += count));
  }
}

function unpackGlue(base64: string, quantum: number): GlueLine[] {
  const reader = new Reader(bytesOf(base64));
  const lines: GlueLine[] = [];
  while (!reader.done) {
    const a = reader.number();
    const b = reader.number();
    const points = new Float32Array(2 * reader.number());
    let x = 0;
    let y = 0;
    for (let i = 0; i < points.length; i += 2) {
      points[i] = (x += reader.number()) * quantum;
      points[i + 1] = (y += reader.number()) * quantum;
    }
    lines.push({a, b, points});
  }
  return lines;
}

export function unpack(packed: PackedFrames): Film {
  const quantum = packed.quantum_mm ?? 1;
  let firstCorner = 0;
  let firstCell = 0;
  const strands = packed.strands.map(s => {
    const [along, through] = s.points;
    const strand = {kind: s.kind, row: s.row, angle_deg: s.angle_deg, along, through, firstCorner, firstCell};
    firstCorner += (along + 1) * (through + 1);
    firstCell += along * through;
    return strand;
  });
  const strandOfCell = new Int32Array(firstCell);
  strands.forEach((s, i) => strandOfCell.fill(i, s.firstCell, s.firstCell + s.along * s.through));

  const quanta = new Int32Array(2 * firstCorner);
  const frames = packed.frames.map(frame => {
    const reader = new Reader(bytesOf(frame.cells));
    for (const s of strands) {
      const last = [0, 0];
      const end = 2 * (s.firstCorner + (s.along + 1) * (s.through + 1));
      for (let i = 2 * s.firstCorner; i < end; ++i) {
        const step = (last[i & 1] = (last[i & 1] ?? 0) + reader.number());
        quanta[i] = (quanta[i] ?? 0) + step;
      }
    }
    return {
      compaction: frame.compaction,
      time_ms: frame.time_ms,
      bottom_mm: frame.bottom_mm,
      top_mm: frame.top_mm,
      corners: Float32Array.from(quanta, q => q * quantum),
      fields: packed.fields.map(() => reader.take(firstCell)),
      glue: unpackGlue(frame.glue, quantum),
    };
  });
  return {
    length_mm: packed.length_mm ?? 0,
    initial_thickness_mm: packed.initial_thickness_mm ?? 0,
    strands, cells: firstCell, strandOfCell, fields: packed.fields, frames,
  };
}

// Corners of a cell: indices of its four corners in the corner list, around it.
export function cornersOfCell(strand: FilmStrand, cell: number): [number, number, number, number] {
  const local = cell - strand.firstCell;
  const j = Math.floor(local / strand.along);
  const a = strand.firstCorner + local + j;
  return [a, a + 1, a + strand.along + 2, a + strand.along + 1];
}

// Value that a field's byte stands for.
export function valueOf(field: Field, byte: number): number {
  return field.low + ((field.high - field.low) * byte) / 255;
}
