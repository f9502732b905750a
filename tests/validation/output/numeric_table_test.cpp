// SPDX-License-Identifier: GPL-3.0-or-later
// CSV files of others: what is read, and what is said of those that cannot be.
#include "validation/output/numeric_table.hpp"

#include "tests/support.hpp"
#include "validation/output/bad_input.hpp"

namespace {

using namespace clatter::validation;

const TableRequest motion{.required = {"t", "x"}, .optional = {"z"}, .words = {}, .names = {}};

NumericTable parsed(const std::string& text, const TableRequest& request = motion) {
  return NumericTable::parse("file.csv", text, request);
}

std::string error_of(const std::string& text, const TableRequest& request = motion) {
  try {
    parsed(text, request);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

BOOST_AUTO_TEST_CASE(numbers_stand_by_rows_with_their_lines_however_the_file_is_written) {
  const std::string plain = "# step: 0.01\n\nt,x,z\n0,1e-3,-.5\n\n# a remark\n+1.5,2.,3\n";
  std::string dos;
  for (const char c : plain) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const std::string quoted = "# step: 0.01\n\n\"t\", x ,\"z\"\n \"0\" ,\" 1e-3\",-.5\n\n\n\"+1.5\",2., 3 \n";
  const std::string semicolons = "# step: 0.01\n\nt;x;z\n0;1e-3;-.5\n\n\n1.5;2;3";
  const std::string tabs = "\xEF\xBB\xBF# step: 0.01\n\nt\tx\tz\n0\t1e-3\t-.5\n\n\n1.5\t2\t3";
  for (const std::string& text : {plain, dos, quoted, semicolons, tabs}) {
    const NumericTable table = parsed(text);
    BOOST_TEST_REQUIRE(table.rows() == 2U);
    BOOST_TEST(table.columns() == (std::vector<std::string>{"t", "x", "z"}), boost::test_tools::per_element());
    BOOST_TEST((table.at(0, 0) == 0 && table.at(0, 1) == 1e-3 && table.at(0, 2) == -0.5));
    BOOST_TEST((table.row(1)[0] == 1.5 && table.row(1)[1] == 2 && table.row(1)[2] == 3));
    BOOST_TEST(table.line(0) == 4U);
    BOOST_TEST(table.line(1) == 7U);
    BOOST_TEST(table.comment("step").value() == "0.01");
    BOOST_TEST(!table.comment("engine").has_value());
  }
}

BOOST_AUTO_TEST_CASE(columns_are_found_by_name_or_by_the_name_that_is_mapped_and_others_are_left_alone) {
  TableRequest request = motion;
  request.words = {"place"};
  request.names = read_column_names("--columns", "t=time, place=end ,z=height of centre");
  const NumericTable table =
      parsed("x,end,remark,height of centre,time,t\n1,a,\"one, \"\"two\"\"\",3,4,5\n6,\"b,c\",nan,7,8,\n", request);
  BOOST_TEST(table.at(0, table.column("t").value()) == 4);
  BOOST_TEST(table.at(1, table.column("z").value()) == 7);
  BOOST_TEST(table.at(1, table.column("x").value()) == 6);
  BOOST_TEST(table.word(0, "place") == "a");
  BOOST_TEST(table.word(1, "place") == "b,c");
  BOOST_TEST(!table.column("remark").has_value());
  // A column that may be missing must be there once its name is given.
  BOOST_TEST(
      error_of("t,x\n1,2\n", {.required = {"t", "x"}, .optional = {"z"}, .words = {}, .names = {{"z", "height"}}})
          .starts_with("file.csv:1:1: no column height; there are t x"));
}

BOOST_AUTO_TEST_CASE(a_malformed_file_is_one_line_with_file_line_and_column) {
  const std::pair<const char*, const char*> cases[]{
      {"", "file.csv: is empty, must be a CSV file with a header and rows"},
      {"# only: words\n\n", "file.csv: is empty, must be a CSV file with a header and rows"},
      {"t,x\n", "file.csv:1:1: no row below the header"},
      {"t,y\n1,2\n", "file.csv:1:1: no column x; there are t y (--columns NAME=COLUMN maps names)"},
      {"0,0.5,0\n1,2,3\n", "file.csv:1:1: the first line has numbers, must name the columns"},
      {"t,x,t\n1,2,3\n", "file.csv:1:5: column t is there twice"},
      {"t,x\n1,2\n\n3\n", "file.csv:4:2: 1 fields, must be 2 as in the header"},
      {"t,x\r\n1,2\r\n3,4,5\r\n", "file.csv:3:5: more fields than the header's 2"},
      {"t,x\n1,nan\n", "file.csv:2:3: x = nan: must be a finite number"},
      {"t,x\n1,-inf\n", "file.csv:2:3: x = -inf: must be a finite number"},
      {"t,x\n1,1e400\n", "file.csv:2:3: x = 1e400: must be a finite number"},
      {"t,x\n1,0x10\n", "file.csv:2:3: x = 0x10: must be a finite number"},
      {"t,x\n1,+-2\n", "file.csv:2:3: x = +-2: must be a finite number"},
      {"t,x\n12,\n", "file.csv:2:4: x = (empty): must be a finite number"},
      {"t,x\n12, 3 4\n", "file.csv:2:4: x = 3 4: must be a finite number"},
      {"t;x\n1,5;2\n", "file.csv:2:1: t = 1,5: must be a finite number"},
      {"t,x\n\"1,2\n", "file.csv:2:1: a quote is not closed"},
      {"t,x\n\"1\"2,3\n", "file.csv:2:1: a quote is not closed"},
  };
  for (const auto& [text, words] : cases) BOOST_TEST(error_of(text) == words);
  BOOST_TEST(error_of(std::string("t,x\n1,\0002\n", 9)) == "file.csv:2:3: byte 0: must be text");
  BOOST_TEST(error_of("\x7f\x45LF\x02\n").find('\n') == std::string::npos);
  BOOST_TEST(parsed("t,x\n1,1e-400\n").at(0, 1) == 0);  // too small for a double
  const NumericTable table = parsed("# step: 1\n# step: 2\nx,t\n 1,  25\n");
  CHECK_REFUSED_SAYING(table.comment("step"), BadInput, "file.csv:2:1: step is given twice");
  CHECK_REFUSED_SAYING(table.refuse(0, "t", "above 30"), BadInput, "file.csv:4:4: t = 25: must be above 30");
}

BOOST_AUTO_TEST_CASE(a_mapping_of_columns_that_cannot_be_used_and_a_file_that_is_none_are_refused) {
  for (const char* text : {"", "t", "t=", "=time", "t=a,t=b", ","})
    CHECK_REFUSED(read_column_names("--columns", text), BadInput);
  for (const std::string path : {"/", "no/such/file.csv"})
    CHECK_REFUSED_SAYING(NumericTable::read(path, motion), BadInput, path + ": ");
  TableRequest request = motion;
  request.names = {{"tt", "time"}};
  BOOST_TEST(error_of("t,x\n1,2\n", request) == "--columns: unknown column tt; did you mean t?");
}

BOOST_AUTO_TEST_CASE(damaged_files_are_read_or_refused_in_one_line) {
  std::mt19937 random(11);
  const std::string whole = "# engine: some engine\nt,x,\"z\"\n0,1e-3,-.5\n1,2,3\n1.5,\"2\",3e5\n";
  int refused = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = whole;
    for (unsigned damage = random() % 4 + 1; damage > 0; --damage) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0: text[at] = static_cast<char>(random() % 256); break;
        case 1: text.erase(at, random() % 5); break;
        default: text.insert(at, std::string(1, ",;\"\n\r#\0e"[random() % 8]));
      }
    }
    const std::string error = error_of(text);
    refused += error != "no error";
    BOOST_TEST(error.find('\n') == std::string::npos);
    BOOST_TEST((error == "no error" || error.starts_with("file.csv:")));
  }
  BOOST_TEST(refused > 1000);
}
