// Bundles src/<name>/main.ts to dist/<name>.js: one script each, with the licences of what went into it, safe inside
// a <script> element. `npm run build -- <folder>` writes elsewhere.
import { mkdir, readFile, writeFile } from 'node:fs/promises';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build } from 'vite';

const here = dirname(fileURLToPath(import.meta.url));
const folder = resolve(process.argv[2] ?? join(here, 'dist'));
const licences = {
  curves: await readFile(join(here, 'licences/plotly.js.txt'), 'utf8'),
  space: `three 0.187.0\n\n${await readFile(join(here, 'node_modules/three/LICENSE'), 'utf8')}`,
};

/** Within <script> only "</script" and "<!--" would be trouble; in scripts both can stand in strings and comments only. */
const safe = (code) => code.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');

await mkdir(folder, { recursive: true });
for (const name of ['page', 'curves', 'space']) {
  const result = await build({
    root: here,
    configFile: false,
    logLevel: 'warn',
    define: { 'process.env.NODE_ENV': '"production"' },
    build: {
      write: false,
      target: 'es2022',
      minify: 'esbuild',
      // A self-contained page has no use for warnings about size.
      chunkSizeWarningLimit: 5000,
      lib: { entry: join(here, `src/${name}/main.ts`), formats: ['iife'], name: `spall_${name}`, fileName: name },
    },
  });
  const { code } = result[0].output[0];
  const notice = licences[name] ? `/*!\nThis script holds\n\n${licences[name].trim().replaceAll('*/', '* /')}\n*/\n` : '';
  await writeFile(join(folder, `${name}.js`), safe(`${notice}${code.trim()}\n`));
}
await writeFile(join(folder, 'LICENSES.txt'), Object.values(licences).map((text) => text.trim()).join('\n\n----\n') + '\n');
