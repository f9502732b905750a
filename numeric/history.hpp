// The time history of a simulated drop.
#pragma once

#include "numeric/drop/history.hpp"
