// Draws the cells of a frame into pixels, each pixel in the colour of one cell and with its number: no seams between cells,
// and a pointer knows at once what it is over.
import {cornersOfCell, type Film, type Frame} from './frames';

// Pixel = origin + scale * mm, y down.
export interface Projection {
  x0: number;
  y0: number;
  xScale: number;
  yScale: number;  // negative: heights go up
}

export interface Canvas {
  width: number;
  height: number;
  pixels: Uint32Array;
  cells: Int32Array;  // cell at each pixel, -1 for none
}

// Fills what lies between the leftmost and rightmost crossing of a cell's edges with the middle of every line of pixels.
// Edges run from their lower end, so that neighbours meet without a gap.
export function drawCells(canvas: Canvas, film: Film, frame: Frame, p: Projection, colourOfCell: Uint32Array): void {
  const {width, height, pixels, cells} = canvas;
  const {corners} = frame;
  const x = new Float64Array(4);
  const y = new Float64Array(4);
  for (const strand of film.strands) {
    const end = strand.firstCell + strand.along * strand.through;
    for (let cell = strand.firstCell; cell < end; ++cell) {
      const quad = cornersOfCell(strand, cell);
      let left = Infinity, right = -Infinity, top = Infinity, bottom = -Infinity;
      for (let k = 0; k < 4; ++k) {
        const c = 2 * quad[k as 0 | 1 | 2 | 3];
        const px = (x[k] = p.x0 + p.xScale * corners[c]!);
        const py = (y[k] = p.y0 + p.yScale * corners[c + 1]!);
        if (px < left) left = px;
        if (px > right) right = px;
        if (py < top) top = py;
        if (py > bottom) bottom = py;
      }
      if (right < 0 || left > width || bottom < 0 || top > height) continue;
      const colour = colourOfCell[cell]!;
      const lastRow = Math.min(height - 1, Math.ceil(bottom - 0.5) - 1);
      for (let row = Math.max(0, Math.ceil(top - 0.5)); row <= lastRow; ++row) {
        const at = row + 0.5;
        let from = Infinity, to = -Infinity;
        for (let k = 0; k < 4; ++k) {
          const n = (k + 1) & 3;
          const low = y[k]! <= y[n]! ? k : n;
          const high = low === k ? n : k;
          const y0 = y[low]!, y1 = y[high]!;
          if (at < y0 || at >= y1) continue;
          const crossing = x[low]! + ((at - y0) * (x[high]! - x[low]!)) / (y1 - y0);
          if (crossing < from) from = crossing;
          if (crossing > to) to = crossing;
        }
        const first = row * width + Math.max(0, Math.ceil(from - 0.5));
        const last = row * width + Math.min(width, Math.ceil(to - 0.5));
        for (let i = first; i < last; ++i) {
          pixels[i] = colour;
          cells[i] = cell;
        }
      }
    }
  }
}
