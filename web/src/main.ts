import {charts} from './chart';
import {embedded} from './data';
import {el} from './dom';
import {runReport} from './run_report';
import {startTheme} from './theme';

function start(): void {
  const place = document.getElementById('report')!;
  startTheme();
  const data = embedded();
  if (data.format !== 1) throw new Error(`format ${data.format} is newer than this page`);
  const report = runReport(data.run);
  document.title = report.title;
  place.append(...report.content);
  Object.assign(window, {strandlab: {charts, view: report.view}});
}

try {
  start();
} catch (error) {
  document.getElementById('report')!.append(el('p', {class: 'card'}, `This report cannot be shown: ${String(error)}`));
  throw error;
}
