'use strict';

const mostSeries = 16;
const palette = ['#2f86c9', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8c6bb1', '#999933'];
const colour = (i) => palette[i % palette.length];
const ms = (ns) => ns / 1e6;
const isTimed = (c) => ['ok', 'unstable'].includes(c.status) && c.statistics?.median_ns > 0;

/** A case as {axis: value, ..., run, date, device, key, time, low, high}; without a time where it has none. */
function pointOf(run, r, c) {
  const device = run.content.devices.find((d) => d.key === c.params.device);
  const s = isTimed(c) ? c.statistics : {};
  return {
    ...c.params, axes: Object.keys(c.params), run: r, runName: run.name, date: run.content.run.started_at, device: device?.name ?? c.params.device, key: c.params.device,
    time: ms(s.median_ns), low: ms(s.ci_low_ns ?? s.median_ns), high: ms(s.ci_high_ns ?? s.median_ns),
  };
}

const timedPoints = (runs) =>
  runs.flatMap((run, r) => run.content.cases.filter(isTimed).map((c) => pointOf(run, r, c)));

/** What makes cases different work: where they run, and every axis but SPP and work-group. */
const workFields = (points) => [...new Set(['run', 'device', 'key', ...points.flatMap((p) => p.axes)])].filter(
  (field) => !['spp', 'work_group'].includes(field) && !field.endsWith('_from'));

/** Groups of at least so many points that share the `fields`, each under a name of those fields that differ between groups. */
function series(all, fields, least = 1) {
  const groups = [...Map.groupBy(all, (p) => JSON.stringify(fields.map((f) => p[f]))).values()].filter((g) => g.length >= least);
  const points = groups.flat();
  const values = (f) => new Set(points.map((p) => p[f])).size;
  const varying = fields.filter((f) => values(f) > (f === 'key' ? values('device') : 1));
  const part = (p, f) => (f === 'run' ? p.runName : ['device', 'key', 'kernel', 'size'].includes(f) ? p[f] : `${f} ${p[f]}`);
  const name = (p, shown) => plain(shown.map((f) => part(p, f)).join(' ') || p.device);
  const distinct = (shown) => new Set(groups.map(([p]) => name(p, shown))).size === groups.length;
  const withoutRun = varying.filter((f) => f !== 'run');
  const shown = distinct(withoutRun) ? withoutRun : varying;
  return groups.map((group) => ({name: name(group[0], shown), points: group}));
}

/** Intervals as lines with caps through the points that have one. */
const intervals = {
  id: 'intervals',
  afterDatasetsDraw(chart) {
    const {ctx, chartArea: {left, top: ceiling, width, height}, scales: {y}} = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, ceiling, width, height);
    ctx.clip();
    chart.data.datasets.forEach((set, i) => chart.isDatasetVisible(i) && set.data.forEach((p, j) => {
      if (!(p?.high > p?.low)) return;
      const {x} = chart.getDatasetMeta(i).data[j];
      const [top, bottom] = [y.getPixelForValue(p.high), y.getPixelForValue(p.low)];
      ctx.strokeStyle = set.borderColor;
      ctx.beginPath();
      ctx.moveTo(x, top); ctx.lineTo(x, bottom);
      for (const end of [top, bottom]) { ctx.moveTo(x - 4, end); ctx.lineTo(x + 4, end); }
      ctx.stroke();
    }));
    ctx.restore();
  },
};

function axis(type, text) { return {type, title: {display: true, text}}; }

/** Draws the charts in a place: they take their size from it. */
function drawIn(place) {
  for (const figure of place.querySelectorAll('figure')) figure.draw?.();
}

/** Shows or hides a data set, and those without a name that follow it. */
function toggle(canvas, sets, i, button) {
  const hidden = !sets[i].hidden;
  for (let j = i; j === i || sets[j]?.label === ''; j += 1) sets[j].hidden = hidden;
  button.ariaPressed = String(!hidden);
  Chart.getChart(canvas).update();
}

/** What the colours mean, as text that wraps and buttons that work with a keyboard. */
function legend(canvas, sets) {
  const entry = ({label, borderColor, backgroundColor, pointStyle}, i) => {
    const mark = element('span', {style: `color: ${backgroundColor ?? borderColor}`}, pointStyle === 'triangle' ? '▲' : '●');
    const button = element('button', {type: 'button', 'aria-pressed': 'true'}, mark, ` ${label}`);
    button.addEventListener('click', () => toggle(canvas, sets, i, button));
    return label === '' ? [] : [element('li', {}, button)];
  };
  const entries = sets.flatMap(entry);
  return entries.length > 1 ? [element('ul', {class: 'legend'}, ...entries)] : [];
}

/** A chart in a figure, to be drawn. `words` are its caption and, where no other is given, its text alternative. */
function chartFigure(config, words, className = '', spokenWords = words) {
  const canvas = element('canvas', {role: 'img', 'aria-label': spokenWords});
  const figure = element('figure', {}, element('div', {class: `canvas ${className}`}, canvas),
    ...legend(canvas, config.data.datasets), element('figcaption', {}, words));
  config.options = {animation: false, maintainAspectRatio: false, ...config.options};
  config.plugins = [intervals, ...config.plugins ?? []];
  figure.draw = () => { Chart.getChart(canvas)?.destroy(); new Chart(canvas, config); };
  return figure;
}

function lineChart(all, x, y, point, words, extra = () => []) {
  const shown = all.slice(0, mostSeries);
  const datasets = shown.flatMap(({name, points}, i) => [
    {label: name, data: points.map(point), borderColor: colour(i), backgroundColor: colour(i)},
    ...extra(points, i)]);
  const left = all.length - shown.length;
  const more = left > 0 ? ` The first ${mostSeries} of ${all.length} series; the table has all.` : '';
  return chartFigure({type: 'line', data: {datasets}, options: {scales: {x, y}}}, words + more);
}

const bySpp = (a, b) => a.spp - b.spp;

function sppChart(points) {
  const all = series(points.filter((p) => p.work_group === 'implicit').sort(bySpp), workFields(points), 2);
  if (!all.length) return [];
  const point = (p) => ({x: p.spp, y: p.time, low: p.low, high: p.high});
  return [lineChart(all, axis('logarithmic', 'samples per pixel'), axis('logarithmic', 'time, ms'), point,
    'Time over samples per pixel, both logarithmic, by device; bars are the medians’ 95 % intervals.')];
}

/** ms per SPP over SPP: a straight line of time is a hyperbola here, whose overhead can be seen. */
function scalingChart(points, runs) {
  const all = series(points.filter((p) => p.work_group === 'implicit').sort(bySpp), workFields(points), 2);
  const same = (f, p) => f.device === p.key &&
    Object.keys(f).every((key) => ['device', 'spp'].includes(key) || f[key] === p[key]);
  const fitOf = (p) => runs[p.run].content.fits.find(({params}) => same(params, p));
  if (!all.some((s) => fitOf(s.points[0]))) return [];
  const line = (group, i) => {
    const fit = fitOf(group[0]);
    if (!fit) return [];
    const data = group.map((p) => ({x: p.spp, y: fit.overhead_ms / p.spp + fit.ms_per_spp}));
    return [{label: '', data, borderColor: colour(i), borderDash: [6, 4], pointRadius: 0}];
  };
  const point = (p) => ({x: p.spp, y: p.time / p.spp, low: p.low / p.spp, high: p.high / p.spp});
  return [lineChart(all, axis('logarithmic', 'samples per pixel'), axis('logarithmic', 'ms per sample per pixel'), point,
    'Time for one sample per pixel, over samples per pixel; dashed: the fit of overhead and slope.', line)];
}

/** Of each work that with the most samples per pixel, whose times are the least noisy. */
function workGroupChart(points) {
  const all = series(points.filter((p) => !p.work_group.includes('x')), workFields(points), 3).map(({name, points: group}) => {
    const most = Math.max(...group.map((p) => p.spp));
    return {name, points: group.filter((p) => p.spp === most)};
  }).filter((s) => s.points.length > 2);
  if (!all.length) return [];
  for (const {points: group} of all) {
    const best = Math.min(...group.map((p) => p.time));
    for (const p of group) p.share = {x: p.work_group, y: p.time / best, low: p.low / best, high: p.high / best};
  }
  const groups = new Set(all.flatMap((s) => s.points.map((p) => p.work_group)));
  const labels = [...groups].sort((a, b) => (Number(a) || 0) - (Number(b) || 0));
  return [lineChart(all, {...axis('category', 'work-group'), labels}, axis('linear', 'time / best time'), (p) => p.share,
    'Time over the size of one-dimensional work-groups at the most samples per pixel, as a multiple of the best; ' +
    'bars are the medians’ 95 % intervals.')];
}

function historyChart(points) {
  const dates = [...new Set(points.map((p) => p.date))].sort();
  if (dates.length < 2) return [];
  const all = series(points, [...workFields(points).filter((f) => f !== 'run'), 'spp', 'work_group'], 2);
  const x = {...axis('category', 'run'), labels: dates};
  return [lineChart(all, x, axis('logarithmic', 'time, ms'), (p) => ({x: p.date, y: p.time, low: p.low, high: p.high}),
    'Time of the same case over the dates of the runs; bars are the medians’ 95 % intervals.')];
}

/** Every sample of a case; flagged ones by their cause. */
function stripFigure(record, samples) {
  const host = record.statistics?.timer === 'host';
  const renders = record.work?.renders || 1;
  const points = samples.map((s, i) => ({x: ms(host ? s.host_ns : s.kernel_ns) / renders, y: i + 1, cause: s.cause}));
  const causes = [...new Set(points.map((p) => p.cause))].sort();
  const datasets = causes.map((cause, i) => ({label: cause || 'counted', data: points.filter((p) => p.cause === cause),
    backgroundColor: colour(i), pointStyle: cause ? 'triangle' : 'circle', pointRadius: cause ? 5 : 3}));
  const flagged = points.filter((p) => p.cause).length;
  const times = points.map((p) => p.x);
  const words = `${points.length} samples of ${record.params.device} ${record.params.kernel} ${record.params.size} ` +
    `SPP ${record.params.spp}: ${Math.min(...times).toPrecision(4)} to ${Math.max(...times).toPrecision(4)} ms, ` +
    `${flagged} flagged${flagged ? ` (${causes.filter(Boolean).join(', ')})` : ''}.`;
  const scales = {x: axis('linear', 'time, ms'), y: axis('linear', 'sample')};
  return chartFigure({type: 'scatter', data: {datasets}, options: {scales}}, words, 'strip');
}

/** The strip of one case at a time. */
function samplesChart(runs) {
  const sampled = runs.flatMap((run, r) => run.content.cases.map((record, c) =>
    ({record, samples: run.samples[c], id: `r${r}c${c}`})))
    .filter(({samples}) => samples.length);
  if (!sampled.length) return [];
  const name = ({id}) => document.querySelector(`#${id} > summary`).textContent;
  const select = element('select', {}, ...sampled.map((each, i) => element('option', {value: i}, name(each))));
  const place = element('div');
  const show = () => {
    place.replaceChildren(stripFigure(sampled[select.value].record, sampled[select.value].samples));
    drawIn(place);
  };
  select.addEventListener('input', show);
  place.append(stripFigure(sampled[0].record, sampled[0].samples));
  return [element('div', {}, element('label', {}, 'Samples of', select), place)];
}

/** Colours that the scheme of the page asks for. */
function themeCharts() {
  const style = getComputedStyle(document.documentElement);
  Chart.defaults.color = style.getPropertyValue('--text');
  Chart.defaults.borderColor = style.getPropertyValue('--line');
}

/** Draws figures in their places, and again where colours change. */
function placeCharts(figures, place = document.getElementById('charts')) {
  if (figures.length) place.append(element('div', {class: 'charts'}, ...figures));
}

function drawCharts() {
  Chart.defaults.plugins.legend.display = false;
  const redraw = () => {
    themeCharts();
    drawIn(document);
  };
  redraw();
  for (const query of ['(prefers-color-scheme: dark)', 'print']) matchMedia(query).addEventListener('change', redraw);
}

/** What is told of the devices of some of the runs. */
function deviceCharts(runs, chosen) {
  const points = timedPoints(runs).filter((p) => chosen.includes(p.run));
  return [...scalingChart(points, runs), ...workGroupChart(points), ...rooflineCharts(chosen.map((r) => runs[r])),
    ...noiseChart(runs, chosen), ...sweepCharts(runs, chosen)];
}

/** All charts in one place, or each device's in its own. */
function setUpCharts(runs) {
  themeCharts();
  const points = timedPoints(runs);
  const parts = [...document.querySelectorAll('.charts-of')];
  for (const part of parts) placeCharts(deviceCharts(runs, part.dataset.runs.split(' ').map(Number)), part);
  const others = parts.length ? [] : deviceCharts(runs, runs.map((_, r) => r));
  placeCharts([...sppChart(points), ...others, ...historyChart(points), ...samplesChart(runs)]);
  drawCharts();
}
