function tiles() {
  const add = (title, values, note) => {
    const numbers = element('div', {class: 'numbers'});
    values.forEach((value, index) =>
      numbers.append(element('span', {style: `color:${runColour(index)}`}, number(value, 4))),
    );
    byId('tiles').append(element('div', {class: 'card tile'}, title, numbers, element('small', {}, note)));
  };
  const monitors = runs.map((run) =>
    ((run.history && run.history.names) || [])
      .map(parsed)
      .filter(({quantity}) => quantity === 'speed')
      .map(({monitor}) => monitor),
  );
  const column = (run, name) => run.history.names.indexOf(name);
  const last = (run, name) => (column(run, name) < 0 ? NaN : run.history.values[column(run, name)].at(-1));
  const note = (unit) => `${unit}, ${monitors[0].length > 1 ? 'the largest of all monitors' : monitors[0][0]}`;
  const largest = (of) => runs.map((run, i) => Math.max(...monitors[i].map((monitor) => of(run, monitor))));
  if (monitors[0].length) {
    const speeds = largest((run, monitor) => run.history.largest[column(run, `${monitor}.speed [m/s]`)]);
    if (speeds.every(Number.isFinite)) add('Largest speed', speeds, note('m/s'));
    const moved = largest((run, monitor) =>
      Math.hypot(last(run, `${monitor}.ux [m]`), last(run, `${monitor}.uy [m]`)),
    );
    if (moved.every(Number.isFinite)) add('Moved at the end', moved, note('m'));
  }
  add(
    'Time in the steps',
    runs.map((run) => run.record.cost[neverSettled(run.record) ? 'settling' : 'stepping']['cpu [s]']),
    's of CPU',
  );
  add(
    'Largest overlap',
    runs.map((run) => run.record['largest_penetration [m]']),
    'm',
  );
  add(
    'Energy residual',
    runs.map((run) => 100 * run.record.largest_residual_share),
    '% of the throughput',
  );
}

function headRow(words) {
  return element('tr', {}, ...words.map((word) => element('th', {}, word)));
}

function toleranceTable() {
  if (!comparison || !comparison.tolerances.length) return;
  byId('tolerances').hidden = false;
  const verdicts = new Map();
  for (const {verdict} of comparison.tolerances) verdicts.set(verdict, (verdicts.get(verdict) || 0) + 1);
  byId('tolerances-legend').textContent = [...verdicts].map(([verdict, count]) => `${count} ${verdict}`).join(', ');
  const table = byId('tolerance-table');
  table.append(headRow(['', 'run', 'against', 'measure', 'found', 'allowed', '']));
  for (const each of comparison.tolerances)
    table.append(
      element(
        'tr',
        {},
        ...[each.column, each.run, each.against, each.measure, number(each.found), number(each.allowed)].map(
          (word) => element('td', {}, word),
        ),
        element('td', {class: each.verdict === 'held' ? 'held' : 'missed'}, each.verdict),
      ),
    );
}

// What --at asked for; the program may write the time otherwise than a browser does.
function valueAt(entry, moment) {
  return (Object.entries(entry.at).find(([time]) => Number(time) === moment) || [])[1];
}

function deviationTable() {
  if (!comparison || !Object.keys(comparison.deviations).length) return;
  byId('deviations').hidden = false;
  byId('deviations-legend').textContent =
    `from ${runs[0].label}` +
    (data.reference ? ' and from the reference' : '') +
    '; the bar is RMS over the largest value';
  const moments = comparison['moments [s]'] || [];
  const table = byId('deviation-table');
  table.append(
    headRow(['', 'run', 'from', 'largest', 'at t [s]', 'RMS', 'at the end', ...moments.map((t) => `at ${t} s`)]),
  );
  for (const [name, of] of Object.entries(comparison.deviations)) {
    const base = runs[0].history.values[runs[0].history.names.indexOf(name)] || [];
    const size = Math.max(...base.map(Math.abs), 0);
    for (const {name: run} of runs)
      for (const [from, entry] of Object.entries(of[run] || {})) {
        const bar = element('span', {
          class: 'bar',
          style: `width:${size > 0 ? Math.min(6, (6 * entry.rms) / size) : 0}em`,
        });
        table.append(
          element(
            'tr',
            {},
            ...[
              name,
              run,
              from === 'from_baseline' ? runs[0].name : 'reference',
              number(entry.largest),
              number(entry['largest_at [s]']),
            ].map((word) => element('td', {}, word)),
            element('td', {}, bar, number(entry.rms)),
            element('td', {}, number(entry.final)),
            ...moments.map((t) => element('td', {}, number(valueAt(entry, t)))),
          ),
        );
      }
  }
}

function costChart() {
  if (!comparison) return;
  const key = data.reference ? 'from_reference' : 'from_baseline';
  const names = Object.keys(comparison.deviations).filter((each) =>
    runs.some((run) => (comparison.deviations[each][run.name] || {})[key]),
  );
  const name = names.find((each) => parsed(each).quantity === 'speed') || names[0];
  if (!name) return;
  const points = runs
    .map((run, index) => {
      const entry = (comparison.deviations[name][run.name] || {})[key];
      return {
        name: run.label,
        index,
        x: run.record.cost.stepping['cpu [s]'],
        y: entry ? entry.rms : index === 0 && !data.reference ? 0 : null,
      };
    })
    .filter((point) => point.y !== null && runs[point.index].record.end === 'finished');
  if (points.length < 2) return;
  byId('cost').hidden = false;
  byId('cost-legend').textContent = `RMS of ${name} from ${data.reference ? 'the reference' : runs[0].label}`;
  const [w, h, left, bottom] = [560, 260, 74, 40];
  const nice = (top) => {
    const power = 10 ** Math.floor(Math.log10(top));
    return power * [1, 2, 2.5, 5, 10, 20].find((step) => step * power >= top * 1.05);
  };
  const topX = nice(Math.max(...points.map((point) => point.x), 1e-12)),
    topY = nice(Math.max(...points.map((point) => point.y), 1e-12));
  const sx = (x) => left + (x / topX) * (w - left - 20),
    sy = (y) => h - bottom - (y / topY) * (h - bottom - 14);
  const lines = [];
  for (let i = 0; i <= 4; ++i) {
    lines.push(
      `<line x1="${sx(0)}" x2="${sx(topX)}" y1="${sy((topY * i) / 4)}" y2="${sy((topY * i) / 4)}" stroke="var(--line)"/>`,
      `<text x="${left - 8}" y="${sy((topY * i) / 4) + 4}" text-anchor="end">${number((topY * i) / 4, 3)}</text>`,
      `<text x="${sx((topX * i) / 4)}" y="${h - bottom + 18}" text-anchor="middle">${number((topX * i) / 4, 3)}</text>`,
    );
  }
  const marks = points.map((point) => {
    const right = point.x > 0.6 * topX;
    const label = document.createElement('span');
    label.textContent = point.name;
    return (
      `<circle cx="${sx(point.x)}" cy="${sy(point.y)}" r="6" fill="var(--run${point.index % 6})"/>` +
      `<text x="${sx(point.x) + (right ? -11 : 11)}" y="${sy(point.y) + 4}" text-anchor="${right ? 'end' : 'start'}">${label.innerHTML}</text>`
    );
  });
  byId('cost-chart').innerHTML =
    `<svg viewBox="0 0 ${w} ${h}" role="img" aria-label="Cost against error">${lines.join('')}${marks.join('')}` +
    `<text x="${(left + w) / 2}" y="${h - 4}" text-anchor="middle">CPU in the steps [s]</text></svg>`;
}

function provenance() {
  const record = runs[0].record,
    table = byId('provenance-table');
  const add = (name, value) =>
    table.append(element('tr', {}, element('td', {}, name), element('td', {}, value)));
  add('scene', `${record.scene.file}, XXH3 ${record.scene.xxh3_128}`);
  add('program', `talus ${record.talus}, ${record.settings.simd} instructions`);
  const plugins = new Map(
    runs.flatMap((run) => run.record.plugins.map((plugin) => [plugin.xxh3_128, plugin])),
  );
  for (const plugin of plugins.values())
    add(
      plugin.components.join(', '),
      `${plugin.file} ${plugin.version} by ${plugin.author}, XXH3 ${plugin.xxh3_128}`,
    );
  if (record.machine) add('machine', `${record.machine.processor}, ${record.machine.cores} cores`);
  for (const run of runs)
    add(
      comparison ? run.label : 'run',
      `${stepsOf(run.record)} of at most ${number(run.record['dt [s]'], 6)} s (${run.record.dt_limiter}), state ${run.record.state_hash}`,
    );
  for (const warning of (comparison && comparison.warnings) || []) add('warning', warning);
  for (const run of runs)
    for (const warning of run.record.warnings)
      add('warning', comparison ? `${run.label}: ${warning}` : warning);
  if (runs.some((run) => run.history && run.history.thinned))
    add('curves', 'drawn through the smallest and the largest of every few rows of history.csv');
  add('to repeat', element('code', {}, data.command));
}
