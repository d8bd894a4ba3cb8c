/** {monitor, quantity, unit} of "monitor.quantity [unit]". */
function parsed(name) {
  const [, monitor, quantity, unit] = /^(.*)\.([^.]+) \[(.*)\]$/.exec(name) || [null, '', name, ''];
  return {monitor, quantity, unit};
}

/** Index of the last entry not after `time`. */
function before(times, time) {
  let low = 0,
    high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Rows over all times that any of the curves has; of the others what their lines pass through there. */
function merged(curves) {
  const times = [...new Set(curves.flatMap((curve) => curve.time))].sort((p, q) => p - q);
  const rows = times.map((time) => [time]);
  curves.forEach((curve, column) => {
    let next = 0;
    times.forEach((time, i) => {
      while (next < curve.time.length && curve.time[next] < time) ++next;
      rows[i][column + 1] = onLine(curve, next, time);
    });
  });
  return rows;
}

/** Value of a curve at a time, of which `next` is the entry at it or after; null beyond its ends and in gaps. */
function onLine({time, values}, next, at) {
  if (next === time.length) return null;
  if (time[next] === at) return values[next];
  if (next === 0 || values[next - 1] === null || values[next] === null) return null;
  const share = (at - time[next - 1]) / (time[next] - time[next - 1]);
  return (1 - share) * values[next - 1] + share * values[next];
}

const charts = [];

/** A value on an axis with such a range: far from zero it takes more digits to tell it from its neighbours. */
function onAxis(value, range, digits) {
  const away = Math.ceil(Math.log10(Math.max(...range.map(Math.abs)) / (range[1] - range[0])));
  if (value === null || !Number.isFinite(away) || away <= 0) return number(value, digits);
  return String(+value.toPrecision(Math.min(15, digits + away)));
}

/** Pixels that the longest of the numbers beside the axis of these rows may take. */
function widthOfNumbers(rows) {
  const values = rows.flatMap((row) => row.slice(1)).filter(Number.isFinite);
  const range = values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
  return Math.max(62, ...range.map((value) => 7.5 * onAxis(value, range, 4).length + 8));
}

/** A card with a chart of curves {label, colour, stroke, time, values}; `choice` offers other sets of curves. */
function addChart(title, unit, curves, choice = null) {
  const small = element('small', {}, unit ? ` ${unit}` : '');
  const heading = element('h2', {}, title, small);
  const area = element('div', {class: 'chart'}),
    legend = element('div', {class: 'chart-legend'});
  byId('charts').append(element('section', {class: 'card', 'data-chart': title}, heading, area, legend));
  const chart = {graph: null, rows: []};
  const show = (shown) => {
    chart.rows = merged(shown);
    if (!chart.rows.length) return;
    const options = {
      file: chart.rows,
      labels: ['t', ...shown.map((curve) => curve.label)],
      colors: shown.map((curve) => css(curve.colour)),
      series: Object.fromEntries(shown.map((curve) => [curve.label, {strokePattern: curve.stroke || null}])),
      axes: {
        y: {
          axisLabelFormatter: (value, _, __, graph) => onAxis(value, graph.yAxisRange(0), 4),
          axisLabelWidth: widthOfNumbers(chart.rows),
        },
        x: {axisLabelFormatter: (value, _, __, graph) => onAxis(value, graph.xAxisRange(), 4), axisLabelWidth: 62},
      },
    };
    if (chart.graph) {
      chart.graph.updateOptions(options);
      return;
    }
    chart.graph = new Dygraph(area, chart.rows, {
      ...options,
      connectSeparatedPoints: true,
      strokeWidth: 1.5,
      xlabel: 't [s]',
      xLabelHeight: 16,
      legend: 'always',
      labelsDiv: legend,
      legendFormatter: (state) => legendOf(state),
      gridLineColor: css('--line'),
      axisLineColor: css('--line'),
      highlightCircleSize: 3.5,
      highlightCallback: (event, time) => setTime(time, chart),
    });
  };
  if (choice) {
    const select = element('select', {'aria-label': `${title}: of what`});
    choice.names.forEach((name, i) => select.append(element('option', {value: i}, name)));
    select.addEventListener('change', () => {
      const of = choice.curves(+select.value);
      small.textContent = ` ${of.unit}`;
      show(of.curves);
    });
    heading.append(' ', select);
  }
  charts.push(chart);
  show(curves);
}

/** A piece of the line of a curve: of several monitors of a run dashes alone tell which is which. */
function sample(series, graph) {
  const dashes = graph.getOption('strokePattern', series.label);
  return (
    `<svg class="sample" viewBox="0 0 30 8"><path d="M0 4H30" stroke="${series.color}" stroke-width="2.5"` +
    `${dashes ? ` stroke-dasharray="${dashes.join(' ')}"` : ''}/></svg>`
  );
}

function legendOf(state) {
  const shown = state.series.filter((series) => series.isVisible);
  const words = shown.map(
    (series) =>
      `<span>${sample(series, state.dygraph)}${series.labelHTML}` +
      (state.x === undefined || series.y === undefined || series.y === null
        ? ''
        : ` <b>${onAxis(series.y, state.dygraph.yAxisRange(0), 5)}</b>`) +
      '</span>',
  );
  return (state.x === undefined ? '' : `<span>t <b>${number(state.x, 5)} s</b></span>`) + words.join('');
}

function monitorCharts() {
  const groups = new Map();
  runs.forEach(
    (run, index) =>
      run.history &&
      run.history.names.forEach((name, column) => {
        const {monitor, quantity, unit} = parsed(name);
        if (!groups.has(quantity)) groups.set(quantity, {unit, curves: [], monitors: []});
        const group = groups.get(quantity);
        if (!group.monitors.includes(monitor)) group.monitors.push(monitor);
        group.curves.push({
          label: comparison ? `${run.label} ${monitor}` : monitor,
          colour: '--run' + ((comparison ? index : group.monitors.indexOf(monitor)) % 6),
          stroke: comparison ? strokes[group.monitors.indexOf(monitor) % strokes.length] : null,
          time: run.history.times[column],
          values: run.history.values[column],
        });
      }),
  );
  if (data.reference)
    data.reference.names.forEach((name, column) => {
      const {monitor, quantity, unit} = parsed(name);
      if (groups.has(quantity) && groups.get(quantity).unit === unit)
        groups
          .get(quantity)
          .curves.push({
            label: `reference ${monitor}`,
            colour: '--reference',
            stroke: [3, 3],
            time: data.reference.times[column],
            values: data.reference.values[column],
          });
    });
  const order = ['speed', 'displacement'];
  const rank = (quantity) => (order.includes(quantity) ? order.indexOf(quantity) : order.length);
  [...groups.entries()]
    .sort((p, q) => rank(p[0]) - rank(q[0]))
    .forEach(([quantity, group]) => addChart(quantity.replaceAll('_', ' '), `[${group.unit}]`, group.curves));
}

function deviationChart() {
  if (!comparison || (runs.length < 2 && !data.reference)) return;
  const names = runs[0].history.names;
  const curve = (of, name, label, index, stroke) => {
    const column = of ? of.names.indexOf(name) : -1;
    if (column < 0) return [];
    return [{label, colour: '--run' + (index % 6), stroke, time: of.times[column], values: of.values[column]}];
  };
  const of = (column) => ({
    unit: `[${parsed(names[column]).unit}]`,
    curves: runs.flatMap((run, i) => [
      ...curve(run.from_baseline, names[column], `${run.label} − ${runs[0].label}`, i, null),
      ...curve(run.from_reference, names[column], `${run.label} − reference`, i, [3, 3]),
    ]),
  });
  const first = Math.max(
    0,
    names.findIndex((name) => parsed(name).quantity === 'speed'),
  );
  const order = names.map((name, i) => i).sort((p, q) => (p === first ? -1 : q === first ? 1 : p - q));
  const initial = of(order[0]);
  addChart('deviation', initial.unit, initial.curves, {
    names: order.map((i) => names[i]),
    curves: (i) => of(order[i]),
  });
}

function energyChart() {
  const of = (index) => {
    const energy = runs[index].energy;
    const wanted = energy.names.filter(
      (name, i) => !name.startsWith('throughput') && energy.values[i].some((value) => value !== 0),
    );
    return {
      unit: '[J/m]',
      curves: wanted.map((name, i) => ({
        label: name.replace(' [J/m]', '').replaceAll('_', ' '),
        colour: '--run' + (i % 6),
        stroke: strokes[Math.floor(i / 6)],
        time: energy.times[energy.names.indexOf(name)],
        values: energy.values[energy.names.indexOf(name)],
      })),
    };
  };
  const with_energy = runs.map((run, i) => i).filter((i) => runs[i].energy && of(i).curves.length);
  if (!with_energy.length) return;
  const initial = of(with_energy[0]);
  addChart(
    'energy',
    initial.unit,
    initial.curves,
    with_energy.length > 1
      ? {names: with_energy.map((i) => runs[i].label), curves: (i) => of(with_energy[i])}
      : null,
  );
}

function contactCharts() {
  const curves = (keys) =>
    runs.flatMap((run, index) =>
      run.film.contacts
        ? keys.map((key, k) => ({
            label: comparison ? `${run.label} ${key}` : key,
            colour: '--run' + ((comparison ? index : k) % 6),
            stroke: comparison ? strokes[k] : null,
            time: run.film.time,
            values: run.film.contacts[key],
          }))
        : [],
    );
  if (!runs.some((run) => run.film.contacts && run.film.contacts.count.some((count) => count > 0))) return;
  addChart('contact forces', '[N/m], sums of magnitudes', curves(['normal', 'tangential']));
  addChart('contacts', '', curves(['count', 'slipping']));
}
