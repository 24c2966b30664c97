/** Makes what the tests open: reports of a real calibration and a real impact by the spall command, and made-up pages. */
import { execFileSync, spawnSync } from 'node:child_process';
import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { OUT, SOURCE } from './pages';

const CASE = `name = "small"
[targets]
E = "30 GPa"
nu = 0.2
ft = "3 MPa"
[fixed]
zeta = 5
Co = "8 MPa"
[specimen]
size = "0.4x0.2x0.2 m"
elements = 1400
fit_seeds = [1]
check_seeds = [2]
`;

export default function setup(): void {
  rmSync(OUT, { recursive: true, force: true });
  mkdirSync(join(OUT, 'pictures'), { recursive: true });
  writeFileSync(join(OUT, 'case.toml'), CASE);
  const spall = (...words: string[]): void => {
    const run = spawnSync(process.env.SPALL_BINARY!, [...words, '--quiet', '--threads', '2'], { cwd: OUT, encoding: 'utf8' });
    // 4: the fit ended, and a tolerance was missed. The page says so.
    if (run.status !== 0 && run.status !== 4) throw new Error(`spall ${words.join(' ')}: ${String(run.status)} ${run.stderr}`);
  };
  spall('calibrate', 'case.toml', '-o', 'calibration');
  spall('impact', join(SOURCE, 'data/cases/slab-small.toml'), '-o', 'impact');
  execFileSync(process.env.SPALL_MAKE_PAGES!, [OUT]);
}
