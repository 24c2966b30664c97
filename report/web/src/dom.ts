/** Small helpers for parts of the page that only scripts need. */

type Properties<Tag extends keyof HTMLElementTagNameMap> = Partial<Omit<HTMLElementTagNameMap[Tag], 'style'>>;

/** An element with properties and children; text stays text. */
export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  properties: Properties<Tag> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

export function button(label: string, title: string, act: () => void): HTMLButtonElement {
  const element = make('button', { type: 'button', title }, label);
  element.addEventListener('click', act);
  return element;
}

/** "Uniaxial tension" -> "uniaxial-tension" */
export function fileName(title: string, otherwise: string): string {
  return title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '') || otherwise;
}

/** Hands the reader a file. */
export function save(name: string, content: Blob): void {
  const link = make('a', { href: URL.createObjectURL(content), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** What a script element within `parent` holds. */
export function embedded(parent: Element, type: string): string {
  const element = parent.querySelector(`script[type="${type}"]`);
  if (!element) throw new Error(`no ${type} in the page where it should be`);
  return element.textContent;
}

/** About `digits` significant digits with a true minus sign; a dash for what is no number. */
export function shortNumber(value: number, digits = 5): string {
  if (!Number.isFinite(value)) return '–';
  return String(Number(value.toPrecision(digits))).replace(/-/g, '−');
}

/** "3.1 MPa"; units that are none are left out. */
export function withUnit(value: number, unit: string, digits = 5): string {
  const number = shortNumber(value, digits);
  return unit && unit !== '-' && unit !== '1' ? `${number} ${unit}` : number;
}
