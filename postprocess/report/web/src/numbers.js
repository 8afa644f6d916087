// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as the report's own drawings and tables write them (views/svg.cpp, views/axis.cpp,
// report/tables.cpp): no thousands separators, units that change at the same sizes.

/** Four significant digits, no zeros at the end, no exponent between 1e-4 and 1e7. */
export function readable(v) {
  if (v === null || v === undefined || !Number.isFinite(v)) return 'n/a';
  const size = Math.abs(v);
  if (size === 0) return '0';
  if (size < 1e-4 || size >= 1e7) return v.toExponential(3);
  const before = Math.floor(Math.log10(size)) + 1;
  return String(Number(v.toFixed(Math.min(7, Math.max(0, 4 - before)))));
}

/** A tick's label with no more decimals than the step between ticks needs. */
export function tickText(v, step) {
  const size = Math.max(Math.abs(v), step);
  if (Math.abs(v) < 1e-9 * step) return '0';
  if (size >= 1e6 || step < 1e-4) return String(Number(v.toPrecision(6)));
  return v.toFixed(Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-6))));
}

const PREFIXES = ['', 'k', 'M', 'G'];

/**
 * The unit in which an axis reads best: "fy [N]" up to 200000 becomes "fy [kN]" with factor 0.001.
 * Never a smaller unit than the chart's own. Other units stay.
 */
export function chooseUnit(title, largest) {
  const found = /\[([kMG]?)(N|Pa)(\/m)?\]/.exec(title);
  if (!found) return { title, factor: 1 };
  const own = PREFIXES.indexOf(found[1]);
  let power = own;
  for (let size = largest; size >= 1e4 && power < 3; size /= 1e3) ++power;
  const unit = `[${PREFIXES[power]}${found[2]}${found[3] ?? ''}]`;
  return { title: title.replace(found[0], unit), factor: 10 ** (3 * (own - power)) };
}
