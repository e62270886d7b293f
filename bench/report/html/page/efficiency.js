'use strict';
// Noise over time: a kernel whose line lies lower is the more efficient, whatever the speed of its samples.

const normal95 = 1.96;

/** Of the chosen runs every case whose noise is known and whose work-group is the usual one, by time. */
function noisePoints(runs, chosen) {
  return chosen.flatMap((r) => runs[r].content.cases.filter((c) => isTimed(c) && c.efficiency?.all && c.params.work_group === 'implicit')
    .map((c) => {
      const {rel_mse: relMse, standard_error: error} = c.efficiency.all;
      const low = Math.max(relMse - normal95 * error, relMse / 10);
      return {...pointOf(runs[r], r, c), relMse, noise: {low, high: relMse + normal95 * error}};
    })).filter((p) => p.relMse > 0).sort((a, b) => a.time - b.time);
}

/** Of works of which some kernel has several times. */
function noiseChart(runs, chosen) {
  const points = noisePoints(runs, chosen);
  const all = series(points, workFields(points));
  if (!all.some((s) => s.points.length > 1)) return [];
  const point = (p) => ({x: p.time, y: p.relMse, ...p.noise});
  return [lineChart(all, axis('logarithmic', 'time, ms'), axis('logarithmic', 'relMSE'), point,
    'Noise over time, both logarithmic; bars are 95 % intervals over pixels. Lower is more efficient. The table “relMSE over ' +
    'time” has the figures.')];
}
