// What a run's numbers say, in plain words.
import type {Run} from './data';
import {parseCsv} from './table';

export interface Finding {
  level: 'good' | 'note' | 'warning';
  text: string;
}

const judgedFrom = 0.05;     // compaction from which the press judges inertia
const kineticLimit = 0.05;   // of internal energy, as the press has it
const balanceLimit = 0.01;   // of the platens' work, likewise
const overlapLimit = 0.01;   // of the panel's area

function percent(share: number, digits = 1): string {
  const text = (100 * share).toFixed(digits);
  return Number(text) === 0 && share > 0 ? `less than ${10 ** -digits} %` : `${text} %`;
}

function of(compaction: number): string {
  return `${Number((100 * compaction).toFixed(1))} %`;
}

function aboutPressing(run: Run): Finding[] {
  const text = run.tables['press.csv'];
  if (!text) return [];
  const table = parseCsv(text);
  const [compaction, kinetic, internal, friction, work] =
    ['compaction', 'kinetic_mJ', 'internal_mJ', 'friction_mJ', 'platen_work_mJ'].map(name => table.numbers(name)) as
      [number[], number[], number[], number[], number[]];
  const losses = ['elastic_mJ', 'plastic_mJ', 'friction_mJ', 'contact_mJ', 'filter_mJ', 'kinetic_mJ'];
  const end = table.rows.length - 1;
  if (end < 0 || !(work[end]! > 0)) return [{level: 'note', text: 'The mat was not pressed.'}];

  const findings: Finding[] = [];
  const worst = compaction.reduce((most, c, i) => (c > judgedFrom && internal[i]! > 0 ? Math.max(most, kinetic[i]! / internal[i]!) : most), 0);
  const warned = (run.record.steps.press?.warnings ?? []).length > 0;
  if (!warned) {
    findings.push({level: 'good', text: worst > 0
      ? `The press was slow enough: beyond ${of(judgedFrom)} compaction the motion of the wood never held more than ` +
        `${percent(worst)} of the energy stored and dissipated in it (limit for the strands' own motion ${of(kineticLimit)}), ` +
        'and both platens felt the same force within the limit.'
      : `The pressing ended before ${of(judgedFrom)} compaction, where inertia is first judged.`});
  }
  const sum = losses.reduce((total, name) => total + table.numbers(name)[end]!, 0);
  const gap = Math.abs(work[end]! - sum) / work[end]!;
  findings.push({level: gap > balanceLimit ? 'warning' : 'good',
    text: `The energies add up: all terms together match the platens' work to ${percent(gap, 2)}.`});
  if (gap > balanceLimit) findings[findings.length - 1]!.text = `The energies are off by ${percent(gap)} of the platens' work (limit ${of(balanceLimit)}).`;
  const slip = friction[end]! / work[end]!;
  findings.push({level: 'note', text: slip > 1e-4
    ? `Strands slid on one another: friction took ${percent(slip)} of the platens' work.`
    : "Strands hardly slid on one another: friction took less than 0.01 % of the platens' work."});
  return findings;
}

function aboutShape(run: Run): Finding[] {
  const text = run.tables['morphology.csv'];
  if (!text) return [];
  const table = parseCsv(text);
  const compaction = table.numbers('compaction');
  const overlap = table.numbers('overlap_fraction');
  const voids = table.numbers('void_fraction');
  const end = compaction.length - 1;
  if (end < 0) return [];
  const most = Math.max(...overlap);
  const at = compaction[overlap.indexOf(most)]!;
  return [
    most > overlapLimit
      ? {level: 'warning', text: `Strands overlap: at ${of(at)} compaction by ${percent(most)} of the section, more than the ` +
                                 `${of(overlapLimit)} that drawing strands as straight-edged cells explains.`}
      : {level: 'good', text: most > 0 ? `Strands keep apart: their outlines overlap by ${percent(most, 2)} of the section at most.`
                                       : 'Strands keep apart: nothing overlaps.'},
    {level: 'note', text: end > 0
      ? `Voids shrank from ${percent(voids[0]!)} to ${percent(voids[end]!)} of the section.`
      : `Voids take ${percent(voids[0]!)} of the section.`},
  ];
}

function aboutTests(run: Run): Finding[] {
  const states = (run.record.steps.test?.states ?? []).filter(state => !state.not_testable);
  if (states.length === 0) return [];
  const floating = states.filter(state => state.floating_strands > 0);
  const last = states[states.length - 1]!;
  return [
    floating.length > 0
      ? {level: 'note', text: 'Some strands float: they are glued to nothing that reaches both loaded ends and were left out of the ' +
                              `tests (${floating.map(s => `${s.floating_strands} at ${of(s.compaction)}`).join(', ')} compaction).`}
      : {level: 'good', text: 'No strand floats: each is glued, directly or through others, to both loaded ends.'},
    {level: 'note', text: `At ${of(last.compaction)} compaction ${percent(last.glued_fraction, 0)} of the strands' facing length is glued.`},
  ];
}

function warnings(run: Run): Finding[] {
  // A warning that several states share but for its numbers is told once, as the last of them has it.
  const seen = new Map<string, string[]>();
  const tests = new Map<string, string>();
  for (const state of run.record.steps.test?.states ?? []) {
    for (const text of state.warnings.filter(w => !w.includes('left out'))) {
      const words = text.replace(/[\d.]+/g, '#');
      const before = seen.get(words) ?? [];
      const also = before.length > 0 ? ` (Likewise at ${before.join(', ')}.)` : '';
      tests.set(words, `At ${of(state.compaction)} compaction: ${text}${also}`);
      seen.set(words, [...before, of(state.compaction)]);
    }
  }
  return [...(run.record.steps.press?.warnings ?? []), ...tests.values()].map(text => ({level: 'warning', text}));
}

// Warnings first.
export function findingsOf(run: Run): Finding[] {
  const all = [...warnings(run), ...aboutPressing(run), ...aboutShape(run), ...aboutTests(run)];
  return [...all.filter(f => f.level === 'warning'), ...all.filter(f => f.level !== 'warning')];
}
