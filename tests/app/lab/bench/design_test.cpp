// Tests the check that the rows of a bench run cover every requirement of the design. Every bench run makes this check.
#include "app/lab/bench/rows/design.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/app/lab/bench/constructed_run.h"

using namespace gearshift::lab;
using namespace gearshift::test;

namespace {

std::vector<BenchRow> one_for_plant(const BenchOptions&) {
  BenchRow row = plain_row("walk", "a", 1.0);
  row.design = Design::plant;
  return {row, plain_row("walk", "b", 1.0)};
}

}  // namespace

TEST_CASE("each row of the design is claimed by a family, and no family claims a row that does not exist") {
  std::set<Design> asked, claimed;
  for (const DesignRow& row : kDesignRows) asked.insert(row.key);
  for (const NamedFamily& family : bench_families()) claimed.insert(family.answers.begin(), family.answers.end());
  CHECK(asked.size() == kDesignRows.size());
  CHECK(asked.size() == static_cast<std::size_t>(Design::score));  // the last requirement
  CHECK(claimed == asked);
}

TEST_CASE("a family must deliver exactly what it claims") {
  CHECK(run_family({"walk", one_for_plant, {Design::plant}}, {}).size() == 2);
  CHECK_THROWS_AS(run_family({"walk", one_for_plant}, {}), std::logic_error);
  CHECK_THROWS_AS(run_family({"walk", one_for_plant, {Design::plant, Design::wall}}, {}), std::logic_error);
}
