// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <sstream>

#include "tests/support.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/output/report.hpp"
#include "validation/output/symbols.hpp"

using namespace clatter::validation;
using clatter::test::infinite, clatter::test::not_a_number;

BOOST_AUTO_TEST_CASE(the_shortest_text_of_a_double_reads_back_as_the_same_double) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const auto value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    const std::string text = shortest(value);
    BOOST_REQUIRE(std::strtod(text.c_str(), nullptr) == value);
    BOOST_REQUIRE(std::strtod(json_text(Value(value)).c_str(), nullptr) == value);
  }
  BOOST_TEST(shortest(0.1) == "0.1");
  BOOST_TEST(shortest(-0.0) == "0");
  BOOST_TEST(json_text(Value(NAN)) == "null\n");
}

BOOST_AUTO_TEST_CASE(significant_digits_are_kept_and_no_more_than_known_ones_shown) {
  BOOST_TEST(significant(5.0819828830553, 6) == "5.08198");
  BOOST_TEST(significant(10.547977, 6) == "10.5480");
  BOOST_TEST(significant(9.9999996, 6) == "10.0000");
  BOOST_TEST(significant(1e-7, 3) == "1.00e-07");
  BOOST_TEST(significant(0, 6) == "0");
  BOOST_TEST(known_digits(1.0, 1e-3) == 3);
  BOOST_TEST(known_digits(1.0, 2e-3) == 2);  // an error of two in the third digit
  BOOST_TEST(known_digits(1.0, 0) == 17);
  BOOST_TEST(known_digits(3.0, 0.5) == 1);  // half a unit of the one digit
  BOOST_TEST(known_digits(3.0, 0.6) == 0);
  BOOST_TEST(known_digits(1.0, 10.0) == 0);
  for (const double unknown : {not_a_number, infinite}) {
    BOOST_TEST(known_digits(1.0, unknown) == 0);
    BOOST_TEST(known_digits(unknown, 0) == 0);
  }
}

BOOST_AUTO_TEST_CASE(an_error_has_two_significant_digits_and_is_never_rounded_down) {
  BOOST_TEST(rounded_up(1.21e-13) == 1.3e-13);
  BOOST_TEST(rounded_up(1.2e-13) == 1.2e-13);
  BOOST_TEST(rounded_up(9.91) == 10);
  BOOST_TEST(rounded_up(100.5) == 110);
  BOOST_TEST((rounded_up(0) == 0 && rounded_up(infinite) == infinite));
  BOOST_TEST(rounded_up(4.9406564584124654e-324) > 0);
  BOOST_TEST(std::isnan(rounded_up(NAN)));
  std::vector<double> errors{1e-4, 9.95e-5, 1e-5, 1.1e-10, 9.91e-13, 1e-99, 1e-100, 0.0, 2e-5};
  std::mt19937_64 random(2);
  for (int i = 0; i < 10000; ++i) errors.push_back(std::bit_cast<double>(random() >> 1));
  for (const double error : errors) {
    if (!(error < 1e307)) continue;
    const double shown = rounded_up(error);
    std::string text, general;
    append_rounded_up(text, -error);
    append_number(general, -shown);
    BOOST_TEST(text == general);
    BOOST_REQUIRE(shown >= error);
    BOOST_REQUIRE(shown <= error * 1.1 || error < 1e-320);  // one unit of the second digit
    const std::string two_digits = fmt::format("{:.1e}", shown);
    BOOST_REQUIRE(std::strtod(two_digits.c_str(), nullptr) == shown);
  }
}

BOOST_AUTO_TEST_CASE(a_sum_is_known_as_well_as_its_parts_together_and_not_at_all_with_an_unknown_one) {
  const Estimated sum = Estimated{1, 0.01} + Estimated{-1, 0.02};
  BOOST_TEST(sum.error == 0.03, boost::test_tools::tolerance(1e-15));
  for (const double unknown : {not_a_number, infinite}) {
    const Estimated doubtful = Estimated{1, 0.01} + Estimated{2, unknown} + Estimated{3, 0};
    BOOST_TEST(doubtful.value == 6);
    BOOST_TEST(!doubtful.is_known());
    BOOST_TEST(known_text(doubtful, {.digits = 6, .size = 1e9}) == "?");
    BOOST_TEST(!larger({1, unknown}, {2, 0}).is_known());
  }
  BOOST_TEST(larger({1, 0.5}, {2, 0.1}).error == 0.5);
}

BOOST_AUTO_TEST_CASE(a_number_within_its_error_of_0_is_0_only_where_both_are_small_for_its_kind) {
  BOOST_TEST(known_text({1e-16, 1e-15}, {.digits = 6, .size = 1}) == "0");
  BOOST_TEST(known_text({1e-3, 2e-3}, {.digits = 6, .size = 1}) == "?");
  BOOST_TEST(known_text({1e-16, 1e-15}, {.digits = 6, .size = 0}) == "?");
  BOOST_TEST(known_text({2.34567, 1e-3}, {.digits = 6, .size = 1}) == "2.35");
  const Cell cell = known_cell({1e-16, 1e-15}, {.digits = 6, .size = 1});
  BOOST_TEST((shown_text(cell) == "0" && *cell.value.number() == 1e-16));  // written as it is
}

BOOST_AUTO_TEST_CASE(only_whole_finite_decimal_numbers_are_read) {
  double value = 0;
  BOOST_TEST(read_number("-1.5e-3", value));
  BOOST_TEST(value == -1.5e-3);
  for (const char* bad :
       {"", " 1", "1 ", "nan", "inf", "-inf", "infinity", "1e400", "0x10", "1,5", "1.0.0", "--1", "e5"}) {
    BOOST_TEST(!read_number(bad, value), bad);
  }
}

Report two_rows() {
  Report report;
  report.title = "title";
  report.head = {"head"};
  report.notes = {"note"};
  report.fields = Value::Fields{{"scene", Value::Fields{{"angle", 10}}}};
  report.grid.columns = {{"a", "α", "°"}, {"b", "b", ""}};
  report.grid.columns.push_back(error_column(report.grid.columns[0]));
  report.grid.rows = {{Cell(1.5, 3), Cell("x,\"y\""), Cell(0.25)}, {Cell(1 / 3.0, 3), Cell(), Cell(INFINITY)}};
  return report;
}

BOOST_AUTO_TEST_CASE(csv_quotes_what_needs_it_and_says_the_rest_above_its_data_unless_bare_and_tables_align_by_width) {
  const Report report = two_rows();
  const std::string bare = "a,b,a_error\n1.5,\"x,\"\"y\"\"\",0.25\n0.3333333333333333,,\n";
  BOOST_TEST(report_text(report, {Format::csv, false, true}) == bare);
  BOOST_TEST(csv_text(report, false) == "# title\n# scene: {\"angle\":10}\n# note\n# units: a [°]\n" + bare);
  for (const char c : report_text(report, {Format::table, true})) BOOST_TEST((c & 0x80) == 0);
  BOOST_TEST(display_width("Ω [°]") == 5u);
  BOOST_TEST(display_width(wrapped(std::string(60, 'a') + " " + std::string(60, 'b')).substr(0, 60)) == 60u);
}

BOOST_AUTO_TEST_CASE(every_form_of_a_report_shows_the_same_rows_and_json_keeps_errors_apart) {
  const Report report = two_rows();
  BOOST_TEST(compact_json(row_objects(report.grid)) ==
             "[{\"a\":1.5,\"b\":\"x,\\\"y\\\"\",\"error_estimate\":{\"a\":0.25}},"
             "{\"a\":0.3333333333333333,\"b\":null,\"error_estimate\":{\"a\":null}}]");
  for (const Format format : {Format::table, Format::markdown, Format::latex}) {
    const std::string text = report_text(report, {format});
    for (const char* part : {"title", "head", "note", "1.50", "0.333"})
      BOOST_TEST(text.find(part) != std::string::npos, part);
    BOOST_TEST(text.find("0.25") == std::string::npos);  // errors are not among the shown columns
  }
}

BOOST_AUTO_TEST_CASE(rows_read_back_from_csv_are_the_rows_that_were_written) {
  Report report = two_rows();
  const std::string text = csv_text(report, true);
  report.grid.rows = read_csv_rows(text.substr(text.find('\n') + 1));
  BOOST_TEST(csv_text(report, true) == text);
  BOOST_TEST_REQUIRE(report.grid.rows[0][0].value.number());
  BOOST_TEST(*report.grid.rows[0][0].value.number() == 1.5);
}

BOOST_AUTO_TEST_CASE(the_nearest_name_is_the_one_with_fewest_changes) {
  const std::vector<std::string> commands{"angles", "sequence", "explain"}, floors{"steel", "wood"};
  BOOST_TEST(near_name("sequnce", commands).value() == "sequence");
  BOOST_TEST(suggestion("sequnce", commands) == "; did you mean sequence?");
  // Neighbours exchanged are one change; a part of a name is near it; what is far from all gets their list, once.
  BOOST_TEST(near_name("drop.angel_deg", {"drop.speed", "drop.angle_deg"}).value() == "drop.angle_deg");
  BOOST_TEST(suggestion("wodo", floors) == "; did you mean wood?");
  BOOST_TEST(suggestion("ang", commands) == "; did you mean angles?");
  BOOST_TEST(suggestion("tile", floors) == "; there are steel, wood");
  BOOST_TEST(suggestion("tile", floors, true) == "");
}

BOOST_AUTO_TEST_CASE(a_name_is_suggested_only_where_few_letters_of_the_shorter_one_differ) {
  std::vector<std::string> keys{"drop.topple",     "run.until",    "impact.restitution", "ground.sliding_friction",
                                "impact.friction", "world.gravity"};
  for (int i = 0; i < 20; ++i) keys.push_back(fmt::format("x.key_{}", i));  // too many to be listed
  BOOST_TEST(suggestion("fricton", keys) == "; did you mean impact.friction?");
  BOOST_TEST(suggestion("restituton", keys) == "; did you mean impact.restitution?");
  BOOST_TEST(suggestion("body.gravity", keys) == "; did you mean world.gravity?");
  BOOST_TEST(suggestion("ground.fricton", keys) == "; did you mean impact.friction?");
  for (const char* far : {"nope.stl", "wrt", "history", "output"}) BOOST_TEST(suggestion(far, keys) == "", far);
  BOOST_TEST(suggestion("ball", {"rod", "box", "capsule", "ellipsoid"}, true) == "");
  BOOST_TEST(suggestion("--frictoin", {"--angle", "--friction"}) == "; did you mean --friction?");
  BOOST_TEST(suggestion("jsn", {"table", "json"}, true) == "; did you mean json?");
}

BOOST_AUTO_TEST_CASE(a_foreign_text_moves_no_cursor_and_stays_readable) {
  BOOST_TEST(printable("a\x1b[2Jb\x7f") == "a\\x1b[2Jb\\x7f");
  BOOST_TEST(printable("\xc2\x9b"
                       "2J \x9b") == "\\xc2\\x9b2J \\x9b");  // C1 in UTF-8, and a byte that is none
  BOOST_TEST(printable("a\nb\r") == "a\\x0ab\\x0d");
  BOOST_TEST(printable("a\nb\r", Lines::kept) == "a\nb\\x0d");
  for (const char* text : {"Ω ≤ 90°, “é” 字 😀", ""}) BOOST_TEST(printable(text) == text);
  Report report = two_rows();
  report.head = report.notes = {"\x1b]0;title\x07"};
  report.grid.rows[0][1] = Cell("\x1b[31m");
  report.fields["text"] = "\x1b\x7f\xc2\x9b";
  for (const Format format : {Format::table, Format::csv, Format::json, Format::markdown, Format::latex}) {
    for (const char c : report_text(report, {format})) BOOST_TEST((c == '\n' || (c >= 0 && c < ' ') == false));
    BOOST_TEST(report_text(report, {format}).find_first_of("\x1b\x07\x7f\x9b") == std::string::npos);
  }
}

BOOST_AUTO_TEST_CASE(a_table_too_wide_for_a_terminal_keeps_its_digits_in_blocks_of_like_width) {
  Report report;
  report.grid.columns = {{"n", "n", ""}};
  report.grid.rows = {{Cell(1)}, {Cell(2)}};
  for (int i = 0; i < 7; ++i) {
    report.grid.columns.push_back({"c", "c" + std::to_string(i), "m"});
    for (Row& row : report.grid.rows) row.push_back(Cell(1 / 3.0, 12));
  }
  const std::string text = report_text(report, {Format::table});
  std::size_t blocks = 0, digits = 0;
  for (std::size_t at = 0; (at = text.find("  n  ", at)) != std::string::npos; ++at) ++blocks;
  for (std::size_t at = 0; (at = text.find("0.333333333333", at)) != std::string::npos; ++at) ++digits;
  BOOST_TEST(blocks == 2u);
  BOOST_TEST(digits == 14u);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) BOOST_TEST(display_width(line) <= 67u);  // four columns and n
}
