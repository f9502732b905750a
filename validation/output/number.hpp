// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers as text, and the middle of several.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace clatter::validation {

/// The middle of a list, of an even number of values the larger of two; 0 of none.
[[nodiscard]] double upper_median(std::vector<double> values);

/// Shortest decimal text that reads back as the same double; "nan", "inf", "-inf" otherwise.
[[nodiscard]] std::string shortest(double value);

/// At most `digits` significant digits, trailing zeros kept, in fixed notation for magnitudes from 1e-4
/// to below 1e7, else with an exponent.  0 prints as "0".
[[nodiscard]] std::string significant(double value, int digits);

/// Whether a number is whole and below 1e5 in magnitude, so that shortest() shows it best.
[[nodiscard]] bool is_short_whole(double value);

/// Significant digits d of `value` that an absolute error leaves, in [0, 17]: the error is at most half a unit of the
/// last one and, for d > 1, at most 10^-d |value|.  17 without error; 0, none, where error or value is not finite.
[[nodiscard]] int known_digits(double value, double error);

/// The least number of two significant digits whose magnitude is at least that of `error`, so that a bound stays one;
/// 0, NaN and infinities as they are.
[[nodiscard]] double rounded_up(double error);
/// Appends rounded_up(error) as append_number() would.
void append_rounded_up(std::string& out, double error);

/// Reads a whole text as a finite decimal number (no "nan", "inf", "0x", blanks or overflow).
/// @returns false if it is not one.
[[nodiscard]] bool read_number(std::string_view text, double& value);

/// from + i·step rounded to 15 digits, so that steps that are decimal fractions give clean decimals.
[[nodiscard]] double clean_step(double from, double step, long long i);

/// How many values from + i·step there are up to `to`, given steps = (to − from)/step >= 0: a step that fits the range
/// but for rounding reaches its end.
[[nodiscard]] long long count_of_steps(double steps);

/// Number i of `count` from `first` to `last`, neither 0 and both of one sign, with equal ratios; rounded likewise.
[[nodiscard]] double clean_ratio(double first, double last, long long i, long long count);

/// Appends shortest(value), or nothing if it is not finite.
void append_number(std::string& out, double value);

/// Reads a whole text as a decimal integer.
[[nodiscard]] bool read_integer(std::string_view text, long long& value);

}  // namespace clatter::validation
