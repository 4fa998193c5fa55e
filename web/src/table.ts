// CSV tables. Cells stay the text of the file, so that what is downloaded is what the run wrote.

export class Table {
  constructor(readonly columns: string[], readonly rows: string[][]) {}

  has(column: string): boolean {
    return this.columns.includes(column);
  }

  private index(column: string): number {
    const index = this.columns.indexOf(column);
    if (index < 0) throw new Error(`no column ${column}`);
    return index;
  }

  text(column: string): string[] {
    const index = this.index(column);
    return this.rows.map(row => row[index] ?? '');
  }

  numbers(column: string): number[] {
    return this.text(column).map(cell => (cell === '' ? NaN : Number(cell)));
  }

  // Different cells of a column, in the order of the file.
  distinct(column: string): string[] {
    return [...new Set(this.text(column))];
  }

  where(column: string, value: string): Table {
    const index = this.index(column);
    return new Table(this.columns, this.rows.filter(row => row[index] === value));
  }

  select(columns: string[]): Table {
    const indices = columns.map(column => this.index(column));
    return new Table(columns, this.rows.map(row => indices.map(i => row[i] ?? '')));
  }

  csv(): string {
    return [this.columns, ...this.rows].map(row => row.map(quoted).join(',') + '\n').join('');
  }
}

function quoted(cell: string): string {
  return /[",\r\n]/.test(cell) ? `"${cell.replace(/"/g, '""')}"` : cell;
}

// RFC 4180.
export function parseCsv(text: string): Table {
  const rows: string[][] = [];
  let row: string[] = [];
  let cell = '';
  let inQuotes = false;
  for (let i = 0; i < text.length; ++i) {
    const c = text[i];
    if (inQuotes) {
      if (c !== '"') cell += c;
      else if (text[i + 1] === '"') cell += text[++i];
      else inQuotes = false;
    } else if (c === '"') {
      inQuotes = true;
    } else if (c === ',' || c === '\n') {
      row.push(cell);
      cell = '';
      if (c === '\n') {
        rows.push(row);
        row = [];
      }
    } else if (c !== '\r') {
      cell += c;
    }
  }
  if (cell !== '' || row.length > 0) rows.push([...row, cell]);
  return new Table(rows[0] ?? [], rows.slice(1));
}
