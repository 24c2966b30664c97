/** The picture as a file: what the canvas shows, with the moment, the scale and the colour bar drawn in. */
import { shortNumber } from '../dom';
import { colour } from '../theme';
import { colourAt } from './colours';
import { roundLength } from './overlay';
import type { Overlay } from './overlay';
import type { State } from './state';
import type { SceneData } from './unpack';
import type { View } from './view';

export async function picture(view: View, scene: SceneData, state: State, overlay: Overlay): Promise<Blob> {
  const { width, height } = view.canvas;
  const ratio = width / view.canvas.clientWidth;
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width, height });
  const paper = canvas.getContext('2d')!;
  paper.fillStyle = colour('card');
  paper.fillRect(0, 0, width, height);
  paper.drawImage(view.canvas, 0, 0);
  paper.scale(ratio, ratio);
  const [w, h] = [width / ratio, height / ratio];
  paper.font = '13px system-ui, "DejaVu Sans", sans-serif';
  paper.fillStyle = paper.strokeStyle = colour('ink');
  paper.fillText(scene.header.frames[state.frame]!.label, 14, 24);
  const length = roundLength(130 * view.metresPerPixel());
  const long = length.metres / view.metresPerPixel();
  paper.fillRect(14, h - 18, long, 2);
  paper.textAlign = 'center';
  paper.fillText(length.words, 14 + long / 2, h - 24);
  const field = scene.header.fields[state.field];
  if (field && !state.brokenOnly) {
    const [x, top, tall] = [w - 70, 44, 160];
    for (let k = 0; k < tall; ++k) {
      paper.fillStyle = `rgb(${colourAt(state.map, 1 - k / (tall - 1)).join(',')})`;
      paper.fillRect(x, top + k, 14, 1.5);
    }
    paper.fillStyle = colour('ink');
    paper.textAlign = 'right';
    paper.fillText(field.unit ? `${field.name} [${field.unit}]` : field.name, w - 14, 26);
    paper.textAlign = 'left';
    overlay.tickValues().forEach((value, k) => paper.fillText(shortNumber(value, 3), x + 20, top + 4 + (k * tall) / 4));
  }
  return new Promise((resolve, reject) =>
    canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error('the picture could not be encoded'))), 'image/png'));
}
