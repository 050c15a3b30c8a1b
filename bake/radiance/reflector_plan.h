// The views of one reflector, element by element.
#pragma once

#include "bake/radiance/choice.h"
#include "bake/radiance/elements.h"

namespace oriel {

struct ElementPlan {
  Element window;
  std::vector<Vec3> candidates;  // viewpoints, reflector space
  std::vector<Choice> choices;   // one a resolution
  Choice choice;                 // the best of them at the price of the day
  double weight = 0;             // of its samples
};
inline void fields(Archive& archive, ElementPlan& e) {
  archive(e.window.lower, e.window.upper, e.window.index, e.candidates, e.choices, e.choice, e.weight);
}

struct ReflectorPlan {
  ElementGrid grid;
  std::vector<ElementPlan> elements;

  // Shares of the samples' weight.
  double seen() const { return mean(&Choice::seen); }
  double sharp() const { return mean(&Choice::sharp); }
  double weight() const {
    double sum = 0;
    for (const ElementPlan& e : elements) sum += e.weight;
    return sum;
  }
  double value(double price) const {
    double sum = 0;
    for (const ElementPlan& e : elements) sum += e.choice.value(price);
    return sum;
  }

 private:
  double mean(double (Choice::*share)() const) const {
    double sum = 0, total = 0;
    for (const ElementPlan& e : elements) {
      sum += e.weight * (e.choice.*share)();
      total += e.weight;
    }
    return total > 0 ? sum / total : 1;
  }
};
inline void fields(Archive& archive, ReflectorPlan& plan) {
  archive(plan.grid.x, plan.grid.y, plan.elements);
}

}  // namespace oriel
