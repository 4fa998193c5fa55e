// Light or dark: as the system has it until the reader chooses. Paper is light.

type Listener = () => void;
const listeners: Listener[] = [];
const system = window.matchMedia('(prefers-color-scheme: dark)');
let chosen: boolean | undefined;
let onPaper = false;

export function isDark(): boolean {
  return !onPaper && (chosen ?? system.matches);
}

export function onThemeChange(listener: Listener): void {
  listeners.push(listener);
}

export function toggleTheme(): void {
  chosen = !isDark();
  apply();
}

// Value of a colour variable of style.css.
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

function apply(): void {
  document.documentElement.dataset['theme'] = isDark() ? 'dark' : 'light';
  for (const listener of listeners) listener();
}

export function startTheme(): void {
  system.addEventListener('change', apply);
  const paper = (now: boolean) => () => {
    onPaper = now;
    apply();
  };
  window.addEventListener('beforeprint', paper(true));
  window.addEventListener('afterprint', paper(false));
  apply();
}
