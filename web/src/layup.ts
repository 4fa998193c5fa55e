// The mat as laid, drawn to scale in length: rows of strands coloured by kind.
import {kindColour} from './colouring';
import type {CaseData, MatData} from './data';
import {button, downloadText, el, svg} from './dom';

export function layupFigure(mat: MatData, c: CaseData): HTMLElement {
  const width = 1000;
  const rowHeight = Math.max(6, Math.min(22, 300 / mat.layers.length));
  const height = rowHeight * mat.layers.length;
  const scale = width / mat.length_mm;
  const names = c.kinds.map(kind => kind.name);
  const drawing = svg('svg', {viewBox: `0 0 ${width} ${height}`, xmlns: 'http://www.w3.org/2000/svg', role: 'img', class: 'layup',
                              'aria-label': `${mat.layers.length} rows of strands`, preserveAspectRatio: 'none'});
  mat.layers.forEach((layer, row) => {
    const y = height - (row + 1) * rowHeight;
    layer.strands.forEach((strand, i) => {
      const name = `${layer.role}, row ${row + 1}, ${strand.x0.toFixed(1)} to ${strand.x1.toFixed(1)} mm`;
      drawing.append(svg('rect', {x: strand.x0 * scale, y: y + 0.4, width: (strand.x1 - strand.x0) * scale, height: rowHeight - 0.8,
                                  fill: kindColour(names.indexOf(layer.role)), 'fill-opacity': i % 2 ? 0.72 : 0.95,
                                  stroke: '#2228', 'stroke-width': 0.6, 'vector-effect': 'non-scaling-stroke'}, svg('title', {}, name)));
    });
  });
  const legend = el('ul', {class: 'legend'}, ...c.kinds.map((kind, i) => {
    const rows = mat.layers.filter(layer => layer.role === kind.name).length;
    const swatch = el('i', {});
    swatch.style.background = kindColour(i);
    return el('li', {}, swatch, el('span', {}, el('b', {}, kind.name),
      ` ${rows} ${rows === 1 ? 'row' : 'rows'} of ${kind.material}, ` +
      (kind.angle_deg === 0 ? 'along the panel' : kind.angle_deg === 90 ? 'across the panel' : `at ${kind.angle_deg}°`)));
  }));
  const total = mat.layers.length * mat.layer_thickness_mm;
  return el('figure', {class: 'card chart wide', 'data-chart': 'layup'},
    el('figcaption', {}, el('h3', {}, 'Layup'),
      el('div', {class: 'tools'}, button('SVG', 'Layup: download the picture as SVG', () =>
        downloadText('layup.svg', 'image/svg+xml', new XMLSerializer().serializeToString(drawing))))),
    el('p', {class: 'note'}, `The mat as laid: ${Number(mat.length_mm.toFixed(3))} mm long, ${Number(total.toFixed(3))} mm thick.`),
    drawing, legend);
}
