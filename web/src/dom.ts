// Elements made in code: text is always text, never markup.

type Child = Node | string | null | undefined | false;
type Attributes = Record<string, string | number | boolean | ((event: Event) => void)>;

function fill(element: Element, attributes: Attributes, children: Child[]): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, '');
    else if (value !== false) element.setAttribute(name, String(value));
  }
  for (const child of children) if (child) element.append(child);
}

// An element with attributes (functions become listeners of the event of that name) and children.
export function el<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  fill(element, attributes, children);
  return element;
}

export function svg<K extends keyof SVGElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: Child[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
  fill(element, attributes, children);
  return element;
}

export function button(label: string, title: string, act: () => void): HTMLButtonElement {
  return el('button', {type: 'button', title, 'aria-label': title, click: act}, label);
}

// Buttons in a row; on a narrow screen behind one that opens them.
export function menu(title: string, ...buttons: HTMLButtonElement[]): HTMLElement {
  const details = el('details', {class: 'menu'}, el('summary', {'aria-label': title, title}, '⋯'), el('div', {class: 'tools'}, ...buttons));
  const narrow = window.matchMedia('(max-width: 640px)');
  const fit = () => {
    details.open = !narrow.matches;
  };
  narrow.addEventListener('change', fit);
  fit();
  return details;
}

// One of several: a group of radio buttons that looks like a row of buttons.
export function choice<T extends string>(
  legend: string, options: {value: T; label: string}[], chosen: T, act: (value: T) => void): HTMLFieldSetElement {
  const name = `choice-${++choices}`;
  return el('fieldset', {class: 'choice'}, el('legend', {}, legend), ...options.map(option => {
    const input = el('input', {type: 'radio', name, value: option.value, checked: option.value === chosen,
                               change: () => act(option.value)});
    return el('label', {}, input, el('span', {}, option.label));
  }));
}
let choices = 0;

// Hands a file to the reader.
export function download(name: string, data: Blob): void {
  const url = URL.createObjectURL(data);
  const link = el('a', {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

export function downloadText(name: string, type: string, text: string): void {
  download(name, new Blob([text], {type: `${type};charset=utf-8`}));
}

// A file name from user text: letters, digits, - and _.
export function fileName(text: string): string {
  return text.replace(/[^A-Za-z0-9_-]+/g, '_').slice(0, 60) || 'strandlab';
}
