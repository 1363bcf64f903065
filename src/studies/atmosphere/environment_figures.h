#pragma once

namespace ifov::studies {

class FigureTable;

/// The environment function F(r) against 6S's and, for thin haze, against light scattered once in closed form.
void add_environment_figures(FigureTable& figures);

}  // namespace ifov::studies
