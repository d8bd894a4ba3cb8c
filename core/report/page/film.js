async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

/** Frames of a run, taken out of their bytes (core/report/film.hpp). */
class Film {
  static async of(run) {
    if (!run.film.bytes) return null;
    const film = new Film();
    film.take(run, await inflated(run.film.bytes));
    return film;
  }

  take(run, buffer) {
    const info = run.film,
      parts = info.parts,
      frames = info.time.length;
    let at = 0;
    const next = (type, count) => {
      const taken = new type(buffer.slice(at, at + count * type.BYTES_PER_ELEMENT));
      at += count * type.BYTES_PER_ELEMENT;
      return taken;
    };
    Object.assign(this, {
      time: info.time,
      parts,
      frames,
      quantum: info.quantum,
      origin: info.origin,
      largest: {speed: info.speed, shear: info.shear},
    });
    this.start = next(Uint32Array, parts + 1);
    this.body = next(Uint32Array, parts);
    this.x = next(Float32Array, info.corners);
    this.y = next(Float32Array, info.corners);
    this.rigid = next(Uint8Array, parts);
    this.firstColumn = new Uint32Array(parts);
    let columns = 0;
    for (let p = 0; p < parts; ++p)
      if (this.rigid[p]) {
        this.firstColumn[p] = columns;
        columns += 3;
      }
    for (let p = 0; p < parts; ++p)
      if (!this.rigid[p]) {
        this.firstColumn[p] = columns;
        columns += 2 * (this.start[p + 1] - this.start[p]);
      }
    const low = next(Uint8Array, columns * frames),
      high = next(Uint8Array, columns * frames);
    this.motion = new Int16Array(columns * frames);
    for (let c = 0, i = 0; c < columns; ++c) {
      let value = 0,
        step = 0;
      for (let f = 0; f < frames; ++f, ++i) {
        step = (step + (low[i] | (high[i] << 8))) & 0xffff;
        value = (value + step) & 0xffff;
        this.motion[i] = value;
      }
    }
    for (const key of ['speed', 'shear']) {
      this[key] = next(Uint8Array, parts * frames);
      for (let p = 0, i = 0; p < parts; ++p)
        for (let f = 0, sum = 0; f < frames; ++f, ++i) this[key][i] = sum = (sum + this[key][i]) & 0xff;
    }
    this.centre = Array.from({length: parts}, (_, p) => {
      let x = 0,
        y = 0;
      for (let i = this.start[p]; i < this.start[p + 1]; ++i) {
        x += this.x[i];
        y += this.y[i];
      }
      const count = this.start[p + 1] - this.start[p];
      return [x / count, y / count];
    });
    this.fixed = Array.from(this.body, (body) => Boolean(run.bodies[body] && run.bodies[body].fixed));
    this.nowX = new Float32Array(info.corners);
    this.nowY = new Float32Array(info.corners);
    this.moved = new Float32Array(parts);
    this.farthest = 0;
    for (const frame of this.sampled()) {
      this.place(this.time[frame]);
      this.farthest = this.moved.reduce((most, moved) => Math.max(most, moved), this.farthest);
    }
    this.placed = null;
  }

  /** Frames that stand for all, the first and the last among them. */
  sampled() {
    const count = Math.min(this.frames, 60);
    return Array.from({length: count}, (_, i) => Math.round((i * (this.frames - 1)) / Math.max(1, count - 1)));
  }

  /** Corners at a time, linear between frames. */
  place(time) {
    if (this.placed === time) return;
    this.placed = time;
    const f = before(this.time, time),
      g = Math.min(f + 1, this.frames - 1);
    const w = g > f ? Math.min(1, Math.max(0, (time - this.time[f]) / (this.time[g] - this.time[f]))) : 0;
    this.frame = w < 0.5 ? f : g;
    const m = this.motion,
      n = this.frames,
      q = this.quantum;
    const at = (column) => {
      const p = m[column * n + f];
      return p + (m[column * n + g] - p) * w;
    };
    for (let part = 0; part < this.parts; ++part) {
      const column = this.firstColumn[part],
        begin = this.start[part],
        end = this.start[part + 1];
      if (this.rigid[part]) {
        const [cx, cy] = this.centre[part],
          dx = at(column) * q,
          dy = at(column + 1) * q;
        const from = m[(column + 2) * n + f],
          turn = ((m[(column + 2) * n + g] - from) << 16) >> 16;
        const angle = (from + turn * w) * ((2 * Math.PI) / 65536),
          c = Math.cos(angle),
          s = Math.sin(angle);
        for (let i = begin; i < end; ++i) {
          const px = this.x[i] - cx,
            py = this.y[i] - cy;
          this.nowX[i] = cx + dx + c * px - s * py;
          this.nowY[i] = cy + dy + s * px + c * py;
        }
        this.moved[part] = Math.hypot(dx, dy);
      } else {
        for (let i = begin, k = column; i < end; ++i, k += 2) {
          this.nowX[i] = this.x[i] + at(k) * q;
          this.nowY[i] = this.y[i] + at(k + 1) * q;
        }
        this.moved[part] = Math.hypot(this.nowX[begin] - this.x[begin], this.nowY[begin] - this.y[begin]);
      }
    }
  }

  /** 0 to 1 of what colours stand for. */
  share(kind, part) {
    if (kind === 'displacement') return this.farthest > 0 ? Math.min(1, this.moved[part] / this.farthest) : 0;
    return this[kind][part * this.frames + this.frame] / 255;
  }

  top(kind) {
    return kind === 'displacement' ? this.farthest : this.largest[kind];
  }

  /** Corners and weights that move as a point of a part does: those of a large triangle in it. */
  weightsIn(part, x, y, share = 1) {
    const begin = this.start[part],
      corners = Array.from({length: this.start[part + 1] - begin}, (_, i) => begin + i);
    const cross = (a, b, px, py) =>
      (this.x[b] - this.x[a]) * (py - this.y[a]) - (this.y[b] - this.y[a]) * (px - this.x[a]);
    const best = (size) => corners.reduce((p, q) => (size(q) > size(p) ? q : p));
    const b = best((i) => Math.hypot(this.x[i] - this.x[begin], this.y[i] - this.y[begin]));
    const c = best((i) => Math.abs(cross(begin, b, this.x[i], this.y[i])));
    const all = cross(begin, b, this.x[c], this.y[c]),
      at_c = cross(begin, b, x, y) / all,
      at_b = -cross(begin, c, x, y) / all;
    return [
      [begin, share * (1 - at_b - at_c)],
      [b, share * at_b],
      [c, share * at_c],
    ];
  }

  partsOf(body) {
    return Array.from({length: this.parts}, (_, part) => part).filter((part) => this.body[part] === body);
  }

  /** Of a point in the first frame, without the origin: in the part that holds it, or the nearest one. */
  sightOfPoint(body, x, y) {
    const distance = (part) => {
      let inside = false,
        least = Infinity;
      for (let i = this.start[part], end = this.start[part + 1], j = end - 1; i < end; j = i++) {
        const [px, py, qx, qy] = [this.x[j], this.y[j], this.x[i], this.y[i]];
        if (qy > y !== py > y && x < qx + ((y - qy) / (py - qy)) * (px - qx)) inside = !inside;
        const length = (qx - px) ** 2 + (qy - py) ** 2;
        const along = length > 0 ? ((x - px) * (qx - px) + (y - py) * (qy - py)) / length : 0;
        const t = Math.min(1, Math.max(0, along));
        least = Math.min(least, Math.hypot(px + t * (qx - px) - x, py + t * (qy - py) - y));
      }
      return inside ? 0 : least;
    };
    const parts = this.partsOf(body);
    if (!parts.length) return [];
    const distances = parts.map(distance);
    return this.weightsIn(parts[distances.indexOf(Math.min(...distances))], x, y);
  }

  sightOfCentroid(body) {
    const parts = this.partsOf(body).map((part) => {
      let area = 0,
        x = 0,
        y = 0;
      const [x0, y0] = this.centre[part];
      for (let i = this.start[part], end = this.start[part + 1], j = end - 1; i < end; j = i++) {
        const [px, py, qx, qy] = [this.x[j] - x0, this.y[j] - y0, this.x[i] - x0, this.y[i] - y0];
        const twice = px * qy - qx * py;
        area += twice;
        x += (twice * (px + qx)) / 3;
        y += (twice * (py + qy)) / 3;
      }
      return {part, area, x: x0 + x / area, y: y0 + y / area};
    });
    const whole = parts.reduce((sum, each) => sum + each.area, 0);
    return parts.flatMap(({part, area, x, y}) => this.weightsIn(part, x, y, area / whole));
  }

  /** Where corners with weights are now. */
  at(sight) {
    if (!sight.length) return null;
    return [this.nowX, this.nowY].map((now) => sight.reduce((sum, [corner, weight]) => sum + weight * now[corner], 0));
  }

  partAt(x, y) {
    for (let part = this.parts - 1; part >= 0; --part) {
      let inside = false;
      for (let i = this.start[part], end = this.start[part + 1], j = end - 1; i < end; j = i++) {
        if (
          this.nowY[i] > y !== this.nowY[j] > y &&
          x <
            this.nowX[i] +
              ((y - this.nowY[i]) / (this.nowY[j] - this.nowY[i])) * (this.nowX[j] - this.nowX[i])
        )
          inside = !inside;
      }
      if (inside) return part;
    }
    return -1;
  }
}
