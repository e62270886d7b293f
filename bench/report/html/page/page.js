'use strict';

/** All of a case's record, put in the place of what is said of it in short when it is opened first. */
function fillCase(details, record, samples) {
  if (details.classList.contains('whole')) return;
  details.classList.add('whole');
  details.querySelector('noscript')?.remove();
  details.append(facts({...record, samples: samples.length ? `${samples.length}, below` : 0}));
  if (samples.length) details.append(stripFigure(record, samples));
  drawIn(details);
}

/** Opens what a link leads to, and all that it lies in. */
function openTarget() {
  let target = document.getElementById(location.hash.slice(1));
  for (let each = target; each; each = each.parentElement) {
    if (each.localName === 'details') each.open = true;
  }
  target?.scrollIntoView();
}

function setUpCases(runs) {
  runs.forEach((run, r) => run.content.cases?.forEach((record, c) => {
    const details = document.getElementById(`r${r}c${c}`);
    const fill = () => details.open && fillCase(details, record, run.samples[c]);
    details.addEventListener('toggle', fill);
  }));
  addEventListener('hashchange', openTarget);
  openTarget();
}

function download(data, name) {
  const link = element('a', {download: name});
  link.href = URL.createObjectURL(new Blob([fileText(data)], {type: 'application/json'}));
  link.click();
  URL.revokeObjectURL(link.href);
}

function setUpDownloads(runs) {
  const what = document.getElementById('history') ? 'history' : document.getElementById('changes') ? 'comparison' : 'result';
  runs.forEach((run, r) => {
    const name = runs.length === 1 ? `${what}.json` : `${what}-${r + 1}.json`;
    const button = element('button', {type: 'button'}, `Download ${name}`);
    button.addEventListener('click', () => download(run, name));
    document.getElementById('raw').append(button);
  });
}

async function start() {
  document.documentElement.classList.add('scripted');
  setUpTables();
  setUpWipe();
  const runs = await Promise.all([...document.querySelectorAll('script.data')].map(unpack));
  setUpDownloads(runs);
  setUpCases(runs);
  if (document.getElementById('history')) setUpHistory(runs[0].content);
  else if (document.getElementById('charts')) setUpCharts(runs);
  document.documentElement.classList.add('ready');
}

start();
