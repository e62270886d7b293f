'use strict';
// Rooflines: see "Roofline: An Insightful Visual Performance Model for Multicore Architectures", by S. Williams,
// A. Waterman and D. Patterson.

/** Every case with counts and a time, as a point: flops a byte of global memory, and billions of flops a second. */
function countedPoints(cases, device) {
  return cases.filter((c) => c.params.device === device && isTimed(c) && c.counted?.bytes_per_segment > 0).map((c) => {
    const {counted, statistics, params} = c;
    return {kernel: params.kernel, x: counted.flops_per_segment / counted.bytes_per_segment,
      y: counted.flops_per_segment * statistics.msegments_per_s / 1e3, of: counted.of_peak};
  });
}

/** What memory gives up to where arithmetic ends it. */
function roof(fma, global, [from, to]) {
  const ridge = fma / global;
  const ends = [from, ...(ridge > from && ridge < to ? [ridge] : []), to];
  return ends.map((x) => ({x, y: Math.min(fma, x * global)}));
}

/** Whole powers of ten around the points and the ridge. */
function decades(xs) {
  return [10 ** Math.floor(Math.log10(Math.min(...xs))), 10 ** Math.ceil(Math.log10(Math.max(...xs) * 1.01))];
}

const percentText = (share) => `${(100 * share).toPrecision(3)} %`;

function placeText(points, kernel) {
  const best = points.filter((p) => p.kernel === kernel).reduce((a, b) => (b.y > a.y ? b : a));
  const limit = best.of.limit_share === null ? '' :
    `; nearest limit ${best.of.limit}, ${percentText(best.of.limit_share)}`;
  return `${kernel} ${best.y.toPrecision(3)} GFLOP/s at ${best.x.toPrecision(3)} flops a byte${limit}`;
}

function rooflineOf(run, {device, peaks}) {
  const value = (name) => peaks.find((p) => p.name === name)?.value;
  const [fma, global] = [value('fma'), value('global')];
  const points = countedPoints(run.content.cases, device);
  if (!(fma > 0 && global > 0) || !points.length) return [];
  const name = run.content.devices.find((d) => d.key === device)?.name ?? device;
  const range = decades([fma / global, ...points.map((p) => p.x)]);
  const kernels = [...new Set(points.map((p) => p.kernel))];
  const datasets = [{label: `roofs: ${fma.toPrecision(3)} GFLOP/s, ${global.toPrecision(3)} GB/s`, type: 'line',
    data: roof(fma, global, range), borderColor: colour(7), backgroundColor: colour(7), pointRadius: 0},
  ...kernels.map((kernel, i) => ({label: kernel, data: points.filter((p) => p.kernel === kernel),
    borderColor: colour(i), backgroundColor: colour(i), pointRadius: 5}))];
  const scales = {x: {...axis('logarithmic', 'flops a byte of global memory'), min: range[0], max: range[1]},
    y: {...axis('logarithmic', 'GFLOP/s'), suggestedMax: 2 * fma}};
  const words = `Roofline of ${device}, ${name}: at most ${fma.toPrecision(3)} GFLOP/s and ${global.toPrecision(3)} ` +
    `GB/s, measured. ${kernels.map((kernel) => placeText(points, kernel)).join('. ')}. ` +
    'Bytes are what kernels ask for: what caches give can lift a point above the slope.';
  return [chartFigure({type: 'scatter', data: {datasets}, options: {scales}}, words)];
}

function rooflineCharts(runs) {
  return runs.flatMap((run) => (run.content.peaks ?? []).flatMap((each) => rooflineOf(run, each)));
}
