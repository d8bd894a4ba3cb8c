// Anchors of the viridis map (public domain), dark to light.
const anchors = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 74, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [109, 205, 89],
  [180, 222, 44],
  [253, 231, 37],
];
const shades = 40;
const palette = Array.from({length: shades}, (_, i) => {
  const at = (i / (shades - 1)) * (anchors.length - 1),
    k = Math.min(Math.floor(at), anchors.length - 2);
  return `rgb(${anchors[k].map((value, c) => Math.round(value + (anchors[k + 1][c] - value) * (at - k))).join(',')})`;
});
const units = {speed: 'm/s', displacement: 'm', shear: 'Pa'};

const films = [];
const canvas = byId('canvas'),
  context = canvas.getContext('2d');
const view = {x: 0, y: 0, scale: 1, width: 0, height: 0};
const shown = {time: 0, end: 0, filled: 0, colour: 'speed', playing: false};

function fitView() {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  const loose = films.some((film) => film && film.fixed.some((fixed) => !fixed));
  for (const film of films) {
    if (!film) continue;
    for (const frame of film.sampled()) {
      film.place(film.time[frame]);
      for (let part = 0; part < film.parts; ++part) {
        if (loose && film.fixed[part]) continue;
        for (let i = film.start[part]; i < film.start[part + 1]; ++i) {
          left = Math.min(left, film.nowX[i] + film.origin[0]);
          right = Math.max(right, film.nowX[i] + film.origin[0]);
          bottom = Math.min(bottom, film.nowY[i] + film.origin[1]);
          top = Math.max(top, film.nowY[i] + film.origin[1]);
        }
      }
    }
  }
  const pad = 0.06 * Math.max(right - left, top - bottom);
  view.scale = Math.min(view.width / (right - left + 2 * pad), view.height / (top - bottom + 2 * pad));
  view.x = (left + right) / 2 - view.width / 2 / view.scale;
  view.y = (bottom + top) / 2 - view.height / 2 / view.scale;
}

function resize() {
  const ratio = window.devicePixelRatio || 1,
    box = canvas.getBoundingClientRect();
  const first = view.width === 0;
  Object.assign(view, {width: box.width, height: box.height});
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  if (first) fitView();
  draw();
}

function trace(film, part, xs, ys) {
  const sx = (i) => (xs[i] + film.origin[0] - view.x) * view.scale,
    sy = (i) => view.height - (ys[i] + film.origin[1] - view.y) * view.scale;
  const begin = film.start[part],
    end = film.start[part + 1];
  context.moveTo(sx(begin), sy(begin));
  for (let i = begin + 1; i < end; ++i) context.lineTo(sx(i), sy(i));
  context.closePath();
}

/** Parts for which `wanted(part)`, as one path. */
function tracedAll(film, xs, ys, wanted) {
  context.beginPath();
  for (let part = 0; part < film.parts; ++part) if (wanted(part)) trace(film, part, xs, ys);
}

const drawTimes = [];
function draw() {
  const begun = performance.now();
  context.clearRect(0, 0, view.width, view.height);
  const main = films[shown.filled];
  if (main) {
    films.forEach((film) => film && film.place(shown.time));
    context.lineJoin = 'round';
    context.fillStyle = css('--fixed');
    tracedAll(main, main.nowX, main.nowY, (part) => main.fixed[part]);
    context.fill();
    if (byId('ghost').checked) {
      context.strokeStyle = css('--ghost');
      context.lineWidth = 0.7;
      context.setLineDash([3, 3]);
      tracedAll(main, main.x, main.y, (part) => !main.fixed[part] && main.moved[part] > 2 / view.scale);
      context.stroke();
      context.setLineDash([]);
    }
    const bins = Array.from({length: shades}, () => []);
    for (let part = 0; part < main.parts; ++part)
      if (!main.fixed[part])
        bins[Math.min(shades - 1, Math.floor(main.share(shown.colour, part) * shades))].push(part);
    bins.forEach((bin, shade) => {
      if (!bin.length) return;
      context.fillStyle = palette[shade];
      context.beginPath();
      bin.forEach((part) => trace(main, part, main.nowX, main.nowY));
      context.fill();
    });
    context.strokeStyle = css('--edge');
    context.lineWidth = main.parts > 3000 ? 0.2 : 0.5;
    tracedAll(main, main.nowX, main.nowY, () => true);
    context.stroke();
    if (byId('outlines').checked)
      films.forEach((film, index) => {
        if (!film || index === shown.filled) return;
        context.strokeStyle = runColour(index);
        context.lineWidth = 1.3;
        tracedAll(film, film.nowX, film.nowY, (part) => !film.fixed[part]);
        context.stroke();
      });
    drawMonitors(main);
    drawScales(main);
  }
  drawTimes.push(performance.now() - begun);
}

/** Where a monitor looks: at its point, or at the centroid of its body. */
function sightOf(film, run, monitor) {
  if (!monitor.sight) {
    const body = run.bodies.findIndex((each) => each.name === monitor.body);
    monitor.sight = monitor.point
      ? film.sightOfPoint(body, monitor.point[0] - film.origin[0], monitor.point[1] - film.origin[1])
      : film.sightOfCentroid(body);
  }
  return monitor.sight;
}

function drawMonitors(film) {
  const run = runs[shown.filled];
  context.font = '12px system-ui, sans-serif';
  for (const monitor of run.monitors) {
    const at = film.at(sightOf(film, run, monitor));
    if (!at) continue;
    const sx = (at[0] + film.origin[0] - view.x) * view.scale,
      sy = view.height - (at[1] + film.origin[1] - view.y) * view.scale;
    context.beginPath();
    context.arc(sx, sy, 3.5, 0, 2 * Math.PI);
    context.fillStyle = css('--card');
    context.fill();
    context.strokeStyle = css('--text');
    context.lineWidth = 1.5;
    context.stroke();
    context.lineWidth = 3;
    context.strokeStyle = css('--card');
    context.strokeText(monitor.name, sx + 7, sy - 6);
    context.fillStyle = css('--text');
    context.fillText(monitor.name, sx + 7, sy - 6);
  }
}

/** A length of one, two or five times a power of ten, and what colours stand for. */
function drawScales(film) {
  context.font = '12px system-ui, sans-serif';
  context.fillStyle = context.strokeStyle = css('--text');
  const room = 120 / view.scale,
    power = 10 ** Math.floor(Math.log10(room));
  const length = power * [5, 2, 1].find((step) => step * power <= room);
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(12, 16);
  context.lineTo(12 + length * view.scale, 16);
  context.stroke();
  context.fillText(`${number(length)} m`, 12, 32);
  const width = Math.min(150, view.width / 3),
    left = view.width - width - 14;
  palette.forEach((colour, i) => {
    context.fillStyle = colour;
    context.fillRect(left + (i * width) / shades, 10, width / shades + 1, 10);
  });
  context.fillStyle = css('--text');
  context.fillText('0', left, 34);
  const top = `${number(film.top(shown.colour), 3)} ${units[shown.colour]}`;
  context.fillText(top, left + width - context.measureText(top).width, 34);
}
