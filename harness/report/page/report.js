'use strict';
(() => {
  const number = text => {
    const match = text.trim().match(/^[×+]?\s*(-?\d+(\.\d+)?(e[-+]?\d+)?)/i);
    return match ? Number(match[1]) : NaN;
  };

  // --- Tables: a click on a heading sorts, long ones can be filtered -------------------------
  const headOf = table => {
    const row = table.tHead ? table.tHead.rows[table.tHead.rows.length - 1] : table.rows[0];
    return row && [...row.cells].every(cell => cell.tagName === 'TH') ? row : null;
  };
  const bodyOf = (table, head) => [...table.rows].filter(
      row => row !== head && !row.closest('thead') && row.cells.length > 1);

  const sortBy = (table, head, column, button) => {
    const down = button.getAttribute('aria-sort') === 'ascending';
    for (const cell of head.cells) cell.removeAttribute('aria-sort');
    button.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const rows = bodyOf(table, head).map((row, index) => {
      const text = row.cells[column] ? row.cells[column].textContent.trim() : '';
      return {row, index, text, value: number(text)};
    });
    rows.sort((a, b) => {
      const numbers = !isNaN(a.value) && !isNaN(b.value);
      if (isNaN(a.value) !== isNaN(b.value)) return isNaN(a.value) ? 1 : -1;
      const order = numbers ? a.value - b.value : a.text.localeCompare(b.text);
      return (down ? -order : order) || a.index - b.index;
    });
    for (const {row} of rows) row.parentNode.appendChild(row);
  };

  const addFilter = (table, head) => {
    const box = document.createElement('input');
    box.type = 'search';
    box.placeholder = 'filter rows';
    box.className = 'filter';
    box.setAttribute('aria-label', 'filter rows');
    box.addEventListener('input', () => {
      const words = box.value.toLowerCase().split(/\s+/).filter(Boolean);
      for (const row of bodyOf(table, head)) {
        const text = row.textContent.toLowerCase();
        row.hidden = !words.every(word => text.includes(word));
      }
    });
    table.parentNode.insertBefore(box, table);
  };

  for (const table of document.querySelectorAll('table')) {
    const head = headOf(table);
    if (!head) continue;
    const offset = table.classList.contains('grouped') ? 1 : 0;
    [...head.cells].forEach((cell, column) => {
      cell.classList.add('sortable');
      cell.tabIndex = 0;
      const sort = () => sortBy(table, head, column + offset, cell);
      cell.addEventListener('click', sort);
      cell.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });
    });
    if (bodyOf(table, head).length > 12) addFilter(table, head);
  }

  // --- Charts: the values under the pointer ---------------------------------------------------
  const axis = text => {
    const [low, high, from, to] = text.split(' ').map(Number);
    return px => low + (px - from) / (to - from) * (high - low);
  };
  const SVG = 'http://www.w3.org/2000/svg';
  for (const svg of document.querySelectorAll('svg')) {
    const panels = [...svg.querySelectorAll('rect.panel')];
    if (panels.length === 0) continue;
    // A path is told in steps, in halves of a pixel.
    const pointsOf = path => {
      const numbers = path.getAttribute('d').match(/-?\d+/g).map(Number);
      const points = [];
      for (let i = 0, x = 0, y = 0; i + 1 < numbers.length; i += 2) {
        points.push([(x += numbers[i]) / 2, (y += numbers[i + 1]) / 2]);
      }
      return points;
    };
    const lines = [...svg.querySelectorAll('path[data-name]')].map(
        path => ({name: path.dataset.name, points: pointsOf(path)}));
    const yAt = (points, x) => {
      for (let i = 1; i < points.length; ++i) {
        const [a, b] = [points[i - 1], points[i]];
        if (b[0] > a[0] && a[0] <= x && x <= b[0]) {
          return a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
        }
      }
      return null;
    };
    const readout = document.createElement('p');
    readout.className = 'readout small soft';
    readout.textContent = '\u00a0';
    svg.after(readout);
    const cursor = document.createElementNS(SVG, 'line');
    cursor.setAttribute('class', 'cursor');
    svg.appendChild(cursor);
    const show = event => {
      const at = new DOMPoint(event.clientX, event.clientY)
          .matrixTransform(svg.getScreenCTM().inverse());
      const first = panels[0].dataset;
      const x = axis(first.x);
      const values = [];
      for (const panel of panels) {
        const top = Number(panel.getAttribute('y'));
        const bottom = top + Number(panel.getAttribute('height'));
        const here = [];
        for (const line of lines) {
          const y = line.points[0][1] >= top - 1 && line.points[0][1] <= bottom + 1 ?
              yAt(line.points, at.x) : null;
          if (y === null) continue;
          const value = axis(panel.dataset.y)(y).toPrecision(3);
          here.push(line.name === panel.dataset.title ? value : `${line.name} ${value}`);
        }
        if (here.length > 0) values.push(`${panel.dataset.title}: ${here.join(', ')}`);
      }
      readout.textContent = `${x(at.x).toPrecision(4)}\n${values.join('\n')}`;
      cursor.setAttribute('x1', at.x);
      cursor.setAttribute('x2', at.x);
      cursor.setAttribute('y1', panels[0].getAttribute('y'));
      const last = panels[panels.length - 1];
      cursor.setAttribute('y2', Number(last.getAttribute('y')) + Number(last.getAttribute('height')));
    };
    for (const panel of panels) panel.addEventListener('pointermove', show);
  }

  // --- Tracks in three dimensions: drag to turn, wheel to come closer -------------------------
  for (const figure of document.querySelectorAll('figure[data-tracks]')) {
    const tracks = figure.dataset.tracks.split(';').map(text => {
      const [color, ...steps] = text.split(' ').map(Number);
      const points = [];
      for (let i = 0, at = [0, 0, 0]; i + 2 < steps.length; i += 3) {
        points.push(at = at.map((v, k) => v + steps[i + k] / 1000));
      }
      return {color, points};
    });
    const canvas = document.createElement('canvas');
    figure.prepend(canvas);
    figure.hidden = false;
    // A straight drive is a line to which an error of centimetres adds nothing that can be seen: an
    // axis that is much shorter than the longest is stretched, by a round number that is said.
    const round = value => {
      const power = Math.pow(10, Math.floor(Math.log10(value)));
      return power * [5, 2, 1].find(digit => digit * power <= value);
    };
    const extentOf = k => {
      const along = tracks.flatMap(track => track.points.map(p => p[k]));
      return Math.max(...along) - Math.min(...along);
    };
    const extents = [0, 1, 2].map(extentOf), longest = Math.max(...extents, 0.1);
    const stretch = extents.map(extent =>
      extent < longest / 8 ? Math.min(1000, round(longest / 8 / Math.max(extent, 1e-6))) : 1);
    const stretched = ['x', 'y', 'z'].map((axis, k) => stretch[k] > 1 ? `${axis} ×${stretch[k]}` : '')
      .filter(text => text).join(', ');
    for (const track of tracks) {
      track.points = track.points.map(p => p.map((v, k) => v * stretch[k]));
    }
    const all = tracks.flatMap(track => track.points);
    const low = [0, 1, 2].map(k => Math.min(...all.map(p => p[k])));
    const high = [0, 1, 2].map(k => Math.max(...all.map(p => p[k])));
    const middle = low.map((v, k) => (v + high[k]) / 2);
    const extent = Math.max(...high.map((v, k) => v - low[k]), 0.1);
    // Pixels a metre so that the tracks fill the canvas as it is first turned.
    let first = null;
    const fit = (width, height, turned) => {
      if (first === null) {
        const seen = all.map(turned);
        const reach = k => Math.max(...seen.map(p => Math.abs(p[k])), 0.05 * extent);
        first = {right: reach(0), up: reach(1)};
      }
      return 0.42 * Math.min(width / first.right, height / first.up);
    };
    let yaw = -0.7, pitch = 0.6, zoom = 1, dragging = null;

    const draw = () => {
      const ratio = window.devicePixelRatio || 1;
      const width = canvas.clientWidth, height = canvas.clientHeight;
      canvas.width = width * ratio;
      canvas.height = height * ratio;
      const pen = canvas.getContext('2d');
      pen.scale(ratio, ratio);
      pen.clearRect(0, 0, width, height);
      const style = getComputedStyle(document.documentElement);
      const turned = p => {
        const [x, y, z] = p.map((v, k) => v - middle[k]);
        const along = Math.cos(yaw) * x - Math.sin(yaw) * y;
        const away = Math.sin(yaw) * x + Math.cos(yaw) * y;
        return [along, Math.cos(pitch) * z + Math.sin(pitch) * away];
      };
      const scale = zoom * fit(width, height, turned);
      const project = p => {
        const [right, up] = turned(p);
        return [width / 2 + scale * right, height / 2 - scale * up];
      };
      const line = (points, color, thick, dash) => {
        pen.beginPath();
        pen.strokeStyle = color;
        pen.lineWidth = thick;
        pen.setLineDash(dash);
        points.forEach((p, i) => {
          const [x, y] = project(p);
          i ? pen.lineTo(x, y) : pen.moveTo(x, y);
        });
        pen.stroke();
      };
      const step = Math.pow(10, Math.floor(Math.log10(extent)));
      const rule = style.getPropertyValue('--rule').trim();
      const ground = low[2];
      for (let x = Math.floor(low[0] / step); x <= Math.ceil(high[0] / step); ++x) {
        line([[x * step, Math.floor(low[1] / step) * step, ground],
              [x * step, Math.ceil(high[1] / step) * step, ground]], rule, 1, []);
      }
      for (let y = Math.floor(low[1] / step); y <= Math.ceil(high[1] / step); ++y) {
        line([[Math.floor(low[0] / step) * step, y * step, ground],
              [Math.ceil(high[0] / step) * step, y * step, ground]], rule, 1, []);
      }
      for (const track of tracks) {
        const truth = track.color < 0;
        const color = style.getPropertyValue(truth ? '--truth' : `--c${track.color}`).trim();
        line(track.points, color, truth ? 2.4 : 1.8, truth ? [6, 4] : []);
      }
      pen.setLineDash([]);
      pen.fillStyle = style.getPropertyValue('--soft').trim();
      pen.font = '12px system-ui, sans-serif';
      pen.fillText(`grid ${step} m${stretched ? `; stretched: ${stretched}` : ''}`, 8, height - 8);
    };
    canvas.addEventListener('pointerdown', event => {
      dragging = [event.clientX, event.clientY];
      canvas.setPointerCapture(event.pointerId);
    });
    canvas.addEventListener('pointerup', () => { dragging = null; });
    canvas.addEventListener('pointermove', event => {
      if (!dragging) return;
      yaw += (event.clientX - dragging[0]) * 0.01;
      pitch = Math.max(0, Math.min(1.57, pitch + (event.clientY - dragging[1]) * 0.01));
      dragging = [event.clientX, event.clientY];
      draw();
    });
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      zoom = Math.max(0.2, Math.min(50, zoom * Math.exp(-event.deltaY * 0.001)));
      draw();
    }, {passive: false});
    new ResizeObserver(draw).observe(canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
    draw();
  }
})();
