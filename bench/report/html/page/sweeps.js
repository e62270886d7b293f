'use strict';
// Of each axis that only some runs vary: bars of the relative time by its values. Which cases belong together is what the
// tables of class "sweep" say; their times are from the data.

/** Rows of the tables as {axis, r, c}: the case that each leads to. */
function sweepRows() {
  return [...document.querySelectorAll('table.sweep')].flatMap((table) => [...table.tBodies[0].rows].map((row) => {
    const [, r, c] = row.querySelector('a').hash.match(/^#r(\d+)c(\d+)$/);
    return {axis: table.tHead.rows[0].cells[0].textContent, r: Number(r), c: Number(c)};
  }));
}

/** The case of a row: its value of the axis, and its time or what it has instead. */
function sweepPoint(runs, {axis, r, c}) {
  const record = runs[r].content.cases[c];
  const value = String(record.params[axis]);
  const outcome = [record.status, record.reason].filter(Boolean).join(': ');
  return {...pointOf(runs[r], r, record), value, outcome, timed: isTimed(record)};
}

/** Relative to the fastest of its series; the fastest is marked. */
function relate({points}) {
  const best = Math.min(...points.filter((p) => p.timed).map((p) => p.time));
  for (const p of points.filter((each) => each.timed)) {
    p.bar = {x: p.value, y: p.time / best, low: p.low / best, high: p.high / best, fastest: p.time === best};
  }
}

/** What a series shows, in words. */
function spoken({name, points}) {
  const say = (p) => `${p.value} ${p.timed ? p.bar.y.toFixed(2) + (p.bar.fastest ? ' (fastest)' : '') : p.outcome}`;
  return `${name}: ${points.map(say).join(', ')}`;
}

/** A star over the fastest bar of each series. */
const stars = {
  id: 'stars',
  afterDatasetsDraw(chart) {
    const {ctx} = chart;
    ctx.save();
    ctx.fillStyle = Chart.defaults.color;
    ctx.textAlign = 'center';
    chart.data.datasets.forEach((set, i) => chart.isDatasetVisible(i) && set.data.forEach((bar, j) => {
      const {x, y} = chart.getDatasetMeta(i).data[j];
      if (bar.fastest) ctx.fillText('★', x, y - 4);
    }));
    ctx.restore();
  },
};

function sweepChart(axisName, points) {
  const all = series(points, workFields(points).filter((field) => field !== axisName)).slice(0, mostSeries);
  all.forEach(relate);
  const labels = [...new Set(points.map((p) => p.value))];
  const datasets = all.map(({name, points: group}, i) => ({label: name, data: group.flatMap((p) => p.bar ?? []),
    backgroundColor: colour(i), borderColor: Chart.defaults.color, maxBarThickness: 48}));
  const lost = all.flatMap(({name, points: group}) => group.filter((p) => !p.timed)
    .map((p) => ` No time for ${p.value} (${name}): ${p.outcome}.`));
  const words = `Time by ${axisName}, as a multiple of the fastest of each series, which has a star; lines are the ` +
    `medians’ 95 % intervals.${[...new Set(lost)].join('')}`;
  const scales = {x: {...axis('category', axisName), labels}, y: {...axis('linear', 'time / shortest time'), min: 0, grace: '8%'}};
  return chartFigure({type: 'bar', data: {datasets}, options: {scales}, plugins: [stars]}, words, '',
    `${words} ${all.map(spoken).join('; ')}.`);
}

function sweepCharts(runs, chosen) {
  const rows = Map.groupBy(sweepRows().filter(({r}) => chosen.includes(r)), ({axis: name}) => name);
  return [...rows].map(([name, group]) => sweepChart(name, group.map((row) => sweepPoint(runs, row))));
}
