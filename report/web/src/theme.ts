/** Dark and light: what the page shows now, and who must draw anew when it changes. */

const CHANGED = 'spall:theme';
const dark = matchMedia('(prefers-color-scheme: dark)');

export function isDark(): boolean {
  const chosen = document.documentElement.dataset.theme;
  return chosen ? chosen === 'dark' : dark.matches;
}

export function choose(theme: 'dark' | 'light'): void {
  document.documentElement.dataset.theme = theme;
  document.dispatchEvent(new Event(CHANGED));
}

export function onThemeChange(act: () => void): void {
  document.addEventListener(CHANGED, act);
  dark.addEventListener('change', act);
}

/** The value of a colour that page.css names, e.g. "ink". */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
