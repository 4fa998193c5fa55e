// The data of a run as the program writes them into the page (src/strandlab/report/report_data.hpp).

export interface Kind {
  name: string;
  material: string;
  angle_deg: number;
  angle_spread_deg?: number;
  angle_sd_deg?: number;
  yield_factor?: number;
  stiffness_factor?: number;
}

export interface Material {
  name: string;
  density_kg_m3: number;
  E_L_MPa: number;
  E_R_MPa: number;
  E_T_MPa: number;
  law: string;              // hill or crushing: the constants of yielding are those of this law
  Y_R_MPa: number;
  hardening_K_MPa?: number;  // of Hill's law
}

export interface CaseData {
  name: string;
  mat_file: string;  // empty: the mat was formed with the seed
  seed: string;      // digits: a number is exact to 2^53 only
  kinds: Kind[];
  materials: Material[];
  compactions: number[];
  densities_kg_m3: number[];  // of the panel at each of them; empty in runs of older programs
  speed_m_s: number;
  friction: number;
  compliances_t_mm_per_MPa: number[];
  compliance_n_mm_per_MPa: number;
  max_gap_mm: number;
}

export interface MatStrand {
  x0: number;
  x1: number;
  angle_deg?: number;
  material?: string;
}

export interface MatData {
  length_mm: number;
  layer_thickness_mm: number;
  layers: {role: string; thickness_mm?: number; strands: MatStrand[]}[];
}

// What run.json has under hotpress, as far as the page shows it; null: not in this cycle.
export interface HotPressRecord {
  press_time_to_cure_s: number | null;
  press_factor_s_per_mm: number | null;
  core_100C_s: number | null;
  gas_core_peak_kPa: number;
  gas_core_peak_kPa_K_times_3: number;
  gas_core_peak_kPa_K_over_3: number;
  blow_risk: number;
  blow_risk_K_times_3: number;
  blow_risk_K_over_3: number;
  density_peak_over_core: number;
  density_peak_depth_mm: number;
  springback_percent: number;
}

export interface RunRecord {
  hotpress?: HotPressRecord;
  strandlab?: string;
  git?: string;
  seed?: number;
  date?: string;
  case_name?: string;
  mat?: {kg_per_m2: number; weight_fraction_by_kind: Record<string, number>; weight_fraction_by_material: Record<string, number>};
  derived_constants?: string[];
  machine?: {host?: string; cpu?: string; cores?: number; system?: string};
  steps: {
    press?: {
      finished?: boolean;
      particles?: number;
      steps?: number;
      threads?: number;
      wall_s?: number;
      particle_steps_per_s?: number;
    };
    test?: {finished?: boolean; wall_s?: number};
  };
}

export interface PackedFrame {
  compaction: number;
  time_ms: number;
  bottom_mm: number;
  top_mm: number;
  cells: string;
  glue: string;
}

// What cells can be coloured by; a cell's value is low + (high - low) byte/255.
export interface Field {
  key: string;
  label: string;
  unit: string;
  digits: number;      // shown behind the point
  diverging: boolean;  // colours symmetric about 0
  low: number;
  high: number;
}

export interface PackedFrames {
  quantum_mm?: number;
  length_mm?: number;
  initial_thickness_mm?: number;
  strands: {kind: string; row: number; angle_deg: number; points: [number, number]}[];
  fields: Field[];
  frames: PackedFrame[];
}

// What names in the tables are called.
export interface Words {
  tests: Record<string, string>;
  quantities: Record<string, {title: string; axis: string; factor: number}>;
  glues: {compliance_t_mm_per_MPa: number; name: string}[];
}

export interface Run {
  case: CaseData;
  case_text: string;
  record: RunRecord;
  mat: MatData | null;
  words: Words;
  tables: Record<string, string>;
  frames: PackedFrames;
}

// What the program writes of a study (src/strandlab/study/page.cpp).
export interface StudyItem {
  number: number;
  hash: string;
  replicate: number;
  seed: string;
  cell: number;
  state: 'whole' | 'failed' | 'missing';
}

export interface Study {
  keys: string[];   // that vary
  cells: {name: string; values: string}[];  // in full, and as legends have it
  items: StudyItem[];
  plan: string;
  words: {tests: Record<string, string>; glues: {compliance_t_mm_per_MPa: number; name: string}[]};
  tables: Record<string, string>;
}

// Of a run, or of a study.
export interface ReportData {
  format: number;
  run?: Run;
  study?: Study;
}

// The data embedded in the page. Throws where the page was not filled.
export function embedded(): ReportData {
  return JSON.parse(document.getElementById('data')?.textContent ?? '') as ReportData;
}
