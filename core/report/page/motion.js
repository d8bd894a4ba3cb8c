function setTime(time, source = null) {
  shown.time = Math.min(Math.max(time, 0), shown.end);
  byId('slider').value = shown.end > 0 ? Math.round((shown.time / shown.end) * 1000) : 0;
  byId('now').textContent = `t = ${shown.time.toPrecision(4)} s`;
  draw();
  for (const chart of charts) {
    if (!chart.graph || chart === source) continue;
    const times = chart.rows;
    let low = 0,
      high = times.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (times[middle][0] <= shown.time) low = middle;
      else high = middle - 1;
    }
    chart.graph.setSelection(low);
  }
}

function play(on) {
  shown.playing = on;
  byId('play').textContent = on ? '⏸ Pause' : '▶ Play';
  if (!on) return;
  if (shown.time >= shown.end) setTime(0);
  let last = performance.now();
  const step = (now) => {
    if (!shown.playing) return;
    const time = shown.time + ((now - last) / 1000) * Number(byId('rate').value);
    last = now;
    setTime(time);
    if (time >= shown.end) play(false);
    else requestAnimationFrame(step);
  };
  requestAnimationFrame(step);
}

function hover(event) {
  const film = films[shown.filled],
    box = canvas.getBoundingClientRect(),
    tip = byId('hovered');
  if (!film) return;
  const x = (event.clientX - box.left) / view.scale + view.x - film.origin[0],
    y = (view.height - (event.clientY - box.top)) / view.scale + view.y - film.origin[1];
  const part = film.partAt(x, y);
  tip.hidden = part < 0;
  if (part < 0) return;
  const body = runs[shown.filled].bodies[film.body[part]];
  const value = (kind) => `${number(film.share(kind, part) * film.top(kind), 3)} ${units[kind]}`;
  tip.textContent = `${body ? body.name : ''}: ${film.fixed[part] ? 'fixed' : `${value('speed')}, moved ${number(film.moved[part], 3)} m, shear ${value('shear')}`}`;
  tip.style.left = `${Math.min(event.clientX - box.left + 12, box.width - 260)}px`;
  tip.style.top = `${event.clientY - box.top + 12}px`;
}

function zoom(factor, x, y) {
  view.x += (x / view.scale) * (1 - 1 / factor);
  view.y += ((view.height - y) / view.scale) * (1 - 1 / factor);
  view.scale *= factor;
  draw();
}

function listenToCanvas() {
  let held = null;
  canvas.addEventListener('pointerdown', (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointerup', () => {
    held = null;
  });
  canvas.addEventListener('pointerleave', () => {
    byId('hovered').hidden = true;
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!held) {
      hover(event);
      return;
    }
    view.x -= (event.clientX - held[0]) / view.scale;
    view.y += (event.clientY - held[1]) / view.scale;
    held = [event.clientX, event.clientY];
    draw();
  });
  canvas.addEventListener(
    'wheel',
    (event) => {
      event.preventDefault();
      zoom(Math.exp(-event.deltaY / 500), event.offsetX, event.offsetY);
    },
    {passive: false},
  );
  canvas.addEventListener('keydown', (event) => {
    const step = shown.end / Math.max(1, (films[shown.filled] || {frames: 2}).frames - 1);
    const act = {
      ArrowRight: () => setTime(shown.time + step),
      ArrowLeft: () => setTime(shown.time - step),
      ' ': () => play(!shown.playing),
      '+': () => zoom(1.25, view.width / 2, view.height / 2),
      '-': () => zoom(0.8, view.width / 2, view.height / 2),
    }[event.key];
    if (act) {
      event.preventDefault();
      act();
    }
  });
}

async function motion() {
  for (const run of runs) films.push(await Film.of(run));
  if (!films.some(Boolean)) {
    const many = runs.some((run) => run.film.frames > 0);
    const cut = runs.some((run) => run.record.end !== 'finished');
    byId('motion').replaceChildren(
      element('h2', {}, 'Motion'),
      many
        ? 'There are too many parts to draw here; frames.pvd opens in ParaView.'
        : cut
          ? 'No frames were written before the run ended.'
          : 'The scene asks for no frames: "output": {"frames": 0.1} writes one every tenth of a second.',
    );
    return;
  }
  shown.filled = films.findIndex(Boolean);
  shown.end = Math.max(...films.filter(Boolean).map((film) => film.time[film.frames - 1]));
  const thinned = runs.map((run) => run.film.every || 1).reduce((p, q) => Math.max(p, q), 1);
  byId('motion-legend').textContent =
    'drag to move, scroll to zoom' + (thinned > 1 ? `; one of every ${thinned} frames` : '');
  runs.forEach(
    (run, index) => films[index] && byId('filled').append(element('option', {value: index}, run.label)),
  );
  byId('run-choice').hidden = byId('outline-choice').hidden = films.filter(Boolean).length < 2;
  byId('slider').max = 1000;
  byId('slider').addEventListener('input', () => {
    play(false);
    setTime((Number(byId('slider').value) / 1000) * shown.end);
  });
  byId('play').addEventListener('click', () => play(!shown.playing));
  byId('colour').addEventListener('change', () => {
    shown.colour = byId('colour').value;
    draw();
  });
  byId('filled').addEventListener('change', () => {
    shown.filled = Number(byId('filled').value);
    draw();
  });
  for (const id of ['ghost', 'outlines']) byId(id).addEventListener('change', draw);
  byId('fit').addEventListener('click', () => {
    fitView();
    draw();
  });
  listenToCanvas();
  new ResizeObserver(resize).observe(byId('stage'));
}
