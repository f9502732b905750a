// SPDX-License-Identifier: GPL-3.0-or-later
// What a simulation says of each impact, and how it ended.
#pragma once

#include "numeric/drop/impact_record.hpp"
