// Scatter plots of cost against error on logarithmic axes, as SVG.
#pragma once

#include <string>
#include <vector>

namespace oriel::trade {

struct Dot {
  double x = 0, y = 0;  // what is not above 0 is drawn at the axis
  std::string label;    // drawn beside dots of the front
  std::string tip;      // shown when pointed at
  int group = 0;        // its colour: an index into plot_colours(), repeated
  bool on_front = false;
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<Dot> dots;
};

// One <svg> element; the front is a line of steps through its dots.
std::string plot_svg(const Plot& plot);

// Of groups, as CSS colours.
const std::vector<std::string>& plot_colours();

}  // namespace oriel::trade
