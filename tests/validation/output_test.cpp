#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>

#include "validation/output/estimated.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/table.hpp"
#include "validation/scene/bad_input.hpp"

using namespace clatter::validation;

BOOST_AUTO_TEST_CASE(the_shortest_text_of_a_double_reads_back_as_the_same_double) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!std::isfinite(value)) continue;
    const std::string text = shortest(value);
    BOOST_REQUIRE(std::strtod(text.c_str(), nullptr) == value);
    BOOST_REQUIRE(std::strtod(json_text(Json(value)).c_str(), nullptr) == value);
  }
  BOOST_TEST(shortest(0.1) == "0.1");
  BOOST_TEST(shortest(-0.0) == "0");
  BOOST_TEST(json_text(Json(NAN)) == "null\n");
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
  for (const double unknown : {static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    BOOST_TEST(known_digits(1.0, unknown) == 0);
    BOOST_TEST(known_digits(unknown, 0) == 0);
  }
}

BOOST_AUTO_TEST_CASE(a_sum_is_known_as_well_as_its_parts_together_and_not_at_all_with_an_unknown_one) {
  const Estimated sum = Estimated{1, 0.01} + Estimated{-1, 0.02};
  BOOST_TEST(sum.error == 0.03, boost::test_tools::tolerance(1e-15));
  for (const double unknown : {static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
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

BOOST_AUTO_TEST_CASE(csv_quotes_what_needs_it_and_tables_align_by_display_width) {
  Table table{.head = {"head"}, .columns = {{"a", "α", "°"}, {"b", "b", ""}}, .rows = {}, .notes = {"note"}};
  table.rows.push_back({Cell(1.5, 3), Cell("x,\"y\"")});
  BOOST_TEST(table_text(table, {Format::csv, false}) == "# head\na,b\n1.5,\"x,\"\"y\"\"\"\n# note\n");
  for (const char c : table_text(table, {Format::table, true})) BOOST_TEST((c & 0x80) == 0);
  BOOST_TEST(display_width("Ω [°]") == 5u);
  BOOST_TEST(display_width(wrapped(std::string(60, 'a') + " " + std::string(60, 'b')).substr(0, 60)) == 60u);
}

BOOST_AUTO_TEST_CASE(the_nearest_name_is_the_one_with_fewest_changes) {
  BOOST_TEST(nearest_name("sequnce", {"angles", "sequence", "explain"}) == "sequence");
}
