/** What every page has: a button for dark and light. */
import { button } from '../dom';
import { choose, isDark, onThemeChange } from '../theme';

const toggle = button('', '', () => choose(isDark() ? 'light' : 'dark'));
toggle.className = 'theme';

function label(): void {
  toggle.textContent = isDark() ? '☀ Light' : '☾ Dark';
  toggle.title = isDark() ? 'Show the page in light colours' : 'Show the page in dark colours';
}
label();
onThemeChange(label);
document.querySelector('header')?.prepend(toggle);
