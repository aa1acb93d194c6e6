// Draws the level of the page: from above or in space, by its light, heights, sectors or floors, with the ledges of a
// body, things and findings over it. Surfaces are one-sided, so one looks into rooms through their ceilings.
"use strict";
(() => {
  const canvas = document.getElementById("canvas");
  if (!canvas) return;
  const about = document.getElementById("about");
  const gl = canvas.getContext("webgl", { antialias: true, alpha: false });
  if (!gl) {
    about.textContent = "This browser draws no WebGL; the findings are beside.";
    return;
  }

  // ---- the level

  const HALF_THROUGH = 2, SKY = 3;
  const FLOOR = 0x1, ICE = 0x3000, WATER = 0x160000, UNDERWATER = 0x2, DEADLY = 0x40;
  const ARRAYS = {
    vertices: Float32Array, corner_start: Int32Array, corner_vertex: Int32Array, corner_light: Uint8Array,
    surface_normal: Float32Array, surface_sector: Int32Array, surface_flags: Uint32Array, surface_look: Uint8Array,
    surface_material: Int32Array, surface_leads_to: Int32Array, sector_flags: Uint32Array, sector_center: Float32Array,
  };
  const unpack = (text, type) => new type(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const level = JSON.parse(document.getElementById("level").textContent);
  for (const [name, type] of Object.entries(ARRAYS)) level[name] = unpack(level[name], type);
  for (const body of level.bodies) {
    for (const [name, type] of [["ends", Float32Array], ["kind", Uint8Array], ["surface", Int32Array], ["drop", Float32Array]]) {
      body[name] = unpack(body[name], type);
    }
  }
  const surfaces = level.surface_flags.length, sectors = level.sector_flags.length;
  const views = level.views === null ? null : unpack(level.views, Uint8Array);
  const seesSector = (a, b) => (views[a * Math.ceil(sectors / 8) + (b >> 3)] >> (b & 7)) & 1;
  const vertex = (corner) => {
    const v = 3 * level.corner_vertex[corner];
    return [level.vertices[v], level.vertices[v + 1], level.vertices[v + 2]];
  };
  const ringOf = (surface) => {
    const ring = [];
    for (let c = level.corner_start[surface]; c < level.corner_start[surface + 1]; c++) ring.push(c);
    return ring;
  };
  const normalOf = (surface) => [0, 1, 2].map((i) => level.surface_normal[3 * surface + i]);

  // ---- vectors

  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const add = (a, b, s = 1) => [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const unit = (a) => { const n = Math.hypot(...a) || 1; return [a[0] / n, a[1] / n, a[2] / n]; };

  // ---- triangles: the fans of the surfaces that are drawn, wound as their normals say

  const triangles = { corner: [], surface: [] };
  const passes = [[], []];  // solid ones, then those that are seen through
  for (let s = 0; s < surfaces; s++) if (level.surface_look[s]) passes[level.surface_look[s] === HALF_THROUGH ? 1 : 0].push(s);
  const ends = passes.map((list) => {
    for (const s of list) {
      const ring = ringOf(s), normal = normalOf(s);
      for (let i = 1; i + 1 < ring.length; i++) {
        const [a, b, c] = [ring[0], ring[i], ring[i + 1]];
        const turned = dot(cross(sub(vertex(b), vertex(a)), sub(vertex(c), vertex(a))), normal) < 0;
        triangles.corner.push(a, turned ? c : b, turned ? b : c);
        triangles.surface.push(s);
      }
    }
    return triangles.surface.length;
  });
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const c of triangles.corner) vertex(c).forEach((x, i) => { low[i] = Math.min(low[i], x); high[i] = Math.max(high[i], x); });
  if (!triangles.corner.length) { low.fill(-1); high.fill(1); }
  const extent = Math.max(high[0] - low[0], high[1] - low[1], high[2] - low[2], 0.1);

  // ---- colours, 0 .. 1

  const PALE = [0.72, 0.71, 0.68];
  const hsl = (h, s, l) => [0, 8, 4].map((n) => {
    const k = (n + h / 30) % 12;
    return l - s * Math.min(l, 1 - l) * Math.max(-1, Math.min(k - 3, 9 - k, 1));
  });
  const PAINTS = {
    light: (s, c) => PALE.map((x) => x * (0.18 + 0.82 * level.corner_light[c] / 255)),
    height: (s, c) => hsl(250 - 220 * (vertex(c)[2] - low[2]) / (high[2] - low[2] || 1), 0.5, 0.5),
    sector: (s) => hsl((level.surface_sector[s] * 137.508) % 360, 0.38, 0.55),
    floor: (s) => {
      const flags = level.surface_flags[s], sector = level.sector_flags[level.surface_sector[s]] || 0;
      if (sector & DEADLY) return [0.6, 0.22, 0.2];
      if (flags & WATER || sector & UNDERWATER) return [0.24, 0.42, 0.62];
      if (flags & FLOOR) return flags & ICE ? [0.62, 0.78, 0.8] : [0.5, 0.62, 0.42];
      return normalOf(s)[2] >= 0.6 ? [0.66, 0.5, 0.3] : [0.42, 0.42, 0.43];
    },
  };
  const PAINT_NAMES = { floor: [["floor", [0.5, 0.62, 0.42]], ["icy floor", [0.62, 0.78, 0.8]], ["level enough, but no floor", [0.66, 0.5, 0.3]], ["water", [0.24, 0.42, 0.62]], ["deadly", [0.6, 0.22, 0.2]]] };
  const BASIN = [0.72, 0.55, 0.85], STUCK = [0.5, 0.05, 0.95];
  const LEDGES = { 1: [0.45, 0.8, 0.45], 2: [0.95, 0.3, 0.25], 3: [0.3, 0.6, 0.95], 4: [1, 0.1, 0.6], 5: [0.75, 0.85, 0.5], 6: [0.85, 0.8, 0.3], 7: [0.95, 0.6, 0.2], 9: [0.65, 0.65, 0.68] };
  const LEDGE_NAMES = JSON.parse(document.getElementById("ledge-kinds").textContent);
  const SEVERITIES = { error: [1, 0.35, 0.3], warning: [1, 0.72, 0.2], info: [0.4, 0.7, 1] };
  const TYPES = { player: [0.35, 1, 0.5], actor: [1, 0.45, 0.4], item: [0.95, 0.85, 0.35], weapon: [0.9, 0.5, 0.9], cog: [0.5, 0.75, 1], ghost: [0.6, 0.6, 0.65] };
  const shade = (s) => { const n = normalOf(s); return 0.86 + 0.14 * n[2] + 0.07 * n[0] - 0.05 * n[1]; };
  const css = (c) => `rgb(${c.map((x) => Math.round(255 * x)).join(" ")})`;

  // ---- what is chosen

  const state = {
    view: "plan", centre: add(low, sub(high, low), 0.5), yaw: 0.6, pitch: 0.9,
    reach: extent * 0.55 * Math.max(1, canvas.clientHeight / Math.max(1, canvas.clientWidth)),
    colour: "light", body: level.bodies.length ? 0 : -1, outlines: true, things: false, marks: true, seen: false,
    cut: Infinity, surface: -1, sector: -1, mark: null,
  };
  const hidden = (s) => state.seen && views && state.sector >= 0 && !seesSector(state.sector, level.surface_sector[s]);

  // ---- the graphics card

  const program = (() => {
    const compiled = (type, text) => {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      return shader;
    };
    const made = gl.createProgram();
    gl.attachShader(made, compiled(gl.VERTEX_SHADER, `
      attribute vec3 place; attribute vec4 colour; uniform mat4 camera; uniform float size;
      varying vec4 paint; varying float height;
      void main() { gl_Position = camera * vec4(place, 1.0); gl_PointSize = size; paint = colour; height = place.z; }`));
    gl.attachShader(made, compiled(gl.FRAGMENT_SHADER, `
      precision mediump float; varying vec4 paint; varying float height; uniform float cut; uniform bool round;
      void main() {
        if (height > cut || paint.a == 0.0) discard;
        if (round && length(gl_PointCoord - 0.5) > 0.5) discard;
        gl_FragColor = paint;
      }`));
    gl.linkProgram(made);
    gl.useProgram(made);
    const uniforms = ["camera", "size", "cut", "round"].map((name) => [name, gl.getUniformLocation(made, name)]);
    const attributes = ["place", "colour"].map((name) => [name, gl.getAttribLocation(made, name)]);
    return Object.fromEntries([...uniforms, ...attributes]);
  })();

  class Batch {  // places and colours that are drawn together
    constructor(kind) { this.kind = kind; this.places = gl.createBuffer(); this.colours = gl.createBuffer(); this.count = 0; }
    fill(places, colours) {
      this.count = places.length / 3;
      gl.bindBuffer(gl.ARRAY_BUFFER, this.places);
      gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(places), gl.STATIC_DRAW);
      this.paint(colours);
    }
    paint(colours) {
      gl.bindBuffer(gl.ARRAY_BUFFER, this.colours);
      gl.bufferData(gl.ARRAY_BUFFER, Uint8Array.from(colours, (x) => Math.round(255 * Math.min(1, Math.max(0, x)))), gl.STATIC_DRAW);
    }
    draw(first = 0, count = this.count - first) {
      if (count <= 0) return;
      for (const [slot, buffer, size, type, scaled] of [[program.place, this.places, 3, gl.FLOAT, false], [program.colour, this.colours, 4, gl.UNSIGNED_BYTE, true]]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.enableVertexAttribArray(slot);
        gl.vertexAttribPointer(slot, size, type, scaled, 0, 0);
      }
      gl.drawArrays(this.kind, first, count);
    }
  }
  const faces = new Batch(gl.TRIANGLES), outlines = new Batch(gl.LINES), ledges = new Batch(gl.LINES);
  const chosen = new Batch(gl.LINES), marks = new Batch(gl.POINTS), things = new Batch(gl.POINTS), place = new Batch(gl.POINTS);
  faces.fill(triangles.corner.flatMap(vertex), []);
  things.fill(level.things.flatMap((t) => t.position), level.things.flatMap((t) => [...(TYPES[t.type] || [0.8, 0.8, 0.8]), 1]));
  marks.fill(level.findings.flatMap((f) => f.place), level.findings.flatMap((f) => [...SEVERITIES[f.severity], 1]));

  const basinsShown = () => (state.body < 0 ? [] : level.bodies[state.body].basins);

  function paintFaces() {
    const basins = new Map(basinsShown().flatMap((b) => b.surfaces.map((s) => [s, b.stuck ? STUCK : BASIN])));
    const paint = PAINTS[state.colour];
    const colours = [];
    triangles.surface.forEach((s, t) => {
      const gone = hidden(s), sky = level.surface_look[s] === SKY;
      for (let i = 0; i < 3; i++) {
        const base = sky ? [0.32, 0.42, 0.55] : paint(s, triangles.corner[3 * t + i]);
        const colour = basins.has(s) ? base.map((x, k) => (x + basins.get(s)[k]) / 2) : base;
        colours.push(...colour.map((x) => x * shade(s)), gone ? 0 : level.surface_look[s] === HALF_THROUGH ? 0.3 : 1);
      }
    });
    faces.paint(colours);
  }

  function paintLines() {
    const places = [], colours = [];
    for (let s = 0; s < surfaces; s++) {
      if (!level.surface_look[s] || hidden(s)) continue;
      const ring = ringOf(s);
      ring.forEach((c, i) => places.push(...vertex(c), ...vertex(ring[(i + 1) % ring.length])));
      for (let i = 0; i < 2 * ring.length; i++) colours.push(0, 0, 0, 0.45);
    }
    outlines.fill(places, colours);
    const body = level.bodies[state.body];
    const rows = body ? [...body.kind.keys()].filter((row) => !hidden(body.surface[row])) : [];
    ledges.fill(rows.flatMap((row) => [...body.ends.subarray(6 * row, 6 * row + 6)]), rows.flatMap((row) => [...LEDGES[body.kind[row]], 1, ...LEDGES[body.kind[row]], 1]));
  }

  function paintChosen() {
    const of = state.surface >= 0 ? [state.surface] : state.sector >= 0 ? [...level.surface_sector.keys()].filter((s) => level.surface_sector[s] === state.sector) : [];
    const places = [], colours = [];
    for (const s of of) {
      const ring = ringOf(s);
      ring.forEach((c, i) => { places.push(...vertex(c), ...vertex(ring[(i + 1) % ring.length])); colours.push(1, 0.9, 0.2, 1, 1, 0.9, 0.2, 1); });
    }
    chosen.fill(places, colours);
    place.fill(state.mark || [], state.mark ? [1, 0.9, 0.2, 1] : []);
  }

  // ---- the camera

  const aspect = () => canvas.width / Math.max(1, canvas.height);
  const back = () => [Math.sin(state.yaw) * Math.cos(state.pitch), -Math.cos(state.yaw) * Math.cos(state.pitch), Math.sin(state.pitch)];
  const TAN = Math.tan(0.42);
  function frame() {  // where the eye is, and its axes
    if (state.view === "plan") return { eye: [state.centre[0], state.centre[1], high[2] + 1], right: [1, 0, 0], up: [0, 1, 0], out: [0, 0, 1] };
    const out = back(), right = unit(cross([0, 0, 1], out));
    return { eye: add(state.centre, out, state.reach / TAN), right, up: cross(out, right), out };
  }
  function camera() {
    const { eye, right, up, out } = frame();
    const view = [right[0], up[0], out[0], 0, right[1], up[1], out[1], 0, right[2], up[2], out[2], 0, -dot(right, eye), -dot(up, eye), -dot(out, eye), 1];
    if (state.view === "plan") {
      const depth = high[2] - low[2] + 2;
      return product([1 / (state.reach * aspect()), 0, 0, 0, 0, 1 / state.reach, 0, 0, 0, 0, -2 / depth, 0, 0, 0, -1, 1], view);
    }
    const near = state.reach * 0.02, far = state.reach * 4 + 3 * extent;
    return product([1 / (TAN * aspect()), 0, 0, 0, 0, 1 / TAN, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0], view);
  }
  const product = (a, b) => Float32Array.from({ length: 16 }, (_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[(i % 4) + 4 * k] * b[k + 4 * (i >> 2)], 0));

  let asked = false;
  function draw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => {
      asked = false;
      const ratio = window.devicePixelRatio || 1;
      canvas.width = Math.round(canvas.clientWidth * ratio);
      canvas.height = Math.round(canvas.clientHeight * ratio);
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0.086, 0.094, 0.106, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.uniformMatrix4fv(program.camera, false, camera());
      gl.uniform1f(program.cut, Math.min(state.cut, 1e9));
      gl.uniform1i(program.round, 0);
      gl.enable(gl.CULL_FACE);
      gl.enable(gl.DEPTH_TEST);
      gl.depthFunc(gl.LEQUAL);
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
      gl.enable(gl.POLYGON_OFFSET_FILL);
      gl.polygonOffset(1, 1);
      faces.draw(0, 3 * ends[0]);
      gl.depthMask(false);
      faces.draw(3 * ends[0]);
      gl.depthMask(true);
      gl.disable(gl.POLYGON_OFFSET_FILL);
      gl.depthMask(false);  // or, from above, the upper edge of an opening would hide the ledge at its foot
      if (state.outlines) outlines.draw();
      gl.depthMask(true);
      ledges.draw();
      gl.disable(gl.DEPTH_TEST);
      gl.uniform1f(program.cut, 1e9);
      chosen.draw();
      gl.uniform1i(program.round, 1);
      const points = (batch, size) => { gl.uniform1f(program.size, size * ratio); batch.draw(); };
      if (state.things) points(things, 6);
      if (state.marks) points(marks, 8);
      points(place, 12);
    });
  }

  // ---- what is under the pointer

  function ray(x, y) {
    const { eye, right, up, out } = frame();
    const across = (2 * x / canvas.clientWidth - 1) * aspect(), above = 1 - 2 * y / canvas.clientHeight;
    if (state.view === "plan") return { from: add(add(eye, right, across * state.reach), up, above * state.reach), to: [0, 0, -1] };
    return { from: eye, to: unit(add(add(add([0, 0, 0], out, -1), right, across * TAN), up, above * TAN)) };
  }
  function surfaceAt(x, y) {
    const { from, to } = ray(x, y);
    let best = Infinity, found = -1;
    triangles.surface.forEach((s, t) => {
      if (hidden(s) || dot(normalOf(s), to) >= 0) return;
      const [a, b, c] = [0, 1, 2].map((i) => vertex(triangles.corner[3 * t + i]));
      const p = sub(b, a), q = sub(c, a), h = cross(to, q), det = dot(p, h);
      if (Math.abs(det) < 1e-12) return;
      const off = sub(from, a), u = dot(off, h) / det, k = cross(off, p), v = dot(to, k) / det, d = dot(q, k) / det;
      if (u < 0 || v < 0 || u + v > 1 || d < 0 || d >= best || from[2] + d * to[2] > state.cut) return;
      best = d;
      found = s;
    });
    return found;
  }
  function nearest(list, positions, x, y) {
    const m = camera();
    let best = 10, found = null;
    list.forEach((each, i) => {
      const [px, py, pz] = positions(each);
      const w = m[3] * px + m[7] * py + m[11] * pz + m[15];
      if (w <= 0) return;
      const sx = (1 + (m[0] * px + m[4] * py + m[8] * pz + m[12]) / w) / 2 * canvas.clientWidth;
      const sy = (1 - (m[1] * px + m[5] * py + m[9] * pz + m[13]) / w) / 2 * canvas.clientHeight;
      const away = Math.hypot(sx - x, sy - y);
      if (away < best) { best = away; found = each; }
    });
    return found;
  }

  function tell(...lines) {
    about.replaceChildren(...lines.filter(Boolean).map((line) => Object.assign(document.createElement("p"), { textContent: line })));
  }
  const hex = (flags) => `0x${flags.toString(16)}`;
  function tellSurface(s, ...more) {
    const sector = level.surface_sector[s], material = level.surface_material[s], leads = level.surface_leads_to[s];
    tell(
      `surface ${s}, flags ${hex(level.surface_flags[s])}${material >= 0 ? `, ${level.materials[material]}` : ""}`,
      sector >= 0 ? `sector ${sector}, flags ${hex(level.sector_flags[sector])}` : "in no sector",
      leads >= 0 && `leads to sector ${leads}`,
      views && sector >= 0 && `${[...Array(sectors).keys()].filter((b) => seesSector(sector, b)).length} of ${sectors} sectors can be seen from this one`,
      ...level.findings.filter((f) => f.kind === "surface" && f.index === s).map((f) => `${f.code}: ${f.message}`),
      ...more,
    );
  }

  function repaint() { paintFaces(); paintLines(); paintChosen(); legend(); draw(); }
  function choose(surface, sector, mark) {
    Object.assign(state, { surface, sector, mark });
    for (const row of document.querySelectorAll("#findings .chosen")) row.classList.remove("chosen");
    if (state.seen) repaint(); else { paintChosen(); draw(); }
  }
  function goTo(point) {
    state.centre = [...point];
    state.reach = Math.min(state.reach, Math.max(1.5, extent * 0.04));
  }
  function pick(x, y) {
    const finding = state.marks && nearest(level.findings, (f) => f.place, x, y);
    if (finding) return show(finding);
    const thing = state.things && nearest(level.things, (t) => t.position, x, y);
    if (thing) {
      tell(`thing ${thing.index} (${thing.name}), ${thing.type}`, `template ${thing.template}`, `at ${thing.position.join(", ")}, sector ${thing.sector}`);
      return choose(-1, thing.sector, thing.position);
    }
    const s = surfaceAt(x, y);
    if (s < 0) { tell(); return choose(-1, -1, null); }
    tellSurface(s);
    choose(s, level.surface_sector[s], null);
  }
  function show(finding) {
    tell(`${finding.code}: ${finding.message}`, finding.help, finding.where);
    if (finding.kind === "surface") choose(finding.index, level.surface_sector[finding.index], finding.place);
    else choose(-1, finding.kind === "sector" ? finding.index : -1, finding.place);
    for (const row of document.querySelectorAll("#findings .placed")) {
      const its = level.findings[row.dataset.finding] === finding;
      row.classList.toggle("chosen", its);
      if (its) row.scrollIntoView({ block: "nearest" });
    }
  }

  function legend() {
    const kinds = state.body < 0 ? [] : [...new Set(level.bodies[state.body].kind)].sort((a, b) => a - b);
    const rows = kinds.map((kind) => [LEDGE_NAMES.find((each) => each.value === kind).name, LEDGES[kind]]);
    if (basinsShown().some((basin) => !basin.stuck)) rows.push(["basin: every way out goes up", BASIN]);
    if (basinsShown().some((basin) => basin.stuck)) rows.push(["basin without a way out", STUCK]);
    if (state.things) for (const type of new Set(level.things.map((t) => t.type))) rows.push([type, TYPES[type] || [0.8, 0.8, 0.8]]);
    rows.push(...(PAINT_NAMES[state.colour] || []));
    document.getElementById("legend").replaceChildren(...rows.map(([name, colour]) => {
      const item = document.createElement("li"), swatch = document.createElement("i");
      swatch.style.background = css(colour);
      item.append(swatch, name);
      return item;
    }));
  }

  // ---- the hand

  let held = null;
  canvas.addEventListener("pointerdown", (e) => { canvas.setPointerCapture(e.pointerId); held = { x: e.offsetX, y: e.offsetY, moved: 0 }; });
  canvas.addEventListener("pointermove", (e) => {
    if (!held) return;
    const dx = e.offsetX - held.x, dy = e.offsetY - held.y;
    held = { x: e.offsetX, y: e.offsetY, moved: held.moved + Math.abs(dx) + Math.abs(dy) };
    if (state.view === "space" && !e.shiftKey && !(e.buttons & 2)) {
      state.yaw -= dx * 0.006;
      state.pitch = Math.max(-1.5, Math.min(1.5, state.pitch + dy * 0.006));
    } else pan(dx, dy);
    draw();
  });
  canvas.addEventListener("pointerup", (e) => { if (held && held.moved < 4) pick(e.offsetX, e.offsetY); held = null; });
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener("wheel", (e) => {
    e.preventDefault();
    zoom(Math.exp(e.deltaY * 0.0012), e.offsetX, e.offsetY);
  }, { passive: false });
  canvas.addEventListener("keydown", (e) => {
    const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
    if (moves[e.key]) pan(...moves[e.key]);
    else if (e.key === "+" || e.key === "-") zoom(e.key === "+" ? 0.8 : 1.25, canvas.clientWidth / 2, canvas.clientHeight / 2);
    else return;
    e.preventDefault();
    draw();
  });
  function pan(dx, dy) {
    const { right, up } = frame(), scale = 2 * state.reach / Math.max(1, canvas.clientHeight);
    state.centre = add(add(state.centre, right, -dx * scale), up, dy * scale);
  }
  function zoom(factor, x, y) {
    const before = ray(x, y).from;
    state.reach = Math.max(0.02, Math.min(4 * extent, state.reach * factor));
    if (state.view === "plan") state.centre = add(state.centre, sub(before, ray(x, y).from));
    draw();
  }

  const control = (id, change) => {
    const element = document.getElementById(id);
    element.addEventListener("input", () => { change(element); repaint(); });
  };
  control("colour", (e) => { state.colour = e.value; });
  control("body", (e) => { state.body = Number(e.value); });
  for (const id of ["outlines", "things", "marks", "seen"]) control(id, (e) => { state[id] = e.checked; });
  control("cut", (e) => { state.cut = e.value === e.max ? Infinity : low[2] + (high[2] - low[2]) * e.value / e.max; });
  if (!views) document.getElementById("seen").parentElement.hidden = true;
  for (const button of document.querySelectorAll("[data-view]")) {
    button.addEventListener("click", () => {
      state.view = button.dataset.view;
      for (const other of document.querySelectorAll("[data-view]")) other.setAttribute("aria-pressed", other === button);
      draw();
    });
  }

  const onChoice = (list, action) => {
    for (const item of document.querySelectorAll(list)) {
      item.addEventListener("click", () => action(item));
      item.addEventListener("keydown", (e) => { if (e.key === "Enter") action(item); });
    }
  };
  onChoice("#findings .placed", (item) => {
    const finding = level.findings[item.dataset.finding];
    goTo(finding.place);
    show(finding);
  });
  onChoice(".basins .placed", (item) => {
    const s = Number(item.dataset.surface), ring = ringOf(s).map(vertex);
    goTo(ring.reduce((sum, v) => add(sum, v, 1 / ring.length), [0, 0, 0]));
    tellSurface(s);
    choose(s, level.surface_sector[s], null);
  });

  new ResizeObserver(draw).observe(canvas);
  repaint();
})();

(() => {  // the filters of the findings, which need no picture
  const search = document.getElementById("search");
  if (!search) return;
  const rows = [...document.querySelectorAll("#findings li")].map((row) => [row, row.textContent.toLowerCase()]);
  const filter = () => {
    const words = search.value.toLowerCase().split(/\s+/);
    const shown = new Set([...document.querySelectorAll(".severity:checked")].map((box) => box.value));
    for (const [row, text] of rows) {
      row.hidden = !([...shown].some((severity) => row.classList.contains(severity)) && words.every((word) => text.includes(word)));
    }
  };
  for (const input of document.querySelectorAll("#search, .severity")) input.addEventListener("input", filter);
})();
