// SPDX-License-Identifier: GPL-3.0-or-later
// Equations in docs/method.md, section 1; impulses in docs/method.md, section 7; files in
// CONTRACT.md.
