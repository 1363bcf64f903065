#include "studies/common/figures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/format.h"
#include "io/json/json_writer.h"
#include "studies/common/html_page.h"

namespace ifov::studies {

std::string number_text(double value) { return std::isfinite(value) ? format("{:.6g}", value) : "-"; }

void FigureTable::report(std::string name, double value, std::string unit, std::string meaning) {
  add({std::move(name), value, std::move(unit), "", std::nullopt, std::move(meaning)});
}

void FigureTable::at_most(std::string name, double value, double limit, std::string unit,
                          std::string meaning) {
  add({std::move(name), value, std::move(unit), format("<= {:g}", limit), value <= limit,
       std::move(meaning)});
}

void FigureTable::at_least(std::string name, double value, double limit, std::string unit,
                           std::string meaning) {
  add({std::move(name), value, std::move(unit), format(">= {:g}", limit), value >= limit,
       std::move(meaning)});
}

void FigureTable::between(std::string name, double value, double low, double high, std::string unit,
                          std::string meaning) {
  const std::string must = low == high ? format("= {:.10g}", low) : format("{:.10g} to {:.10g}", low, high);
  add({std::move(name), value, std::move(unit), must, value >= low && value <= high, std::move(meaning)});
}

bool FigureTable::all_met() const {
  return std::all_of(figures_.begin(), figures_.end(), [](const Figure& f) { return f.ok.value_or(true); });
}

namespace {

std::string verdict(const Figure& figure) { return !figure.ok ? "" : *figure.ok ? "ok" : "NO"; }

}  // namespace

std::string FigureTable::json() const {
  io::JsonWriter json(io::JsonWriter::Layout::indented);
  json.object([&] {
    for (const Figure& f : figures_)
      json.object(f.name, [&] {
        json.member("value", f.value);
        json.member("unit", f.unit);
        json.member("must", f.must);
        json.key("ok");
        f.ok ? json.value(*f.ok) : json.null();
        json.member("meaning", f.meaning);
      });
  });
  return json.written();
}

std::string FigureTable::text() const {
  std::size_t name = 6, unit = 4, must = 4;
  for (const Figure& f : figures_) {
    name = std::max(name, f.name.size());
    unit = std::max(unit, f.unit.size());
    must = std::max(must, f.must.size());
  }
  std::string out;
  const auto row = [&](const std::string& a, const std::string& b, const std::string& c, const std::string& d,
                       const std::string& e) {
    std::string line = format("{:<{}}  {:>12}  {:<{}}  {:<{}}  {}", a, name, b, c, unit, d, must, e);
    out += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  };
  row("figure", "value", "unit", "must", "");
  for (const Figure& f : figures_) row(f.name, number_text(f.value), f.unit, f.must, verdict(f));
  return out;
}

std::string FigureTable::html() const {
  std::string out = "<table class=\"figures\"><tr><th>figure</th><th>value</th><th>must</th><th></th></tr>\n";
  for (const Figure& f : figures_) {
    const std::string colour = !f.ok ? "" : *f.ok ? " class=\"met\"" : " class=\"missed\"";
    out += format(
        "<tr><td>{}<br><small>{}</small></td><td class=\"n\">{} {}</td><td>{}</td><td{}>{}</td></tr>\n",
        html_text(f.meaning), html_text(f.name), number_text(f.value), html_text(f.unit), html_text(f.must),
        colour, verdict(f));
  }
  return out + "</table>\n";
}

}  // namespace ifov::studies
