// What a simulation says of each impact, and how it ended.
#pragma once

#include "numeric/drop/impact_record.hpp"
