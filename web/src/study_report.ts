// The page of a study: means of its cells with their intervals, effects, the same side by side, curves, and its items.
import {Chart, type Series} from './chart';
import type {Study} from './data';
import {button, choice, el} from './dom';
import {parseCsv, Table} from './table';
import {toggleTheme} from './theme';
import {Tornado} from './tornado';

const mostCells = 24;  // side by side

function section(title: string, ...content: (HTMLElement | null)[]): HTMLElement {
  return el('section', {}, el('h2', {}, title), ...content);
}

// What is looked at: a test, a kept state, a quality of glue, each by its place.
interface Choice {
  test: string;
  state: string;
  glue: number;  // place in the list of compliances of a cell
}

class StudyView {
  private readonly means: Table;
  private readonly effects: Table;
  private readonly stress: Table;
  private readonly profiles: Table;
  private readonly states: string[];
  private readonly tests: string[];
  private readonly glues: string[];  // names by place
  private chosen: Choice;

  constructor(private readonly study: Study) {
    const summary = parseCsv(study.tables['summary.csv'] ?? '');
    this.means = summary.has('contrast') ? summary.where('contrast', '') : summary;
    this.effects = parseCsv(study.tables['effects.csv'] ?? '');
    this.stress = parseCsv(study.tables['stress_bands'] ?? '');
    this.profiles = parseCsv(study.tables['profile_bands'] ?? '');
    this.states = this.means.distinct('state');
    this.tests = this.means.distinct('test');
    const first = this.rowsOf(0, this.tests[0] ?? '', this.states[0] ?? '');
    this.glues = first.text('compliance_t_mm_per_MPa').map(c => this.glueName(c));
    this.chosen = {test: this.tests[0] ?? '', state: this.states[this.states.length - 1] ?? '', glue: Math.floor((this.glues.length - 1) / 2)};
  }

  private glueName(compliance: string): string {
    const name = this.study.words.glues.find(glue => glue.compliance_t_mm_per_MPa === Number(compliance))?.name;
    return name ?? (compliance === 'nan' || compliance === '' ? 'glue as varied' : `1/Dₜ ${compliance}`);
  }

  private testName(test: string): string {
    return this.study.words.tests[test] ?? test;
  }

  // Rows of summary.csv of a cell: cells stand one after the other, each begins anew with its first state and test.
  private cells: Table[] | undefined;
  private rowsOf(cell: number, test: string, state: string): Table {
    if (!this.cells) {
      const keys = this.study.keys.map(key => this.means.text(key));
      const values = this.means.rows.map((_, i) => keys.map(column => column[i]).join('\n'));
      const groups = new Map<string, string[][]>();
      this.means.rows.forEach((row, i) => groups.set(values[i]!, [...(groups.get(values[i]!) ?? []), row]));
      this.cells = [...groups.values()].map(rows => new Table(this.means.columns, rows));
    }
    const rows = this.cells[cell] ?? new Table(this.means.columns, []);
    return rows.where('test', test).where('state', state);
  }

  private density(state: string): string {
    const values = this.means.where('state', state).numbers('density_kg_m3').filter(Number.isFinite);
    return values.length > 0 ? `${(values.reduce((a, b) => a + b, 0) / values.length).toFixed(0)} kg/m³` : `state ${state}`;
  }

  // A line of a cell over its glues or its states, with its band.
  private overGlue(cell: number): Series {
    const rows = this.rowsOf(cell, this.chosen.test, this.chosen.state);
    return {name: this.nameOf(cell), x: rows.numbers('compliance_t_mm_per_MPa'), y: rows.numbers('mean_MPa'), low: rows.numbers('low_MPa'),
            high: rows.numbers('high_MPa'), style: 'marked', ...(this.count > 8 ? {family: [cell, this.count] as [number, number]} : {})};
  }

  private overDensity(cell: number, glue: number, name: string, extra: Partial<Series>): Series {
    const points = this.states.map(state => {
      const rows = this.rowsOf(cell, this.chosen.test, state);
      const value = (column: string) => rows.numbers(column)[glue] ?? NaN;
      return [value('density_kg_m3'), value('mean_MPa'), value('low_MPa'), value('high_MPa')] as const;
    }).filter(point => Number.isFinite(point[0]));
    return {name, x: points.map(p => p[0]), y: points.map(p => p[1]), low: points.map(p => p[2]), high: points.map(p => p[3]), style: 'marked', ...extra};
  }

  // What the values in legends are of.
  private legendNote(text: string): string {
    return this.study.keys.length < 2 ? text : `${text} Names: ${this.study.keys.map(inShort).join(' · ')}.`;
  }
  private nameOf(cell: number): string {
    return this.study.cells[cell]!.values;
  }
  private get count(): number {
    return this.study.cells.length;
  }
  private get cellNumbers(): number[] {
    return this.study.cells.map((_, i) => i);
  }

  build(place: HTMLElement): void {
    place.querySelector('header')?.append(button('◐', 'Light or dark', toggleTheme));
    const sections: (HTMLElement | null)[] = [];
    if (this.means.rows.length > 0) sections.push(...this.charts());
    sections.push(this.items(), section('The plan', el('details', {class: 'card'}, el('summary', {}, 'The plan, as it was run'),
      el('pre', {tabindex: 0}, this.study.plan))));
    place.append(...sections.filter((node): node is HTMLElement => node !== null));
    const background = document.getElementById('background');
    if (background) place.append(background);
    place.append(el('footer', {}, 'The numbers are in the CSV files of the study\'s folder.'));
  }

  private charts(): HTMLElement[] {
    const tornado = new Tornado('tornado', 'What each factor changes');
    const overGlue = new Chart({id: 'means-glue', title: 'Means over the glue', xLabel: 'glue compliance 1/Dₜ, mm/MPa', yLabel: 'modulus, MPa', series: [],
                                table: this.means, summary: 'Mean modulus of each cell against glue compliance, with 95 % intervals.', x: {min: 0}, y: {min: 0}});
    const overDensity = new Chart({id: 'means-density', title: 'Means over density', xLabel: 'density, kg/m³', yLabel: 'modulus, MPa', series: [],
                                   table: this.means, summary: 'Mean modulus of each cell against density, with 95 % intervals.', y: {min: 0}});
    const stress = new Chart({id: 'stress', title: 'Pressing stress', xLabel: 'compaction, %', yLabel: 'stress, MPa', table: this.stress,
                              note: this.legendNote('Means over replicates with their 95 % intervals.'), summary: 'Mean platen stress of each cell against compaction.', y: {min: 0},
                              series: this.cellNumbers.map(cell => {
                                const rows = this.stress.where('cell', String(cell));
                                return {name: this.nameOf(cell), x: rows.numbers('compaction').map(c => 100 * c), y: rows.numbers('stress_MPa'),
                                        low: rows.numbers('low_MPa'), high: rows.numbers('high_MPa')};
                              }).filter(series => series.x.length > 0)});
    const profile = new Chart({id: 'profile', title: 'Density through the thickness', xLabel: 'relative height', yLabel: 'density, kg/m³', table: this.profiles,
                               series: [], summary: 'Mean density profile of each cell.', x: {min: 0, max: 1}, y: {min: 0}});
    const shown = this.cellNumbers.slice(0, mostCells);
    const multiples = this.states.length > 1 && this.count > 1 ? shown.map(cell => new Chart({
      id: `multiple-${cell}`, title: this.study.cells[cell]!.name, xLabel: 'density, kg/m³', yLabel: 'modulus, MPa', series: [],
      table: new Table(this.means.columns, []), summary: 'Mean modulus against density, one line per glue, with 95 % intervals.', y: {min: 0},
    })) : [];

    const told = el('p', {class: 'note'});
    const draw = () => {
      const {test, state, glue} = this.chosen;
      const what = `${this.testName(test)} modulus`;
      told.textContent = this.legendNote(`${what} at ${this.density(state)} or with ${this.glues[glue] ?? ''}; means of replicates, paler their 95 % intervals.`);
      overGlue.update({ series: this.cellNumbers.map(cell => this.overGlue(cell)), table: this.means.where('test', test)});
      overDensity.update({table: this.means.where('test', test),
        series: this.cellNumbers.map(cell => this.overDensity(cell, glue, this.nameOf(cell),
                                                              this.count > 8 ? {family: [cell, this.count]} : {}))});
      profile.update({series: this.cellNumbers.flatMap(cell => {
        const rows = this.profiles.where('cell', String(cell)).where('state', state);
        return rows.rows.length === 0 ? [] : [{name: this.nameOf(cell), x: rows.numbers('relative_height'), y: rows.numbers('density_kg_m3'),
                                               low: rows.numbers('low_kg_m3'), high: rows.numbers('high_kg_m3')}];
      })});
      const effects = this.effects.where('test', test).where('state', state);
      const names = ['factor', 'value', 'against'].map(column => effects.text(column));
      const seen = new Map<string, number>();
      const rows = effects.rows.map((_, i) => ({name: `${inShort(names[0]![i]!)}: ${names[1]![i]} against ${names[2]![i]}`, i}));
      const ofGlue = rows.filter(({name}) => {  // rows of an effect stand in the order of its glues
        const place = seen.get(name) ?? 0;
        seen.set(name, place + 1);
        return place === glue;
      });
      const [mean, low, high, reference, n] = ['effect_MPa', 'low_MPa', 'high_MPa', 'reference_MPa', 'n'].map(column => effects.numbers(column)) as number[][];
      tornado.show(ofGlue.map(({name, i}) => ({name, percent: 100 * mean![i]! / reference![i]!, low: 100 * low![i]! / reference![i]!,
                                                high: 100 * high![i]! / reference![i]!, n: n![i]!})),
        `${what} at ${this.density(state)}, ${this.glues[glue] ?? ''}: change in % of what it is held against; pale where the interval takes in zero.`);
      const highest = Math.max(...this.means.where('test', test).numbers('high_MPa').filter(Number.isFinite),
                               ...this.means.where('test', test).numbers('mean_MPa').filter(Number.isFinite));
      multiples.forEach((chart, k) => chart.update({
        series: this.glues.map((name, g) => this.overDensity(shown[k]!, g, name, {family: [g, this.glues.length]})), y: {min: 0, max: nice(highest)},
        table: (this.cells?.[shown[k]!] ?? this.means).where('test', test),
      }));
    };
    const options = (values: string[], name: (value: string) => string) => values.map(value => ({value, label: name(value)}));
    const controls = el('div', {class: 'toolbar card study-choices'},
      choice('Test', options(this.tests, test => this.testName(test)), this.chosen.test, test => {
        this.chosen.test = test;
        draw();
      }),
      choice('State', options(this.states, state => this.density(state)), this.chosen.state, state => {
        this.chosen.state = state;
        draw();
      }),
      choice('Glue', this.glues.map((name, i) => ({value: String(i), label: name})), String(this.chosen.glue), glue => {
        this.chosen.glue = Number(glue);
        draw();
      }));
    draw();
    return [
      section('What varies', controls, this.effects.rows.length > 0 ? tornado.element : null, told,
        el('div', {class: 'grid'}, overGlue.element, this.states.length > 1 ? overDensity.element : null)),
      ...(multiples.length > 0 ? [section('Side by side', el('div', {class: 'grid multiples'}, ...multiples.map(chart => chart.element)),
        this.count > mostCells ? el('p', {class: 'note'}, `The first ${mostCells} of ${this.count} cells.`) : null)] : []),
      section('Pressing and density', el('div', {class: 'grid'}, stress.element, this.profiles.rows.length > 0 ? profile.element : null)),
    ];
  }

  // Each with what it left in the folder.
  private items(): HTMLElement {
    const link = (path: string, text: string) => el('a', {href: path}, text);
    const rows = this.study.items.map(item => el('tr', {}, el('th', {scope: 'row'}, String(item.number)), el('td', {}, this.study.cells[item.cell]?.name ?? ''),
      el('td', {}, item.seed), el('td', {}, item.state),
      el('td', {}, link(`items/${item.hash}/case.toml`, 'case'), ...(item.state === 'missing' ? [] : [' ', link(`items/${item.hash}/log.txt`, 'log')]))));
    return section('Panels', el('details', {class: 'card'}, el('summary', {}, `${this.study.items.length} panels and their cases`),
      el('p', {class: 'note'}, 'A panel with its film and page: strandlab run items/HASH/case.toml gives the same numbers.'),
      el('div', {class: 'numbers words', tabindex: 0}, el('table', {}, el('thead', {}, el('tr', {}, ...['item', 'cell', 'seed', 'state', 'files'].map(name =>
        el('th', {scope: 'col'}, name)))), el('tbody', {}, ...rows)))));
  }
}

// Keys without what all of a kind have in common: "surface.yield_factor", "speed_m_s".
function inShort(factor: string): string {
  return factor.split(' + ').map(key => (key.startsWith('kinds.') ? key.slice(6) : key.slice(key.indexOf('.') + 1))).join(' + ');
}

// A round number above.
function nice(value: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
  return ([1, 2, 3, 4, 5, 6, 8, 10].find(f => f * power >= value) ?? 10) * power;
}

export function studyReport(study: Study, place: HTMLElement): void {
  new StudyView(study).build(place);
}
