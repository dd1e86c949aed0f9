'use strict';
(() => {
  const number = text => {
    const match = text.trim().match(/^[×≈+]?\s*(-?\d+(\.\d+)?(e[-+]?\d+)?)/i);
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
      const cell = row.cells[column];
      const text = cell ? cell.textContent.trim() : '';
      return {row, index, text, value: number(cell && cell.dataset.value || text)};
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
  // A panel's data-x and data-y: the values at its two ends and where these are drawn, in the
  // chart's own thousandths across and pixels down. Where it is bare, values across say nothing.
  const axisOf = text => {
    const [low, high, from, to] = text.split(' ').map(Number);
    return {value: at => low + (at - from) / (to - from) * (high - low),
            at: value => from + (value - low) / (high - low) * (to - from), from, to};
  };
  const SVG = 'http://www.w3.org/2000/svg';
  const draw = (name, css, parent) => {
    const element = document.createElementNS(SVG, name);
    element.setAttribute('class', css);
    parent.appendChild(element);
    return element;
  };
  // A path is told in steps, in halves of a pixel.
  const pointsOf = path => {
    const numbers = path.getAttribute('d').match(/-?\d+/g).map(Number);
    const points = [];
    for (let i = 0, x = 0, y = 0; i + 1 < numbers.length; i += 2) {
      points.push([(x += numbers[i]) / 2, (y += numbers[i + 1]) / 2]);
    }
    return points;
  };
  const yAt = (points, x) => {
    for (let i = 1; i < points.length; ++i) {
      const [a, b] = [points[i - 1], points[i]];
      if (b[0] > a[0] && a[0] <= x && x <= b[0]) {
        return a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]);
      }
    }
    return null;
  };

  for (const svg of document.querySelectorAll('svg.chart')) {
    const panels = [...svg.querySelectorAll('rect.panel')];
    const lines = [...svg.querySelectorAll('path[data-name]')].map(
        path => ({name: path.dataset.name, points: pointsOf(path)}));
    if (panels.length === 0 || lines.length === 0) continue;
    const readout = document.createElement('p');
    readout.className = 'readout small soft';
    readout.textContent = '\u00a0';
    svg.after(readout);
    const cursor = draw('line', 'cursor', svg);
    const inPanel = (points, panel) => {
      const top = Number(panel.getAttribute('y'));
      const bottom = top + Number(panel.getAttribute('height'));
      return points[0][1] >= top - 1 && points[0][1] <= bottom + 1;
    };
    const place = across => {
      const first = panels[0], last = panels[panels.length - 1];
      cursor.setAttribute('x1', `${across / 10}%`);
      cursor.setAttribute('x2', `${across / 10}%`);
      cursor.setAttribute('y1', first.getAttribute('y'));
      cursor.setAttribute('y2', Number(last.getAttribute('y')) + Number(last.getAttribute('height')));
    };
    const show = event => {
      const box = panels[0].getBoundingClientRect();
      const x = axisOf(panels[0].dataset.x);
      const across = x.from + (event.clientX - box.left) / box.width * (x.to - x.from);
      const values = [];
      for (const panel of panels) {
        const here = [];
        for (const line of lines) {
          const y = inPanel(line.points, panel) ? yAt(line.points, across) : null;
          if (y === null) continue;
          const value = axisOf(panel.dataset.y).value(y).toPrecision(3);
          here.push(line.name === panel.dataset.title ? value : `${line.name} ${value}`);
        }
        if (here.length > 0) values.push(`${panel.dataset.title}: ${here.join(', ')}`);
      }
      const at = 'bare' in panels[0].dataset ? '' : `${x.value(across).toPrecision(4)}\n`;
      readout.textContent = at + values.join('\n');
      place(across);
    };
    for (const panel of panels) panel.addEventListener('pointermove', show);
    svg.showTime = seconds => place(axisOf(panels[0].dataset.x).at(seconds));
  }

  // --- Frames: one picture under a slider, and where it is in time and space ------------------
  const worldAxes = {x: 0, y: 1, z: 2};
  const showPlace = (map, at) => {
    const panel = map.querySelector('rect.panel');
    const titles = [...map.querySelectorAll('text.axis')].map(text => text.textContent);
    const across = titles.find(title => title !== panel.dataset.title);
    const x = axisOf(panel.dataset.x).at(at[worldAxes[across[0]]]);
    const y = axisOf(panel.dataset.y).at(at[worldAxes[panel.dataset.title[0]]]);
    const mark = map.querySelector('.here') || draw('circle', 'here', map);
    mark.setAttribute('cx', x);
    mark.setAttribute('cy', y);
    mark.setAttribute('r', 11);
  };

  for (const albums of document.querySelectorAll('.albums')) {
    const runs = [...albums.querySelectorAll('.album')].map(album => ({
      name: album.dataset.system,
      title: album.querySelector('h4').textContent,
      frames: [...album.querySelectorAll('.pictures a')],
    }));
    // The charts that stand before the album belong to the same scene.
    const charts = [...document.querySelectorAll('.charts')].filter(
        chart => chart.compareDocumentPosition(albums) & Node.DOCUMENT_POSITION_FOLLOWING).pop();
    const chart = charts && charts.querySelector('svg.chart');
    const map = charts && charts.querySelector('svg.map');
    const viewer = document.createElement('div');
    viewer.className = 'viewer';
    const make = (tag, parent = viewer) => parent.appendChild(document.createElement(tag));
    const tabs = make('div');
    tabs.className = 'tabs';
    const link = make('a');
    const image = make('img', link);
    const slider = make('input');
    slider.type = 'range';
    slider.min = 0;
    slider.setAttribute('aria-label', 'frame');
    const words = make('output');
    let run = null;

    const show = () => {
      const frame = run.frames[Number(slider.value)];
      const still = frame.querySelector('img');
      link.href = frame.href;
      image.src = frame.href;
      image.alt = still.alt;
      words.textContent = `${run.title}: ${still.alt.slice(0, still.alt.lastIndexOf(', '))}`;
      if (frame.dataset.s === undefined) return;
      if (chart && chart.showTime) chart.showTime(Number(frame.dataset.s));
      if (map) showPlace(map, frame.dataset.at.split(' ').map(Number));
    };
    const choose = (chosen, seconds) => {
      run = chosen;
      for (const tab of tabs.children) {
        tab.setAttribute('aria-pressed', tab.textContent === run.name);
      }
      slider.max = run.frames.length - 1;
      const distance = frame => Math.abs(Number(frame.dataset.s) - seconds);
      const worst = run.frames.findIndex(frame => frame.querySelector('img').alt.includes('worst error'));
      slider.value = seconds === null ? Math.max(worst, 0) :
          run.frames.reduce((best, frame, i) =>
              distance(frame) < distance(run.frames[best]) ? i : best, 0);
      show();
    };
    for (const one of runs) {
      const tab = make('button', tabs);
      tab.type = 'button';
      tab.textContent = one.name;
      tab.addEventListener('click', () => {
        choose(one, Number(run.frames[Number(slider.value)].dataset.s));
      });
    }
    slider.addEventListener('input', show);
    viewer.appendChild(albums.querySelector('.colors'));
    const heading = albums.querySelector('h3');
    viewer.id = heading.id;
    heading.removeAttribute('id');
    albums.hidden = true;
    const beside = charts && charts.querySelector('.beside');
    if (beside) {
      beside.prepend(viewer);
    } else {
      albums.before(viewer);
    }
    choose(runs[0], null);
  }
})();
