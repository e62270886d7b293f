'use strict';
// Each line of a history over its runs: medians, their intervals, the levels between changes, and the kernels' hashes.

const shortHash = (text) => text.slice(0, 9);

/** When each run began, and of which revision it is. */
const runLabels = ({runs}) =>
  runs.map((run) => [run.started_at.slice(5, 10) || run.file, shortHash(run.revision)].map(plain));

/** The kernels of a line, each from the run on that has it first. */
const kernelsOf = ({points}) => points.filter((p, i) => p.kernel_hash && p.kernel_hash !== points[i - 1]?.kernel_hash)
  .map((p) => ({run: p.run, hash: plain(shortHash(p.kernel_hash))}));

/** Medians of the levels that changes separate, as {from, to, ns}: indices of points. */
function levels({points, steps}) {
  const ends = [0, ...steps.map((step) => step.at), points.length];
  return ends.slice(1).map((to, i) => {
    const sorted = points.slice(ends[i], to).map((p) => p.median_ns).sort((a, b) => a - b);
    return {from: ends[i], to, ns: (sorted[(sorted.length - 1) >> 1] + sorted[sorted.length >> 1]) / 2};
  });
}

/** A line before the first run of each new level, and the kernels' hashes on the axis. */
const changeMarks = {
  id: 'changeMarks',
  beforeDatasetsDraw({ctx, chartArea: {top, bottom}, scales: {x}, config: {options}}) {
    ctx.save();
    ctx.setLineDash([4, 3]);
    for (const {run, slower} of options.changes) {
      ctx.strokeStyle = slower ? colour(1) : colour(2);
      const at = x.getPixelForValue(run - 0.5);
      ctx.beginPath();
      ctx.moveTo(at, top);
      ctx.lineTo(at, bottom);
      ctx.stroke();
    }
    ctx.fillStyle = Chart.defaults.color;
    for (const {run, hash} of options.kernels) ctx.fillText(`▴ ${hash}`, x.getPixelForValue(run) - 4, bottom - 4);
    ctx.restore();
  },
};

function changeWords({runs}, {points, steps}) {
  const word = ({at, shift, suspected}) => `${suspected ? 'perhaps ' : ''}${Math.exp(shift.value).toFixed(3)} times as long since run ` +
    `${points[at].run + 1} (${runs[points[at].run].started_at.slice(0, 16).replace('T', ' ')})`;
  return steps.length ? steps.map(word).join(', ') : 'no change';
}

function historyLineChart(history, line) {
  const {points, steps} = line;
  const data = points.map((p) => ({x: p.run, y: ms(p.median_ns), low: ms(p.interval_ns?.low), high: ms(p.interval_ns?.high)}));
  const level = levels(line).map(({from, to, ns}) => ({label: '', pointRadius: 0, borderWidth: 3, borderColor: colour(7),
    data: [{x: points[from].run, y: ms(ns)}, {x: points[to - 1].run, y: ms(ns)}]}));
  const labels = runLabels(history);
  const x = {...axis('linear', ''), min: -1, max: history.runs.length, ticks: {stepSize: 1, callback: (value) => labels[value] ?? ''}};
  const y = {...axis('linear', 'time, ms'), grace: '20%'};
  const changes = steps.map((step) => ({run: points[step.at].run, slower: step.shift.value > 0}));
  const words = `${line.case} on ${line.device}${line.where && `, ${line.where}`}: ${changeWords(history, line)}. Bars are the ` +
    'medians’ 95 % intervals; dashed: changes; ▴: from there on the kernel with that hash.';
  return chartFigure({type: 'line', plugins: [changeMarks], options: {scales: {x, y}, changes, kernels: kernelsOf(line)},
    data: {datasets: [{label: line.case, data, borderColor: colour(0), backgroundColor: colour(0), borderWidth: 1}, ...level]}}, words);
}

function setUpHistory(history) {
  themeCharts();
  placeCharts(history.lines.filter(({points}) => points.length > 1).map((line) => historyLineChart(history, line)));
  drawCharts();
}
