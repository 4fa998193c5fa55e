import {charts} from './chart';
import {embedded} from './data';
import {el} from './dom';
import {runReport} from './run_report';
import {studyReport} from './study_report';
import {startTheme} from './theme';

function start(): void {
  const place = document.getElementById('report')!;
  startTheme();
  const data = embedded();
  if (data.format !== 2) throw new Error(`format ${data.format} is another than this page's`);
  if (data.study) studyReport(data.study, place);
  const view = data.run ? runReport(data.run, place) : undefined;
  Object.assign(window, {strandlab: {charts, view}});
}

let begun = false;
function begin(): void {
  if (begun) return;
  begun = true;
  try {
    start();
  } catch (error) {
    document.getElementById('report')!.append(el('p', {class: 'card'}, `This report cannot be shown: ${String(error)}`));
    throw error;
  }
}

// What needs no script is painted first; a page that is not on show paints nothing.
requestAnimationFrame(() => setTimeout(begin));
setTimeout(begin, 300);
