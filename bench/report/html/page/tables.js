'use strict';

const numberIn = (text) => Number.parseFloat(text.replace('~', ''));

/** Numbers by size, text by the alphabet, what is neither last. */
function compareCells(a, b, numeric) {
  if (!numeric) return a.localeCompare(b, 'en', {numeric: true});
  const [x, y] = [numberIn(a), numberIn(b)];
  return Number.isNaN(x) || Number.isNaN(y) ? Number.isNaN(x) - Number.isNaN(y) : x - y;
}

function sortBy(table, header) {
  const descending = header.ariaSort === 'ascending';
  const numeric = header.classList.contains('n');
  const cell = (row) => row.cells[header.cellIndex].textContent;
  const missing = (row) => numeric && Number.isNaN(numberIn(cell(row)));
  const rows = [...table.tBodies[0].rows].sort((a, b) => {
    if (missing(a) || missing(b)) return missing(a) - missing(b);
    return (descending ? -1 : 1) * compareCells(cell(a), cell(b), numeric);
  });
  for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
  header.setAttribute('aria-sort', descending ? 'descending' : 'ascending');
  table.tBodies[0].append(...rows);
}

function makeSortable(table) {
  for (const header of table.tHead.rows[0].cells) {
    const button = element('button', {type: 'button'}, ...header.childNodes);
    header.append(button);
    button.addEventListener('click', () => sortBy(table, header));
  }
}

/** Rows that hold every word that is typed. */
function makeFilterable(table) {
  const input = element('input', {type: 'search', placeholder: 'gpu pt 1000'});
  const count = element('output', {'aria-live': 'polite'});
  const rows = [...table.tBodies[0].rows];
  const texts = rows.map((row) => [...row.cells].map((cell) => cell.textContent).join(' ').toLowerCase());
  input.addEventListener('input', () => {
    const words = input.value.toLowerCase().split(/\s+/);
    rows.forEach((row, i) => { row.hidden = !words.every((word) => texts[i].includes(word)); });
    count.textContent = `${rows.filter((row) => !row.hidden).length} of ${rows.length} rows`;
  });
  table.parentElement.before(element('label', {}, 'Show rows with ', input, count));
}

function setUpTables() {
  for (const table of document.querySelectorAll('table.sortable')) {
    makeFilterable(table);
    makeSortable(table);
  }
}
