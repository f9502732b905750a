// SPDX-License-Identifier: GPL-3.0-or-later
// The angles at which the page asks for the map of contact angles: in an offline copy the same as online.
export const MAP_RANGE = { from: 0, to: 90, count: 91 } as const;
