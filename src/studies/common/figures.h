#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ifov::studies {

/// One number that a study found, and what is asked of it.
struct Figure {
  std::string name;    ///< stable from release to release, snake_case
  double value = 0.0;  ///< not finite: nothing was found (null in JSON)
  std::string unit;
  std::string must;        ///< "<= 185", "1109 to 1129"; empty where nothing is asked
  std::optional<bool> ok;  ///< absent where nothing is asked
  std::string meaning;     ///< plain words, for tables
};

class FigureTable {
 public:
  void report(std::string name, double value, std::string unit, std::string meaning);
  void at_most(std::string name, double value, double limit, std::string unit, std::string meaning);
  void at_least(std::string name, double value, double limit, std::string unit, std::string meaning);
  void between(std::string name, double value, double low, double high, std::string unit,
               std::string meaning);

  void append(const FigureTable& other) {
    figures_.insert(figures_.end(), other.figures_.begin(), other.figures_.end());
  }

  const std::vector<Figure>& figures() const { return figures_; }
  bool all_met() const;

  /// {"name": {"value": …, "unit": …, "must": …, "ok": …, "meaning": …}, …}
  std::string json() const;
  /// A table for a terminal, one row a figure.
  std::string text() const;
  std::string html() const;

 private:
  void add(Figure figure) { figures_.push_back(std::move(figure)); }
  std::vector<Figure> figures_;
};

/// A number for people: at most six significant digits, "-" where it is not finite.
std::string number_text(double value);

}  // namespace ifov::studies
