// SPDX-License-Identifier: GPL-3.0-or-later
// The time history of a simulated drop.
#pragma once

#include "numeric/drop/history.hpp"
