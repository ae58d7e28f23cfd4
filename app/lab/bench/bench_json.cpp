#include "app/lab/bench/bench_files.h"
#include "app/lab/bench/row_json.h"

namespace gearshift::lab {
namespace {

using Json = nlohmann::ordered_json;

void add_spread(Json& json, const std::optional<Quartiles>& spread) {
  if (spread) json["quartiles"] = {spread->low, spread->high};
}

Json figure_json(const RelatedFigure& figure) {
  Json json{{"what", figure.what}, {"value", figure.value}, {"unit", figure.unit}};
  add_spread(json, figure.spread);
  return json;
}

Json trade_json(const Trade& trade) {
  return {{"contest", trade.contest},
          {"method", trade.method},
          {"cost", figure_json(trade.cost)},
          {"error", figure_json(trade.error)},
          {"chosen", trade.chosen}};
}

Json since_json(const SinceLast& since) {
  return {{"date", since.date},   {"program", since.program}, {"taken", since.contention},
          {"value", since.value}, {"ratio", since.ratio},     {"changed", since.changed}};
}

Json machine_json(const Machine& machine) {
  return {{"cpu", machine.cpu},       {"cores", machine.cores},       {"gpu", machine.gpu},
          {"system", machine.system}, {"compiler", machine.compiler}, {"build", machine.build}};
}

}  // namespace

Json row_json(const BenchRow& row) {
  Json json{{"family", row.family}, {"name", row.name}, {"unit", row.unit}, {"note", row.note}};
  json["value"] = row.measured ? Json(row.value) : Json();
  add_spread(json, row.spread);
  if (row.goal) json["goal"] = *row.goal;
  if (row.goal) json["goal_is"] = goal_direction(row);
  if (row.goal && row.measured) json["verdict"] = format_verdict(row);
  if (row.design != Design::none) json["design"] = design_row_name(row);
  for (const RelatedFigure& more : row.related) json["beside"].push_back(figure_json(more));
  if (row.trade) json["trade"] = trade_json(*row.trade);
  return json;
}

std::string bench_json(const BenchRun& run) {
  Json rows = Json::array();
  for (const MeasuredRow& measured : run.rows) {
    rows.push_back(row_json(measured.row));
    if (measured.since) rows.back()["last"] = since_json(*measured.since);
    if (measured.cost_since) rows.back()["last_cost"] = since_json(*measured.cost_since);
  }
  Json json{{"program", run.program}, {"date", run.date}, {"quick", run.quick}, {"machine", machine_json(run.machine)}};
  if (run.contention)
    json["taken"] = {{"by_host", run.contention->by_host}, {"by_programs", run.contention->by_programs}};
  json["rows"] = rows;
  return json.dump(2) + "\n";
}

}  // namespace gearshift::lab
