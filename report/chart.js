// Brings the page's charts to life: values on hover, zoom, saving as SVG and CSV. The data stand in the page, beside each
// chart; nothing is loaded. Without this script the page shows the same curves as still drawings (chart_svg.cpp).
(() => {
  'use strict';
  const margin = { left: 66, right: 18, top: 16, bottom: 52 };
  const escape = (text) => String(text).replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);
  const superscript = (n) => (n < 0 ? '⁻' : '') + [...String(Math.abs(n))].map((d) => '⁰¹²³⁴⁵⁶⁷⁸⁹'[d]).join('');
  const usable = (value, axis) => value !== null && Number.isFinite(value) && (!axis.log || value > 0);
  const along = (axis, value) => (axis.log ? Math.log10(value) : value);
  const back = (axis, place) => (axis.log ? 10 ** place : place);
  const unitless = (unit) => !unit || unit === '-' || unit === '1';
  const look = (series) => series.kind + (series.thin ? ' thin' : '');
  const words = (axis) => (axis.unit ? `${axis.title} [${axis.unit}]` : axis.title);
  const short = (value, unit) => `${String(Number(value.toPrecision(5))).replace('-', '−')}${unitless(unit) ? '' : ' ' + unit}`;

  // Ticks at 1, 2 or 5 times a power of ten, as in chart_svg.cpp. [low, high] in data units.
  function ticks(axis, [low, high], wanted) {
    const decades = Math.log10(high / low);
    if (axis.log && decades >= 1.2) {
      const out = { at: [], labels: [], power: 0 };
      const stride = Math.max(1, Math.ceil(decades / wanted));
      for (let p = Math.ceil(Math.log10(low) - 1e-9); p <= Math.log10(high) + 1e-9; p += stride) {
        out.at.push(10 ** p);
        out.labels.push(p >= -3 && p <= 4 ? String(Number((10 ** p).toPrecision(1))) : '10' + superscript(p));
      }
      return out;
    }
    const rough = (high - low) / Math.max(1, wanted);
    const unit = 10 ** Math.floor(Math.log10(rough));
    const step = unit * [1, 2, 5, 10].find((n) => rough <= n * 1.0001 * unit);
    const largest = Math.max(Math.abs(low), Math.abs(high));
    const power = largest >= 1e5 || largest < 1e-2 ? Math.floor(Math.log10(largest)) : 0;
    const decimals = Math.min(12, Math.max(0, -Math.floor(Math.log10(step / 10 ** power) + 1e-9)));
    const out = { at: [], labels: [], power };
    for (let k = Math.ceil(low / step - 1e-6); k * step <= high + 1e-6 * step; ++k) {
      if (axis.log && k <= 0) continue;
      out.at.push(k * step);
      out.labels.push((k < 0 ? '−' : '') + Math.abs((k * step) / 10 ** power).toFixed(decimals));
    }
    return out;
  }

  function marker(x, y, colour) {
    const at = (dx, dy) => `M${(x + dx).toFixed(1)} ${(y + dy).toFixed(1)}`;
    return [
      at(-3.4, 0) + 'a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0Z', at(-3, -3) + 'h6v6h-6Z',
      at(0, -4.4) + 'l4 7h-8Z', at(0, -4) + 'l4 4l-4 4l-4 -4Z',
    ][colour % 4];
  }

  function save(name, type, text) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([text], { type }));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  function start(figure) {
    const data = JSON.parse(figure.querySelector('script').textContent);
    const canvas = figure.querySelector('.canvas');
    const svg = canvas.querySelector('svg');
    const clip = svg.querySelector('clipPath').id;
    const home = () => ({
      x: [along(data.x, data.x.low), along(data.x, data.x.high)], y: [along(data.y, data.y.low), along(data.y, data.y.high)],
    });
    let view = home(), width = 860, height = 430, box, drag = null, chosen = null;
    data.series.forEach((series) => { series.shown = true; });

    const px = (value) => box.left + ((along(data.x, value) - view.x[0]) / (view.x[1] - view.x[0])) * box.width;
    const py = (value) => box.bottom - ((along(data.y, value) - view.y[0]) / (view.y[1] - view.y[0])) * box.height;
    const place = (x, y) => ({
      x: view.x[0] + ((x - box.left) / box.width) * (view.x[1] - view.x[0]),
      y: view.y[0] + ((box.bottom - y) / box.height) * (view.y[1] - view.y[0]),
    });

    const readable = (series, k) => usable(series.x[k], data.x) && usable(series.y[k], data.y);

    function path(series) {
      const good = (k, values) => usable(series.x[k], data.x) && usable(values[k], data.y);
      let out = '';
      if (series.kind === 'band') {
        const keep = series.x.map((_, k) => k).filter((k) => good(k, series.y) && good(k, series.upper));
        const edge = (values) => (k) => `${px(series.x[k]).toFixed(1)} ${py(values[k]).toFixed(1)}`;
        return keep.length ? 'M' + [...keep.map(edge(series.y)), ...keep.reverse().map(edge(series.upper))].join('L') + 'Z' : '';
      }
      let drawing = false, lastX = 0, lastY = 0;
      for (let k = 0; k < series.x.length; ++k) {
        if (!good(k, series.y)) { drawing = false; continue; }
        const x = px(series.x[k]), y = py(series.y[k]);
        if (series.kind === 'points') { out += marker(x, y, series.colour); continue; }
        if (drawing && k + 1 < series.x.length && Math.hypot(x - lastX, y - lastY) < 0.35) continue;
        out += `${drawing ? 'L' : 'M'}${x.toFixed(1)} ${y.toFixed(1)}`;
        [drawing, lastX, lastY] = [true, x, y];
      }
      return out;
    }

    function draw() {
      width = Math.max(280, canvas.clientWidth);
      height = Math.round(Math.min(430, Math.max(270, width * 0.5)));
      const right = width - margin.right, bottom = height - margin.bottom;
      box = { left: margin.left, top: margin.top, right, bottom, width: right - margin.left, height: bottom - margin.top };
      const shownX = view.x.map((v) => back(data.x, v)), shownY = view.y.map((v) => back(data.y, v));
      const tx = ticks(data.x, shownX, Math.max(2, Math.round(box.width / 100)));
      const ty = ticks(data.y, shownY, Math.max(2, Math.round(box.height / 60)));
      const titled = (axis, power) => escape(words(axis) + (power ? '  ×10' + superscript(power) : ''));
      const middle = (box.top + bottom) / 2;
      let grid = '', text = '';
      tx.at.forEach((value, k) => {
        grid += `M${px(value).toFixed(1)} ${box.top}V${bottom}`;
        text += `<text x="${px(value).toFixed(1)}" y="${bottom + 18}" text-anchor="middle">${tx.labels[k]}</text>`;
      });
      ty.at.forEach((value, k) => {
        grid += `M${box.left} ${py(value).toFixed(1)}H${right}`;
        text += `<text x="${box.left - 8}" y="${(py(value) + 4).toFixed(1)}" text-anchor="end">${ty.labels[k]}</text>`;
      });
      const crosses = (axis, [low, high]) => !axis.log && low < 0 && high > 0;
      const zero = (crosses(data.x, shownX) ? `M${px(0).toFixed(1)} ${box.top}V${bottom}` : '') +
        (crosses(data.y, shownY) ? `M${box.left} ${py(0).toFixed(1)}H${right}` : '');
      text += `<text class="title" text-anchor="middle" x="${(box.left + right) / 2}" y="${height - 10}">${titled(data.x, tx.power)}</text>`;
      text += `<text class="title" text-anchor="middle" x="16" y="${middle}" transform="rotate(-90 16 ${middle})">${titled(data.y, ty.power)}</text>`;
      const curves = data.series.filter((s) => s.shown).map((s) => `<path class="${look(s)} c${s.colour}" d="${path(s)}"/>`).join('');
      svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
      svg.innerHTML = `<clipPath id="${clip}"><rect x="${box.left}" y="${box.top}" width="${box.width}" height="${box.height}"/></clipPath>` +
        `<path class="grid" d="${grid}"/><path class="zero" d="${zero}"/><path class="frame" d="M${box.left} ${box.top}V${bottom}H${right}"/>` +
        `<g class="words">${text}</g><g clip-path="url(#${clip})">${curves}</g><g class="over"></g>`;
      point(chosen, false);
    }

    // What the reader points at: a marked point and its values.
    const tip = document.createElement('div');
    tip.className = 'tip';
    tip.hidden = true;
    tip.setAttribute('role', 'status');
    canvas.append(tip);
    function point(choice, spoken) {
      chosen = choice;
      const over = svg.querySelector('.over');
      tip.hidden = !choice;
      if (over && !drag) over.innerHTML = '';
      if (!choice || !over) return;
      const { series, k } = choice;
      const x = px(series.x[k]), y = py(series.y[k]);
      const inside = x >= box.left - 1 && x <= box.right + 1 && y >= box.top - 1 && y <= box.bottom + 1;
      if (!series.shown || !inside) { tip.hidden = true; return; }
      over.innerHTML = `<path class="cross" d="M${x} ${box.top}V${box.bottom}M${box.left} ${y}H${box.right}"/>` +
        `<circle class="here c${series.colour}" cx="${x}" cy="${y}" r="4.5"/>`;
      const name = document.createElement('b');
      name.textContent = series.name;
      const second = series.upper ? `${short(series.y[k])} to ${short(series.upper[k], data.y.unit)}` : short(series.y[k], data.y.unit);
      tip.replaceChildren(name, `${data.x.title}  ${short(series.x[k], data.x.unit)}\n${data.y.title}  ${second}`);
      tip.setAttribute('aria-live', spoken ? 'polite' : 'off');
      tip.style.left = `${x > width / 2 ? Math.max(0, x - tip.offsetWidth - 14) : Math.min(x + 14, width - tip.offsetWidth)}px`;
      tip.style.top = `${y > height / 2 ? Math.max(0, y - tip.offsetHeight - 10) : y + 10}px`;
    }
    function nearest(x, y) {
      let best = null, closest = 40 * 40;
      for (const series of data.series) {
        if (!series.shown) continue;
        for (let k = 0; k < series.x.length; ++k) {
          if (!readable(series, k)) continue;
          // A band gives way to a curve as near as its edge: the curve is what the reader wants to know.
          const distance = (px(series.x[k]) - x) ** 2 + (py(series.y[k]) - y) ** 2 + (series.upper ? 150 : 0);
          if (distance < closest) [best, closest] = [{ series, k }, distance];
        }
      }
      return best;
    }

    function zoom(factor, x, y) {
      const at = place(x, y);
      for (const name of ['x', 'y']) view[name] = view[name].map((edge) => at[name] + (edge - at[name]) * factor);
      // Beyond this the ticks would run out of digits, or the curves out of sight.
      const whole = home();
      for (const name of ['x', 'y']) {
        const share = (view[name][1] - view[name][0]) / (whole[name][1] - whole[name][0]);
        if (share > 20 || share < 1e-6) view = whole;
      }
      draw();
    }
    function pan(dx, dy) {
      view.x = view.x.map((v) => v - (dx / box.width) * (view.x[1] - view.x[0]));
      view.y = view.y.map((v) => v + (dy / box.height) * (view.y[1] - view.y[0]));
      draw();
    }
    function reset() { view = home(); chosen = null; draw(); }

    const where = (event) => {
      const frame = svg.getBoundingClientRect();
      return { x: ((event.clientX - frame.left) / frame.width) * width, y: ((event.clientY - frame.top) / frame.height) * height };
    };
    const within = (at) => ({ x: Math.min(box.right, Math.max(box.left, at.x)), y: Math.min(box.bottom, Math.max(box.top, at.y)) });
    canvas.addEventListener('pointerdown', (event) => {
      if (event.button !== 0) return;
      drag = { from: within(where(event)), to: null, moves: event.shiftKey };
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointermove', (event) => {
      const at = where(event);
      if (!drag) { point(nearest(at.x, at.y), false); return; }
      const to = within(at);
      if (drag.moves) {
        pan(to.x - drag.from.x, to.y - drag.from.y);
        drag.from = to;
        return;
      }
      drag.to = to;
      tip.hidden = true;
      const area = selection();
      svg.querySelector('.over').innerHTML =
        `<rect class="select" x="${area.left}" y="${area.top}" width="${area.right - area.left}" height="${area.bottom - area.top}"/>`;
    });
    // A flat drag selects along one axis only.
    function selection() {
      const { from, to } = drag;
      const wide = Math.abs(to.x - from.x) > 10, tall = Math.abs(to.y - from.y) > 10;
      return {
        left: wide ? Math.min(from.x, to.x) : box.left, right: wide ? Math.max(from.x, to.x) : box.right,
        top: tall ? Math.min(from.y, to.y) : box.top, bottom: tall ? Math.max(from.y, to.y) : box.bottom, any: wide || tall,
      };
    }
    canvas.addEventListener('pointerup', () => {
      const area = drag && drag.to ? selection() : null;
      drag = null;
      if (area && area.any) {
        const low = place(area.left, area.bottom), high = place(area.right, area.top);
        view = { x: [low.x, high.x], y: [low.y, high.y] };
      }
      if (area) draw();
    });
    canvas.addEventListener('pointercancel', () => { drag = null; draw(); });
    canvas.addEventListener('pointerleave', () => { if (!drag) point(null, false); });
    canvas.addEventListener('dblclick', reset);
    // The wheel belongs to the page until the reader has chosen the chart.
    canvas.addEventListener('wheel', (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      const at = within(where(event));
      zoom(Math.exp(Math.max(-120, Math.min(120, event.deltaY)) * 0.002), at.x, at.y);
    }, { passive: false });
    canvas.addEventListener('keydown', (event) => {
      const centre = [(box.left + box.right) / 2, (box.top + box.bottom) / 2];
      const shown = data.series.filter((s) => s.shown && s.x.length);
      const step = (by) => {
        if (!shown.length) return;
        const { series, k } = chosen || { series: shown[0], k: by > 0 ? -1 : shown[0].x.length };
        let next = Math.min(series.x.length - 1, Math.max(0, k + by));
        while (series.x[next] !== undefined && !readable(series, next)) next += Math.sign(by);
        if (series.x[next] !== undefined) point({ series, k: next }, true);
      };
      const other = (by) => {
        if (!shown.length) return;
        const next = shown[(shown.indexOf(chosen ? chosen.series : null) + by + shown.length) % shown.length] || shown[0];
        const k = Math.min(next.x.length - 1, chosen ? chosen.k : 0);
        const readableNear = [...next.x.keys()].filter((n) => readable(next, n)).sort((a, b) => Math.abs(a - k) - Math.abs(b - k))[0];
        if (readableNear !== undefined) point({ series: next, k: readableNear }, true);
      };
      const act = {
        '+': () => zoom(0.8, ...centre), '=': () => zoom(0.8, ...centre), '-': () => zoom(1.25, ...centre), 0: reset,
        Escape: () => { drag = null; reset(); }, ArrowRight: () => step(event.shiftKey ? 10 : 1), ArrowLeft: () => step(event.shiftKey ? -10 : -1),
        ArrowDown: () => other(1), ArrowUp: () => other(-1),
      }[event.key];
      if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
      event.preventDefault();
      act();
    });

    // Buttons: the legend hides and shows, the tools save and reset.
    figure.querySelectorAll('.legend li').forEach((item, k) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.append(...item.childNodes);
      button.setAttribute('aria-pressed', 'true');
      button.title = 'Show or hide';
      button.addEventListener('click', () => {
        data.series[k].shown = !data.series[k].shown;
        button.setAttribute('aria-pressed', String(data.series[k].shown));
        draw();
      });
      item.append(button);
    });
    const tools = document.createElement('div');
    tools.className = 'tools';
    const tool = (label, title, act) => {
      const button = document.createElement('button');
      Object.assign(button, { type: 'button', textContent: label, title });
      button.addEventListener('click', act);
      tools.append(button);
    };
    const file = data.title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '') || 'chart';
    tool('Reset', 'Show everything again', reset);
    tool('SVG', 'Save the drawing as it is shown', () => save(`${file}.svg`, 'image/svg+xml', picture()));
    tool('CSV', 'Save the data of every curve', () => save(`${file}.csv`, 'text/csv', table()));
    figure.querySelector('.head').append(tools);
    const hint = document.createElement('p');
    hint.className = 'hint';
    hint.textContent = 'Drag to zoom, shift-drag to move, wheel after a click, double click to reset; keys: arrows read values, + − 0 zoom.';
    figure.append(hint);
    canvas.classList.add('live');
    canvas.tabIndex = 0;
    canvas.setAttribute('role', 'application');
    canvas.setAttribute('aria-label', `${data.title}: arrow keys read values, plus and minus zoom, zero resets`);

    // The drawing with its title and legend, its looks written into it so that it stands alone.
    function picture() {
      const looks = ['fill', 'fill-opacity', 'stroke', 'stroke-opacity', 'stroke-width', 'stroke-dasharray', 'stroke-linejoin', 'stroke-linecap', 'font-size', 'font-family'];
      const shown = data.series.filter((series) => series.shown);
      const head = 30 + 18 * shown.length;
      const live = svg.cloneNode(true);
      live.querySelector('.over').remove();
      const heading = shown.map((series, k) => {
        const d = { band: 'M0 -5H28V5H0Z', points: marker(14, 0, series.colour) }[series.kind] || 'M0 0H28';
        return `<g transform="translate(${box.left} ${36 + 18 * k})"><path class="${look(series)} c${series.colour}" d="${d}"/>` +
          `<g class="words"><text x="36" y="4">${escape(series.name)}</text></g></g>`;
      }).join('');
      live.innerHTML = `<rect width="${width}" height="${height + head}" style="fill:var(--card)"/>` +
        `<g class="words"><text class="title" x="${box.left}" y="20">${escape(data.title)}</text></g>${heading}` +
        `<g transform="translate(0 ${head})">${live.innerHTML}</g>`;
      live.setAttribute('viewBox', `0 0 ${width} ${height + head}`);
      live.setAttribute('width', width);
      live.setAttribute('height', height + head);
      live.style.visibility = 'hidden';
      figure.append(live);
      live.querySelectorAll('rect, path, text').forEach((node) => {
        const style = getComputedStyle(node);
        node.setAttribute('style', looks.map((name) => `${name}:${style.getPropertyValue(name)}`).join(';'));
      });
      live.remove();
      live.removeAttribute('style');
      return new XMLSerializer().serializeToString(live);
    }

    function table() {
      const quote = (text) => (/[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text);
      const column = (axis) => quote(`${axis.title}[${axis.unit || '-'}]`);
      const banded = data.series.some((series) => series.upper);
      const rows = [`series,${column(data.x)},${column(data.y)}${banded ? ',upper' : ''}`];
      for (const series of data.series)
        series.x.forEach((x, k) => {
          const cells = [quote(series.name), x, series.y[k], ...(banded ? [series.upper ? series.upper[k] : ''] : [])];
          rows.push(cells.map((cell) => (cell === null ? '' : cell)).join(','));
        });
      return rows.join('\n') + '\n';
    }

    draw();
    new ResizeObserver(() => { if (Math.abs(canvas.clientWidth - width) > 1) draw(); }).observe(canvas);
  }

  document.querySelectorAll('figure.chart').forEach(start);
})();
