// Copyright 2026 the contact_tracking authors
// SPDX-License-Identifier: Apache-2.0
// What moves on the page: a moment of the recording is drawn, a track is chosen, time goes by.
// Rows come sorted by track, then time. Text goes into the page as text only.
'use strict';
(async () => {
  const MINUTE = 60, NEAR = 26, FADE = 3, SELDOM = 200, LONG = 90 * MINUTE, AROUND = 10 * MINUTE;
  const byId = (id) => document.getElementById(id);
  const content = JSON.parse(byId('content').textContent);
  const tracks = decode(content.tracks), plots = decode(content.plots), truth = decode(content.truth);
  const scans = decode(content.scans).stamp, end = scans[scans.length - 1];
  const isPlan = content.kind === 'plan';
  const paths = split(tracks.id), truePaths = truth.piece ? split(truth.piece) : [];
  for (const path of paths) path.pieces = [];
  const owners = new Map(paths.map((path) => [path.id, path]));
  for (const piece of split(tracks.piece)) owners.get(tracks.id[piece.first]).pieces.push(piece);
  const isLong = isPlan && end - scans[0] > LONG;  // then only what is near in time is drawn
  const state = {time: scans[0], chosen: null, playing: false, moved: 0, drawn: 0, rate: 30, shown: new Set()};

  for (const [target, item] of Object.entries(content.figures)) await Bokeh.embed.embed_item(item, target);
  const models = {};
  for (const doc of Bokeh.documents) {
    for (const model of doc._all_models.values()) if (model.name) models[model.name] = model;
  }
  const stage = models.stage;
  const layers = {};  // source name: its renderers
  for (const renderer of stage.renderers) (layers[renderer.data_source.name] ||= []).push(renderer);

  function decode(columns) {
    const arrays = {};
    for (const [name, {type, data}] of Object.entries(columns)) {
      const bytes = Uint8Array.from(atob(data), (c) => c.charCodeAt(0));
      arrays[name] = new globalThis[type](bytes.buffer);
    }
    return arrays;
  }

  function split(ids) {
    const parts = [];
    for (let i = 0; i < ids.length; i++) {
      if (i === 0 || ids[i] !== ids[i - 1]) parts.push({id: ids[i], first: i, end: i});
      parts[parts.length - 1].end = i + 1;
    }
    return parts;
  }

  // The last row from first to end whose time is not after t; first - 1 if there is none.
  function before(times, t, first, end) {
    while (first < end) {
      const middle = (first + end) >> 1;
      if (times[middle] <= t) first = middle + 1; else end = middle;
    }
    return first - 1;
  }

  const colour = (id) => content.colours[id % content.colours.length];
  const fill = (name, data) => { models[name].data = data; };
  const px = isPlan ? tracks.x : tracks.bearing;
  const py = isPlan ? tracks.y : tracks.stamp.map((t) => t / MINUTE);

  function rowNow(path, t) {
    const row = before(tracks.stamp, t, path.first, path.end);
    return row >= path.first && t - tracks.stamp[row] < 1.5 * content.period ? row : -1;
  }

  function place(row, t) {
    if (!isPlan) return [px[row], t / MINUTE];
    const ahead = Math.min(Math.max(t - tracks.time[row], 0), 1.5 * content.period);
    return [px[row] + ahead * tracks.vx[row], py[row] + ahead * tracks.vy[row]];
  }

  function drawTracks(t) {
    const now = {x: [], y: [], colour: [], label: []}, gates = {x: [], y: [], width: [], height: [], colour: []};
    const ellipses = {...empty(gates), angle: []}, trails = {xs: [], ys: [], colour: []};
    const lines = {x: [], y: [], x1: [], y1: [], colour: []}, chosen = {x: [], y: []};
    for (const path of paths) {
      const row = rowNow(path, t);
      if (row < 0) continue;
      const [x, y] = place(row, t), own = colour(path.id);
      push(now, x, y, own, state.shown.has('labels') ? String(path.id) : '');
      if (path === state.chosen) push(chosen, x, y);
      if (!isPlan) { push(lines, x - tracks.gate[row], y, x + tracks.gate[row], y, own); continue; }
      push(gates, x, y, 2 * tracks.gate_x[row], 2 * tracks.gate_y[row], own);
      push(ellipses, x, y, 2 * tracks.major[row], 2 * tracks.minor[row], own, tracks.angle[row]);
      push(lines, x, y, x + content.lead * tracks.vx[row], y + content.lead * tracks.vy[row], own);
      const first = before(tracks.stamp, t - 3 * content.lead, path.first, path.end) + 1;
      push(trails, [...px.subarray(first, row + 1), x], [...py.subarray(first, row + 1), y], own);
    }
    fill('now', now); fill('chosen', chosen);
    fill('velocities', !isPlan && !state.shown.has('gates') ? empty(lines) : lines);
    if (!isPlan) return;
    fill('gates', state.shown.has('gates') ? gates : empty(gates));
    fill('ellipses', state.shown.has('ellipses') ? ellipses : empty(ellipses));
    fill('trails', trails);
  }

  function push(columns, ...values) { Object.values(columns).forEach((column, k) => column.push(values[k])); }
  function empty(columns) { return Object.fromEntries(Object.keys(columns).map((name) => [name, []])); }

  function drawPlots(t) {
    const shown = {x: [], y: [], alpha: []};
    if (plots.time && state.shown.has('plots')) {
      const span = (isPlan ? FADE : 1) * content.period;
      const last = before(plots.time, t, 0, plots.time.length);
      for (let i = last; i >= 0 && plots.time[i] > t - span; i--) {
        push(shown, isPlan ? plots.x[i] : plots.bearing[i], isPlan ? plots.y[i] : plots.time[i] / MINUTE,
          1 - (t - plots.time[i]) / span);
      }
    }
    fill('plots', shown);
  }

  function drawTruth(t) {
    const shown = {x: [], y: []};
    if (state.shown.has('truth')) {
      for (const path of truePaths) {
        const row = before(truth.time, t, path.first, path.end), next = row + 1;
        if (row < path.first || next >= path.end) continue;
        const part = (t - truth.time[row]) / (truth.time[next] - truth.time[row]);
        const mix = (values) => values[row] + part * (values[next] - values[row]);
        push(shown, mix(isPlan ? truth.x : truth.bearing), isPlan ? mix(truth.y) : t / MINUTE);
      }
    }
    fill('truth', shown);
  }

  const isNear = (times, {first, end: last}) => !isLong || (times[first] < state.time + AROUND && times[last - 1] > state.time - AROUND);

  function drawWhole() {
    state.drawn = state.time;
    const whole = {xs: [], ys: [], colour: [], alpha: []}, real = {xs: [], ys: []}, all = {x: [], y: []};
    if (state.shown.has('paths')) {
      for (const path of paths) {
        if (!isNear(tracks.stamp, path) && path !== state.chosen) continue;
        for (const {first, end: last} of path.pieces) {
          push(whole, px.subarray(first, last), py.subarray(first, last), colour(path.id),
            state.chosen === path ? 1 : isPlan ? 0.38 : 0.75);
        }
      }
    }
    if (state.shown.has('truth')) {
      for (const {first, end: last} of truePaths.filter((path) => isNear(truth.time, path))) {
        const minutes = truth.time.subarray(first, last).map((t) => t / MINUTE);
        push(real, (isPlan ? truth.x : truth.bearing).subarray(first, last), isPlan ? truth.y.subarray(first, last) : minutes);
      }
    }
    if (plots.time && state.shown.has('all_plots')) {
      all.x = isPlan ? plots.x : plots.bearing;
      all.y = isPlan ? plots.y : plots.time.map((t) => t / MINUTE);
    }
    fill('paths', whole); fill('truth_paths', real); fill('all_plots', all);
  }

  function draw() {
    const t = state.time;
    if (isLong && Math.abs(t - state.drawn) > AROUND / 10) drawWhole();
    drawTracks(t); drawPlots(t); drawTruth(t);
    moveCursors(t);
    byId('time').value = t;
    byId('clock').textContent = clock(t);
    if (state.chosen && byId('follow').checked) follow(t);
    tellFacts(t);
  }

  // A cursor that moves has its whole figure drawn anew: seldom while everything moves.
  function moveCursors(t) {
    const now = performance.now();
    if (state.playing && now - state.moved < SELDOM) return;
    state.moved = now;
    for (const [name, model] of Object.entries(models)) {
      if (name.startsWith('cursor_') && (!state.playing || name !== 'cursor_gospa')) model.location = t / MINUTE;
    }
  }

  // Show everything; a kilometre is as long in both directions.
  function fit() {
    const {x_range: xs, y_range: ys, inner_width: width, inner_height: height} = stage;
    if (!isPlan || !(width > 0 && height > 0)) return;
    const extent = (values) => values.reduce(([low, high], v) => (Number.isFinite(v) ? [Math.min(low, v), Math.max(high, v)] : [low, high]), [Infinity, -Infinity]);
    const [west, east] = extent(px), [south, north] = extent(py);
    const unit = 1.08 * Math.max((east - west) / width, (north - south) / height, 1e-3);
    const around = (range, middle, size) => {
      const [start, stop] = [middle - unit * size / 2, middle + unit * size / 2];
      range.setv({start, end: stop, reset_start: start, reset_end: stop});
    };
    around(xs, (west + east) / 2, width);
    around(ys, (south + north) / 2, height);
  }

  // After a change of the window's shape the centre stays, and circles stay round.
  function keepShape() {
    if (!isPlan) return;
    const {x_range: xs, y_range: ys, inner_width: width, inner_height: height} = stage;
    const half = (xs.end - xs.start) / width * height / 2, middle = (ys.start + ys.end) / 2;
    ys.setv({start: middle - half, end: middle + half});
  }

  // Make the stage so many times as large about its middle, or move it by parts of its size.
  function look(times, right, up) {
    [[stage.x_range, right], [stage.y_range, isPlan ? up : 0]].forEach(([range, part]) => {
      const size = range.end - range.start, middle = (range.start + range.end) / 2 + part * size;
      range.setv({start: middle - times * size / 2, end: middle + times * size / 2});
    });
  }

  function follow(t) {
    const row = rowNow(state.chosen, t);
    if (row < 0) return;
    const centre = place(row, t);
    [stage.x_range, stage.y_range].forEach((range, k) => {
      const half = (range.end - range.start) / 2;
      range.setv({start: centre[k] - half, end: centre[k] + half});
    });
  }

  const clock = (t) => `${Math.floor(t / MINUTE)}:${String(Math.floor(t % MINUTE)).padStart(2, '0')}`;
  const share = (value) => (Number.isFinite(value) ? `${(100 * value).toFixed(0)} %` : 'unknown');
  const number = (value, digits, unit) => (Number.isFinite(value) ? `${value.toFixed(digits)} ${unit}` : 'unknown');
  const compass = (course) => number((450 - course * 180 / Math.PI) % 360, 0, 'deg');

  const [unit, digits] = content.unit === 1 ? ['m', 1] : ['km', 2];

  function facts(row) {
    const common = [['exists', share(tracks.existence[row])], ['manoeuvres', share(tracks.manoeuvre[row])],
      ['NIS', number(tracks.nis[row], 1, '')], ['plot', tracks.coasted[row] ? 'missed' : 'seen']];
    const moves = [['speed', number(tracks.speed[row], 1, 'm/s')], ['course', compass(tracks.course[row])]];
    return isPlan ? [['east', number(px[row], digits, unit)], ['north', number(py[row], digits, unit)], ...moves,
      ['height', number(content.unit * tracks.z[row], 2 - digits, 'm')], ['sd', number(content.unit * tracks.major[row] / 2.448, 2 - digits, 'm')], ...common]
      : [['bearing', number((px[row] + 360) % 360, 2, 'deg')], ['sd', number(tracks.bearing_sd[row], 3, 'deg')],
        ['range', number(tracks.range[row], 0, 'm')], ['its sd', number(tracks.range_sd[row], 0, 'm')], ...moves, ...common];
  }

  function tellFacts(t) {
    const row = state.chosen ? rowNow(state.chosen, t) : -1;
    byId('light').style.background = row < 0 ? '' : content.lights[tracks.light[row]];
    byId('name').textContent = state.chosen ? `Track ${state.chosen.id}` + (row < 0 ? ', not there now' : '') : 'No track chosen';
    byId('facts').replaceChildren(...(row < 0 ? [] : facts(row)).flatMap(([name, value]) => [node('dt', name), node('dd', value)]));
  }

  function node(kind, text) {
    const made = document.createElement(kind);
    made.textContent = text;
    return made;
  }

  function choose(path) {
    state.chosen = path;
    const own = empty(models.own.data instanceof Map ? Object.fromEntries(models.own.data) : models.own.data);
    if (path) {
      // Each piece has an end on either side: there lines stop and areas are nothing.
      const rows = path.pieces.flatMap(({first, end: last}) => Array.from({length: last - first + 2}, (_, k) =>
        [Math.min(Math.max(first + k - 1, first), last - 1), k === 0 || k > last - first]));
      own.t = rows.map(([i]) => tracks.stamp[i] / MINUTE);
      own.colour = rows.map(([i]) => content.lights[tracks.light[i]]);
      for (const name of Object.keys(own)) {
        if (tracks[name]) own[name] = rows.map(([i, isEnd]) => (!isEnd ? tracks[name][i] : name.startsWith('p_') ? 0 : NaN));
      }
    }
    fill('own', own);
    for (const line of byId('list').tBodies[0].rows) line.ariaSelected = String(Boolean(path) && Number(line.dataset.id) === path.id);
    drawWhole(); draw();
  }

  function chooseNear(event) {
    const {x_range: xs, y_range: ys, inner_width: width, inner_height: height} = stage;
    let best = null, least = NEAR;
    const consider = (path, x, y) => {
      const apart = Math.hypot((x - event.x) / (xs.end - xs.start) * width, (y - event.y) / (ys.end - ys.start) * height);
      if (apart < least) { least = apart; best = path; }
    };
    for (const path of paths) {
      const row = rowNow(path, state.time);
      if (row >= 0) consider(path, ...place(row, state.time));
    }
    if (!best && state.shown.has('paths')) {
      for (const path of paths.filter((one) => isNear(tracks.stamp, one))) for (let i = path.first; i < path.end; i++) consider(path, px[i], py[i]);
    }
    choose(best);
  }

  function seek(t) { state.time = Math.min(Math.max(t, scans[0]), end); draw(); }

  function step(count) {
    const at = before(scans, state.time + 1e-6, 0, scans.length);
    seek(scans[Math.min(Math.max(at + count, 0), scans.length - 1)]);
  }

  function play(on) {
    state.playing = on;
    byId('play').textContent = on ? '\u25AE\u25AE' : '\u25B6';
    if (!on) return draw();
    if (state.time >= end) state.time = scans[0];
    let last = performance.now();
    const tick = (now) => {
      if (!state.playing) return;
      seek(state.time + state.rate * (now - last) / 1000);
      last = now;
      if (state.time >= end) play(false); else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  const KEYS = {
    ' ': () => play(!state.playing), Home: () => seek(scans[0]), End: () => seek(end), Escape: () => choose(null),
    ArrowRight: (event) => step(event.shiftKey ? 10 : 1), ArrowLeft: (event) => step(event.shiftKey ? -10 : -1),
    ArrowDown: () => chooseNext(1), ArrowUp: () => chooseNext(-1),
    '+': () => look(0.8, 0, 0), '-': () => look(1.25, 0, 0), 0: () => stage.reset.emit(),
    a: () => look(1, -0.1, 0), d: () => look(1, 0.1, 0), w: () => look(1, 0, 0.1), s: () => look(1, 0, -0.1),
  };

  function chooseNext(count) {
    const there = paths.filter((path) => rowNow(path, state.time) >= 0 || path === state.chosen);
    if (!there.length) return;
    const at = there.indexOf(state.chosen);
    choose(there[at < 0 ? 0 : (at + count + there.length) % there.length]);
  }

  document.addEventListener('keydown', (event) => {
    const typing = event.target.matches('select, textarea, input[type=radio]') || (event.target.matches('button, input, summary, tr') && event.key === ' ' && event.target.id !== 'play');
    if (typing || event.ctrlKey || event.altKey || event.metaKey || !KEYS[event.key]) return;
    event.preventDefault();
    KEYS[event.key](event);
  });

  function listTracks() {
    const mean = (values, rows) => { const known = rows.map((i) => values[i]).filter(Number.isFinite); return known.length ? known.reduce((a, b) => a + b) / known.length : NaN; };
    for (const path of paths) {
      const rows = Array.from({length: path.end - path.first}, (_, k) => path.first + k);
      const cells = [String(path.id), clock(tracks.stamp[path.first]), clock(tracks.stamp[path.end - 1]), String(rows.length),
        share(mean(tracks.coasted, rows)), number(mean(tracks.nis, rows), 2, ''), share(mean(tracks.manoeuvre, rows))];
      const line = node('tr', '');
      line.append(...cells.map((text) => node('td', text)));
      line.dataset.id = path.id;
      line.tabIndex = 0;
      const show = () => { choose(path); if (rowNow(path, state.time) < 0) seek(tracks.stamp[path.first]); };
      line.addEventListener('click', show);
      line.addEventListener('keydown', (event) => { if (event.key === 'Enter' || event.key === ' ') { event.preventDefault(); event.stopPropagation(); show(); } });
      byId('list').tBodies[0].append(line);
    }
  }

  function connect() {
    if (!isPlan) document.querySelector('[data-layer=ellipses]').parentElement.hidden = true;
    document.querySelector('[data-layer=all_plots]').checked = !isPlan;
    if (isLong) byId('whole').textContent = 'tracks near in time';
    if (!isPlan) byId('gate').textContent = '\u2501';
    byId('lead').hidden = !isPlan;
    byId('lead').textContent = `The line ahead of a track is its way in ${content.lead} s.`;
    byId('time').min = scans[0];
    byId('time').max = end;
    byId('time').addEventListener('input', (event) => seek(Number(event.target.value)));
    byId('play').addEventListener('click', () => play(!state.playing));
    byId('play').addEventListener('keydown', (event) => { if (event.key === ' ') event.preventDefault(); });
    byId('play').addEventListener('keyup', (event) => { if (event.key === ' ') event.preventDefault(); });
    byId('rate').addEventListener('change', (event) => { state.rate = Number(event.target.value); });
    for (const box of document.querySelectorAll('[data-layer]')) {
      const follow = () => { box.checked ? state.shown.add(box.dataset.layer) : state.shown.delete(box.dataset.layer); };
      box.addEventListener('change', () => { follow(); drawWhole(); draw(); });
      follow();
    }
    for (const radio of document.querySelectorAll('[name=shown]')) {
      radio.addEventListener('change', () => {
        for (const name of ['existence', 'manoeuvre', 'light']) models[`overview_${name}`].visible = name === radio.value;
      });
    }
    stage.on_event('tap', chooseNear);
    for (const side of ['inner_width', 'inner_height']) stage.properties[side].change.connect(keepShape);
    for (const name of ['own_existence', 'own_modes', 'own_nis']) models[name]?.on_event('tap', (event) => seek(event.x * MINUTE));
    models.overview.on_event('tap', (event) => { choose(paths[Math.floor(event.y)] || null); seek(event.x * MINUTE); });
  }

  fit();
  connect();
  listTracks();
  drawWhole();
  state.time = scans[Math.floor(scans.length / 3)];
  choose(paths.filter((path) => rowNow(path, state.time) >= 0).sort((a, b) => b.end - b.first - a.end + a.first)[0] || null);
  byId('play').focus({preventScroll: true});
  window.contactTracks = {state, seek, choose, paths, models};  // for whoever wants to look closer
  requestAnimationFrame(() => requestAnimationFrame(() => {  // painted
    Object.assign(document.body.dataset, {ready: 'true', after: performance.now()});
  }));
})();
