// SPDX-License-Identifier: GPL-3.0-or-later

const cell = (v) => (/[",\r\n]/.test(String(v)) ? `"${String(v).replaceAll('"', '""')}"` : `${v}`);

/** Rows of values as CSV (RFC 4180). */
export const csvText = (rows) => rows.map((row) => `${row.map(cell).join(',')}\r\n`).join('');
