'use strict';

const mostSeries = 16;
const palette = ['#2f86c9', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#8c6bb1', '#999933'];
const colour = (i) => palette[i % palette.length];
const ms = (ns) => ns / 1e6;
const isTimed = (c) => ['ok', 'unstable'].includes(c.status) && c.statistics?.median_ns > 0;

/** Every timed case as {run, label parts, spp, time ...}. */
function timedPoints(runs) {
  return runs.flatMap((run, r) => run.content.cases.filter(isTimed).map((c) => {
    const device = run.content.devices.find((d) => d.key === c.params.device);
    const {kernel, size, path_length: length, scene, lanes, spp, work_group: group} = c.params;
    const s = c.statistics;
    return {
      run: r, date: run.content.run.started_at, device: device?.name ?? c.params.device, key: c.params.device,
      kernel, size, length, scene, lanes, spp, group,
      time: ms(s.median_ns), low: ms(s.ci_low_ns ?? s.median_ns), high: ms(s.ci_high_ns ?? s.median_ns),
    };
  }));
}

/** Points in groups that share the `fields`, each under a name of those fields that differ between groups. */
function series(points, fields) {
  const values = (f) => new Set(points.map((p) => p[f])).size;
  const varying = fields.filter((f) => values(f) > (f === 'key' ? values('device') : 1));
  const groups = Map.groupBy(points, (p) => JSON.stringify(fields.map((f) => p[f])));
  const name = (p) => varying.map((f) => (f === 'run' ? p.date : p[f])).join(' ') || p.device;
  return [...groups.values()].map((group) => ({name: name(group[0]), points: group}));
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

/** A chart in a figure, to be drawn. `words` are its text alternative and its caption. */
function chartFigure(config, words, className = '') {
  const canvas = element('canvas', {role: 'img', 'aria-label': words});
  const figure = element('figure', {}, element('div', {class: `canvas ${className}`}, canvas),
    element('figcaption', {}, words));
  config.options = {animation: false, maintainAspectRatio: false, ...config.options};
  config.plugins = [intervals];
  figure.draw = () => { Chart.getChart(canvas)?.destroy(); new Chart(canvas, config); };
  return figure;
}

function lineChart(all, x, y, point, words, extra = () => []) {
  const shown = all.slice(0, mostSeries);
  const datasets = shown.flatMap(({name, points}, i) => [
    {label: name, data: points.map(point), borderColor: colour(i), backgroundColor: colour(i)},
    ...extra(points, i)]);
  const left = all.length - shown.length;
  const legend = {display: datasets.length > 1, labels: {boxWidth: 12, filter: (item) => item.text !== ''}};
  const more = left > 0 ? ` The first ${mostSeries} of ${all.length} series; the table has all.` : '';
  return chartFigure({type: 'line', data: {datasets}, options: {scales: {x, y}, plugins: {legend}}}, words + more);
}

const work = ['run', 'device', 'key', 'kernel', 'size', 'length', 'scene', 'lanes'];
const bySpp = (a, b) => a.spp - b.spp;

function sppChart(points) {
  const all = series(points.filter((p) => p.group === 'implicit').sort(bySpp), work);
  if (!all.some((s) => s.points.length > 1)) return [];
  const point = (p) => ({x: p.spp, y: p.time, low: p.low, high: p.high});
  return [lineChart(all, axis('logarithmic', 'samples per pixel'), axis('logarithmic', 'time, ms'), point,
    'Time over samples per pixel, both logarithmic, by device; bars are the medians’ 95 % intervals.')];
}

/** ms per SPP over SPP: a straight line of time is a hyperbola here, whose overhead can be seen. */
function scalingChart(points, runs) {
  const all = series(points.filter((p) => p.group === 'implicit').sort(bySpp), work);
  const fitOf = (p) => runs[p.run].content.fits.find(({params: f}) => f.device === p.key && f.kernel === p.kernel &&
    f.size === p.size && f.work_group === 'implicit' && f.lanes === p.lanes && f.scene === p.scene &&
    f.path_length === p.length);
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
  const all = series(points.filter((p) => !p.group.includes('x')), work).map(({name, points: group}) => {
    const most = Math.max(...group.map((p) => p.spp));
    return {name, points: group.filter((p) => p.spp === most)};
  }).filter((s) => s.points.length > 2);
  if (!all.length) return [];
  for (const {points: group} of all) {
    const best = Math.min(...group.map((p) => p.time));
    for (const p of group) p.share = {x: p.group, y: p.time / best, low: p.low / best, high: p.high / best};
  }
  const groups = new Set(all.flatMap((s) => s.points.map((p) => p.group)));
  const labels = [...groups].sort((a, b) => (Number(a) || 0) - (Number(b) || 0));
  return [lineChart(all, {...axis('category', 'work-group'), labels}, axis('linear', 'time / best time'), (p) => p.share,
    'Time over the size of one-dimensional work-groups at the most samples per pixel, as a multiple of the best; ' +
    'bars are the medians’ 95 % intervals.')];
}

function historyChart(points) {
  const dates = [...new Set(points.map((p) => p.date))].sort();
  if (dates.length < 2) return [];
  const all = series(points, [...work.slice(1), 'spp', 'group']).filter((s) => s.points.length > 1);
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
  const plugins = {legend: {display: flagged > 0, labels: {usePointStyle: true}}};
  return chartFigure({type: 'scatter', data: {datasets}, options: {scales, plugins}}, words, 'strip');
}

/** The strip of one case at a time. */
function samplesChart(runs) {
  const sampled = runs.flatMap((run) => run.content.cases.map((record, c) => ({record, samples: run.samples[c]})))
    .filter(({samples}) => samples.length);
  if (!sampled.length) return [];
  const name = ({params: p}) => `${p.device} ${p.kernel} ${p.size} SPP ${p.spp} ${p.work_group} lanes ${p.lanes}`;
  const select = element('select', {}, ...sampled.map(({record}, i) => element('option', {value: i}, name(record))));
  const place = element('div');
  const show = () => {
    place.replaceChildren(stripFigure(sampled[select.value].record, sampled[select.value].samples));
    drawIn(place);
  };
  select.addEventListener('input', show);
  show();
  return [element('div', {}, element('label', {}, 'Samples of', select), place)];
}

/** Colours that the scheme of the page asks for. */
function themeCharts() {
  const style = getComputedStyle(document.documentElement);
  Chart.defaults.color = style.getPropertyValue('--text');
  Chart.defaults.borderColor = style.getPropertyValue('--line');
}

function setUpCharts(runs) {
  themeCharts();
  const points = timedPoints(runs);
  const figures = [...sppChart(points), ...scalingChart(points, runs), ...workGroupChart(points), ...historyChart(points),
    ...rooflineCharts(runs), ...samplesChart(runs)];
  document.getElementById('charts').append(element('div', {class: 'charts'}, ...figures));
  drawIn(document);
  const redraw = () => {
    themeCharts();
    drawIn(document);
  };
  for (const query of ['(prefers-color-scheme: dark)', 'print']) matchMedia(query).addEventListener('change', redraw);
}
