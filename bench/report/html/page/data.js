'use strict';
// What the page carries: bench/report/html/packed.h says how it was packed. Text of drivers and files goes into the page
// as text nodes only, never as markup.

/** A function that reads the next number that exp_golomb.h wrote. */
function numberReader(bytes) {
  let at = 0;
  const bit = () => {
    const value = bytes[at >> 3] >> (7 - (at & 7)) & 1;
    at++;
    return value;
  };
  return (order) => {
    let digits = order;
    while (!bit()) digits++;
    let value = 1;
    for (; digits > 0; digits--) value = 2 * value + bit();
    return value - 2 ** order;
  };
}

/** A function that makes the samples of the next case from its columns. */
function sampleReader(bytes) {
  const next = numberReader(bytes);
  const column = (n, {middle, step, order}) => Array.from({length: n}, () => {
    const difference = next(order);
    return middle + step * (difference % 2 ? -(difference + 1) / 2 : difference / 2);
  });
  return ({cause, ...columns}) => {
    const read = Object.entries(columns).map(([key, how]) => [key, how.kernel, column(cause.length, how)]);
    const [[, , kernel]] = read;
    const value = (added, stored, i) => (added ? kernel[i] : 0) + stored[i];
    return cause.map((why, i) =>
      ({...Object.fromEntries(read.map(([key, added, stored]) => [key, value(added, stored, i)])), cause: why}));
  };
}

/** The bytes that packed.cpp wrote as text. */
function fromBase91(text) {
  const digit = (i) => {
    const code = text.charCodeAt(i);
    return (code === 33 ? 60 : code) - 35;
  };
  const bytes = new Uint8Array((text.length >> 1) * 13 + (text.length & 1) * 6 >> 3);
  let [bits, count, at] = [0, 0, 0];
  for (let i = 0; i < text.length; i += 2) {
    const lone = i + 1 === text.length;
    bits |= (digit(i) + (lone ? 0 : 91 * digit(i + 1))) << count;
    count += lone ? 6 : 13;
    for (; count >= 8; count -= 8) {
      bytes[at++] = bits & 255;
      bits >>= 8;
    }
  }
  return bytes;
}

/** One data script as {text, samples, content}: the file's text without samples, they, and what the text says. */
async function unpack(script) {
  const stream = new Blob([fromBase91(script.textContent)]).stream().pipeThrough(new DecompressionStream('deflate'));
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
