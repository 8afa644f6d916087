// SPDX-License-Identifier: GPL-3.0-or-later
// TODO: some day
// FIXME(me) [;

int x; // HACK
