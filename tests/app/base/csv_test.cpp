// The quoting rules of CSV fields (RFC 4180, section 2).
#include "app/base/csv.h"

#include <utility>

#include <doctest/doctest.h>

using namespace gearshift::base;

TEST_CASE("a field is quoted only where necessary") {
  CHECK(csv_field("plain words") == "plain words");
  CHECK(csv_field("") == "");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"no\"") == "\"say \"\"no\"\"\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
  CHECK(csv_field("a\rb") == "\"a\rb\"");
  CHECK(csv_field("\"") == "\"\"\"\"");
}

TEST_CASE("a table has one line per record") {
  CsvTable table;
  table.texts({"what", "value"}).end();
  table.text("half, or so").number(0.5).end();
  table.text("zero").number(-0.0).end();
  CHECK(std::move(table).take() == "what,value\r\n\"half, or so\",0.5\r\nzero,0\r\n");
}

TEST_CASE("a table for spreadsheets: byte order mark, another separator, decimal comma") {
  CsvTable table({';', true, true});
  table.text("half, or so").text("a;b").number(-0.5).number(1e-9).number(3).end();
  CHECK(std::move(table).take() == "\xef\xbb\xbfhalf, or so;\"a;b\";-0,5;1e-09;3\r\n");
  CsvTable quoted({',', true, false});
  quoted.number(0.5).number(7.0).end();
  CHECK(std::move(quoted).take() == "\"0,5\",7\r\n");
  CHECK(csv_field("a;b\tc", '\t') == "\"a;b\tc\"");
}

// OWASP, CSV Injection: cells that begin with = + - @, also full-width.
TEST_CASE("a text that would be a formula gets an apostrophe; numbers and single signs do not") {
  CsvTable table;
  table.text("=1+1").text("+1").text("-2+3").text("@SUM(1)").text("\uff1d1").text("-").text("a=1").number(-2.5).end();
  CHECK(std::move(table).take() == "'=1+1,'+1,'-2+3,'@SUM(1),'\uff1d1,-,a=1,-2.5\r\n");
}

TEST_CASE("a field has printable lines") {
  CsvTable table;
  table.text("red\x1b[31m\nabc\u202e").end();
  CHECK(std::move(table).take() == "\"red?[31m\nabc?\"\r\n");
}
