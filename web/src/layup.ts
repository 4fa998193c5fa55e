// The mat as laid, drawn to scale in length: rows of strands coloured by kind.
import {kindColour} from './colouring';
import type {CaseData, Kind, MatData, RunRecord} from './data';
import {button, downloadText, el, svg} from './dom';

function angles(kind: Kind): string {
  const spread = kind.angle_spread_deg ?? 0;
  if (spread >= 90) return 'at any angle';
  if (spread > 0) return `at ${kind.angle_deg}° ± ${spread}°`;
  const sd = kind.angle_sd_deg ?? 0;
  if (sd > 0) return `at ${kind.angle_deg}° with a standard deviation of ${sd}°`;
  return kind.angle_deg === 0 ? 'along the panel' : kind.angle_deg === 90 ? 'across the panel' : `at ${kind.angle_deg}°`;
}

function softening(kind: Kind): string {
  const factors = [['yield', kind.yield_factor ?? 1], ['stiffness', kind.stiffness_factor ?? 1]] as const;
  const softer = factors.filter(([, factor]) => factor < 1).map(([what, factor]) => `${what} × ${factor}`);
  return softer.length ? `, in the press ${softer.join(', ')}` : '';
}

function share(fractions: Record<string, number> | undefined, name: string): string {
  const fraction = fractions?.[name];
  return fraction === undefined ? '' : `, ${(100 * fraction).toFixed(1)} % of the weight`;
}

export function layupFigure(mat: MatData, c: CaseData, record: RunRecord): HTMLElement {
  const width = 1000;
  const rowHeight = Math.max(6, Math.min(22, 300 / mat.layers.length));
  const height = rowHeight * mat.layers.length;
  const thicknesses = mat.layers.map(layer => layer.thickness_mm ?? mat.layer_thickness_mm);
  const total = thicknesses.reduce((sum, thickness) => sum + thickness, 0);
  const tops = thicknesses.map((_, row) => height * (1 - thicknesses.slice(0, row + 1).reduce((a, b) => a + b, 0) / total));
  const scale = width / mat.length_mm;
  const names = c.kinds.map(kind => kind.name);
  const drawing = svg('svg', {viewBox: `0 0 ${width} ${height}`, xmlns: 'http://www.w3.org/2000/svg', role: 'img', class: 'layup',
                              'aria-label': `${mat.layers.length} rows of strands`, preserveAspectRatio: 'none'});
  mat.layers.forEach((layer, row) => {
    const y = tops[row] ?? 0;
    const rowThick = height * (thicknesses[row] ?? 0) / total;
    layer.strands.forEach((strand, i) => {
      const name = `${layer.role}, row ${row}, ${strand.x0.toFixed(1)} to ${strand.x1.toFixed(1)} mm` +
        (strand.angle_deg === undefined ? '' : `, grain at ${strand.angle_deg}°`);
      drawing.append(svg('rect', {x: strand.x0 * scale, y: y + 0.4, width: (strand.x1 - strand.x0) * scale, height: Math.max(rowThick - 0.8, 0.5),
                                  fill: kindColour(names.indexOf(layer.role)), 'fill-opacity': i % 2 ? 0.72 : 0.95,
                                  stroke: '#2228', 'stroke-width': 0.6, 'vector-effect': 'non-scaling-stroke'}, svg('title', {}, name)));
    });
  });
  const legend = el('ul', {class: 'legend'}, ...c.kinds.map((kind, i) => {
    const rows = mat.layers.filter(layer => layer.role === kind.name).length;
    const swatch = el('i', {});
    swatch.style.background = kindColour(i);
    return el('li', {}, swatch, el('span', {}, el('b', {}, kind.name),
      ` ${rows} ${rows === 1 ? 'row' : 'rows'} of ${kind.material}, ${angles(kind)}${softening(kind)}` +
      share(record.mat?.weight_fraction_by_kind, kind.name)));
  }));
  return el('figure', {class: 'card chart wide', 'data-chart': 'layup'},
    el('figcaption', {}, el('h3', {}, 'Layup'),
      el('div', {class: 'tools'}, button('SVG', 'Layup: download the picture as SVG', () =>
        downloadText('layup.svg', 'image/svg+xml', new XMLSerializer().serializeToString(drawing))))),
    el('p', {class: 'note'}, `The mat as laid: ${Number(mat.length_mm.toFixed(3))} mm long, ${Number(total.toFixed(3))} mm thick` +
      (record.mat ? `, ${record.mat.kg_per_m2.toPrecision(4)} kg/m².` : '.')),
    drawing, legend);
}
