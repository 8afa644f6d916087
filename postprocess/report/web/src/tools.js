// SPDX-License-Identifier: GPL-3.0-or-later
// What reports and sweeps share: buttons that save drawings as PNG and SVG and tables as CSV, and a
// word above each table that is wider than its place. Nothing is loaded from elsewhere.

import { csvText } from './csv.js';

const SCALE = 2; // pixels of a PNG per pixel of the drawing

const slug = (text) => text.toLowerCase().normalize('NFKD').replace(/[^a-z0-9]+/g, '-')
  .replace(/^-+|-+$/g, '').slice(0, 60) || 'icesolve';

function save(name, blob) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** The drawing as a file of its own: with size and with what it refers to elsewhere in the page. */
export function svgText(svg) {
  const copy = svg.cloneNode(true);
  copy.removeAttribute('class');
  const defs = document.createElementNS(copy.namespaceURI, 'defs');
  for (const use of copy.querySelectorAll('use')) {
    const id = use.getAttribute('href')?.slice(1);
    const target = id && document.getElementById(id);
    if (target && !copy.querySelector(`[id="${id}"]`) && !defs.querySelector(`[id="${id}"]`))
      defs.append(target.cloneNode(true));
  }
  if (defs.children.length) copy.prepend(defs);
  return `${new XMLSerializer().serializeToString(copy)}\n`;
}

function savePng(svg, name) {
  const [, , width, height] = svg.getAttribute('viewBox').split(/\s+/).map(Number);
  const picture = new Image();
  picture.onload = () => {
    const canvas = document.createElement('canvas');
    [canvas.width, canvas.height] = [Math.ceil(SCALE * width), Math.ceil(SCALE * height)];
    const paper = canvas.getContext('2d');
    paper.fillStyle = '#ffffff';
    paper.fillRect(0, 0, canvas.width, canvas.height);
    paper.drawImage(picture, 0, 0, canvas.width, canvas.height);
    canvas.toBlob((blob) => save(name, blob));
  };
  picture.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svgText(svg))}`;
}

/** Texts of a table's cells; "1406 ± 55" in two columns, the second one for the half width. */
function tableRows(table) {
  const rows = [...table.rows].map((row) => [...row.cells].map((c) => c.textContent.trim()));
  const pair = /^(\S+)\s*±\s*(\S+)/;
  const double = rows[0].map((_, k) => rows.some((row) => pair.test(row[k] ?? '')));
  return rows.map((row, r) => row.flatMap((text, k) => {
    if (!double[k]) return [text];
    if (r === 0 && table.tHead) return [text, `${text}, half width`];
    const found = pair.exec(text);
    return found ? [found[1], found[2]] : [text, ''];
  }));
}

function buttonRow(items) {
  const row = document.createElement('div');
  row.className = 'save';
  row.append('save ');
  for (const [name, act, hidden] of items) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.hidden = Boolean(hidden);
    button.addEventListener('click', act);
    row.append(button);
  }
  return row;
}

/** File name from the page's title and the drawing's own. */
const fileName = (text, ending) => `${slug(document.title)}-${slug(text)}.${ending}`;

function addToDrawing(svg) {
  const holder = svg.closest('[data-chart]');
  const place = holder ?? svg.closest('.both') ?? svg.parentElement;
  const title = svg.querySelector(':scope > title')?.textContent ?? 'drawing';
  const row = buttonRow([
    ['PNG', () => savePng(svg, fileName(title, 'png'))],
    ['SVG', () => save(fileName(title, 'svg'),
      new Blob([svgText(svg)], { type: 'image/svg+xml' }))],
    ['CSV', () => save(fileName(title, 'csv'), new Blob([holder.csv()], { type: 'text/csv' })),
      true]]);
  holder?.addEventListener('live', () => {
    row.lastElementChild.hidden = false;
    place.append(row); // below the chart that took the drawing's place
  });
  place.append(row);
}

function addToTable(wide) {
  const table = wide.querySelector('table');
  const section = wide.closest('section');
  const title = wide.previousElementSibling?.tagName === 'H3' ? wide.previousElementSibling
    : section?.querySelector('h2');
  const name = fileName(title?.textContent ?? 'table', 'csv');
  // names and values are for reading
  if (!table.classList.contains('facts'))
    wide.after(buttonRow([['CSV', () => save(name,
      new Blob([csvText(tableRows(table))], { type: 'text/csv' }))]]));
  const hint = document.createElement('p');
  hint.className = 'hint';
  hint.textContent = 'scroll the table sideways for more columns →';
  wide.before(hint);
  const look = () => {
    const cut = wide.scrollWidth > wide.clientWidth + 1;
    hint.hidden = !cut;
    // keys scroll what has the focus
    if (cut) wide.tabIndex = 0;
    else wide.removeAttribute('tabindex');
  };
  new ResizeObserver(look).observe(wide);
  look();
}

/** Adds buttons and hints to all drawings and tables; a drawing twice in the page counts once. */
export function addTools() {
  for (const svg of document.querySelectorAll(
    '.figures svg[viewBox], .opening svg[viewBox]'))
    if (!svg.parentElement.closest('svg') && !svg.closest('.phone')) addToDrawing(svg);
  for (const wide of document.querySelectorAll('.wide')) addToTable(wide);
  // on paper everything is open but the longest texts
  window.addEventListener('beforeprint', () => {
    for (const part of document.querySelectorAll('details:not([open])'))
      if (!part.querySelector('pre')) part.open = true;
  });
}

addTools();
