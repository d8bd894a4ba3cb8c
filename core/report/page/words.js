const data = JSON.parse(document.getElementById('data').textContent);
const byId = (id) => document.getElementById(id);
const runs = data.runs;
const comparison = data.comparison;
// A number alone does not say what varied.
for (const run of runs)
  run.label =
    comparison && Number.isFinite(Number(run.name))
      ? `${comparison.varied.split('/').at(-1)} ${run.name}`
      : run.name;

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const runColour = (index) => css('--run' + (index % 6));
const strokes = [null, [7, 3], [2, 2], [9, 3, 2, 3], [4, 4], [1, 3]];

function number(value, digits = 4) {
  if (value === null || value === undefined || Number.isNaN(value)) return '–';
  const size = Math.abs(value);
  return size !== 0 && (size < 1e-3 || size >= 1e6)
    ? value.toExponential(digits - 2)
    : String(+value.toPrecision(digits));
}

const neverSettled = (record) => 'settling_t [s]' in record;
const stepsOf = (record) =>
  neverSettled(record) ? `${record.settle_steps} steps of settling` : `${record.steps} steps`;

function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function swatch(colour) {
  return element('span', {class: 'swatch', style: `background:${colour}`});
}

function head() {
  const record = runs[0].record;
  byId('title').textContent = record.scene.title || record.scene.file;
  runs.forEach((run, index) => {
    const words = comparison ? run.label : `${run.record.bodies} bodies, ${number(run.record['t [s]'])} s`;
    byId('runs').append(element('span', {class: 'run'}, swatch(runColour(index)), words));
  });
  if (comparison)
    byId('runs').append(`${comparison.varied} varies; ${record.bodies} bodies, ${number(record['t [s]'])} s`);
  byId('troubles').textContent = runs
    .filter((run) => run.record.end !== 'finished')
    .map((run) => {
      const settled = run.record['settling_t [s]'];
      const when = settled === undefined ? `${number(run.record['t [s]'], 6)} s` : `${number(settled, 6)} s of settling`;
      return `${run.label}: ${run.record.end} at t = ${when}. ${run.record.trouble || ''}`;
    })
    .join('\n');
}
