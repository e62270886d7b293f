'use strict';
// What the page carries: bench/report/html/packed.h says how it was packed. Text of drivers and files goes into the page
// as text nodes only, never as markup.

/** A function that makes the samples of the next case from its columns. */
function sampleReader(bytes) {
  let at = 0;
  const column = (n, {from, planes}) => {
    const values = Array(n).fill(from);
    for (let p = 0; p < planes; p++) {
      for (let i = 0; i < n; i++) values[i] += bytes[at++] * 256 ** p;
    }
    return values;
  };
  return ({cause, ...columns}) => {
    const read = Object.entries(columns).map(([key, how]) => [key, how.kernel, column(cause.length, how)]);
    const [[, , kernel]] = read;
    const value = (added, stored, i) => (added ? kernel[i] : 0) + stored[i];
    return cause.map((why, i) =>
      ({...Object.fromEntries(read.map(([key, added, stored]) => [key, value(added, stored, i)])), cause: why}));
  };
}

/** One data script as {text, samples, content}: the file's text without samples, they, and what the text says. */
async function unpack(script) {
  const binary = atob(script.textContent);
  const packed = new Uint8Array(binary.length);  // Uint8Array.from took 0.3 s for 2.5 MB
  for (let i = 0; i < binary.length; i++) packed[i] = binary.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
  const end = bytes.indexOf(10);
  const data = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
  data.samples = data.samples.map(sampleReader(bytes.subarray(end + 1)));
  data.content = JSON.parse(data.text);
  return data;
}

/** The file's own text: the samples put back where the text has an empty list of them. */
function fileText(data) {
  const cases = data.text.indexOf('\n  "cases": [');
  if (cases < 0) return data.text;
  let next = 0;
  const whole = () => '"samples": ' + JSON.stringify(data.samples[next++], null, 2).replaceAll('\n', '\n      ');
  return data.text.slice(0, cases) + data.text.slice(cases).replace(/"samples": \[\]/g, whole);
}

/** Text without control characters, but for line breaks and tabs, and without what turns the direction of writing. */
const plain = (text) =>
  text.replace(/[\0-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]/g, '?');

/** An element with attributes and children; children that are strings become plain text. */
function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, plain(String(value)));
  made.append(...children.map((child) => (typeof child === 'string' ? plain(child) : child)));
  return made;
}

/** A JSON value as nested lists of names and values. */
function facts(value) {
  if (value === null || value === '') return '-';
  if (typeof value === 'string' && value.includes('\n')) return element('pre', {}, value);
  if (typeof value !== 'object') return String(value);
  const list = element('dl');
  for (const [key, inner] of Object.entries(value)) {
    list.append(element('dt', {}, key), element('dd', {}, facts(inner)));
  }
  return list.childElementCount ? list : '-';
}
