'use strict';

/** Two pictures over one another, and a slider that wipes between them. */
function setUpWipe() {
  const images = [...document.querySelectorAll('.pictures img')];
  if (images.length < 2) return;
  const choice = (label, chosen) => {
    const select = element('select', {}, ...images.map((image, i) => element('option', {value: i}, image.alt)));
    select.value = chosen;
    return {select, label: element('label', {}, label, select)};
  };
  const left = choice('Left picture', 0), right = choice('Right picture', 1);
  const slider = element('input', {type: 'range', min: 0, max: 100, value: 50, 'aria-label': 'Wipe from left to right'});
  const stage = element('div', {class: 'wipe'}, element('img'), element('img'));
  const show = () => {
    [left, right].forEach(({select}, i) => {
      stage.children[i].src = images[select.value].src;
      stage.children[i].alt = images[select.value].alt;
    });
    stage.style.setProperty('--at', `${slider.value}%`);
  };
  for (const control of [left.select, right.select, slider]) control.addEventListener('input', show);
  show();
  const whole = element('div', {id: 'wipe'}, element('h3', {}, 'Wipe'), left.label, right.label, stage, slider);
  (document.getElementById('pictures') ?? document.getElementById('devices')).append(whole);
}
